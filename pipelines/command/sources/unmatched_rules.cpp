// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/unmatched_rules.h"

#include "pipelines/command/sources/source_list.h"
#include "pipelines/profiles/glob.h"
#include "pipelines/profiles/nearest_path.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

using profiles::Configuration;
using profiles::Rule;

/// Add the paths, relative to the project, of the sources that lie in it.
void addPaths(const Configuration& configuration, const std::vector<std::string>& sources,
              std::vector<std::string>& paths)
{
    for (const std::string& source : sources)
        if (std::string path = configuration.pathInProject(source); !path.empty())
            paths.push_back(std::move(path));
}

void removeMatched(std::vector<const Rule*>& rules, const std::vector<std::string>& paths)
{
    std::erase_if(rules,
                  [&](const Rule* rule)
                  {
                      return std::any_of(paths.begin(), paths.end(),
                                         [&](const std::string& path)
                                         { return profiles::matchesPath(rule->match, path); });
                  });
}

std::string describeMismatch(const Rule& rule, const std::vector<std::string>& paths)
{
    const std::optional<profiles::NearestPath> nearest = profiles::nearestPath(rule.match, paths);
    if (!nearest)
        return fmt::format("'{}' matches no source: none lies in the folder of this file", rule.match);
    const std::string pattern =
        nearest->pattern.empty() ? "" : fmt::format(", which '{}' would match", nearest->pattern);
    return fmt::format("'{}' matches no source; nearest: {}{}", rule.match, nearest->path, pattern);
}

} // namespace

std::vector<Error> findUnmatchedRules(const Configuration& configuration,
                                      const std::vector<std::string>& sources)
{
    std::vector<const Rule*> rules;
    const profiles::ConfigFile* project = configuration.projectFile();
    for (size_t i = 0; project != nullptr && i < project->rules.size(); ++i)
        if (project->rules[i].appliesTo(configuration.profileName()))
            rules.push_back(&project->rules[i]);
    std::vector<std::string> paths;
    addPaths(configuration, sources, paths);
    removeMatched(rules, paths);
    if (rules.empty())
        return {};
    // search the folder only now, because few cooks need it
    if (const auto models = expandSources({configuration.projectFolder()}); models.ok())
        addPaths(configuration, *models, paths);
    removeMatched(rules, paths);
    if (paths.empty() && sources.empty())
        return {};
    std::vector<Error> warnings;
    for (const Rule* rule : rules)
        warnings.push_back(
            {Issue::rule_unmatched, project->path, rule->place, describeMismatch(*rule, paths)});
    return warnings;
}

} // namespace hearth::command
