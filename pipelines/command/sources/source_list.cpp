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

constexpr std::array<std::string_view, 7> kModelExtensions{".gltf", ".glb", ".obj", ".ply",
                                                           ".stl",  ".off", ".drc"};

/// Call `look` for the folders and files below `folder` that are not hidden, in the order of the disk.
Status visitFolder(const fs::path& folder, const std::function<void(const fs::directory_entry&)>& look)
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
Result<std::vector<std::string>> listFiles(const fs::path& folder,
                                           const std::function<bool(const fs::path&)>& accepts)
{
    std::vector<std::string> files;
    HEARTH_TRY(visitFolder(folder,
                           [&](const fs::directory_entry& entry)
                           {
                               std::error_code ignored;
                               if (entry.is_regular_file(ignored) && accepts(entry.path()))
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

WordKind classifyWord(const std::string& word)
{
    std::error_code error;
    if (fs::is_directory(word, error))
        return WordKind::folder;
    return profiles::isPattern(word) && !fs::exists(word, error) ? WordKind::pattern : WordKind::file;
}

/// Return the folder where the search for a pattern's files starts: the folders before the first * or ?, with
/// a slash at their end.
std::string patternFolder(const std::string& pattern)
{
    const size_t slash = pattern.rfind('/', pattern.find_first_of("*?"));
    return slash == std::string::npos ? "./" : pattern.substr(0, slash + 1);
}

Result<std::vector<std::string>> listPatternFiles(const std::string& pattern)
{
    const std::string folder = patternFolder(pattern);
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return std::vector<std::string>();
    const std::string in_folder = pattern.starts_with(folder) ? pattern.substr(folder.size()) : pattern;
    return listFiles(folder, [&](const fs::path& path)
                     { return profiles::matchesPath(in_folder, path.string().substr(folder.size())); });
}

} // namespace

bool isModelFile(const std::string& path)
{
    std::string ending = fs::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(kModelExtensions.begin(), kModelExtensions.end(), ending) != kModelExtensions.end();
}

Result<std::vector<std::string>> expandSources(const std::vector<std::string>& words)
{
    std::vector<std::string> sources;
    for (const std::string& word : words)
    {
        const WordKind kind = classifyWord(word);
        std::vector<std::string> files{word};
        if (kind == WordKind::folder)
        {
            HEARTH_ASSIGN_OR_RETURN(
                files, listFiles(word, [](const fs::path& path) { return isModelFile(path.string()); }));
        }
        else if (kind == WordKind::pattern)
        {
            HEARTH_ASSIGN_OR_RETURN(files, listPatternFiles(word));
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

std::vector<std::string> sourceFolders(const std::vector<std::string>& words)
{
    std::vector<std::string> folders;
    for (const std::string& word : words)
    {
        const WordKind kind = classifyWord(word);
        if (kind == WordKind::file)
            continue;
        folders.push_back(kind == WordKind::folder ? word : patternFolder(word));
        // expandSources() reports folders that cannot be read
        (void)visitFolder(folders.back(),
                          [&](const fs::directory_entry& entry)
                          {
                              std::error_code ignored;
                              if (entry.is_directory(ignored))
                                  folders.push_back(entry.path().string());
                          });
    }
    return folders;
}

std::vector<std::string> filesInFolders(const std::vector<std::string>& words)
{
    std::vector<std::string> files;
    for (const std::string& word : words)
    {
        if (classifyWord(word) != WordKind::folder)
            continue;
        const auto below = listFiles(word, [](const fs::path&) { return true; });
        if (below.ok())
            files.insert(files.end(), below->begin(), below->end());
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

} // namespace hearth::command
