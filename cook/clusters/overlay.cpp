// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

// All functions that pass eight lanes are inlined: no call depends on how they would be passed.
#pragma GCC diagnostic ignored "-Wpsabi"

// One function for processors with eight lanes, one for all others; the arithmetic, and so the result, is the same.
#define HEARTH_EIGHT_LANES __attribute__((target_clones("avx2", "default")))
#define HEARTH_INLINE inline __attribute__((always_inline))

namespace hearth::clusters
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Parts of the triangle's size that are taken for rounding: so far may what is looked at lie beside what is meant.
constexpr float kMargin = 1e-5f;

// Triangles flatter than this (their determinant against the squares of their edges) have no useful plane.
constexpr float kFlattest = 1e-4f;

using Eight = float __attribute__((vector_size(kEight * sizeof(float))));
using EightMask = int32_t __attribute__((vector_size(kEight * sizeof(int32_t))));

/// The triangle's own coordinates: barycentric u and v, of its corners 1 and 2, and the height over it.
struct View
{
    Float3 origin, to_u, to_v, to_h;
    float size = 0;
};

/// A corner of the patch as the triangle sees it.
struct Seen
{
    Eight u, v, w, h;
};

HEARTH_INLINE Eight greater(Eight a, Eight b)
{
    return a > b ? a : b;
}
HEARTH_INLINE Eight lesser(Eight a, Eight b)
{
    return a < b ? a : b;
}
HEARTH_INLINE Eight allEight(float x)
{
    return Eight{} + x;
}
HEARTH_INLINE bool anySet(EightMask mask)
{
    int64_t quarters[kEight / 2];
    std::memcpy(quarters, &mask, sizeof(mask));
    return (quarters[0] | quarters[1] | quarters[2] | quarters[3]) != 0;
}
template <typename Lane>
HEARTH_INLINE auto load(const Lane (&row)[kEight])
{
    Lane __attribute__((vector_size(kEight * sizeof(Lane)))) lanes;
    std::memcpy(&lanes, row, sizeof(lanes));
    return lanes;
}

HEARTH_INLINE Seen see(Eight x, Eight y, Eight z, const View& view)
{
    x -= view.origin.x;
    y -= view.origin.y;
    z -= view.origin.z;
    const auto along = [&](Float3 axis) { return x * axis.x + y * axis.y + z * axis.z; };
    const Eight u = along(view.to_u), v = along(view.to_v);
    return {u, v, 1.0f - u - v, along(view.to_h)};
}

/// Collects heights, and what forbids to trust them.
struct Finding
{
    Eight height{};
    EightMask failed{};
    EightMask covered[3]{};

    HEARTH_INLINE void add(EightMask mask, Eight h)
    {
        height = greater(height, mask ? greater(h, -h) : Eight{});
    }
};

HEARTH_INLINE EightMask isOver(const Seen& p, float margin)
{
    return lesser(lesser(p.u, p.v), p.w) > margin;
}

HEARTH_INLINE EightMask areBeyond(Eight a, Eight b, Eight c)
{
    return greater(greater(a, b), c) < -kMargin;
}

/// Where the edges a, b cross the edge of the triangle on which the coordinate `s` is 0 and `r` is that along the edge.
struct Crossing
{
    EightMask valid;
    Eight t;
};

HEARTH_INLINE Crossing cross(Eight sa, Eight sb, Eight ra, Eight rb)
{
    const EightMask apart = ((sa > kMargin) & (sb < -kMargin)) | ((sa < -kMargin) & (sb > kMargin));
    const Eight t = sa / (sa - sb);
    const Eight r = ra + t * (rb - ra);
    return {apart & (r > -kMargin) & (r < 1 + kMargin), t};
}

/// Edges from a to b: where they cross those of the triangle.
HEARTH_INLINE void addCrossings(const Seen& a, const Seen& b, Finding& finding)
{
    const auto add = [&](Crossing crossing) { finding.add(crossing.valid, a.h + crossing.t * (b.h - a.h)); };
    add(cross(a.u, b.u, a.v, b.v));
    add(cross(a.v, b.v, a.u, b.u));
    add(cross(a.w, b.w, a.u, b.u));
}

/// Edges from a to b that must not come over the triangle: each has to lie beyond one of the triangle's edges, or to
/// have all of the triangle on one side.
HEARTH_INLINE void addRim(const Seen& a, const Seen& b, EightMask rim, Finding& finding)
{
    const EightMask beyond =
        (greater(a.u, b.u) < kMargin) | (greater(a.v, b.v) < kMargin) | (greater(a.w, b.w) < kMargin);
    const Eight du = b.u - a.u, dv = b.v - a.v;
    const Eight at_0 = dv * a.u - du * a.v, at_1 = at_0 - dv, at_2 = at_0 + du;
    const Eight margin = kMargin * (greater(du, -du) + greater(dv, -dv));
    const EightMask aside =
        (lesser(lesser(at_0, at_1), at_2) > -margin) | (greater(greater(at_0, at_1), at_2) < margin);
    finding.failed |= rim & ~(beyond | aside);
}

/// The triangle's corners, at (0, 0), (1, 0) and (0, 1), over facets of twice the area `area2`.
HEARTH_INLINE void addOwnCorners(const Seen& a, const Seen& b, const Seen& c, Eight area2, EightMask usable,
                                 Finding& finding)
{
    // signed areas against each edge, at the first corner and how they change towards the others
    const Eight of_a = b.u * c.v - b.v * c.u, of_b = c.u * a.v - c.v * a.u, of_c = a.u * b.v - a.v * b.u;
    const Eight a_u = b.v - c.v, b_u = c.v - a.v, c_u = a.v - b.v;
    const Eight a_v = c.u - b.u, b_v = a.u - c.u, c_v = b.u - a.u;
    const Eight least_area = -kMargin * area2;
    const Eight inverse = 1.0f / area2;
    const auto addAt = [&](size_t corner, Eight at_a, Eight at_b, Eight at_c)
    {
        const EightMask inside = usable & (lesser(lesser(at_a, at_b), at_c) > least_area);
        finding.add(inside, (at_a * a.h + at_b * b.h + at_c * c.h) * inverse);
        finding.covered[corner] |= inside;
    };
    addAt(0, of_a, of_b, of_c);
    addAt(1, of_a + a_u, of_b + b_u, of_c + c_u);
    addAt(2, of_a + a_v, of_b + b_v, of_c + c_v);
}

/// The edges opposite the center that are on the rim: neither end is a center, or both are open.
HEARTH_INLINE EightMask rimOf(EightMask next, EightMask previous, std::span<const uint32_t> centers)
{
    const EightMask next_open = next < 0, previous_open = previous < 0;
    next = next_open ? ~next : next;
    previous = previous_open ? ~previous : previous;
    EightMask central{};
    for (const uint32_t center : centers)
        central |= (next == static_cast<int32_t>(center)) | (previous == static_cast<int32_t>(center));
    return ~central | (next_open & previous_open);
}

HEARTH_INLINE void addBlock(const StarBlock& block, const Seen& center, bool center_open,
                            std::span<const uint32_t> centers, const View& view, Finding& finding)
{
    const Seen next = see(load(block.next[0]), load(block.next[1]), load(block.next[2]), view);
    const Seen previous =
        see(load(block.previous[0]), load(block.previous[1]), load(block.previous[2]), view);
    const EightMask beside = areBeyond(center.u, next.u, previous.u) |
                             areBeyond(center.v, next.v, previous.v) |
                             areBeyond(center.w, next.w, previous.w);
    if (!anySet(~beside))
        return;
    const EightMask next_name = load(block.next_name), previous_name = load(block.previous_name);
    const Eight area2 =
        (next.u - center.u) * (previous.v - center.v) - (next.v - center.v) * (previous.u - center.u);
    const EightMask upward = area2 > 0.0f;
    finding.failed |= ~(upward | beside);
    addCrossings(center, next, finding);
    if (center_open)
    {
        addRim(center, next, next_name < 0, finding);
        addRim(center, previous, previous_name < 0, finding);
        addCrossings(center, previous, finding);
    }
    addRim(next, previous, rimOf(next_name, previous_name, centers), finding);
    finding.add(isOver(next, -kMargin), next.h);
    finding.add(isOver(previous, -kMargin), previous.h);
    addOwnCorners(center, next, previous, area2, upward, finding);
}

/// The greatest height where corners or edges of triangle and patch meet, or infinity.
HEARTH_EIGHT_LANES float greatestHeight(const Surface& surface, const StarBlocks& blocks,
                                        std::span<const uint8_t> open, std::span<const uint32_t> centers,
                                        const View& view)
{
    Finding finding;
    for (const uint32_t position : centers)
    {
        const Float3 place = surface.place_of_position[position];
        const Seen center = see(allEight(place.x), allEight(place.y), allEight(place.z), view);
        finding.add(isOver(center, -kMargin), center.h);
        for (const StarBlock& block : blocks.of(position))
            addBlock(block, center, open[position] != 0, centers, view, finding);
    }
    if (anySet(finding.failed) || !anySet(finding.covered[0]) || !anySet(finding.covered[1]) ||
        !anySet(finding.covered[2]))
        return kInfinity;
    float greatest = 0;
    for (size_t lane = 0; lane < kEight; ++lane)
        greatest = std::max(greatest, finding.height[lane]);
    return greatest;
}

/// Returns false for a triangle without a useful plane.
bool makeView(const Corners& triangle, View& view)
{
    const Float3 e1 = triangle[1] - triangle[0];
    const Float3 e2 = triangle[2] - triangle[0];
    const float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2);
    const float det = d11 * d22 - d12 * d12;
    if (!(det > kFlattest * d11 * d22))
        return false;
    const Float3 normal = hearth::cross(e1, e2);
    view.origin = triangle[0];
    view.to_u = (e1 * d22 - e2 * d12) / det;
    view.to_v = (e2 * d11 - e1 * d12) / det;
    view.to_h = normal / length(normal);
    view.size = std::sqrt(std::max(d11, d22));
    return true;
}

} // namespace

void Overlay::addCenter(uint32_t position)
{
    if (std::find(centers_.begin(), centers_.end(), position) == centers_.end())
        centers_.push_back(position);
}

float Overlay::heightOver(const Corners& triangle) const
{
    View view;
    if (!makeView(triangle, view))
        return kInfinity;
    return greatestHeight(surface_, blocks_, open_, centers_, view) + 4 * kMargin * view.size;
}

} // namespace hearth::clusters
