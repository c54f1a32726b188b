// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/specialized_shader.h"

#include "formats/base/assert.h"
#include "runtime/gpu/vulkan/spirv_instructions.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace hearth::gpu
{

namespace
{

/// Knowledge of a value: nothing yet, its bits, or that they differ from run to run.
struct Known
{
    enum class State : uint8_t
    {
        nothing,
        bits,
        varies,
    };
    State state = State::nothing;
    uint32_t bits = 0; ///< 0 or 1 of a boolean

    bool is(uint32_t value) const { return state == State::bits && bits == value; }
    bool operator==(const Known&) const = default;
};

constexpr Known kNothing{};
constexpr Known kVaries{Known::State::varies};

constexpr Known knownBits(uint32_t bits)
{
    return {Known::State::bits, bits};
}

/// Compute an operation of 32-bit integers or booleans; kVaries for others.
Known compute(uint32_t op, std::span<const Known> values)
{
    // one operand decides alone
    const auto any = [&](uint32_t bits)
    { return std::any_of(values.begin(), values.end(), [bits](Known value) { return value.is(bits); }); };
    if ((op == kOpLogicalAnd || op == kOpBitwiseAnd || op == kOpIMul) && any(0))
        return knownBits(0);
    if (op == kOpLogicalOr && any(1))
        return knownBits(1);
    if (op == kOpSelect && values[0].state == Known::State::bits)
        return values[values[0].bits != 0 ? 1 : 2];

    const auto any_in = [&](Known::State state)
    { return std::any_of(values.begin(), values.end(), [state](Known v) { return v.state == state; }); };
    if (any_in(Known::State::varies))
        return kVaries;
    if (any_in(Known::State::nothing))
        return kNothing;

    const uint32_t a = values[0].bits;
    const uint32_t b = values.size() > 1 ? values[1].bits : 0;
    const auto signed_a = static_cast<int32_t>(a);
    const auto signed_b = static_cast<int32_t>(b);
    switch (op)
    {
    case kOpIAdd:
        return knownBits(a + b);
    case kOpISub:
        return knownBits(a - b);
    case kOpIMul:
        return knownBits(a * b);
    case kOpLogicalEqual:
    case kOpIEqual:
        return knownBits(a == b ? 1 : 0);
    case kOpLogicalNotEqual:
    case kOpINotEqual:
        return knownBits(a != b ? 1 : 0);
    case kOpLogicalOr:
    case kOpBitwiseOr:
        return knownBits(a | b);
    case kOpLogicalAnd:
    case kOpBitwiseAnd:
        return knownBits(a & b);
    case kOpBitwiseXor:
        return knownBits(a ^ b);
    case kOpLogicalNot:
        return knownBits(a ^ 1u);
    case kOpNot:
        return knownBits(~a);
    case kOpUGreaterThan:
        return knownBits(a > b ? 1 : 0);
    case kOpSGreaterThan:
        return knownBits(signed_a > signed_b ? 1 : 0);
    case kOpUGreaterThanEqual:
        return knownBits(a >= b ? 1 : 0);
    case kOpSGreaterThanEqual:
        return knownBits(signed_a >= signed_b ? 1 : 0);
    case kOpULessThan:
        return knownBits(a < b ? 1 : 0);
    case kOpSLessThan:
        return knownBits(signed_a < signed_b ? 1 : 0);
    case kOpULessThanEqual:
        return knownBits(a <= b ? 1 : 0);
    case kOpSLessThanEqual:
        return knownBits(signed_a <= signed_b ? 1 : 0);
    case kOpShiftRightLogical:
        return b < 32 ? knownBits(a >> b) : kVaries;
    case kOpShiftLeftLogical:
        return b < 32 ? knownBits(a << b) : kVaries;
    default:
        return kVaries;
    }
}

struct Block
{
    uint32_t label = 0;
    std::vector<Words> body; ///< all between the label and the next two
    Words merge{};           ///< OpLoopMerge or OpSelectionMerge; empty: none
    Words end{};             ///< branch, return or the like
    bool reached = false;
};

class Specializer
{
public:
    Specializer(Words spirv, Words constants)
        : spirv_(spirv),
          constants_(constants),
          known_(spirv[3], kVaries),
          types_(spirv[3]),
          definitions_(spirv[3]),
          used_(spirv[3]),
          removed_(spirv[3])
    {
    }

    std::optional<std::vector<uint32_t>> run()
    {
        std::vector<uint32_t> functions;
        size_t at = kHeaderWords;
        // annotations come before all definitions, and all that is global before the functions
        for (; at < spirv_.size(); at += instructionAt(at).size())
        {
            const Words instruction = instructionAt(at);
            if (opcode(instruction) == kOpFunction)
                break;
            if (opcode(instruction) == kOpDecorate && instruction[2] == kDecorationSpecId)
                spec_ids_[instruction[1]] = instruction[3];
            if (!addGlobal(instruction))
                return std::nullopt;
        }
        while (at < spirv_.size())
            at = specializeFunction(at, functions);

        std::vector<uint32_t> result(spirv_.begin(), spirv_.begin() + kHeaderWords);
        for (const std::vector<uint32_t>& instruction : globals_)
            if (!annotatesRemoved(instruction))
                result.insert(result.end(), instruction.begin(), instruction.end());
        result.insert(result.end(), functions.begin(), functions.end());
        return result;
    }

private:
    Words instructionAt(size_t at) const { return spirv_.subspan(at, spirv_[at] >> 16); }

    bool annotatesRemoved(Words instruction) const
    {
        const uint32_t op = opcode(instruction);
        if (op == kOpDecorate && instruction[2] == kDecorationSpecId)
            return true;
        return (op == kOpName || op == kOpDecorate || op == kOpDecorateId) && removed_[instruction[1]];
    }

    bool isBoolean(uint32_t type) const { return types_[type] == kOpTypeBool; }
    bool isScalar(uint32_t type) const { return isBoolean(type) || types_[type] == kOpTypeInt; }

    /// Keep an instruction outside of functions, with values in place of specialization constants.
    bool addGlobal(Words instruction)
    {
        std::vector<uint32_t>& kept = globals_.emplace_back(instruction.begin(), instruction.end());
        const uint32_t op = opcode(instruction);
        switch (op)
        {
        case kOpTypeBool:
            types_[instruction[1]] = op;
            return true;
        case kOpTypeInt:
            if (instruction[2] == 32)
                types_[instruction[1]] = op;
            return true;
        case kOpSpecConstantTrue:
        case kOpSpecConstantFalse:
            kept = booleanConstant(instruction[1], instruction[2],
                                   specialized(instruction[2], op == kOpSpecConstantTrue ? 1 : 0) != 0);
            break;
        case kOpSpecConstant:
            kept[0] = firstWord(kOpConstant, static_cast<uint32_t>(kept.size()));
            kept[3] = specialized(instruction[2], instruction[3]);
            break;
        case kOpSpecConstantComposite:
            kept[0] = firstWord(kOpConstantComposite, static_cast<uint32_t>(kept.size()));
            return true;
        case kOpSpecConstantOp:
        {
            const Known value =
                isScalar(instruction[1]) ? evaluate(instruction[3], instruction.subspan(4)) : kVaries;
            if (value.state != Known::State::bits)
                return false;
            kept = isBoolean(instruction[1])
                       ? booleanConstant(instruction[1], instruction[2], value.bits != 0)
                       : std::vector<uint32_t>{firstWord(kOpConstant, 4), instruction[1], instruction[2],
                                               value.bits};
            break;
        }
        case kOpConstantTrue:
        case kOpConstantFalse:
        case kOpConstant:
            break;
        default:
            return true;
        }
        const uint32_t kept_op = opcode(kept);
        if (isScalar(kept[1]))
            known_[kept[2]] = knownBits(kept_op == kOpConstant       ? kept[3]
                                        : kept_op == kOpConstantTrue ? 1
                                                                     : 0);
        return true;
    }

    static std::vector<uint32_t> booleanConstant(uint32_t type, uint32_t id, bool value)
    {
        return {firstWord(value ? kOpConstantTrue : kOpConstantFalse, 3), type, id};
    }

    uint32_t specialized(uint32_t id, uint32_t standard) const
    {
        const auto found = spec_ids_.find(id);
        return found != spec_ids_.end() && found->second < constants_.size() ? constants_[found->second]
                                                                             : standard;
    }

    Known evaluate(uint32_t op, Words operands) const
    {
        if (operands.empty() || operands.size() > 3)
            return kVaries;
        Known values[3];
        for (size_t i = 0; i < operands.size(); ++i)
            values[i] = operands[i] < known_.size() ? known_[operands[i]] : kVaries;
        return compute(op, std::span(values).first(operands.size()));
    }

    /// Read the function at a word, append what is left of it, and return the word behind it.
    size_t specializeFunction(size_t at, std::vector<uint32_t>& out)
    {
        blocks_.clear();
        block_of_.clear();
        edges_.clear();
        for (; opcode(instructionAt(at)) != kOpFunctionEnd; at += instructionAt(at).size())
        {
            const Words instruction = instructionAt(at);
            const uint32_t op = opcode(instruction);
            if (op == kOpLine || op == kOpNoLine)
                continue;
            if (op == kOpLabel)
            {
                block_of_[instruction[1]] = blocks_.size();
                blocks_.push_back({.label = instruction[1]});
            }
            else if (blocks_.empty()) // the function and its parameters
                out.insert(out.end(), instruction.begin(), instruction.end());
            else if (op == kOpLoopMerge || op == kOpSelectionMerge)
                blocks_.back().merge = instruction;
            else if (op >= kOpBranch && op <= kOpUnreachable)
                blocks_.back().end = instruction;
            else
            {
                blocks_.back().body.push_back(instruction);
                if (isPure(instruction))
                    known_[instruction[2]] = kNothing;
            }
        }
        const Words end = instructionAt(at);
        if (!blocks_.empty())
        {
            propagateConstants();
            markUsed();
            for (const Block& block : blocks_)
                removed_[block.label] = true;
            for (const uint32_t label : structuredOrder())
            {
                removed_[label] = false;
                appendBlock(blocks_[block_of_.at(label)], out);
            }
        }
        out.insert(out.end(), end.begin(), end.end());
        return at + end.size();
    }

    static uint64_t edge(uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; }
    bool isReached(uint32_t label) const { return blocks_[block_of_.at(label)].reached; }

    /// Find the blocks that are reached, the edges that are taken, and what is known of values.
    void propagateConstants()
    {
        blocks_.front().reached = true;
        for (bool changed = true; changed;)
        {
            changed = false;
            for (size_t i = 0; i < blocks_.size(); ++i)
                if (blocks_[i].reached)
                    changed |= propagateThrough(blocks_[i]);
        }
    }

    bool propagateThrough(const Block& block)
    {
        bool changed = false;
        for (const Words instruction : block.body)
        {
            if (!isPure(instruction))
                continue;
            Known& known = known_[instruction[2]];
            if (known == kVaries)
                continue;
            Known now = kVaries;
            if (isScalar(instruction[1]))
                now = opcode(instruction) == kOpPhi ? meet(block, instruction)
                                                    : evaluate(opcode(instruction), instruction.subspan(3));
            changed |= !(now == known);
            known = now;
        }
        for (const uint32_t target : takenTargets(block))
            if (edges_.insert(edge(block.label, target)).second)
            {
                blocks_[block_of_.at(target)].reached = true;
                changed = true;
            }
        return changed;
    }

    Known meet(const Block& block, Words phi) const
    {
        Known result = kNothing;
        for (size_t i = 3; i + 1 < phi.size(); i += 2)
        {
            if (!edges_.contains(edge(phi[i + 1], block.label)))
                continue;
            const Known value = known_[phi[i]];
            if (value.state == Known::State::nothing)
                continue;
            if (result.state != Known::State::nothing && !(result == value))
                return kVaries;
            result = value;
        }
        return result;
    }

    /// Return what is known of the condition of a block's conditional branch. That of a branch back to
    /// the head of a loop counts as one that varies, since each loop must have such a branch.
    Known knownCondition(const Block& block) const
    {
        const auto leads_back = [&](uint32_t target)
        {
            const Block& head = blocks_[block_of_.at(target)];
            return &head <= &block && !head.merge.empty() && opcode(head.merge) == kOpLoopMerge;
        };
        const Known condition = known_[block.end[1]];
        const bool is_known = condition.state == Known::State::bits;
        return is_known && (leads_back(block.end[2]) || leads_back(block.end[3])) ? kVaries : condition;
    }

    /// Return the blocks to which a block may branch, by what is known; each once.
    std::vector<uint32_t> takenTargets(const Block& block) const
    {
        const Words end = block.end;
        std::vector<uint32_t> targets;
        const auto add = [&](uint32_t label)
        {
            if (std::find(targets.begin(), targets.end(), label) == targets.end())
                targets.push_back(label);
        };
        switch (opcode(end))
        {
        case kOpBranch:
            add(end[1]);
            break;
        case kOpBranchConditional:
        {
            const Known condition = knownCondition(block);
            if (condition.state == Known::State::nothing)
                break;
            if (!condition.is(0))
                add(end[2]);
            if (!condition.is(1))
                add(end[3]);
            break;
        }
        case kOpSwitch:
        {
            const Known selector = known_[end[1]];
            if (selector.state == Known::State::nothing)
                break;
            bool found = false;
            for (size_t i = 3; i + 1 < end.size(); i += 2)
                if (selector.state == Known::State::varies || selector.bits == end[i])
                {
                    add(end[i + 1]);
                    found = selector.state == Known::State::bits;
                }
            if (!found)
                add(end[2]);
            break;
        }
        default:
            break;
        }
        return targets;
    }

    /// Mark the values on which anything depends that a reached block does.
    void markUsed()
    {
        std::vector<Words> open;
        for (const Block& block : blocks_)
            for (const Words instruction : block.body)
            {
                if (isPure(instruction) && block.reached)
                    definitions_[instruction[2]] = instruction;
                if (hasResult(instruction)) // until something is found to use it
                    removed_[instruction[2]] = isPure(instruction) || !block.reached;
            }
        const auto use = [&](uint32_t id)
        {
            // literals are taken for ids, too, which keeps a little too much
            if (id >= used_.size() || used_[id])
                return;
            used_[id] = true;
            if (!definitions_[id].empty())
                open.push_back(definitions_[id]);
        };
        for (const Block& block : blocks_)
        {
            if (!block.reached)
                continue;
            for (const Words instruction : block.body)
                if (!isPure(instruction))
                    std::for_each(instruction.begin() + 1, instruction.end(), use);
            if (keepsCondition(block))
                std::for_each(block.end.begin() + 1, block.end.end(), use);
        }
        while (!open.empty())
        {
            const Words instruction = open.back();
            open.pop_back();
            removed_[instruction[2]] = false;
            if (opcode(instruction) != kOpPhi)
                std::for_each(instruction.begin() + 3, instruction.end(), use);
            else
                for (size_t i = 3; i + 1 < instruction.size(); i += 2)
                    if (isReached(instruction[i + 1]))
                        use(instruction[i]);
        }
    }

    /// True unless the block ends in a condition that is known.
    bool keepsCondition(const Block& block) const
    {
        return opcode(block.end) != kOpBranchConditional || knownCondition(block).state != Known::State::bits;
    }

    /// True if the block still declares where its construct ends: a selection whose condition is known
    /// is no construct any more. A switch stays one, since blocks within it may leave it from inside
    /// other constructs.
    bool keepsMerge(const Block& block) const
    {
        return !block.merge.empty() && (opcode(block.merge) == kOpLoopMerge || keepsCondition(block));
    }

    /// Return the labels of the blocks to keep, dominators first: those that are reached, and blocks
    /// where constructs end and loops continue.
    std::vector<uint32_t> structuredOrder() const
    {
        struct Visit
        {
            uint32_t label;
            std::vector<uint32_t> open; ///< blocks that must come later; the last is visited next
        };
        std::vector<uint32_t> order;
        std::unordered_set<uint32_t> seen;
        std::vector<Visit> path;
        const auto enter = [&](uint32_t label)
        {
            if (!seen.insert(label).second)
                return;
            const Block& block = blocks_[block_of_.at(label)];
            Visit visit{label, {}};
            if (block.reached)
            {
                visit.open = takenTargets(block);
                // visited first, so that they come behind all blocks of the construct
                if (keepsMerge(block))
                {
                    if (opcode(block.merge) == kOpLoopMerge)
                        visit.open.push_back(block.merge[2]);
                    visit.open.push_back(block.merge[1]);
                }
            }
            path.push_back(std::move(visit));
        };
        enter(blocks_.front().label);
        while (!path.empty())
        {
            if (path.back().open.empty())
            {
                order.push_back(path.back().label);
                path.pop_back();
                continue;
            }
            const uint32_t next = path.back().open.back();
            path.back().open.pop_back();
            enter(next);
        }
        std::reverse(order.begin(), order.end());
        return order;
    }

    void appendBlock(const Block& block, std::vector<uint32_t>& out)
    {
        const auto append = [&out](Words words) { out.insert(out.end(), words.begin(), words.end()); };
        append({{firstWord(kOpLabel, 2), block.label}});
        if (!block.reached)
        {
            // the end of a construct, or the place where a loop would continue
            const uint32_t loop = loopThatContinuesAt(block.label);
            if (loop != 0)
                append({{firstWord(kOpBranch, 2), loop}});
            else
                append({{firstWord(kOpUnreachable, 1)}});
            return;
        }
        for (const Words instruction : block.body)
        {
            if (isPure(instruction) && removed_[instruction[2]])
                continue;
            if (opcode(instruction) == kOpPhi)
                append(phiOfTakenEdges(block, instruction));
            else
                append(instruction);
        }
        if (keepsMerge(block))
            append(block.merge);
        const std::vector<uint32_t> targets = takenTargets(block);
        if (!keepsCondition(block))
            append({{firstWord(kOpBranch, 2), targets.front()}});
        else if (opcode(block.end) == kOpSwitch && known_[block.end[1]].state == Known::State::bits)
            append({{firstWord(kOpSwitch, 3), block.end[1], targets.front()}});
        else
            append(block.end);
    }

    std::vector<uint32_t> phiOfTakenEdges(const Block& block, Words phi) const
    {
        std::vector<uint32_t> kept(phi.begin(), phi.begin() + 3);
        for (size_t i = 3; i + 1 < phi.size(); i += 2)
            if (edges_.contains(edge(phi[i + 1], block.label)))
                kept.insert(kept.end(), {phi[i], phi[i + 1]});
        // a loop that never continues has an edge from there all the same
        if (opcode(block.merge.empty() ? block.end : block.merge) == kOpLoopMerge &&
            !isReached(block.merge[2]))
            kept.insert(kept.end(), {phi[2], block.merge[2]});
        kept[0] = firstWord(kOpPhi, static_cast<uint32_t>(kept.size()));
        return kept;
    }

    /// Return the label of the reached loop that continues at a block; 0 if there is none.
    uint32_t loopThatContinuesAt(uint32_t label) const
    {
        for (const Block& block : blocks_)
            if (block.reached && !block.merge.empty() && opcode(block.merge) == kOpLoopMerge &&
                block.merge[2] == label)
                return block.label;
        return 0;
    }

    Words spirv_;
    Words constants_;
    std::unordered_map<uint32_t, uint32_t> spec_ids_; ///< by the id of the constant
    std::vector<std::vector<uint32_t>> globals_;
    std::vector<Known> known_;       ///< by id, as the next four
    std::vector<uint32_t> types_;    ///< kOpTypeBool; kOpTypeInt of 32 bits; 0: another type, or none
    std::vector<Words> definitions_; ///< of pure instructions
    std::vector<bool> used_;
    std::vector<bool> removed_;
    // of the present function
    std::vector<Block> blocks_;
    std::unordered_map<uint32_t, size_t> block_of_; ///< by label
    std::unordered_set<uint64_t> edges_;            ///< that are taken
};

} // namespace

std::optional<std::vector<uint32_t>> specializeShader(std::span<const uint32_t> spirv,
                                                      std::span<const uint32_t> constants)
{
    HEARTH_ASSERT(spirv.size() > kHeaderWords);
    return Specializer(spirv, constants).run();
}

std::vector<uint32_t> moveToOneSet(std::span<const uint32_t> spirv)
{
    std::vector<uint32_t> moved(spirv.begin(), spirv.end());
    for (size_t at = kHeaderWords; at < moved.size(); at += moved[at] >> 16)
        if (opcode(spirv.subspan(at)) == kOpDecorate && moved[at + 2] == kDecorationDescriptorSet)
            moved[at + 3] = 0;
    return moved;
}

} // namespace hearth::gpu
