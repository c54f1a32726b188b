// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/source_list.h"

#include "pipelines/profiles/glob.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

namespace hearth::command
{

namespace
{

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kModels{".gltf", ".glb", ".obj", ".ply", ".stl", ".off", ".drc"};

bool isModel(const fs::path& path)
{
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(kModels.begin(), kModels.end(), ending) != kModels.end();
}

/// The files below `folder` that `takes` wants, sorted; nothing where the folder cannot be read.
Result<std::vector<std::string>> filesBelow(const fs::path& folder,
                                            const std::function<bool(const fs::path&)>& takes)
{
    std::vector<std::string> files;
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    {
        std::error_code ignored; // of a link that leads nowhere
        const bool is_hidden = entry->path().filename().string().starts_with('.');
        if (is_hidden && entry->is_directory(ignored))
            entry.disable_recursion_pending();
        else if (!is_hidden && entry->is_regular_file(ignored) && takes(entry->path()))
            files.push_back(entry->path().lexically_normal().string());
    }
    if (error)
        return Error{Issue::input_missing, folder.string(), "", error.message()};
    std::sort(files.begin(), files.end());
    return files;
}

/// The files of a pattern, whose folders before the first * or ? are where the search starts.
Result<std::vector<std::string>> filesOfPattern(const std::string& pattern)
{
    const size_t slash = pattern.rfind('/', pattern.find_first_of("*?"));
    const std::string folder = slash == std::string::npos ? "" : pattern.substr(0, slash + 1);
    std::error_code error;
    if (!fs::is_directory(folder.empty() ? "." : folder, error))
        return std::vector<std::string>();
    const std::string in_folder = pattern.substr(folder.size());
    // paths of "." start with "./", those of "props/" with "props/"
    const size_t prefix = folder.empty() ? 2 : folder.size();
    return filesBelow(folder.empty() ? "." : folder, [&](const fs::path& path)
                      { return profiles::matchesPath(in_folder, path.string().substr(prefix)); });
}

} // namespace

Result<std::vector<std::string>> sourcesOf(const std::vector<std::string>& words)
{
    std::vector<std::string> sources;
    for (const std::string& word : words)
    {
        std::error_code error;
        std::vector<std::string> files{word};
        const bool is_folder = fs::is_directory(word, error);
        const bool is_pattern = !is_folder && profiles::isPattern(word) && !fs::exists(word, error);
        if (is_folder)
        {
            HEARTH_ASSIGN_OR_RETURN(files, filesBelow(word, isModel));
        }
        else if (is_pattern)
        {
            HEARTH_ASSIGN_OR_RETURN(files, filesOfPattern(word));
        }
        if (files.empty())
            return Error{Issue::no_source, word, "",
                         is_folder ? "there is no model in this folder, or below it"
                                   : "no file matches this pattern"};
        for (const std::string& file : files)
            if ((!is_folder && !is_pattern) ||
                std::find(sources.begin(), sources.end(), file) == sources.end())
                sources.push_back(file);
    }
    return sources;
}

} // namespace hearth::command
