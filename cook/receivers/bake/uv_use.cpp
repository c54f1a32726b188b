// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/uv_use.h"

#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hearth::receivers
{

namespace
{

/// UV by which corners may be outside [0, 1]: stored UVs are rounded.
constexpr float kUvTolerance = 1.0f / 1024;

/// Area in UV of a triangle that has none, from which on its texels would be arbitrary.
constexpr double kFlatArea = 1e-12;

/// Texels each way of the rectangle in which overlap is found before the density is known.
constexpr uint32_t kOverlapSide = 256;

double areaInUv(const Triangle& triangle)
{
    const Float2 a = triangle.uvs[1] - triangle.uvs[0], b = triangle.uvs[2] - triangle.uvs[0];
    return 0.5 * std::abs(double{a.x} * double{b.y} - double{a.y} * double{b.x});
}

bool isOutside(const Triangle& triangle)
{
    const auto is_in = [](float value) { return value >= -kUvTolerance && value <= 1 + kUvTolerance; };
    return !std::ranges::all_of(triangle.uvs, [&](Float2 uv) { return is_in(uv.x) && is_in(uv.y); });
}

uint32_t roundSide(double texels)
{
    return static_cast<uint32_t>(
        std::clamp(std::round(texels), double{kMinRectangleSide}, double{kMaxRectangleSide}));
}

} // namespace

RectangleSize chooseRectangle(std::span<const Triangle> triangles, double texels_per_metre)
{
    HEARTH_ASSERT(texels_per_metre > 0);
    double area_sum = 0, along_u = 0, along_v = 0; // squares of metres per unit of UV, times area
    for (const Triangle& triangle : triangles)
    {
        const double area = 0.5 * double{length(crossEdges(triangle))};
        const double uv_area = areaInUv(triangle);
        if (!(area > 0 && uv_area > kFlatArea))
            continue;
        const Float2 a = triangle.uvs[1] - triangle.uvs[0], b = triangle.uvs[2] - triangle.uvs[0];
        const Double3 p = widen(triangle.corners[1] - triangle.corners[0]),
                      q = widen(triangle.corners[2] - triangle.corners[0]);
        const Double3 by_u = (p * double{b.y} - q * double{a.y}) * (0.5 / uv_area);
        const Double3 by_v = (q * double{a.x} - p * double{b.x}) * (0.5 / uv_area);
        area_sum += area;
        along_u += area * dot(by_u, by_u);
        along_v += area * dot(by_v, by_v);
    }
    if (!(area_sum > 0))
        return {kMinRectangleSide, kMinRectangleSide};
    return {roundSide(std::sqrt(along_u / area_sum) * texels_per_metre),
            roundSide(std::sqrt(along_v / area_sum) * texels_per_metre)};
}

UvCheck checkUvs(std::span<const Triangle> triangles)
{
    double area_sum = 0, flat = 0, outside = 0;
    for (const Triangle& triangle : triangles)
    {
        const double area = 0.5 * double{length(crossEdges(triangle))};
        area_sum += area;
        flat += areaInUv(triangle) > kFlatArea ? 0 : area;
        outside += isOutside(triangle) ? area : 0;
    }
    if (!(area_sum > 0) || flat > kMaxFlat * area_sum)
        return {UvUse::flat, area_sum > 0 ? flat / area_sum : 1};
    if (outside > 0)
        return {UvUse::outside, outside / area_sum};
    return {};
}

UvCheck checkOverlap(const TexelDomain& domain)
{
    return domain.overlap > kMaxOverlap ? UvCheck{UvUse::overlapping, domain.overlap} : UvCheck{};
}

UvCheck checkUvsAndOverlap(std::span<const Triangle> triangles)
{
    const UvCheck check = checkUvs(triangles);
    return check.use == UvUse::usable ? checkOverlap(rasterise(triangles, 0, kOverlapSide, kOverlapSide, 0))
                                      : check;
}

std::string describe(const UvCheck& check)
{
    const char* const reason = check.use == UvUse::flat      ? "of its area has no area in UV"
                               : check.use == UvUse::outside ? "of its area has UVs outside [0, 1]"
                                                             : "of its UVs overlap";
    if (check.use == UvUse::usable)
        return {};
    char text[96];
    std::snprintf(text, sizeof(text), "%.1f %% %s", 100 * check.share, reason);
    return text;
}

} // namespace hearth::receivers
