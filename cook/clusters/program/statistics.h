// Statistics of each cooked mesh, for people and scripts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/program/discrete_lods.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::clusters
{

/// Errors of the clusters of a level.
struct ErrorStatistics
{
    double max = 0;
    double mean = 0; ///< mean over the triangles
};

struct LevelStatistics
{
    uint32_t clusters = 0;
    uint64_t triangles = 0;
    double fill = 0;          ///< triangles relative to full clusters
    ErrorStatistics error;    ///< object space: the error that chooses the cut
    ErrorStatistics position; ///< object space
    ErrorStatistics normal;   ///< radians
    ErrorStatistics uv;       ///< object space
};

/// Result of a LevelTarget.
struct TargetStatistics
{
    uint32_t level = 0;
    uint64_t wanted = 0;
    std::optional<uint64_t> triangles; ///< nothing if the hierarchy has no such level
    bool met() const;                  ///< within 3 %, as users are promised
};

/// Comparison of the hierarchy with discrete LODs.
struct DiscreteLodStatistics
{
    DiscreteLods chain;
    uint64_t hierarchy_bytes = 0; ///< storedBytes
};

struct MeshStatistics
{
    uint32_t index = 0;
    std::string name;
    uint32_t source_triangles = 0;
    uint32_t source_vertices = 0;
    uint32_t degenerate_triangles = 0;
    uint32_t groups = 0;
    uint32_t clusters = 0;
    uint32_t pages = 0;
    uint64_t page_bytes = 0;        ///< decoded
    uint64_t stored_page_bytes = 0; ///< as stored in the file
    std::vector<LevelStatistics> levels;
    std::vector<TargetStatistics> targets;
    std::vector<uint32_t> authored_levels; ///< as in Hierarchy
    BuildCounts counts;
    std::optional<DiscreteLodStatistics> discrete_lods; ///< slow to compute, so only on request
    /// Wall-clock time of the build; differs from run to run, so only on request.
    std::optional<double> seconds;
};

/// Collect the statistics of a hierarchy that was built with `config`.
MeshStatistics collectStatistics(const Hierarchy& hierarchy, const Config& config, uint32_t index,
                                 std::string name);

/// Format the statistics as JSON, schema "hearth.clusters/1". `source` is the name of the input.
std::string statisticsJson(const std::string& source, std::span<const MeshStatistics> meshes);

} // namespace hearth::clusters
