// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_fit.h"

#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::shared
{

namespace
{

// Maximum texel coordinate. Larger floats have a resolution below 1/16 and would lose the position within a
// texel.
constexpr double kMaxTexelCoordinate = 1 << 20;

// Maximum half-angle of a spot map, 80 degrees: there a map spends a sixth of its texels each way on the
// inner 45 degrees; beyond, next to none are left.
constexpr float kMaxConeRad = 1.396263f;

// Slack for vertices that are rounded differently from the box of the scene.
constexpr double kRangeSlack = 1e-4;

void setAxes(ShadowLight& light, Float3 direction)
{
    const Double3 along = widen(direction) * (1 / length(widen(direction)));
    // any perpendicular axes will do, as long as equal directions have the same
    const Double3 aside = std::abs(along.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0};
    const Double3 across = cross(along, aside);
    const Double3 right = across * (1 / length(across));
    light.direction = narrow(along);
    light.right = narrow(right);
    light.down = narrow(cross(along, right));
}

/// Return the number of texels that a sphere may fill each way; the rounding of coordinates is excluded as
/// well, 1/16 at each side.
double usableTexels(ShadowMapSize size)
{
    return size.texels - 2 * (size.kernel + 1.0) - 0.125;
}

void checkSize(ShadowMapSize size)
{
    HEARTH_ASSERT(std::has_single_bit(size.texels) && size.texels <= 8192 &&
                  size.texels >= 4 * (size.kernel + 1));
}

ShadowMap emptyMap(ShadowMapSize size)
{
    checkSize(size);
    ShadowMap map{};
    map.size = static_cast<float>(size.texels);
    map.kernel = static_cast<float>(size.kernel);
    return map;
}

/// Interval of one of the light's coordinates.
struct Interval
{
    double low, high;
};

/// Return the bounds of x / z over a disc in front of z = 0, within the cone, from the tangents through the
/// origin. M. Mara, M. McGuire, "2D polyhedral bounds of a clipped, perspective-projected 3D sphere", 2013.
Interval discBounds(double x, double z, double radius, double cone_tangent)
{
    Interval span{-cone_tangent, cone_tangent};
    const double reach2 = x * x + z * z - radius * radius;
    if (reach2 <= 0)
        return span;
    const double reach = std::sqrt(reach2);
    // directions of the tangents; a tangent that points backwards leaves its side unbounded
    const double low_z = z * reach + x * radius;
    const double high_z = z * reach - x * radius;
    if (low_z > 0)
        span.low = std::max(span.low, (x * reach - z * radius) / low_z);
    if (high_z > 0)
        span.high = std::min(span.high, (x * reach + z * radius) / high_z);
    return span;
}

/// Compute scale and offset of one axis.
void cropTo(Interval span, double cone_tangent, ShadowMapSize size, float& scale, float& offset)
{
    const double finest = kMaxTexelCoordinate / cone_tangent;
    const double texels = std::min(usableTexels(size) / (span.high - span.low), finest);
    scale = static_cast<float>(texels);
    offset = static_cast<float>(0.5 * size.texels - 0.5 * (span.low + span.high) * double{scale});
}

ShadowMap crop(Interval x, Interval y, double cone_tangent, ShadowMapSize size)
{
    ShadowMap map = emptyMap(size);
    cropTo(x, cone_tangent, size, map.scale_x, map.offset_x);
    cropTo(y, cone_tangent, size, map.scale_y, map.offset_y);
    map.density = std::min(map.scale_x, map.scale_y);
    return map;
}

/// Return the sphere around the slice [near, far] of a view frustum: on its axis, through the corners of one
/// end or of both.
/// corner_tangent2  squared tangent of the angle between the axis and an edge
Sphere makeSliceSphere(Double3 eye, Double3 forward, double near, double far, double corner_tangent2)
{
    const double center = std::min(far, 0.5 * (near + far) * (1 + corner_tangent2));
    const double radius = std::sqrt((far - center) * (far - center) + far * far * corner_tangent2);
    return {narrow(eye + forward * center), static_cast<float>(radius)};
}

/// Return the sphere around the slice [near, far] of an orthographic view.
/// corner2  squared distance from the axis to an edge
Sphere makeBoxSphere(Double3 eye, Double3 forward, double near, double far, double corner2)
{
    const double half = 0.5 * (far - near);
    return {narrow(eye + forward * (near + half)), static_cast<float>(std::sqrt(half * half + corner2))};
}

/// Return how much farther from the view's axis the far side of an off-centre image is than that of a centred
/// one. Shifts of less than four pixels do not count, and others are rounded: the maps of an image that
/// jitters shall stay as they are.
/// row     of FrameView across the image
/// pixels  of the image along it
double widening(const Float4& row, const Float4& along, float pixels)
{
    constexpr double kPixels = 4, kSteps = 64;
    const bool is_orthographic = along.w > 0;
    const double shift = std::abs(double{is_orthographic ? row.w : dot(row3(row), row3(along))});
    const double counted = std::max(0.0, shift - 2 * kPixels / double{pixels});
    return 1 + std::ceil(counted * kSteps) / kSteps;
}

} // namespace

ShadowLight makeSunShadow(Float3 direction, const Box3& scene)
{
    HEARTH_ASSERT(!scene.empty() && length(direction) > 0);
    ShadowLight light{};
    setAxes(light, direction);
    light.origin = scene.center();
    const Double3 half = (widen(scene.max) - widen(scene.min)) * 0.5;
    const Double3 along = widen(light.direction);
    // a scene without extent along the light has one depth, for which any scale will do
    const double half_range =
        (std::abs(along.x) * half.x + std::abs(along.y) * half.y + std::abs(along.z) * half.z) *
            (1 + kRangeSlack) +
        kRangeSlack;
    light.depth_step = static_cast<float>(0.5 / half_range);
    light.depth_scale = -light.depth_step;
    light.depth_offset = 0.5f;
    light.perspective = 0;
    light.rounding = kDepthMargin;
    return light;
}

ShadowLight makeSpotShadow(Float3 position, Float3 direction, float near)
{
    HEARTH_ASSERT(near > 0 && length(direction) > 0);
    ShadowLight light{};
    setAxes(light, direction);
    light.origin = position;
    light.depth_scale = 0;
    light.depth_offset = near;
    light.depth_step = near;
    light.perspective = 1;
    light.rounding = kDepthMargin * near;
    return light;
}

ShadowLight makePointShadow(Float3 position, uint32_t face, float near)
{
    HEARTH_ASSERT(face < kPointFaces);
    const float along = face % 2 == 0 ? 1.0f : -1.0f;
    const uint32_t axis = face / 2;
    return makeSpotShadow(position, {axis == 0 ? along : 0, axis == 1 ? along : 0, axis == 2 ? along : 0},
                          near);
}

ShadowMap fitSunMap(const ShadowLight& light, const Sphere& sphere, ShadowMapSize size)
{
    HEARTH_ASSERT(light.perspective == 0 && sphere.radius > 0);
    ShadowMap map = emptyMap(size);
    const Double3 center = widen(sphere.center) - widen(light.origin);
    const double x = dot(widen(light.right), center);
    const double y = dot(widen(light.down), center);
    const double reach = std::max(std::abs(x), std::abs(y)) + double{sphere.radius};
    // one texel for the snapping of the centre, half of it to each side
    double scale = (usableTexels(size) - 1) / (2 * double{sphere.radius});
    // by halves: a sphere that moves nearly always keeps its scale
    while (scale * reach > kMaxTexelCoordinate)
        scale *= 0.5;
    map.scale_x = map.scale_y = map.density = static_cast<float>(scale);
    const auto snapped = [&](double along)
    { return static_cast<float>(0.5 * size.texels - std::floor(along * double{map.density} + 0.5)); };
    map.offset_x = snapped(x);
    map.offset_y = snapped(y);
    return map;
}

float coneTangent(float outer_cone_rad)
{
    return std::tan(std::min(outer_cone_rad, kMaxConeRad));
}

ShadowMap makeConeMap(float cone_tangent, ShadowMapSize size)
{
    const Interval all{-double{cone_tangent}, double{cone_tangent}};
    return crop(all, all, double{cone_tangent}, size);
}

std::optional<ShadowMap> fitSpotMap(const ShadowLight& light, float cone_tangent, const Sphere& sphere,
                                    ShadowMapSize size)
{
    HEARTH_ASSERT(light.perspective == 1 && sphere.radius > 0 && cone_tangent > 0);
    const Double3 center = widen(sphere.center) - widen(light.origin);
    const double radius = double{sphere.radius};
    const double tangent = double{cone_tangent};
    const double z = dot(widen(light.direction), center);
    if (z + radius <= 0)
        return std::nullopt;
    if (dot(center, center) <= radius * radius)
        return makeConeMap(cone_tangent, size);
    const Interval x = discBounds(dot(widen(light.right), center), z, radius, tangent);
    const Interval y = discBounds(dot(widen(light.down), center), z, radius, tangent);
    if (x.low > x.high || y.low > y.high)
        return std::nullopt;
    return crop(x, y, tangent, size);
}

void sortByDensity(std::span<ShadowMap> maps)
{
    // insertion sort: lights have few maps, and std::stable_sort may allocate
    for (auto map = maps.begin(); map != maps.end(); ++map)
        std::rotate(std::upper_bound(maps.begin(), map, *map,
                                     [](const ShadowMap& a, const ShadowMap& b)
                                     { return a.density > b.density; }),
                    map, map + 1);
}

const ShadowMap* findShadowMap(const ShadowLight& light, std::span<const ShadowMap> maps, Float3 point)
{
    const ShadowPoint projected = shadowPoint(light, point);
    const auto found = std::find_if(maps.begin(), maps.end(),
                                    [&](const ShadowMap& map) { return isInShadowMap(map, projected); });
    return found == maps.end() ? nullptr : &*found;
}

void computeSplitSpheres(const FrameView& view, const SplitRange& range, std::span<Sphere> spheres)
{
    HEARTH_ASSERT(range.near > 0 && range.far > range.near && range.blend >= 0 && range.blend <= 1);
    // from the size, not from the clip rows, whose lengths round differently for each direction
    const double up_tangent =
        0.5 * double{view.height} / double{view.lod_scale} * widening(view.clip_y, view.clip_w, view.height);
    const double side_tangent =
        0.5 * double{view.width} / double{view.lod_scale} * widening(view.clip_x, view.clip_w, view.width);
    const double corner_tangent2 = up_tangent * up_tangent + side_tangent * side_tangent;
    const Double3 eye = widen(view.eye);
    const Double3 forward = widen(row3(view.clip_w));
    const double near = double{range.near};
    const double far = double{range.far};
    const double blend = double{range.blend};
    double begin = near;
    for (size_t i = 0; i < spheres.size(); ++i)
    {
        const double part = static_cast<double>(i + 1) / static_cast<double>(spheres.size());
        const double end =
            blend * near * std::pow(far / near, part) + (1 - blend) * (near + (far - near) * part);
        spheres[i] = isOrthographic(view) ? makeBoxSphere(eye, forward, begin, end, corner_tangent2)
                                          : makeSliceSphere(eye, forward, begin, end, corner_tangent2);
        begin = end;
    }
}

} // namespace hearth::shared
