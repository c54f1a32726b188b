// Quads and boxes with UVs for the tests of receivers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/surface.h"

#include <vector>

namespace hearth::receivers
{

/// Part of the square of UV.
struct UvBox
{
    Float2 low{0, 0}, high{1, 1};
};

/// Append a parallelogram whose front is on the side of cross(a, b).
inline void addQuad(std::vector<Triangle>& triangles, Float3 corner, Float3 a, Float3 b, Float3 albedo,
                    uint32_t instance, UvBox uv = {})
{
    const Float3 normal = normalizeOr(cross(a, b), {0, 0, 1});
    const auto add = [&](Float3 p, Float3 q, Float3 r, Float2 up, Float2 uq, Float2 ur) {
        triangles.push_back({{p, q, r}, {normal, normal, normal}, {up, uq, ur}, albedo, instance, false});
    };
    const Float2 uv_a{uv.high.x, uv.low.y}, uv_b{uv.low.x, uv.high.y};
    add(corner, corner + a, corner + a + b, uv.low, uv_a, uv.high);
    add(corner, corner + a + b, corner + b, uv.low, uv.high, uv_b);
}

/// Append the six sides of a box that is seen from within, each in its own part of UV.
inline void addRoom(std::vector<Triangle>& triangles, Float3 low, Float3 size, Float3 albedo,
                    uint32_t instance)
{
    const Float3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z}, high = low + size;
    uint32_t side = 0;
    const auto add = [&](Float3 corner, Float3 a, Float3 b)
    {
        const float u = static_cast<float>(side % 3) / 3, v = side < 3 ? 0.0f : 0.5f;
        constexpr float kGap = 0.03f;
        addQuad(triangles, corner, a, b, albedo, instance,
                {{u + kGap, v + kGap}, {u + 1.0f / 3 - kGap, v + 0.5f - kGap}});
        ++side;
    };
    add(low, y, z);
    add(low, z, x);
    add(low, x, y);
    add(high, -z, -y);
    add(high, -x, -z);
    add(high, -y, -x);
}

} // namespace hearth::receivers
