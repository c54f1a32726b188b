// What became of each mesh, as numbers for people and scripts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/program/manual_lods.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::clusters
{

/// Of the clusters of a level.
struct ErrorStatistics
{
    double max = 0;
    double mean = 0; ///< over the triangles
};

struct LevelStatistics
{
    uint32_t clusters = 0;
    uint64_t triangles = 0;
    double fill = 0;          ///< triangles, of those that as many full clusters would have
    ErrorStatistics error;    ///< object space: what chooses the cut
    ErrorStatistics position; ///< object space
    ErrorStatistics normal;   ///< radians
    ErrorStatistics uv;       ///< object space
};

/// What became of a LevelTarget.
struct TargetStatistics
{
    uint32_t level = 0;
    uint64_t wanted = 0;
    std::optional<uint64_t> triangles; ///< nothing where the hierarchy has no such level
    bool met() const;                  ///< within 3 %, what users are promised
};

/// The hierarchy against levels by hand.
struct ManualLodStatistics
{
    ManualLods chain;
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
    uint64_t stored_page_bytes = 0; ///< as they lie in the file
    std::vector<LevelStatistics> levels;
    std::vector<TargetStatistics> targets;
    std::vector<uint32_t> authored_levels; ///< as in Hierarchy
    BuildCounts counts;
    std::optional<ManualLodStatistics> manual_lods; ///< takes time, so only on request
    std::optional<double>
        seconds; ///< that building took; what differs from run to run is only there on request
};

/// `config` is what the hierarchy was built with.
MeshStatistics statisticsOf(const Hierarchy& hierarchy, const Config& config, uint32_t index,
                            std::string name);

/// Schema "hearth.clusters/1". `source` is the name of what was read.
std::string statisticsJson(const std::string& source, std::span<const MeshStatistics> meshes);

} // namespace hearth::clusters
