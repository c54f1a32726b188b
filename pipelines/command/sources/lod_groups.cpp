// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/lod_groups.h"

#include "cook/tools/lod_files.h"
#include "pipelines/command/sources/source_list.h"
#include "pipelines/cookers/registry.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hearth::command
{

namespace
{

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

/// Return the normal form of a path, however it was typed.
std::string normalPath(const std::string& file)
{
    return fs::path(file).lexically_normal().string();
}

std::string lodArgument(size_t level, const std::string& file)
{
    return fmt::format("{}={}", level, file);
}

/// Levels that a setting lists for a source.
struct ListedLevels
{
    Words files;        ///< normal paths, finest first
    std::string origin; ///< of the setting
};

/// Level that a file's name gives.
struct NamedLevel
{
    std::string file; ///< normal path
    uint32_t level = 0;
};

/// Files of one folder whose names differ only in the level.
struct NamedGroup
{
    std::map<uint32_t, std::string> file_of_level; ///< normal paths
    std::vector<NamedLevel> repeated;              ///< further files of a level that has one
};

class LodGrouper
{
public:
    LodGrouper(const std::vector<std::string>& files, const profiles::Configuration& configuration)
        : files_(files), configuration_(configuration)
    {
    }

    Result<LodGroups> group()
    {
        readSettings();
        HEARTH_TRY(takeListedLods());
        takeNamedLods();
        for (const std::string& file : files_)
        {
            const std::string path = normalPath(file);
            if (level_files_.contains(path))
                continue;
            groups_.sources.push_back(file);
            groups_.lods_of_source.push_back(lods_of_file_[path]);
        }
        return std::move(groups_);
    }

private:
    void readSettings()
    {
        for (const std::string& file : files_)
        {
            const settings::Values values = configuration_.valuesOfSource(file);
            const auto found = values.find(cookers::kImportLods);
            if (found == values.end())
                continue;
            ListedLevels& listed = listed_[normalPath(file)];
            listed = {{}, found->second.origin};
            for (const std::string& name : settings::valueTexts(found->second))
                listed.files.push_back(normalPath((fs::path(file).parent_path() / name).string()));
        }
    }

    /// Take the LODs that settings list. A rule may match the levels as well as their source, so a file that
    /// another file lists is a level, whatever it lists itself.
    Status takeListedLods()
    {
        for (const auto& [file, listed] : listed_)
            for (const std::string& level : listed.files)
                if (level != file)
                    level_files_.insert(level);
        std::set<std::string> used;
        for (const auto& [file, listed] : listed_)
            if (!level_files_.contains(file))
                used.insert(listed.files.begin(), listed.files.end());
        for (const auto& [file, listed] : listed_)
        {
            for (const std::string& level : listed.files)
                if (level == file ? !level_files_.contains(file) : !used.contains(level))
                    return Error{Issue::profile_value, listed.origin, std::string(cookers::kImportLods),
                                 fmt::format("makes {} a level of {}, which {}", level, file,
                                             level == file ? "is the same file" : "is a level itself")};
            if (!level_files_.contains(file))
                for (size_t i = 0; i < listed.files.size(); ++i)
                    lods_of_file_[file].push_back(lodArgument(i + 1, listed.files[i]));
        }
        return success();
    }

    /// Take the LODs that names give, only of files without a setting.
    void takeNamedLods()
    {
        std::map<std::pair<std::string, std::string>, NamedGroup> group_of_stem;
        for (const std::string& file : files_)
        {
            const fs::path path(normalPath(file));
            const auto name = tools::parseLodName(path.stem().string());
            if (!name || !isModelFile(path.string()) || listed_.contains(path.string()) ||
                level_files_.contains(path.string()))
                continue;
            NamedGroup& group = group_of_stem[{path.parent_path().string(), name->stem}];
            const auto [first, is_new] = group.file_of_level.emplace(name->level, path.string());
            if (!is_new && first->second != path.string())
                group.repeated.push_back({path.string(), name->level});
        }
        for (const auto& [stem, group] : group_of_stem)
            if (group.file_of_level.size() > 1 && group.file_of_level.begin()->first == 0)
                takeGroup(group);
    }

    void takeGroup(const NamedGroup& group)
    {
        const std::string& source = group.file_of_level.at(0);
        for (const auto& [level, file] : group.file_of_level)
            if (level > 0)
            {
                lods_of_file_[source].push_back(lodArgument(level, file));
                level_files_.insert(file);
            }
        std::set<std::string> warned;
        for (const NamedLevel& repeated : group.repeated)
        {
            if (!warned.insert(repeated.file).second)
                continue;
            const std::string& first = group.file_of_level.at(repeated.level);
            if (repeated.level > 0)
                level_files_.insert(repeated.file);
            groups_.warnings.push_back(
                {Issue::lod_repeated, repeated.file, "",
                 repeated.level > 0
                     ? fmt::format("is level {} of {}, as is {}, which is used: this file is left out",
                                   repeated.level, source, first)
                     : fmt::format("is level 0, as is {}, which has the levels: this file is a source "
                                   "without them, in the same place",
                                   first)});
        }
    }

    const std::vector<std::string>& files_;
    const profiles::Configuration& configuration_;
    std::map<std::string, ListedLevels> listed_; ///< by file; all paths here and below are normal
    std::map<std::string, Words> lods_of_file_;
    std::set<std::string> level_files_; ///< files that are levels, not sources
    LodGroups groups_;
};

} // namespace

Result<LodGroups> groupLods(const std::vector<std::string>& files,
                            const profiles::Configuration& configuration)
{
    return LodGrouper(files, configuration).group();
}

} // namespace hearth::command
