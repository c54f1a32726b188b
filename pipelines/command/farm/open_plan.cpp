// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/farm/open_plan.h"

#include "cook/tools/child_processes.h"
#include "cook/tools/sha256.h"
#include "formats/base/regular_file.h"
#include "pipelines/graph/journal.h"

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace hearth::command
{

namespace
{

constexpr std::string_view kFolderScheme = "dir:";

std::string absoluteCache(const std::string& cache)
{
    if (!cache.starts_with(kFolderScheme))
        return cache;
    const size_t options = std::min(cache.find(','), cache.size());
    const std::string folder = cache.substr(kFolderScheme.size(), options - kFolderScheme.size());
    // an empty folder is reported where the cache is opened
    return folder.empty() ? cache
                          : std::string(kFolderScheme) + graph::absolutePath(folder) + cache.substr(options);
}

std::string withoutSuffix(const std::string& text, std::string_view ending)
{
    return text.ends_with(ending) && text.size() > ending.size() ? text.substr(0, text.size() - ending.size())
                                                                 : text;
}

} // namespace

std::vector<std::string> absoluteCaches(const std::vector<std::string>& caches)
{
    std::vector<std::string> given = caches;
    const char* variable = std::getenv("HEARTH_CACHE");
    if (std::string_view rest = variable == nullptr ? "" : variable; given.empty() && rest != "off")
        while (!rest.empty())
        {
            const size_t end = std::min(rest.find(';'), rest.size());
            given.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    for (std::string& cache : given)
        cache = absoluteCache(cache);
    return given;
}

Result<OpenedPlan> openPlan(const PlanOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(options.plan_file));
    OpenedPlan opened;
    HEARTH_ASSIGN_OR_RETURN(opened.plan, farm::parsePlan(text, options.plan_file));
    if (!options.directory.empty())
        opened.plan.folder = opened.directory = graph::absolutePath(options.directory);
    opened.file = graph::absolutePath(options.plan_file);
    opened.hash = tools::computeSha256(text);
    opened.caches = absoluteCaches(options.caches);
    return opened;
}

Status enterSourceFolder(const OpenedPlan& opened)
{
    std::error_code error;
    std::filesystem::current_path(opened.plan.folder, error);
    if (error)
        return Error{Issue::input_missing, opened.plan.folder, "",
                     "the folder of the sources is not here: " + error.message()};
    return success();
}

farm::FarmJob makeFarmJob(const OpenedPlan& opened, const std::string& pack)
{
    farm::FarmJob job;
    job.hearth = tools::programFolder() + "/hearth";
    job.plan_file = opened.file;
    job.pack = pack.empty() ? withoutSuffix(withoutSuffix(opened.file, ".json"), ".plan") + ".hearth"
                            : graph::absolutePath(pack);
    job.directory = opened.directory;
    job.caches = opened.caches;
    job.shard_count = opened.plan.shards.size();
    job.has_two_steps = farm::hasTwoSteps(opened.plan.graph);
    return job;
}

} // namespace hearth::command
