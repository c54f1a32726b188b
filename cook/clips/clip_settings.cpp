// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clips/clip_settings.h"

#include "cook/clips/compress.h"
#include "cook/tools/suggest.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <toml++/toml.h>

namespace hearth::clips
{

namespace
{

// A kilometre: whoever writes more means other units.
constexpr double kMostError = 1000;

Error wrong(Issue issue, const std::string& file, const toml::node& node, const std::string& key,
            std::string detail)
{
    return {issue, file, fmt::format("line {}, {}", node.source().begin.line, key), std::move(detail)};
}

Result<StatedError> statedErrorOf(const toml::table& root, const std::string& file)
{
    const toml::node* node = root.get("animation");
    if (node == nullptr)
        return StatedError{0, kDefaultShareOfSize};
    const toml::table* table = node->as_table();
    if (table == nullptr)
        return wrong(Issue::profile_value, file, *node, "animation", "must be a table");
    for (const auto& [key, value] : *table)
        if (key.str() != "error")
        {
            const std::string nearest = tools::nearestMatch(key.str(), std::array<std::string, 1>{"error"});
            return wrong(Issue::profile_key, file, value, fmt::format("animation.{}", key.str()),
                         nearest.empty() ? "this key is not known"
                                         : fmt::format("this key is not known: did you mean '{}'?", nearest));
        }
    const toml::node* error = table->get("error");
    if (error == nullptr)
        return StatedError{0, kDefaultShareOfSize};
    const double metres = error->value<double>().value_or(-1);
    if (!error->is_number() || !(metres >= 0 && metres <= kMostError))
        return wrong(Issue::profile_value, file, *error, "animation.error",
                     fmt::format("must be a number of metres from 0 to {:g}", kMostError));
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
    try
    {
        return statedErrorOf(toml::parse(text), name);
    }
    catch (const toml::parse_error& malformed)
    {
        return Error{Issue::profile_syntax, name, fmt::format("line {}", malformed.source().begin.line),
                     std::string(malformed.description())};
    }
}

} // namespace hearth::clips
