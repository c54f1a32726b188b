// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/clip_settings.h"

#include "cook/animation_compression/compress.h"
#include "cook/tools/toml.h"
#include "formats/base/nearest_match.h"
#include "formats/base/regular_file.h"

#include <array>
#include <fmt/format.h>

namespace hearth::animation_compression
{

namespace
{

using tools::TomlNode;

// Maximum error, a kilometre: larger values are probably in other units.
constexpr double kMaxError = 1000;

Error settingError(Issue issue, const std::string& file, const TomlNode& node, const std::string& key,
                   std::string detail)
{
    return {issue, file, fmt::format("line {}, {}", node.line, key), std::move(detail)};
}

Result<StatedError> readErrorSetting(const TomlNode& root, const std::string& file)
{
    const TomlNode* table = root.find("animation");
    if (table == nullptr)
        return StatedError{0, kDefaultShareOfSize};
    if (!table->isTable())
        return settingError(Issue::profile_value, file, *table, "animation", "must be a table");
    for (const TomlNode& member : table->children)
        if (member.key != "error")
        {
            const std::string nearest = nearestMatch(member.key, std::array<std::string, 1>{"error"});
            return settingError(Issue::profile_key, file, member, fmt::format("animation.{}", member.key),
                                nearest.empty()
                                    ? "this key is not known"
                                    : fmt::format("this key is not known: did you mean '{}'?", nearest));
        }
    const TomlNode* error = table->find("error");
    if (error == nullptr)
        return StatedError{0, kDefaultShareOfSize};
    const double metres = error->asNumber().value_or(-1);
    if (!(metres >= 0 && metres <= kMaxError))
        return settingError(Issue::profile_value, file, *error, "animation.error",
                            fmt::format("must be a number of metres from 0 to {:g}", kMaxError));
    return StatedError{metres, 0};
}

} // namespace

Result<StatedError> readStatedError(const std::string& profile_path)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(profile_path));
    return parseStatedError(text, profile_path);
}

Result<StatedError> parseStatedError(std::string_view text, const std::string& name)
{
    tools::TomlError fault;
    const std::optional<TomlNode> root = tools::parseToml(text, fault);
    if (!root)
        return Error{Issue::profile_syntax, name, fmt::format("line {}", fault.line), fault.text};
    return readErrorSetting(*root, name);
}

} // namespace hearth::animation_compression
