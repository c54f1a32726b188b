// Random lights for the tests of shadow maps, and the ray through a point of a map in doubles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "runtime/frame/shadow_fit.h"

#include <numbers>
#include <random>

namespace hearth::test
{

inline float between(std::mt19937& random, float low, float high)
{
    // 24 bits: the same on every standard library
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
}

inline Float3 randomUnit(std::mt19937& random)
{
    for (;;)
    {
        const Float3 v{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
        if (length(v) > 0.1f && length(v) < 1)
            return v / length(v);
    }
}

inline Double3 unit(Double3 v)
{
    return v * (1 / length(v));
}

/// Unit vector at an angle to an axis, with random rotation about it.
inline Float3 tilted(Float3 axis, double angle_rad, std::mt19937& random)
{
    const Double3 along = widen(axis);
    const Double3 across = unit(cross(along, widen(randomUnit(random))));
    return narrow(unit(along * std::cos(angle_rad) + across * std::sin(angle_rad)));
}

/// Ray of the light at a position in its map: points begin + t * along; for a spot, t > 0 is in front of it.
struct LightRay
{
    Double3 begin, along;
};

inline LightRay rayThrough(const shared::ShadowLight& light, const shared::ShadowMap& map, double texel_x,
                           double texel_y)
{
    const double x = (texel_x - double{map.offset_x}) / double{map.scale_x};
    const double y = (texel_y - double{map.offset_y}) / double{map.scale_y};
    const Double3 aside = widen(light.right) * x + widen(light.down) * y;
    if (light.perspective == 0)
        return {aside, widen(light.direction)};
    return {{}, aside + widen(light.direction)};
}

/// A plane through a point.
struct Plane
{
    Double3 point, normal;

    Double3 meet(const LightRay& ray) const
    {
        return ray.begin + ray.along * (dot(normal, point - ray.begin) / dot(normal, ray.along));
    }
};

inline constexpr double kDegree = std::numbers::pi / 180;

} // namespace hearth::test
