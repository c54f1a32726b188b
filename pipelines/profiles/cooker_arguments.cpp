// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/cooker_arguments.h"

#include <charconv>
#include <fmt/format.h>

namespace hearth::profiles
{

namespace
{

const Value* find(const Values& values, std::string_view key)
{
    const auto found = values.find(key);
    return found == values.end() ? nullptr : &found->second;
}

/// Parse a number, which was checked when the value was read.
template <typename Number>
Number parseNumber(const Value& value)
{
    Number number = 0;
    std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
    return number;
}

bool isOn(const Values& values, std::string_view key)
{
    const Value* value = find(values, key);
    return value != nullptr && value->text == "true";
}

/// Append "--set KEY=VALUE" for all keys of a group.
void addGroup(const Values& values, std::string_view group, std::vector<std::string>& words)
{
    for (const auto& [key, value] : values)
        if (settingGroup(key) == group)
            words.insert(words.end(), {"--set", key + "=" + value.text});
}

Result<graph::VisibilityOptions> makeVisibilityOptions(const Values& values)
{
    graph::VisibilityOptions options;
    if (const Value* quality = find(values, "visibility.quality"))
        options.quality = valueTexts(*quality).front();
    if (const Value* occluders = find(values, "visibility.occluders"))
        options.occluders = valueTexts(*occluders).front();
    if (const Value* distance = find(values, "visibility.distance"))
        options.distance = parseNumber<double>(*distance);
    if (const Value* power = find(values, "visibility.power"))
    {
        options.power = parseNumber<double>(*power);
        if (options.distance == 0)
            return Error{Issue::profile_value, power->origin, "visibility.power",
                         "needs visibility.distance, which is not set"};
    }
    if (const Value* poses = find(values, "visibility.poses"))
        options.poses = valueTexts(*poses);
    options.refine = isOn(values, "visibility.refine");
    return options;
}

} // namespace

Result<graph::SourceSettings> makeCookerArguments(const Values& values)
{
    graph::SourceSettings arguments;
    if (const Value* angle = find(values, "import.crease_angle"))
        arguments.import = {"--crease-angle", angle->text};
    if (const Value* scale = find(values, "import.scale"))
        arguments.import.insert(arguments.import.end(), {"--scale", scale->text});
    if (const Value* up = find(values, "import.up"))
        arguments.import.insert(arguments.import.end(), {"--up", valueTexts(*up).front()});
    addGroup(values, "animation", arguments.import);
    if (const Value* size = find(values, "textures.max_size"))
        arguments.textures = {"--max-size", size->text};
    addGroup(values, "clusters", arguments.clusters);
    if (isOn(values, "visibility.enabled"))
    {
        HEARTH_ASSIGN_OR_RETURN(arguments.visibility, makeVisibilityOptions(values));
    }
    return arguments;
}

std::optional<graph::BrickOptions> makeBrickOptions(const Values& values)
{
    if (!isOn(values, "bricks.enabled"))
        return std::nullopt;
    graph::BrickOptions options;
    if (const Value* size = find(values, "bricks.voxel_size"))
        options.voxel_size = parseNumber<double>(*size);
    if (const Value* memory = find(values, "bricks.memory"))
        options.memory_bytes = parseNumber<uint64_t>(*memory);
    if (const Value* bounces = find(values, "bricks.bake"))
        options.bounces = parseNumber<uint32_t>(*bounces);
    return options;
}

} // namespace hearth::profiles
