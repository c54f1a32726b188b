// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

// All functions that pass eight lanes are inlined: no call depends on how they would be passed.
#pragma GCC diagnostic ignored "-Wpsabi"

// One function for processors with eight lanes, one for all others; the arithmetic, and so the result, is the same.
#ifdef __x86_64__
#define HEARTH_EIGHT_LANES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define HEARTH_EIGHT_LANES
#endif
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

// Facets whose area, as the triangle sees it, is below 1e-4 of their edges' product stand upright.
constexpr float kSteepest = 1e-4f / (kMargin * kMargin);

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
    Eight height = Eight{} - 1.0f; ///< around one center; negative: it has nothing over the triangle
    EightMask failed{};
    EightMask covered[3]{};

    HEARTH_INLINE void add(EightMask mask, Eight h) { addBetween(mask, h, h); }
    HEARTH_INLINE void addBetween(EightMask mask, Eight high, Eight low)
    {
        height = greater(height, mask ? greater(high, -low) : Eight{} - 1.0f);
    }
};

/// Whether facets lie beyond one of the triangle's edges.
HEARTH_INLINE EightMask areBeside(const Seen& a, const Seen& b, const Seen& c, float margin)
{
    const auto beyond = [&](Eight x, Eight y, Eight z) { return greater(greater(x, y), z) < margin; };
    return beyond(a.u, b.u, c.u) | beyond(a.v, b.v, c.v) | beyond(a.w, b.w, c.w);
}

/// The parameters between which edges lie over the triangle: nowhere if begin > end.
struct Stretch
{
    Eight begin{};
    Eight end = Eight{} + 1.0f;

    /// Keep what is on the inner side of the triangle's edge on which a coordinate, `a` to `b` on the edges, is 0:
    /// nothing of edges that only touch it.
    HEARTH_INLINE void clip(Eight a, Eight b)
    {
        const Eight at = a / (a - b);
        begin = greater(begin, a < -kMargin ? at : Eight{});
        end = lesser(end, b < -kMargin ? at : Eight{} + 1.0f);
        end = greater(a, b) > kMargin ? end : Eight{} - 1.0f;
    }
};

/// Twice the signed areas that a line from a to b has with the triangle's corners.
struct Sides
{
    Eight at[3];
    Eight margin;

    HEARTH_INLINE Eight least() const { return lesser(lesser(at[0], at[1]), at[2]); }
    HEARTH_INLINE Eight most() const { return greater(greater(at[0], at[1]), at[2]); }
};

HEARTH_INLINE Sides sidesOf(const Seen& a, const Seen& b)
{
    const Eight du = b.u - a.u, dv = b.v - a.v;
    const Eight at_0 = dv * a.u - du * a.v;
    return {{at_0, at_0 - dv, at_0 + du}, kMargin * (greater(du, -du) + greater(dv, -dv))};
}

/// Edges from a to b: where they enter and leave the triangle. Those that only pass by a corner of it are not over it;
/// those that are wholly over it are, however short they look.
HEARTH_INLINE void addEdges(const Seen& a, const Seen& b, const Sides& sides, Finding& finding)
{
    Stretch over;
    over.clip(a.u, b.u);
    over.clip(a.v, b.v);
    over.clip(a.w, b.w);
    const Eight rise = b.h - a.h;
    const Eight first = a.h + over.begin * rise, last = a.h + over.end * rise;
    const Eight part = over.end - over.begin;
    const EightMask valid = (part * sides.margin > kMargin * kMargin) | (part >= 1.0f);
    finding.addBetween(valid, greater(first, last), lesser(first, last));
}

/// Edges from a to b that must not come over the triangle: each has to lie beyond one of the triangle's edges, or to
/// have all of the triangle on one side.
HEARTH_INLINE void addRim(const Seen& a, const Seen& b, const Sides& sides, EightMask rim, Finding& finding)
{
    const EightMask beyond =
        (greater(a.u, b.u) < kMargin) | (greater(a.v, b.v) < kMargin) | (greater(a.w, b.w) < kMargin);
    finding.failed |= rim & ~(beyond | (sides.least() > -sides.margin) | (sides.most() < sides.margin));
}

/// The triangle's corners over facets a, b, c. `of` are the sides of the edges opposite them.
HEARTH_INLINE void addOwnCorners(const Seen& a, const Seen& b, const Seen& c, const Sides (&of)[3],
                                 Eight area2, EightMask overlapping, Finding& finding)
{
    const Eight inverse = 1.0f / area2;
    for (size_t k = 0; k < 3; ++k)
    {
        const EightMask inside = overlapping & (of[0].at[k] > -of[0].margin) & (of[1].at[k] > -of[1].margin) &
                                 (of[2].at[k] > -of[2].margin);
        finding.add(inside, (of[0].at[k] * a.h + of[1].at[k] * b.h + of[2].at[k] * c.h) * inverse);
        finding.covered[k] |= inside;
    }
}

/// Whether a line parts facets that turn over, or stand upright (twice their area is `area2`), from the triangle.
HEARTH_INLINE EightMask areAside(const Sides& of, Eight area2)
{
    return (of.least() > -of.margin) | ((of.most() < of.margin) & (area2 > -of.margin));
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
    const EightMask beside = areBeside(center, next, previous, -kMargin);
    if (!anySet(~beside))
        return;
    const EightMask next_name = load(block.next_name), previous_name = load(block.previous_name);
    const Eight area2 =
        (next.u - center.u) * (previous.v - center.v) - (next.v - center.v) * (previous.u - center.u);
    const Sides of[3]{sidesOf(next, previous), sidesOf(previous, center), sidesOf(center, next)};
    const EightMask upward = area2 > kSteepest * of[1].margin * of[2].margin;
    // facets that only touch the triangle are not over it: walls that stand on its edges, and what is below them
    const EightMask touching = areBeside(center, next, previous, kMargin);
    const EightMask overlapping = upward & ~touching & (of[0].most() > of[0].margin) &
                                  (of[1].most() > of[1].margin) & (of[2].most() > of[2].margin);
    if (const EightMask others = ~(upward | touching); anySet(others))
        finding.failed |=
            others & ~(areAside(of[0], area2) | areAside(of[1], area2) | areAside(of[2], area2));
    addEdges(center, next, of[2], finding);
    if (center_open)
    {
        addRim(center, next, of[2], next_name < 0, finding);
        addRim(previous, center, of[1], previous_name < 0, finding);
        addEdges(center, previous, of[1], finding);
    }
    addRim(next, previous, of[0], rimOf(next_name, previous_name, centers), finding);
    addOwnCorners(center, next, previous, of, area2, overlapping, finding);
}

/// The greatest height where corners or edges of triangle and patch meet, or infinity.
HEARTH_EIGHT_LANES float greatestHeight(const Surface& surface, const StarBlocks& blocks,
                                        std::span<const uint8_t> open, std::span<const float> added,
                                        std::span<const uint32_t> centers, const View& view)
{
    Finding finding;
    Eight sums{};
    for (const uint32_t position : centers)
    {
        const Float3 place = surface.place_of_position[position];
        const Seen center = see(allEight(place.x), allEight(place.y), allEight(place.z), view);
        for (const StarBlock& block : blocks.of(position))
            addBlock(block, center, open[position] != 0, centers, view, finding);
        sums = greater(sums, finding.height < 0.0f ? Eight{} : finding.height + added[position]);
        finding.height = Eight{} - 1.0f;
    }
    if (anySet(finding.failed) || !anySet(finding.covered[0]) || !anySet(finding.covered[1]) ||
        !anySet(finding.covered[2]))
        return kInfinity;
    float greatest = 0;
    for (size_t lane = 0; lane < kEight; ++lane)
        greatest = std::max(greatest, sums[lane]);
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

float Overlay::heightOver(const Corners& triangle) const
{
    View view;
    if (!makeView(triangle, view))
        return kInfinity;
    return greatestHeight(surface_, blocks_, open_, added_, centers_, view) + 4 * kMargin * view.size;
}

} // namespace hearth::clusters
