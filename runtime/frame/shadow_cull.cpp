// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_cull.h"

#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <cmath>

namespace hearth::shared
{

namespace
{

/// Return the plane through an edge of a map. Inside is where the light's coordinate is more than
/// `min_coordinate`, or less with side -1.
Float4 edgePlane(const ShadowLight& light, Double3 eye, Float3 axis, double min_coordinate, double side)
{
    const Double3 along = widen(light.direction);
    // min_coordinate < axis . p / w, times w
    const Double3 normal = (widen(axis) - along * (min_coordinate * double{light.perspective})) * side;
    const double offset = dot(normal, eye) - side * min_coordinate * (1 - double{light.perspective});
    const Float3 n = narrow(normal);
    return {n.x, n.y, n.z, static_cast<float>(offset)};
}

/// Return the far plane of a light with a range, or else the near plane; a sun has neither, and all points
/// are inside. The sides of a map meet at the light, so they leave little in front of its near plane.
Float4 rangePlane(const ShadowLight& light, Double3 eye, double range)
{
    const double side = range > 0 ? -1 : 1;
    const double bound = range > 0 ? range : double{light.depth_offset};
    const Double3 normal = widen(light.direction) * (side * double{light.perspective});
    const Float3 n = narrow(normal);
    return {n.x, n.y, n.z, static_cast<float>(dot(normal, eye) - side * bound * double{light.perspective})};
}

} // namespace

FrameView makeCasterView(const FrameView& view, const ShadowLight& light, const ShadowMap& map,
                         float error_bias, float range)
{
    HEARTH_ASSERT(error_bias >= 1 && range >= 0);
    const Double3 eye = widen(view.eye) - widen(light.origin);
    const auto coordinate = [](float texel, float scale, float offset)
    { return (double{texel} - double{offset}) / double{scale}; };
    FrameView casters = view;
    casters.planes[0] = edgePlane(light, eye, light.right, coordinate(0, map.scale_x, map.offset_x), 1);
    casters.planes[1] =
        edgePlane(light, eye, light.right, coordinate(map.size, map.scale_x, map.offset_x), -1);
    casters.planes[2] = edgePlane(light, eye, light.down, coordinate(0, map.scale_y, map.offset_y), 1);
    casters.planes[3] =
        edgePlane(light, eye, light.down, coordinate(map.size, map.scale_y, map.offset_y), -1);
    casters.planes[4] = rangePlane(light, eye, double{range});
    casters.threshold = view.threshold * error_bias;
    casters.flags = view.flags & (kCullInstances | kCullFrustum);
    return casters;
}

EyeCell findEyeCell(const FrameView& view, float texel_m, float error_bias)
{
    HEARTH_ASSERT(texel_m > 0 && error_bias >= 1);
    // cells above a kilometre or below a millimetre gain nothing
    constexpr float kMinExponent = -10;
    constexpr float kMaxExponent = 10;
    constexpr float kHalfDiagonal = 0.8660255f; // of a cube of side 1
    // orthographic, errors do not depend on where the eye is
    const float error_a_metre =
        isOrthographic(view) ? 0 : std::max(view.threshold, 0.0f) * error_bias / view.lod_scale;
    const float allowed_shift = 0.5f * texel_m / std::max(error_a_metre, 1e-12f);
    const float exponent = std::floor(std::log2(allowed_shift / kHalfDiagonal));
    const float side = std::exp2(std::clamp(exponent, kMinExponent, kMaxExponent));
    const auto middle = [&](float along) { return (std::floor(along / side) + 0.5f) * side; };
    return {{middle(view.eye.x), middle(view.eye.y), middle(view.eye.z)}, side * kHalfDiagonal};
}

} // namespace hearth::shared
