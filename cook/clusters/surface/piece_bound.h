// Bounds the distance of a piece of a triangle to a few other triangles. See cook/clusters/README.md,
// "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/triangle_block.h"
#include "formats/base/assert.h"
#include "formats/base/math.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace hearth::clusters
{

using Corners = std::array<Float3, 3>;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr size_t kMaxBlocks = 8;
inline constexpr size_t kMaxCandidates = kLanes * kMaxBlocks;
inline constexpr size_t kMaxPoints = 28;

// Pieces are cut until their bounds are within this factor of the group's largest distance.
inline constexpr float kSlack = 1.1f;
inline constexpr float kSlack2 = kSlack * kSlack;

/// Candidate triangles for the bound of a piece, at most kMaxCandidates.
class Candidates
{
public:
    void load(std::span<const DistanceTriangle> triangles)
    {
        HEARTH_ASSERT(!triangles.empty() && triangles.size() <= kMaxCandidates);
        block_count_ = (triangles.size() + kLanes - 1) / kLanes;
        for (size_t b = 0; b < block_count_; ++b)
        {
            // unused lanes repeat the first triangle
            std::array<const DistanceTriangle*, kLanes> lanes;
            for (size_t lane = 0; lane < kLanes; ++lane)
                lanes[lane] = &triangles[b * kLanes + lane < triangles.size() ? b * kLanes + lane : 0];
            blocks_[b] = makeTriangleBlock(lanes);
        }
    }

    std::span<const TriangleBlock> blocks() const { return std::span(blocks_).first(block_count_); }

private:
    std::array<TriangleBlock, kMaxBlocks> blocks_;
    size_t block_count_ = 0;
};

/// Distance between points of two surfaces that depends on more than their positions.
class PointMetric
{
public:
    virtual ~PointMetric() = default;

    /// Return the squared distances of a point of the piece to points of a block's candidates. The distance
    /// is convex along straight lines on both surfaces.
    /// plane  coordinates of the point: multiples of the piece's edges from corner 0
    virtual Lanes distance2(Float2 plane, size_t block, const TriangleBlock::Nearest& nearest) const = 0;
};

/// Bounds of the distance between a piece and its candidates, squared.
struct Bound
{
    float upper2; ///< the whole piece is within this distance of the candidates, squared
    float found2; ///< some point of the piece is this far from these candidates, squared
    float sure2;  ///< some point of the piece is this far from all triangles, squared
    bool closed;  ///< upper2 is within the tolerance
};

/// Bounds the distance of one piece of a triangle to a few triangles.
class PieceBounder
{
public:
    /// Cut the piece where the nearest candidate changes, until every part is within allowed2 of one
    /// candidate (or within 10 % of a real distance), or the points run out. Parts are cut at corners of
    /// candidates that lie over them, else where an edge leaves the candidate that it starts on: on a plane
    /// this is the common refinement of both surfaces.
    ///
    /// blocks    all triangles that are within `radius` of the piece, and perhaps others
    /// metric    instead of the distance, between a point and the nearest one of each candidate; null: the
    ///           distance
    Bound bound(const Corners& piece, std::span<const TriangleBlock> blocks, float allowed2, float radius,
                size_t max_points = kMaxPoints, const PointMetric* metric = nullptr);

    /// True if the last bound of some part was taken from the candidate.
    bool wasUsed(size_t candidate) const { return (used_ >> candidate & 1) != 0; }

    /// Return the squared distance of the parts whose bounds were taken from a used candidate.
    float usedDistance2(size_t candidate) const { return used_distance2_[candidate]; }

private:
    using Part = std::array<uint8_t, 3>;
    static constexpr uint8_t kNoPoint = 0xFF;

    /// Corners this near to an edge of the piece are left to the cuts of edges.
    static constexpr float kCornerMargin = 0.01f;

    /// Shortest part of an edge that is worth cutting off.
    static constexpr float kMinCut = 0.01f;

    /// Point of the piece, with its coordinates in the piece's plane and its squared distance to each
    /// candidate.
    struct Probe
    {
        Float3 place;
        Float2 plane; ///< multiples of the piece's edges from corner 0
        std::array<Lanes, kMaxBlocks> distance2;
    };

    void use(size_t candidate, float distance2);
    float tolerance2() const;
    uint8_t addPoint(Float3 place, Float2 plane);
    template <size_t N>
    float commonDistance2(const std::array<uint8_t, N>& names) const;
    size_t best(const Part& part) const;
    void findCorners();
    void keepInside(Lanes x, Lanes y);
    Float3 positionAt(Float2 plane) const;
    uint8_t cornerInside(const Part& part);
    size_t worstEdge(const Part& part) const;
    uint8_t cutEdge(uint8_t p, uint8_t q);

    std::span<const TriangleBlock> blocks_;
    const PointMetric* metric_ = nullptr;
    uint64_t used_ = 0;                                  ///< a bit for each candidate
    std::array<float, kMaxCandidates> used_distance2_{}; ///< set for those with a bit
    float allowed2_ = 0;
    float radius2_ = 0;
    float lower2_ = 0; ///< largest distance of a point to the candidates; valid up to radius2_
    std::array<Probe, kMaxPoints> points_;
    size_t point_count_ = 0;
    std::array<Part, 3 * kMaxPoints> stack_;
    std::array<Float2, 12> corners_;
    uint32_t corner_count_ = 0;
    bool corners_found_ = false;
};

} // namespace hearth::clusters
