// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/source_list.h"

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

/// Call `look` for the folders and files below `folder` that are not hidden, in the order of the disk.
Status visit(const fs::path& folder, const std::function<void(const fs::directory_entry&)>& look)
{
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    {
        std::error_code ignored; // a dangling link
        if (!entry->path().filename().string().starts_with('.'))
            look(*entry);
        else if (entry->is_directory(ignored))
            entry.disable_recursion_pending();
    }
    return error ? Status(Error{Issue::input_missing, folder.string(), "", error.message()}) : success();
}

/// Return the files below `folder` that the filter lets pass, sorted; an error if the folder cannot be read.
Result<std::vector<std::string>> filesBelow(const fs::path& folder,
                                            const std::function<bool(const fs::path&)>& takes)
{
    std::vector<std::string> files;
    HEARTH_TRY(visit(folder,
                     [&](const fs::directory_entry& entry)
                     {
                         std::error_code ignored;
                         if (entry.is_regular_file(ignored) && takes(entry.path()))
                             files.push_back(entry.path().lexically_normal().string());
                     }));
    std::sort(files.begin(), files.end());
    return files;
}

enum class WordKind
{
    file,
    folder,
    pattern,
};

WordKind kindOf(const std::string& word)
{
    std::error_code error;
    if (fs::is_directory(word, error))
        return WordKind::folder;
    return profiles::isPattern(word) && !fs::exists(word, error) ? WordKind::pattern : WordKind::file;
}

/// Return the folder where the search for a pattern's files starts: the folders before the first * or ?, with
/// a slash at their end.
std::string folderOfPattern(const std::string& pattern)
{
    const size_t slash = pattern.rfind('/', pattern.find_first_of("*?"));
    return slash == std::string::npos ? "./" : pattern.substr(0, slash + 1);
}

Result<std::vector<std::string>> filesOfPattern(const std::string& pattern)
{
    const std::string folder = folderOfPattern(pattern);
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return std::vector<std::string>();
    const std::string in_folder = pattern.starts_with(folder) ? pattern.substr(folder.size()) : pattern;
    return filesBelow(folder, [&](const fs::path& path)
                      { return profiles::matchesPath(in_folder, path.string().substr(folder.size())); });
}

} // namespace

bool isModel(const std::string& path)
{
    std::string ending = fs::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(kModels.begin(), kModels.end(), ending) != kModels.end();
}

Result<std::vector<std::string>> sourcesOf(const std::vector<std::string>& words)
{
    std::vector<std::string> sources;
    for (const std::string& word : words)
    {
        const WordKind kind = kindOf(word);
        std::vector<std::string> files{word};
        if (kind == WordKind::folder)
        {
            HEARTH_ASSIGN_OR_RETURN(
                files, filesBelow(word, [](const fs::path& path) { return isModel(path.string()); }));
        }
        else if (kind == WordKind::pattern)
        {
            HEARTH_ASSIGN_OR_RETURN(files, filesOfPattern(word));
        }
        if (files.empty())
            return Error{Issue::no_source, word, "",
                         kind == WordKind::folder ? "there is no model in this folder, or below it"
                                                  : "no file matches this pattern"};
        for (const std::string& file : files)
            if (kind == WordKind::file || std::find(sources.begin(), sources.end(), file) == sources.end())
                sources.push_back(file);
    }
    return sources;
}

std::vector<std::string> foldersOf(const std::vector<std::string>& words)
{
    std::vector<std::string> folders;
    for (const std::string& word : words)
    {
        const WordKind kind = kindOf(word);
        if (kind == WordKind::file)
            continue;
        folders.push_back(kind == WordKind::folder ? word : folderOfPattern(word));
        // sourcesOf() reports folders that cannot be read
        (void)visit(folders.back(),
                    [&](const fs::directory_entry& entry)
                    {
                        std::error_code ignored;
                        if (entry.is_directory(ignored))
                            folders.push_back(entry.path().string());
                    });
    }
    return folders;
}

std::vector<std::string> filesOfFolders(const std::vector<std::string>& words)
{
    std::vector<std::string> files;
    for (const std::string& word : words)
    {
        if (kindOf(word) != WordKind::folder)
            continue;
        const auto below = filesBelow(word, [](const fs::path&) { return true; });
        if (below.ok())
            files.insert(files.end(), below->begin(), below->end());
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

} // namespace hearth::command
