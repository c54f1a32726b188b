// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/precision/spirv_module.h"

#include "formats/base/assert.h"

namespace hearth::test
{

namespace
{

constexpr size_t kHeaderWords = 5;

} // namespace

SpirvModule::SpirvModule(std::span<const uint32_t> words) : words_(words)
{
    HEARTH_ASSERT(words.size() > kHeaderWords && words[0] == spv::MagicNumber);
    bool in_function = false;
    for (size_t at = kHeaderWords; at < words.size();)
    {
        const size_t length = words[at] >> spv::WordCountShift;
        HEARTH_ASSERT(length > 0 && at + length <= words.size());
        SpirvInstruction instruction{static_cast<spv::Op>(words[at] & spv::OpCodeMask),
                                     words.subspan(at, length), in_function, 0, 0};
        at += length;
        bool has_result = false, has_type = false;
        spv::HasResultAndType(instruction.op, &has_result, &has_type);
        instruction.type = has_type ? instruction.words[1] : 0;
        instruction.result = has_result ? instruction.words[has_type ? 2 : 1] : 0;
        const auto operand = [&](size_t index) { return instruction.words[index]; };
        switch (instruction.op)
        {
        case spv::OpDecorate:
            if (operand(2) == spv::DecorationRelaxedPrecision)
                relaxed_.insert(operand(1));
            has_relaxed_ |= operand(2) == spv::DecorationRelaxedPrecision;
            break;
        case spv::OpMemberDecorate:
            has_relaxed_ |= operand(3) == spv::DecorationRelaxedPrecision;
            break;
        case spv::OpTypeFloat:
            if (operand(2) == 32)
            {
                float_type_ = instruction.result;
                float_sizes_[instruction.result] = 1;
            }
            break;
        case spv::OpTypeVector:
            if (operand(2) == float_type_)
                float_sizes_[instruction.result] = operand(3);
            break;
        case spv::OpFunction:
            in_function = true;
            break;
        case spv::OpFunctionEnd:
            in_function = false;
            break;
        default:
            break;
        }
        if (has_result)
            definitions_[instruction.result] = instructions_.size();
        instructions_.push_back(instruction);
    }
}

uint32_t SpirvModule::floatSize(uint32_t type) const
{
    const auto found = float_sizes_.find(type);
    return found == float_sizes_.end() ? 0 : found->second;
}

uint32_t SpirvModule::valueType(uint32_t id) const
{
    const SpirvInstruction* found = definition(id);
    return found == nullptr ? 0 : found->type;
}

const SpirvInstruction* SpirvModule::definition(uint32_t id) const
{
    const auto found = definitions_.find(id);
    return found == definitions_.end() ? nullptr : &instructions_[found->second];
}

bool SpirvModule::isArithmetic(const SpirvInstruction& instruction) const
{
    if (!instruction.in_function || floatSize(instruction.type) == 0)
        return false;
    switch (instruction.op)
    {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpDot:
        return true;
    case spv::OpExtInst: // of GLSL: the only set
        return floatSize(valueType(instruction.words[5])) > 0;
    default:
        return false;
    }
}

} // namespace hearth::test
