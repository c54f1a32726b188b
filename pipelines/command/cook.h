// hearth cook: runs the cookers over sources and links what they make into one pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/terminal.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// What hearth-visibility is told.
struct VisibilityOptions
{
    std::string quality = "default";
    std::string occluders = "scene";
    double distance = 0; ///< metres; 0: no limit
    double power = 0;    ///< with a distance only
};

/// What hearth-bricks is told; else it decides itself.
struct BrickOptions
{
    std::optional<double> voxel_size;     ///< metres
    std::optional<uint64_t> memory_bytes; ///< of the GPU
};

struct CookOptions
{
    std::vector<std::string> sources;
    std::string output;
    /// Cookers at once. They are parallel themselves: two are enough to hide their serial parts, and each more costs
    /// the memory of another mesh.
    unsigned jobs = 2;
    Verbosity verbosity = Verbosity::normal;
    std::vector<std::string> lods;               ///< "N=FILE": levels of detail of the only source
    std::string profile;                         ///< TOML file that the cookers read; empty: none
    std::string report_file;                     ///< empty: none
    std::optional<VisibilityOptions> visibility; ///< none: vertices do not say what they see
    std::optional<BrickOptions> bricks;          ///< none: the pack has no grid of bricks
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
};

struct CookOutcome
{
    int exit_code = 0;
    std::string error; ///< the error line, empty on success
    size_t failed_source = 0;
    std::vector<StageRecord> stages;             ///< in the order of the plan, those that ended well
    std::vector<std::string> cluster_statistics; ///< of each source, JSON of hearth-clusters; for the report
    std::string brick_statistics;                ///< JSON of hearth-bricks; for the report
    double seconds = 0;
    uint64_t output_bytes = 0;
};

/// Cook all sources into one pack, their scenes side by side. The output appears whole or not at all; on failure or
/// interruption an output that was there before is as it was, and nothing else is left behind.
/// returns    the exit code; every problem has been told on stderr
int cook(const CookOptions& options);

/// Schema "hearth.report/1". `meta` is the pack's META, empty on failure.
std::string reportJson(const CookOptions& options, const CookOutcome& outcome, std::string_view meta);

} // namespace hearth::command
