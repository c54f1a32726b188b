// Reorders the triangles of a cluster so that most share an edge with the one before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/page_codec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::pages
{

/// Start of a triangle: formats::kEdge*, or kEdgeNone for a restart.
inline constexpr uint8_t kEdgeNone = 4;

struct WalkStep
{
    uint8_t edge = kEdgeNone;
    std::array<uint8_t, 3> corners; ///< the edge, then the added corner
};

/// Walks the triangles of one cluster after the other.
class TriangleWalk
{
public:
    TriangleWalk() : across_(size_t{1} << 16, kNoEdge) {}

    /// Return each triangle once, rotated so that it begins with its edge. Valid until the next walk.
    ///
    /// indices  three for each of at most kMaxClusterTriangles
    /// known    for each vertex: not 0 if an earlier cluster has it; the walk begins there
    std::span<const WalkStep> walk(std::span<const uint8_t> indices, std::span<const uint16_t> known);

    /// Return the walk of a stored page, from its triangles in their order and its codes. Valid until the
    /// next walk.
    ///
    /// codes  of the cluster, in formats::codeBytes
    std::span<const WalkStep> replay(std::span<const uint8_t> indices, std::span<const uint8_t> codes);

private:
    static constexpr uint16_t kNoEdge = 4 * formats::kMaxClusterTriangles;

    void linkEdges();
    void follow(uint32_t triangle);
    void cross(uint8_t edge, uint8_t from, uint8_t to);
    uint32_t bestStart() const;
    bool free(uint8_t from, uint8_t to) const { return visited_[across(from, to) / 4] == 0; }
    uint32_t across(uint8_t from, uint8_t to) const { return across_[size_t{from} << 8 | to]; }
    std::array<uint8_t, 3> triangleCorners(uint32_t triangle) const
    {
        return {indices_[triangle * 3], indices_[triangle * 3 + 1], indices_[triangle * 3 + 2]};
    }
    void visit(uint32_t triangle, const WalkStep& step);

    struct KeptEdge
    {
        uint8_t from, to;
        uint32_t step; ///< step that could keep it
    };

    std::span<const uint8_t> indices_;
    /// 4 * triangle that has the edge from << 8 | to + the number of its corner opposite that edge
    std::vector<uint16_t> across_;
    /// The last is a sentinel for no triangle.
    std::array<uint8_t, formats::kMaxClusterTriangles + 1> visited_{};
    std::array<uint8_t, formats::kMaxClusterVertices> available_{}; ///< 1: placed, or known
    std::vector<KeptEdge> kept_;
    std::array<WalkStep, formats::kMaxClusterTriangles> steps_;
    uint32_t step_count_ = 0;
};

} // namespace hearth::pages
