// hearth cook: runs the cookers on sources, and links their results into one pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/run_limits.h"
#include "pipelines/graph/cook_graph.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

struct CookOptions : graph::CookSettings, RunLimits
{
    std::vector<std::string> lods; ///< values of --lod, "N=FILE": authored LODs of the only source
    bool fail_fast = false;        ///< stop at the first failure; else cook all that does not depend on it
    /// Make the pack without the sources that cannot be cooked; else there is no pack.
    bool skips_missing = false;
    std::vector<std::string>
        caches; ///< values of --cache, nearest first; none: cache::resolveCacheSpecs decides
    bool no_cache = false;
    bool force = false;                  ///< run every cooker, whatever the cache has
    bool explain = false;                ///< print why each cooker runs
    bool dry_run = false;                ///< only print what would run
    bool dry_run_checks = false;         ///< exit with 1 if something would run
    std::string dry_run_format = "text"; ///< "text", or "json": the plan
    /// Warnings that count as errors, as "W1302"; nullopt: none, an empty list: all.
    std::optional<std::vector<std::string>> fatal_warnings;
    std::string depfile; ///< file for the list of files read, see makeDepfile; empty: none
    /// Reports, written whatever the outcome: .html is the page, .xml JUnit's, .csv a table, all else JSON.
    std::vector<std::string> report_files;
    std::string events_file;  ///< empty: none
    bool lists_files = false; ///< have cookers list the files that they look for, even without a cache
    /// Words of the command line that the sources come from. Files of folders among them that no cooker reads
    /// are printed. Empty: they are not.
    std::vector<std::string> source_words;
    /// Warning lines about the settings, printed before anything runs.
    std::vector<std::string> setting_warnings;
};

/// Cook all sources into one pack, their scenes side by side: run the actions whose result is not in the
/// cache (incremental build). The output appears whole or not at all. After a failure or an interruption an
/// old output is unchanged, and nothing else is left behind.
/// dependencies  receives the files that were read or probed; null: not needed
/// returns     the exit code, 1 for a pack without some of its sources; every problem has been printed on
///             stderr
int cook(const CookOptions& options, std::vector<std::string>* dependencies = nullptr);

} // namespace hearth::command
