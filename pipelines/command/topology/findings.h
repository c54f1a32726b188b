// Findings about the topology of a mesh, as inspect --topology reports them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/json/json.h"
#include "cook/mesh/source_mesh.h"
#include "cook/topology/topology.h"
#include "pipelines/command/topology/finding_kinds.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// Pairs of triangles of a mesh that intersect.
struct SelfIntersections
{
    uint64_t triangle_pairs = 0;
    std::vector<std::array<uint32_t, 2>> pairs; ///< some of them: triangles of the source mesh
};

/// Geometry that shows findings of one kind: points, edges and faces, by positions of their own.
struct FindingGeometry
{
    std::vector<Float3> positions; ///< object space
    std::vector<uint32_t> points;
    std::vector<std::array<uint32_t, 2>> edges;
    std::vector<std::array<uint32_t, 3>> faces;
};

/// Findings of one kind in one mesh.
struct FindingGroup
{
    Finding finding{};
    uint64_t count = 0;
    std::string detail;       ///< more about them, and where the first one is
    Json json;                ///< members beside the count; lists have up to kMaxListed items
    FindingGeometry geometry; ///< all of them; of intersections those that the check lists
};

inline constexpr size_t kMaxListed = 1000;

struct MeshFindings
{
    uint32_t mesh = 0;
    std::string name;
    uint32_t triangles = 0;
    uint32_t vertices = 0;
    uint32_t positions = 0;
    uint32_t components = 0;
    double tolerance = 0;                ///< of T-junctions
    std::vector<topology::Shell> shells; ///< the largest first
    std::vector<Float3> shell_positions; ///< a corner of each
    std::vector<FindingGroup> groups;    ///< those that have any, the worst kind first
};

/// Collect the findings of a mesh.
/// intersections  nullopt: not checked
MeshFindings collectFindings(const mesh::SourceMesh& mesh, uint32_t index,
                             const std::optional<SelfIntersections>& intersections);

/// Return the findings of a kind, or null.
const FindingGroup* findGroup(const MeshFindings& mesh, Finding finding);

const char* shellSideName(topology::ShellSide side);

} // namespace hearth::command
