// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/unused_files.h"

#include "pipelines/command/shell/name_list.h"
#include "pipelines/command/sources/source_list.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace hearth::command
{

namespace
{

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> kImageExtensions{".png", ".jpg", ".jpeg", ".webp", ".tga",
                                                            ".bmp", ".hdr", ".exr",  ".ktx2", ".dds"};
/// Other files that sources refer to.
constexpr std::array<std::string_view, 2> kSideFileExtensions{".bin", ".mtl"};
/// Files that Hearth itself writes, or reads its settings from.
constexpr std::array<std::string_view, 2> kHearthExtensions{".hearth", ".toml"};

template <size_t kCount>
bool hasExtension(const std::string& path, const std::array<std::string_view, kCount>& endings)
{
    std::string ending = fs::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Canonical paths of files, whatever their spelling: the real folder, and the file's name in it.
class CanonicalPaths
{
public:
    std::string get(const std::string& path)
    {
        const fs::path file(path);
        const auto [folder, is_new] = real_folder_.emplace(file.parent_path().string(), "");
        if (is_new)
        {
            std::error_code error;
            folder->second = fs::canonical(folder->first.empty() ? "." : folder->first, error).string();
        }
        return folder->second + "/" + file.filename().string();
    }

private:
    std::map<std::string, std::string> real_folder_; ///< by folder as typed
};

/// Files that are left out for the same reason.
struct Group
{
    const char* singular;
    const char* plural;
    std::vector<std::string> files;
};

/// Return the index of the file's group: textures, other usable files, others.
size_t groupIndex(const std::string& file)
{
    if (hasExtension(file, kImageExtensions))
        return 0;
    return hasExtension(file, kSideFileExtensions) || isModelFile(file) ? 1 : 2;
}

std::string groupText(const Group& group)
{
    return fmt::format("{} {} ({})", group.files.size(),
                       group.files.size() == 1 ? group.singular : group.plural, namesText(group.files));
}

} // namespace

std::string unusedFilesText(const std::vector<std::string>& files, const std::vector<std::string>& known)
{
    CanonicalPaths real;
    std::set<std::string> used;
    for (const std::string& path : known)
        used.insert(real.get(path));
    std::array<Group, 3> groups{
        {{"texture that no source uses", "textures that no source uses", {}},
         {"file that no source uses", "files that no source uses", {}},
         {"file of a kind that is not read", "files of kinds that are not read", {}}}};
    for (const std::string& file : files)
        if (!hasExtension(file, kHearthExtensions) && !used.contains(real.get(file)))
            groups[groupIndex(file)].files.push_back(file);
    std::string text;
    for (const Group& group : groups)
        if (!group.files.empty())
            text += (text.empty() ? "" : ", ") + groupText(group);
    return text.empty() ? "" : fmt::format("{:<10}{}", "left out", text);
}

} // namespace hearth::command
