// hearth cook: runs the cookers over sources and links what they make into one pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/terminal.h"
#include "pipelines/graph/cook_graph.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

using graph::BrickOptions;
using graph::VisibilityOptions;

struct CookOptions : graph::CookSettings
{
    /// Cookers at once. They are parallel themselves: two are enough to hide their serial parts, and each more costs
    /// the memory of another mesh.
    unsigned jobs = 2;
    /// What the cookers may take together, by their estimates; 0: three quarters of the machine's memory.
    uint64_t memory_bytes = 0;
    bool fail_fast = false;          ///< end at the first failure; else cook what does not depend on it
    std::vector<std::string> caches; ///< of --cache, nearest first; none: as cache::cacheSpecs says
    bool no_cache = false;
    bool force = false;                  ///< run everything, whatever the cache has
    bool explain = false;                ///< say why each cooker runs
    bool dry_run = false;                ///< only say what would run
    std::string dry_run_format = "text"; ///< or "json": the plan
    Verbosity verbosity = Verbosity::normal;
    std::string progress = "auto"; ///< see progressStyle
    /// Warnings that count as errors, as "W1302"; nothing: none does, an empty list: all do.
    std::optional<std::vector<std::string>> fatal_warnings;
    std::string report_file; ///< empty: none
    std::string events_file; ///< empty: none
};

/// One cooker's run.
struct StageRecord
{
    std::string
        stage; ///< "import", "clusters", "textures", "skinning", "visibility", "specular", "bricks", "link"
    size_t source = 0; ///< index of the source; their number for what is not of one source
    double seconds = 0;
    double cpu_seconds = 0;
    uint64_t peak_rss_bytes = 0;
    uint64_t output_bytes = 0;
    bool cached = false; ///< the result was kept from an earlier run, whose times these are
};

/// What hearth-visibility says of a source; for the report.
struct VisibilityReport
{
    std::string statistics; ///< JSON
    std::string picture;    ///< PNG
};

struct CookOutcome
{
    int exit_code = 0;
    std::string error;                           ///< the first error line, empty on success
    std::vector<size_t> failed_sources;          ///< their number for what is not of one
    bool is_up_to_date = false;                  ///< the pack was there already, byte for byte
    std::vector<StageRecord> stages;             ///< in the order of the graph; none on failure
    std::vector<std::string> cluster_statistics; ///< of each source, JSON of hearth-clusters; for the report
    std::vector<VisibilityReport> visibility;    ///< of each source, where visibility was baked
    std::string brick_statistics;                ///< JSON of hearth-bricks; for the report
    double seconds = 0;
    uint64_t output_bytes = 0;
};

/// Cook all sources into one pack, their scenes side by side: run what the cache has no result of. The output appears whole
/// or not at all; on failure or interruption an output that was there before is as it was, and nothing else is left behind.
/// returns    the exit code; every problem has been told on stderr
int cook(const CookOptions& options);

/// Schema "hearth.report/1". `meta` is the pack's META, empty on failure.
std::string reportJson(const CookOptions& options, const CookOutcome& outcome, std::string_view meta);

} // namespace hearth::command
