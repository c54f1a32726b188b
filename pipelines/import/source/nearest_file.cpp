// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/source/nearest_file.h"

#include "formats/base/nearest_match.h"
#include "pipelines/import/images/decode.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace hearth::import
{

namespace
{

// More files than the textures of a game. An asset in a home folder must not list all of it.
constexpr size_t kMaxFiles = 20'000;

/// Difference between a file and the requested one, nearest first.
enum class Difference : uint8_t
{
    separators,
    letter_case,
    folder,
    format,
    folder_and_format,
    none_of_these,
};

constexpr std::array<std::string_view, 5> kDifferences{
    ", with '/' between folders, not '\\'", ", whose letters differ in case", ", in another folder",
    ", in another format", ", in another folder and format"};

std::string toLower(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

/// Path split into its parts: "textures/", "wood", ".png".
struct PathParts
{
    explicit PathParts(std::string_view path)
    {
        const size_t name = path.rfind('/') + 1; // npos + 1 is 0
        const size_t dot = std::min(path.rfind('.'), path.size());
        const size_t end = dot <= name ? path.size() : dot;
        folder = path.substr(0, name);
        stem = path.substr(name, end - name);
        extension = path.substr(end);
    }

    std::string_view folder;
    std::string_view stem;
    std::string_view extension;
};

bool isImageName(std::string_view name)
{
    return looksLikeImage(std::string(name), {});
}

/// Classify the difference between a requested path and a listed one.
/// wanted  with '/' between folders
Difference classifyDifference(const std::string& wanted, const std::string& wanted_lower,
                              const std::string& path)
{
    if (path == wanted)
        return Difference::separators;
    const std::string lower = toLower(path);
    if (lower == wanted_lower)
        return Difference::letter_case;
    const PathParts asked(wanted_lower);
    const PathParts there(lower);
    if (asked.stem != there.stem)
        return Difference::none_of_these;
    if (asked.extension == there.extension)
        return Difference::folder;
    if (!isImageName(wanted_lower) || !isImageName(lower))
        return Difference::none_of_these;
    return asked.folder == there.folder ? Difference::format : Difference::folder_and_format;
}

} // namespace

FileListing::FileListing(const std::string& folder)
{
    namespace fs = std::filesystem;
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::recursive_directory_iterator() && paths_.size() < kMaxFiles;
         entry.increment(error))
    {
        std::error_code ignored; // of a dangling link
        if (entry->is_regular_file(ignored))
            paths_.push_back(entry->path().string().substr(folder.size()));
    }
    std::sort(paths_.begin(), paths_.end());
}

std::string FileListing::suggest(std::string_view path) const
{
    if (std::binary_search(paths_.begin(), paths_.end(), path))
        return "";
    std::string wanted(path);
    std::replace(wanted.begin(), wanted.end(), '\\', '/');
    wanted = std::filesystem::path(wanted).lexically_normal().string();
    const std::string wanted_lower = toLower(wanted);
    const std::string* best = nullptr;
    Difference best_difference = Difference::none_of_these;
    for (const std::string& there : paths_)
        if (const Difference difference = classifyDifference(wanted, wanted_lower, there);
            difference < best_difference)
        {
            best_difference = difference;
            best = &there;
        }
    if (best != nullptr)
        return fmt::format("\"{}\"{}", *best, kDifferences[static_cast<size_t>(best_difference)]);
    return suggestByTypo(wanted);
}

/// Return the file in the same folder whose name is a typing error away; empty if none is.
/// wanted  with '/' between folders
std::string FileListing::suggestByTypo(const std::string& wanted) const
{
    const PathParts asked(wanted);
    std::vector<std::string> stems;
    std::vector<const std::string*> path_of_stem;
    for (const std::string& there : paths_)
        if (const PathParts parts(there);
            parts.folder == asked.folder && isImageName(there) == isImageName(wanted))
        {
            stems.emplace_back(parts.stem);
            path_of_stem.push_back(&there);
        }
    const std::string typo = nearestMatch(asked.stem, stems);
    const auto found = std::find(stems.begin(), stems.end(), typo);
    return typo.empty() ? ""
                        : fmt::format("\"{}\"", *path_of_stem[static_cast<size_t>(found - stems.begin())]);
}

} // namespace hearth::import
