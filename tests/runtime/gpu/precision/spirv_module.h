// Instructions of a SPIR-V module, with the types and precisions of its values.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv_cross/spirv.hpp>

namespace hearth::test
{

struct SpirvInstruction
{
    spv::Op op;
    std::span<const uint32_t> words; ///< with the first, which has opcode and length
    bool in_function;
    uint32_t type;   ///< 0: none
    uint32_t result; ///< 0: none
};

/// Parsed module; the words must outlive it.
class SpirvModule
{
public:
    explicit SpirvModule(std::span<const uint32_t> words);

    std::span<const uint32_t> words() const { return words_; }
    std::span<const SpirvInstruction> instructions() const { return instructions_; }
    uint32_t bound() const { return words_[3]; }

    bool isRelaxed(uint32_t id) const { return relaxed_.contains(id); }
    /// True if anything in the module, a member of a struct as well, has RelaxedPrecision.
    bool hasRelaxed() const { return has_relaxed_; }
    /// Number of components of a type of 32-bit floats: 1 a scalar, 0 another type.
    uint32_t floatSize(uint32_t type) const;
    uint32_t floatType() const { return float_type_; } ///< 0: none
    /// Id of a value's type; 0 if the id is no value.
    uint32_t valueType(uint32_t id) const;
    const SpirvInstruction* definition(uint32_t id) const;
    /// True for an instruction that computes floats from floats.
    bool isArithmetic(const SpirvInstruction& instruction) const;

private:
    std::span<const uint32_t> words_;
    std::vector<SpirvInstruction> instructions_;
    std::map<uint32_t, size_t> definitions_;
    std::map<uint32_t, uint32_t> float_sizes_;
    std::set<uint32_t> relaxed_;
    bool has_relaxed_ = false;
    uint32_t float_type_ = 0;
};

} // namespace hearth::test
