// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/clip_settings.h"

#include "cook/animation_compression/compress.h"
#include "cook/tools/toml.h"
#include "formats/base/nearest_match.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

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
    std::error_code error;
    std::ifstream file(profile_path, std::ios::binary);
    if (!file.is_open() || std::filesystem::is_directory(profile_path, error))
        return Error{Issue::input_missing, profile_path, "", "the profile cannot be read"};
    return parseStatedError(
        std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()), profile_path);
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
