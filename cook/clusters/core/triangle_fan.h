// A few triangles of a surface, prepared for repeated nearest-point queries.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "cook/clusters/core/triangle_block.h"
#include "formats/base/assert.h"
#include "formats/base/math.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Point of a triangle: (1 - v - w) * corner 0 + v * corner 1 + w * corner 2.
struct TrianglePoint
{
    TriangleId triangle = kInvalid;
    float v = 0, w = 0;
    float distance2 = 0; ///< squared distance from the position that was projected

    std::array<float, 3> parts() const { return {1 - v - w, v, w}; }
};

inline Float3 trianglePosition(const TrianglePoint& point,
                               IdSpan<TriangleId, const DistanceTriangle> triangles)
{
    const DistanceTriangle& triangle = triangles[point.triangle];
    return triangle.a + triangle.ab * point.v + triangle.ac * point.w;
}

/// Triangles of a surface in SIMD blocks, for nearest-point queries.
class TriangleFan
{
public:
    /// Load some triangles of a surface.
    /// triangles  triangles of the surface
    /// fan        some of them, at least one; must outlive the use of the fan
    void load(IdSpan<TriangleId, const DistanceTriangle> triangles, std::span<const TriangleId> fan)
    {
        HEARTH_ASSERT(!fan.empty());
        fan_ = fan;
        blocks_.clear();
        // unused lanes repeat the last triangle
        for (size_t first = 0; first < fan.size(); first += kLanes)
        {
            std::array<const DistanceTriangle*, kLanes> block;
            for (size_t i = 0; i < kLanes; ++i)
                block[i] = &triangles[fan[std::min(first + i, fan.size() - 1)]];
            blocks_.push_back(makeTriangleBlock(block));
        }
    }

    /// Find the nearest point on all of the triangles, by TriangleBlock::nearest.
    TrianglePoint nearest(Float3 place) const
    {
        HEARTH_RUNTIME_ASSERT(!blocks_.empty());
        Lanes least = splat(std::numeric_limits<float>::infinity());
        Lanes v{}, w{};
        LaneMask blocks{};
        for (size_t block = 0; block < blocks_.size(); ++block)
        {
            const TriangleBlock::Nearest nearest = blocks_[block].nearest(place);
            const LaneMask nearer = nearest.distance2 < least;
            least = nearer ? nearest.distance2 : least;
            v = nearer ? nearest.v : v;
            w = nearer ? nearest.w : w;
            blocks = nearer ? LaneMask{} + static_cast<int32_t>(block) : blocks;
        }
        size_t lane = 0;
        for (size_t i = 1; i < kLanes; ++i)
            if (least[i] < least[lane])
                lane = i;
        const size_t found = static_cast<size_t>(blocks[lane]) * kLanes + lane;
        return {fan_[std::min(found, fan_.size() - 1)], v[lane], w[lane], least[lane]};
    }

    /// Call visit(point) with the nearest point on each of the triangles.
    template <typename Visit>
    void forEachNearest(Float3 place, Visit visit) const
    {
        for (size_t block = 0; block < blocks_.size(); ++block)
        {
            const TriangleBlock::Nearest nearest = blocks_[block].nearest(place);
            for (size_t i = 0; i < std::min(kLanes, fan_.size() - block * kLanes); ++i)
                visit(TrianglePoint{fan_[block * kLanes + i], nearest.v[i], nearest.w[i],
                                    nearest.distance2[i]});
        }
    }

private:
    std::span<const TriangleId> fan_;
    std::vector<TriangleBlock> blocks_;
};

} // namespace hearth::clusters
