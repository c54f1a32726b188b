// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/precision/relaxed_precision.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"
#include "tests/runtime/gpu/precision/spirv_module.h"

#include <algorithm>
#include <spirv_cross/GLSL.std.450.h>
#include <utility>

namespace hearth::test
{

namespace
{

/// Walks from places in textures back to the values that they are computed from.
class PlaceTracer
{
public:
    explicit PlaceTracer(std::span<const uint32_t> words) : module_(words)
    {
        for (const SpirvInstruction& instruction : module_.instructions())
            if (instruction.op == spv::OpStore)
                stores_[baseVariable(instruction.words[1])].push_back(instruction.words[2]);
    }

    std::vector<std::string> find()
    {
        for (const SpirvInstruction& instruction : module_.instructions())
            addPlaces(instruction);
        while (!open_.empty())
        {
            const uint32_t id = open_.back();
            open_.pop_back();
            if (visited_.insert(id).second)
                visit(id);
        }
        return std::move(found_);
    }

private:
    void addPlaces(const SpirvInstruction& instruction)
    {
        const auto words = instruction.words;
        switch (instruction.op)
        {
        case spv::OpImageSampleDrefImplicitLod:
        case spv::OpImageSampleDrefExplicitLod:
            open_.insert(open_.end(), {words[4], words[5]});
            break;
        case spv::OpImageSampleExplicitLod:
            if (words[5] == spv::ImageOperandsGradMask)
                open_.insert(open_.end(), {words[4], words[6], words[7]});
            break;
        default:
            break;
        }
    }

    /// Return the variable that a pointer points into.
    uint32_t baseVariable(uint32_t pointer) const
    {
        const SpirvInstruction* at = module_.definition(pointer);
        while (at != nullptr && at->op == spv::OpAccessChain)
            at = module_.definition(at->words[3]);
        return at == nullptr ? 0 : at->result;
    }

    void visit(uint32_t id)
    {
        const SpirvInstruction* at = module_.definition(id);
        if (at == nullptr || !at->in_function)
            return;
        if (module_.isRelaxed(id) && module_.floatSize(at->type) > 0)
            found_.push_back("value " + std::to_string(id) + " of opcode " + std::to_string(at->op));
        const auto words = at->words;
        const auto follow = [&](size_t first, size_t end, size_t step = 1)
        {
            for (size_t i = first; i < std::min(end, words.size()); i += step)
                open_.push_back(words[i]);
        };
        switch (at->op)
        {
        case spv::OpLoad:
            if (const auto stored = stores_.find(baseVariable(words[3])); stored != stores_.end())
                open_.insert(open_.end(), stored->second.begin(), stored->second.end());
            break;
        case spv::OpCompositeExtract:
            follow(3, 4);
            break;
        case spv::OpCompositeInsert:
        case spv::OpVectorShuffle:
            follow(3, 5);
            break;
        case spv::OpPhi:
            follow(3, words.size(), 2);
            break;
        case spv::OpExtInst:
            follow(5, words.size());
            break;
        case spv::OpFunctionCall:
            found_.push_back("function " + std::to_string(words[3]) + " is not inlined");
            break;
        default:
            follow(3, words.size());
            break;
        }
    }

    SpirvModule module_;
    std::map<uint32_t, std::vector<uint32_t>> stores_; ///< values stored in each variable
    std::vector<uint32_t> open_;
    std::set<uint32_t> visited_;
    std::vector<std::string> found_;
};

/// Writes a module in which relaxed values are rounded.
class HalfRounder
{
public:
    explicit HalfRounder(std::span<const uint32_t> words) : module_(words), bound_(module_.bound()) {}

    std::vector<uint32_t> rewrite()
    {
        const auto header = module_.words().first(5);
        out_.assign(header.begin(), header.end());
        for (const SpirvInstruction& instruction : module_.instructions())
            rewrite(instruction);
        out_[3] = bound_;
        return std::move(out_);
    }

private:
    void rewrite(const SpirvInstruction& instruction)
    {
        if (instruction.op != spv::OpPhi)
            roundPhis();
        const bool relaxed = module_.isRelaxed(instruction.result);
        if (!relaxed || module_.floatSize(instruction.type) == 0)
            return copy(instruction.words);
        if (!instruction.in_function)
            return copyConstant(instruction);
        if (instruction.op == spv::OpPhi)
        {
            const uint32_t full = bound_++;
            copyWithResult(instruction.words, full);
            phis_.push_back({instruction.type, instruction.result, full});
            return;
        }
        if (!module_.isArithmetic(instruction))
        {
            const uint32_t full = bound_++;
            copyWithResult(instruction.words, full);
            return put(spv::OpQuantizeToF16, {instruction.type, instruction.result, full});
        }
        const uint32_t full = compute(instruction);
        put(spv::OpQuantizeToF16, {instruction.type, instruction.result, full});
    }

    struct Phi
    {
        uint32_t type, result, full;
    };

    /// Phis stand together at the start of a block: their rounding follows the last.
    void roundPhis()
    {
        for (const Phi& phi : std::exchange(phis_, {}))
            put(spv::OpQuantizeToF16, {phi.type, phi.result, phi.full});
    }

    void copy(std::span<const uint32_t> words) { out_.insert(out_.end(), words.begin(), words.end()); }

    void copyWithResult(std::span<const uint32_t> words, uint32_t result)
    {
        copy(words);
        out_[out_.size() - words.size() + 2] = result;
    }

    void copyConstant(const SpirvInstruction& constant)
    {
        copy(constant.words);
        if (constant.op == spv::OpConstant)
            out_.back() = std::bit_cast<uint32_t>(
                floatFromHalf(halfFromFloat(std::bit_cast<float>(constant.words[3]))));
    }

    void put(spv::Op op, std::initializer_list<uint32_t> operands)
    {
        out_.push_back(static_cast<uint32_t>(operands.size() + 1) << spv::WordCountShift | op);
        out_.insert(out_.end(), operands);
    }

    uint32_t emit(spv::Op op, uint32_t type, std::initializer_list<uint32_t> operands)
    {
        out_.push_back(static_cast<uint32_t>(operands.size() + 3) << spv::WordCountShift | op);
        out_.insert(out_.end(), {type, bound_});
        out_.insert(out_.end(), operands);
        return bound_++;
    }

    uint32_t round(uint32_t type, uint32_t value) { return emit(spv::OpQuantizeToF16, type, {value}); }

    uint32_t rounded(spv::Op op, uint32_t type, std::initializer_list<uint32_t> operands)
    {
        return round(type, emit(op, type, operands));
    }

    /// Call a function of GLSL and round the result.
    uint32_t roundedCall(uint32_t set, GLSLstd450 function, uint32_t type, uint32_t value)
    {
        return rounded(spv::OpExtInst, type, {set, static_cast<uint32_t>(function), value});
    }

    uint32_t dot(uint32_t vector_type, uint32_t a, uint32_t b)
    {
        const uint32_t scalar = module_.floatType();
        const uint32_t products = rounded(spv::OpFMul, vector_type, {a, b});
        uint32_t sum = emit(spv::OpCompositeExtract, scalar, {products, 0});
        for (uint32_t i = 1; i < module_.floatSize(vector_type); ++i)
            sum = rounded(spv::OpFAdd, scalar, {sum, emit(spv::OpCompositeExtract, scalar, {products, i})});
        return sum;
    }

    /// Write an instruction step by step, with rounded operands. Returns its result, of which the last step
    /// is not rounded.
    uint32_t compute(const SpirvInstruction& instruction)
    {
        std::vector<uint32_t> words(instruction.words.begin(), instruction.words.end());
        const bool call = instruction.op == spv::OpExtInst;
        std::vector<uint32_t> operands;
        for (size_t i = call ? 5 : 3; i < words.size(); ++i)
            if (const uint32_t type = module_.valueType(words[i]); module_.floatSize(type) > 0)
            {
                words[i] = round(type, words[i]);
                operands.push_back(words[i]);
            }
        const uint32_t type = instruction.type;
        if (instruction.op == spv::OpDot)
            return dot(module_.valueType(instruction.words[3]), operands[0], operands[1]);
        if (call)
            switch (const uint32_t set = words[3]; static_cast<GLSLstd450>(words[4]))
            {
            case GLSLstd450Fma:
                return emit(spv::OpFAdd, type,
                            {rounded(spv::OpFMul, type, {operands[0], operands[1]}), operands[2]});
            case GLSLstd450Pow:
            {
                const uint32_t log = roundedCall(set, GLSLstd450Log2, type, operands[0]);
                const uint32_t power = rounded(spv::OpFMul, type, {log, operands[1]});
                return emit(spv::OpExtInst, type, {set, GLSLstd450Exp2, power});
            }
            case GLSLstd450FMix:
            {
                const uint32_t step = rounded(spv::OpFSub, type, {operands[1], operands[0]});
                return emit(spv::OpFAdd, type,
                            {operands[0], rounded(spv::OpFMul, type, {step, operands[2]})});
            }
            case GLSLstd450Length:
                if (const uint32_t vector = module_.valueType(instruction.words[5]); vector != type)
                    return emit(spv::OpExtInst, type,
                                {set, GLSLstd450Sqrt, dot(vector, operands[0], operands[0])});
                break;
            case GLSLstd450Normalize:
                if (type != module_.floatType())
                {
                    const uint32_t square = dot(type, operands[0], operands[0]);
                    const uint32_t scale =
                        roundedCall(set, GLSLstd450InverseSqrt, module_.floatType(), square);
                    return emit(spv::OpVectorTimesScalar, type, {operands[0], scale});
                }
                break;
            default:
                break;
            }
        const uint32_t full = bound_++;
        copyWithResult(words, full);
        return full;
    }

    SpirvModule module_;
    uint32_t bound_;
    std::vector<uint32_t> out_;
    std::vector<Phi> phis_;
};

} // namespace

PrecisionCounts countPrecisions(std::span<const uint32_t> words)
{
    const SpirvModule module(words);
    PrecisionCounts counts;
    for (const SpirvInstruction& instruction : module.instructions())
        if (module.isArithmetic(instruction))
        {
            ++counts.arithmetic;
            counts.relaxed += module.isRelaxed(instruction.result) ? 1 : 0;
        }
    return counts;
}

bool hasRelaxedPrecision(std::span<const uint32_t> words)
{
    return SpirvModule(words).hasRelaxed();
}

std::vector<std::string> findRelaxedPlaces(std::span<const uint32_t> words)
{
    return PlaceTracer(words).find();
}

std::vector<uint32_t> relaxEverything(std::span<const uint32_t> words)
{
    const SpirvModule module(words);
    std::vector<uint32_t> out(words.begin(), words.begin() + 5);
    bool decorated = false;
    for (const SpirvInstruction& instruction : module.instructions())
    {
        if (instruction.op == spv::OpDecorate && !std::exchange(decorated, true))
            for (const SpirvInstruction& computed : module.instructions())
                if (module.isArithmetic(computed) && !module.isRelaxed(computed.result))
                    out.insert(out.end(), {3u << spv::WordCountShift | spv::OpDecorate, computed.result,
                                           spv::DecorationRelaxedPrecision});
        out.insert(out.end(), instruction.words.begin(), instruction.words.end());
    }
    return out;
}

std::vector<uint32_t> roundRelaxedToHalf(std::span<const uint32_t> words)
{
    return HalfRounder(words).rewrite();
}

} // namespace hearth::test
