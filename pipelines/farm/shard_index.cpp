// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/shard_index.h"

#include <array>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace hearth::farm
{

namespace
{

struct Variable
{
    const char* index;
    // variables of the range, where the batch system sets them
    const char* first = nullptr;
    const char* last = nullptr;
    const char* step = nullptr;
};

constexpr std::array kVariables{
    Variable{"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP"},
    Variable{"JOB_COMPLETION_INDEX"},
    Variable{"AWS_BATCH_JOB_ARRAY_INDEX"},
    Variable{"SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE"},
    Variable{"PBS_ARRAY_INDEX"},
};

std::optional<size_t> parseNumber(std::string_view text)
{
    size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

Error wrong(const std::string& what)
{
    return {Issue::usage, "--shard", "", what};
}

Result<size_t> indexFromOption(const std::string& option, size_t count)
{
    const size_t slash = option.find('/');
    const auto index = parseNumber(option.substr(0, slash));
    const auto of = slash == std::string::npos ? std::nullopt : parseNumber(option.substr(slash + 1));
    if (!index || !of)
        return wrong(fmt::format("'{}' is no shard: write 0/{} for the first", option, count));
    if (*of != count)
        return wrong(fmt::format("the plan has {} shards, not {}", count, *of));
    if (*index >= count)
        return wrong(fmt::format("shards count from 0: the last is {}/{}", count - 1, count));
    return *index;
}

Result<size_t> indexFromVariable(const Variable& variable, const std::string& value, size_t count,
                                 const Environment& environment)
{
    const auto numberIn = [&](const char* name) -> std::optional<size_t>
    {
        const char* text = name == nullptr ? nullptr : environment(name);
        return text == nullptr ? std::nullopt : parseNumber(text);
    };
    const auto index = parseNumber(value);
    if (!index)
        return wrong(fmt::format("{} is '{}', which is no number", variable.index, value));
    const auto first = numberIn(variable.first);
    const auto last = numberIn(variable.last);
    if (!first || !last)
    {
        if (*index < count)
            return *index;
        return wrong(fmt::format("{} is {}, but the plan has {} shards: it must count from 0", variable.index,
                                 *index, count));
    }
    // part of an array, such as one that is submitted again: the shards cannot be told apart
    if (*last < *first || *last - *first + 1 != count || numberIn(variable.step).value_or(1) != 1 ||
        *index < *first || *index > *last)
        return wrong(fmt::format("{} is {} of {} to {}, but the plan has {} shards: say --shard I/{}",
                                 variable.index, *index, *first, *last, count, count));
    return *index - *first;
}

} // namespace

Result<size_t> shardIndex(const std::string& option, size_t count, const Environment& environment)
{
    if (!option.empty())
        return indexFromOption(option, count);
    for (const Variable& variable : kVariables)
        // Grid Engine says "undefined" to a job that is no array
        if (const char* value = environment(variable.index);
            value != nullptr && *value != '\0' && std::string_view(value) != "undefined")
            return indexFromVariable(variable, value, count, environment);
    return wrong(fmt::format(
        "is missing, and no batch system says which shard: say --shard 0/{} for the first", count));
}

} // namespace hearth::farm
