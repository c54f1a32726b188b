// hearth cook: runs the cookers over sources and links what they make into one pack.
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

using graph::BrickOptions;
using graph::VisibilityOptions;

struct CookOptions : graph::CookSettings, Effort
{
    std::vector<std::string> lods;   ///< of --lod, "N=FILE": levels of detail of the only source
    bool fail_fast = false;          ///< end at the first failure; else cook what does not depend on it
    std::vector<std::string> caches; ///< of --cache, nearest first; none: as cache::cacheSpecs says
    bool no_cache = false;
    bool force = false;                  ///< run everything, whatever the cache has
    bool explain = false;                ///< say why each cooker runs
    bool dry_run = false;                ///< only say what would run
    bool dry_run_checks = false;         ///< end with 1 where something would run
    std::string dry_run_format = "text"; ///< or "json": the plan
    /// Warnings that count as errors, as "W1302"; nothing: none does, an empty list: all do.
    std::optional<std::vector<std::string>> fatal_warnings;
    std::string depfile; ///< what was read, as depfileOf writes it; empty: none
    /// Written whatever the end: .html is the page, .xml JUnit's, .csv a table, all else JSON.
    std::vector<std::string> report_files;
    std::string events_file;  ///< empty: none
    bool lists_files = false; ///< has cookers list what they look for, without a cache too
    /// Words of the user that the sources come from: files of folders that nobody reads are named. None: they
    /// are not.
    std::vector<std::string> source_words;
    /// Warnings of the settings, as lines: told before anything runs.
    std::vector<std::string> setting_warnings;
};

/// Cook all sources into one pack, their scenes side by side: run what the cache has no result of. The output appears whole
/// or not at all; on failure or interruption an output that was there before is as it was, and nothing else is left behind.
/// looked_for  gets the files that it has read, or has looked for in vain; null: does not
/// returns     the exit code; every problem has been told on stderr
int cook(const CookOptions& options, std::vector<std::string>* looked_for = nullptr);

} // namespace hearth::command
