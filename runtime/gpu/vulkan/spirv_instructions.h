// Instructions of SPIR-V modules, as far as specialization needs to know them. SPIR-V Specification
// 1.3, 3.32, "Instructions".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>

namespace hearth::gpu
{

/// Numbers of instructions.
enum Opcode : uint32_t
{
    kOpUndef = 1,
    kOpName = 5,
    kOpLine = 8,
    kOpExtInst = 12,
    kOpTypeBool = 20,
    kOpTypeInt = 21,
    kOpConstantTrue = 41,
    kOpConstantFalse = 42,
    kOpConstant = 43,
    kOpConstantComposite = 44,
    kOpSpecConstantTrue = 48,
    kOpSpecConstantFalse = 49,
    kOpSpecConstant = 50,
    kOpSpecConstantComposite = 51,
    kOpSpecConstantOp = 52,
    kOpFunction = 54,
    kOpFunctionEnd = 56,
    kOpFunctionCall = 57,
    kOpLoad = 61,
    kOpAccessChain = 65,
    kOpInBoundsAccessChain = 66,
    kOpArrayLength = 68,
    kOpDecorate = 71,
    kOpVectorExtractDynamic = 77, // first of those that take vectors apart and join them
    kOpTranspose = 84,            // last of them
    kOpSampledImage = 86,         // first of those that read images
    kOpImageRead = 98,            // last of them
    kOpImage = 100,               // first of queries of images
    kOpImageQuerySamples = 107,   // last of them
    kOpConvertFToU = 109,         // first conversion
    kOpBitcast = 124,             // last conversion
    kOpSNegate = 126,             // first of arithmetic
    kOpIAdd = 128,
    kOpISub = 130,
    kOpIMul = 132,
    kOpSMulExtended = 152, // last of arithmetic
    kOpAny = 154,          // first of comparisons
    kOpLogicalEqual = 164,
    kOpLogicalNotEqual = 165,
    kOpLogicalOr = 166,
    kOpLogicalAnd = 167,
    kOpLogicalNot = 168,
    kOpSelect = 169,
    kOpIEqual = 170,
    kOpINotEqual = 171,
    kOpUGreaterThan = 172,
    kOpSGreaterThan = 173,
    kOpUGreaterThanEqual = 174,
    kOpSGreaterThanEqual = 175,
    kOpULessThan = 176,
    kOpSLessThan = 177,
    kOpULessThanEqual = 178,
    kOpSLessThanEqual = 179,
    kOpFUnordGreaterThanEqual = 191, // last of comparisons
    kOpShiftRightLogical = 194,      // first of operations on bits
    kOpShiftLeftLogical = 196,
    kOpBitwiseOr = 197,
    kOpBitwiseXor = 198,
    kOpBitwiseAnd = 199,
    kOpNot = 200,
    kOpBitCount = 205, // last of operations on bits
    kOpDPdx = 207,     // first derivative
    kOpFwidthCoarse = 215,
    kOpAtomicLoad = 227, // first atomic operation
    kOpAtomicStore = 228,
    kOpAtomicXor = 242, // last atomic operation
    kOpPhi = 245,
    kOpLoopMerge = 246,
    kOpSelectionMerge = 247,
    kOpLabel = 248,
    kOpBranch = 249,
    kOpBranchConditional = 250,
    kOpSwitch = 251,
    kOpUnreachable = 255,
    kOpNoLine = 317,
    kOpDecorateId = 332,
};

inline constexpr uint32_t kHeaderWords = 5;
inline constexpr uint32_t kDecorationSpecId = 1;
inline constexpr uint32_t kDecorationDescriptorSet = 34;
inline constexpr uint32_t kExtendedModf = 35; // of GLSL.std.450: these two write through a pointer
inline constexpr uint32_t kExtendedFrexp = 51;

using Words = std::span<const uint32_t>;

inline uint32_t opcode(Words instruction)
{
    return instruction[0] & 0xFFFFu;
}

constexpr uint32_t firstWord(uint32_t op, uint32_t words)
{
    return words << 16 | op;
}

/// True for an instruction with a type and a result, in words 1 and 2, and no other effect.
inline bool isPure(Words instruction)
{
    const uint32_t op = opcode(instruction);
    const auto within = [op](uint32_t first, uint32_t last) { return op >= first && op <= last; };
    if (op == kOpExtInst)
        return instruction[4] != kExtendedModf && instruction[4] != kExtendedFrexp;
    return op == kOpLoad || op == kOpAccessChain || op == kOpInBoundsAccessChain || op == kOpArrayLength ||
           op == kOpPhi || within(kOpVectorExtractDynamic, kOpTranspose) ||
           within(kOpSampledImage, kOpImageRead) || within(kOpImage, kOpImageQuerySamples) ||
           within(kOpConvertFToU, kOpBitcast) || within(kOpSNegate, kOpSMulExtended) ||
           within(kOpAny, kOpFUnordGreaterThanEqual) || within(kOpShiftRightLogical, kOpBitCount) ||
           within(kOpDPdx, kOpFwidthCoarse);
}

/// True for an instruction with a result, in word 2.
inline bool hasResult(Words instruction)
{
    const uint32_t op = opcode(instruction);
    return isPure(instruction) || op == kOpUndef || op == kOpFunctionCall ||
           (op >= kOpAtomicLoad && op <= kOpAtomicXor && op != kOpAtomicStore);
}

} // namespace hearth::gpu
