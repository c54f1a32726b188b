// Lights and transforms for the scenes of the shadow tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/test_scene.h"

#include <cmath>

namespace hearth::test
{

/// Return axes whose -z points along a direction.
inline Affine3 shining(Float3 position, Float3 direction)
{
    const Float3 z = -normalizeOr(direction, {});
    const Float3 x = normalizeOr(cross(std::abs(z.y) < 0.9f ? Float3{0, 1, 0} : Float3{1, 0, 0}, z), {});
    const Float3 y = cross(z, x);
    Affine3 t = translated(position);
    const Float3 columns[] = {x, y, z};
    for (size_t c = 0; c < 3; ++c)
    {
        t.m[0][c] = columns[c].x;
        t.m[1][c] = columns[c].y;
        t.m[2][c] = columns[c].z;
    }
    return t;
}

inline formats::LightRecord light(formats::LightType type, Float3 position, Float3 direction, float intensity)
{
    formats::LightRecord record{};
    record.type = static_cast<uint32_t>(type);
    record.world_from_light = shining(position, direction);
    record.color = {1, 1, 1};
    record.intensity = intensity;
    record.inner_cone_rad = 0.5f;
    record.outer_cone_rad = 0.7f;
    return record;
}

inline formats::LightRecord sun(Float3 direction)
{
    return light(formats::LightType::directional, {}, direction, 2);
}

/// Rotate the quad's +z up.
inline Affine3 lying(Float3 offset)
{
    Affine3 t = translated(offset);
    t.m[1][1] = t.m[2][2] = 0;
    t.m[1][2] = 1;
    t.m[2][1] = -1;
    return t;
}

inline Affine3 scaled(float factor, Float3 offset)
{
    Affine3 t = translated(offset);
    t.m[0][0] = t.m[1][1] = t.m[2][2] = factor;
    return t;
}

} // namespace hearth::test
