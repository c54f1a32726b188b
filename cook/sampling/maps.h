// Maps the unit square to the hemisphere and to triangles. Ratios of areas are preserved, so that points that
// are even in the square are even there, too.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cmath>

namespace hearth::sampling
{

struct SineCosine
{
    float sine, cosine;
};

/// Compute sine and cosine of `turns` full turns, in [0, 1]: within 2e-7, the same on every machine.
inline SineCosine sineCosine(float turns)
{
    const auto quarter = static_cast<int32_t>(turns * 4 + 0.5f); // the nearest one
    const float angle = (turns * 4 - static_cast<float>(quarter)) * 1.57079633f;
    const float a = angle * angle;
    const float sine = angle * (1 + a * (-1 / 6.0f + a * (1 / 120.0f + a * (-1 / 5040.0f + a / 362880.0f))));
    const float cosine = 1 + a * (-0.5f + a * (1 / 24.0f + a * (-1 / 720.0f + a / 40320.0f)));
    const float s = (quarter & 1) != 0 ? cosine : sine;
    const float c = (quarter & 1) != 0 ? sine : cosine;
    return {(quarter & 2) != 0 ? -s : s, ((quarter + 1) & 2) != 0 ? -c : c};
}

/// Map to a unit direction of the hemisphere about +z: equal areas of the square are equal solid angles.
/// z = u.x.
inline Float3 hemisphereDirection(Float2 u)
{
    const float radius = std::sqrt((1 - u.x) * (1 + u.x));
    const SineCosine azimuth = sineCosine(u.y);
    return {radius * azimuth.cosine, radius * azimuth.sine, u.x};
}

/// Map to a unit direction of the hemisphere about +z, with densities by the cosine.
inline Float3 cosineDirection(Float2 u)
{
    return hemisphereDirection({std::sqrt(u.x), u.y});
}

/// Map to weights of a triangle's corners 1 and 2: equal areas of the square are equal areas of the triangle.
/// source  E. Heitz, "A low-distortion map between triangle and square", 2019
inline Float2 trianglePoint(Float2 u)
{
    return u.y > u.x ? Float2{u.x * 0.5f, u.y - u.x * 0.5f} : Float2{u.x - u.y * 0.5f, u.y * 0.5f};
}

/// Orthonormal basis.
struct Frame
{
    Float3 x, y, z;
    Float3 fromLocal(Float3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Build an orthonormal basis with z = normal.
/// source  T. Duff et al., "Building an orthonormal basis, revisited", 2017
/// normal  unit
inline Frame frameAround(Float3 normal)
{
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
    return {{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y},
            normal};
}

} // namespace hearth::sampling
