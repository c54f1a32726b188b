// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/unmatched_rules.h"

#include "pipelines/command/sources/source_list.h"
#include "pipelines/profiles/glob.h"
#include "pipelines/profiles/nearest_path.h"
#include "pipelines/profiles/rules_by_path.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

using profiles::Configuration;
using profiles::Rule;

/// Pattern of a rule that no source matches.
struct Pattern
{
    Issue issue;
    std::string file; ///< in which the rule is
    std::string place;
    std::string match;
};

/// Return the patterns of the rules that hold with the chosen profile: those of the project's file, and those
/// of lists of rules that have a path.
std::vector<Pattern> listPatterns(const Configuration& configuration)
{
    std::vector<Pattern> patterns;
    const auto addPathRules = [&](const settings::Values& values)
    {
        for (const profiles::PathRule& rule : profiles::listPathRules(values))
            patterns.push_back({Issue::texture_unmatched, rule.origin, rule.place, rule.path});
    };
    addPathRules(configuration.valuesOfPack());
    const profiles::ConfigFile* project = configuration.projectFile();
    for (size_t i = 0; project != nullptr && i < project->rules.size(); ++i)
        if (const Rule& rule = project->rules[i]; rule.appliesTo(configuration.profileName()))
        {
            patterns.push_back({Issue::rule_unmatched, project->path, rule.place, rule.match});
            addPathRules(rule.values);
        }
    return patterns;
}

/// Add the paths by which rules match the sources.
void addPaths(const Configuration& configuration, const std::vector<std::string>& sources,
              std::vector<std::string>& paths)
{
    for (const std::string& source : sources)
        if (std::string path = configuration.pathForRules(source); !path.empty())
            paths.push_back(std::move(path));
}

void removeMatched(std::vector<Pattern>& patterns, const std::vector<std::string>& paths)
{
    std::erase_if(patterns,
                  [&](const Pattern& pattern)
                  {
                      return std::any_of(paths.begin(), paths.end(),
                                         [&](const std::string& path)
                                         { return profiles::matchesPath(pattern.match, path); });
                  });
}

std::string describeMismatch(const Pattern& rule, const std::vector<std::string>& paths)
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
    std::vector<Pattern> patterns = listPatterns(configuration);
    std::vector<std::string> paths;
    addPaths(configuration, sources, paths);
    removeMatched(patterns, paths);
    if (patterns.empty())
        return {};
    // search the folder only now, because few cooks need it
    if (configuration.projectFile() != nullptr)
        if (const auto models = expandSources({configuration.projectFolder()}); models.ok())
            addPaths(configuration, *models, paths);
    removeMatched(patterns, paths);
    if (paths.empty() && sources.empty())
        return {};
    std::vector<Error> warnings;
    for (const Pattern& pattern : patterns)
        warnings.push_back({pattern.issue, pattern.file, pattern.place, describeMismatch(pattern, paths)});
    return warnings;
}

} // namespace hearth::command
