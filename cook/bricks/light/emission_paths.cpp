// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/emission_paths.h"

#include "formats/gpu_shared/brick_rays.h"

#include <algorithm>
#include <cmath>

namespace hearth::bricks
{

using namespace shared;

namespace
{

constexpr uint32_t kMaxBounces = 8;

/// Voxels by which points are kept off the sides of their voxel: coordinates up to 2^14 round to 2^-11.
constexpr double kInsideMargin = 0.002;

/// Twice the area in voxels of triangles that are too large to be real.
constexpr double kMaxTriangle = 1e12;

/// Voxels by which a path starts off its triangle.
constexpr float kPathOffset = 0.002f;

/// Return the point of a polygon for a point of the unit square, evenly distributed.
Double3 pointIn(const Polygon& polygon, double u, double v)
{
    double rest = u * length(doubleArea(polygon));
    const Double3& a = polygon.points[0];
    for (uint32_t i = 2;; ++i)
    {
        const Double3& b = polygon.points[i - 1];
        const Double3& c = polygon.points[i];
        const double area = length(cross(b - a, c - a));
        if (rest >= area && i + 1 < polygon.count)
        {
            rest -= area;
            continue;
        }
        const double root = std::sqrt(area > 0 ? std::min(rest / area, 1.0) : 0.0);
        return a * (1 - root) + b * (root * (1 - v)) + c * (root * v);
    }
}

Float3 insideCell(const Double3& position, const Cell& cell)
{
    const auto inside = [](double place, uint32_t low)
    { return static_cast<float>(std::clamp(place, low + kInsideMargin, low + 1 - kInsideMargin)); };
    return {inside(position.x, cell[0]), inside(position.y, cell[1]), inside(position.z, cell[2])};
}

} // namespace

void LeavingLights::add(const VoxelPlace& voxel, Float3 flux, Float3 direction)
{
    LeavingLight light{voxel, widen(flux), double{flux.x} + flux.y + flux.z, {}};
    for (uint32_t side = 0; side < kFaces; ++side)
        light.moment[side] = light.weight * std::max(0.0f, dot(direction, brickFaceAxis(side)));
    add(light);
}

void LeavingLights::add(const LeavingLight& light)
{
    LeavingLight& sum = at(light.voxel);
    sum.flux = sum.flux + light.flux;
    sum.weight += light.weight;
    for (uint32_t side = 0; side < kFaces; ++side)
        sum.moment[side] += light.moment[side];
}

LeavingLight& LeavingLights::at(const VoxelPlace& voxel)
{
    const auto [number, is_new] = numbers_.try_emplace(key(voxel), lights_.size());
    if (is_new)
        lights_.push_back({voxel, {}, 0, {}});
    return lights_[number->second];
}

struct EmissionPaths::Emitter
{
    TriangleSurface surface;
    Double3 corner;
    Double3 normal; ///< unit, of the front
    bool double_sided;
    double area_factor; ///< of the triangle over that of its rounded corners
};

/// Light at a point of a surface.
struct EmissionPaths::PathPoint
{
    Float3 position;
    Float3 inside; ///< point beside it in its voxel
    Float3 normal; ///< unit, on the side that the light leaves by
    Float3 flux;
};

/// A side by which a ray passes from a solid voxel to the air.
struct EmissionPaths::Exit
{
    VoxelPlace voxel{};
    bool exists = false;
    bool is_face = false; ///< false: the side looks at a space that nobody sees
};

Double3 EmissionPaths::sendFrom(const formats::ClusterGeometry& geometry, const SurfaceMaterial& material,
                                const Affine3d& voxels_from_object, bool mirrored, uint32_t seed,
                                LeavingLights& lights) const
{
    const Cell size{masks_.grid.voxels_x, masks_.grid.voxels_y, masks_.grid.voxels_z};
    Double3 sent;
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        const std::array<uint32_t, 3> corners = geometry.triangle(t);
        Polygon exact, rounded;
        for (const uint32_t corner : corners)
        {
            exact.add(transformPoint(voxels_from_object, widen(geometry.position(corner))));
            rounded.add(snapped(exact.points[exact.count - 1]));
        }
        const Double3 area = doubleArea(exact), rounded_area = doubleArea(rounded);
        if (!(length(rounded_area) > 0 && length(area) > 0 && length(area) < kMaxTriangle))
            continue;
        const TriangleAttributes attributes = readTriangleAttributes(geometry, corners, material);
        const Emitter emitter{TriangleSurface(material, exact, attributes), exact.points[0],
                              area * ((mirrored ? -1 : 1) / length(area)), material.doubleSided(),
                              length(area) / length(rounded_area)};
        forEachPiece(rounded, rounded_area * (mirrored ? -1 : 1), size, {{0, 0, 0}, size},
                     [&](const Cell& cell, const Polygon& piece)
                     { sent = sent + sendFrom(emitter, cell, piece, seed, lights); });
    }
    return sent;
}

Double3 EmissionPaths::sendFrom(const Emitter& emitter, const Cell& cell, const Polygon& piece,
                                uint32_t& seed, LeavingLights& lights) const
{
    const double area = 0.5 * length(doubleArea(piece)) * emitter.area_factor;
    const auto count = static_cast<uint32_t>(std::ceil(area * density_));
    Double3 sent;
    for (const double side : {1.0, -1.0})
    {
        if (side < 0 && !emitter.double_sided)
            break;
        seed = brickHash(seed);
        const Float3 normal = narrow(emitter.normal * side);
        for (uint32_t i = 0; i < count; ++i)
        {
            // sequence R2 (M. Roberts, 2018)
            const double shift = double{brickRandomUnit(seed)};
            const Double3 rounded = pointIn(piece, std::fmod(shift + i * 0.7548776662466927, 1.0),
                                            std::fmod(shift + i * 0.5698402909980532, 1.0));
            const Double3 position = rounded - emitter.normal * dot(rounded - emitter.corner, emitter.normal);
            const SurfaceSample look = emitter.surface.at(position);
            const Float3 flux = look.emission * (look.coverage * static_cast<float>(area / count));
            if (flux == Float3{})
                continue;
            sent = sent + widen(flux);
            followPath({narrow(position), insideCell(position, cell), normal, flux},
                       brickRayDirection(normal, i, count, seed), brickHash(seed + i), lights);
        }
    }
    return sent;
}

void EmissionPaths::followPath(PathPoint from, Float3 direction, uint32_t seed, LeavingLights& lights) const
{
    for (uint32_t bounce = 0; bounce <= kMaxBounces; ++bounce)
    {
        const Float3 start = from.position + from.normal * kPathOffset;
        const std::optional<RayScene::Hit> hit = rays_.nearest(start, direction);
        const float far = hit ? length(hit->position - start) : kBrickInfinity;
        const Exit exit = findExit(from.inside, direction, far);
        if (exit.is_face)
            lights.add(exit.voxel, from.flux, direction);
        if (exit.exists || !hit)
            return;
        from = {hit->position, hit->position - hit->normal * (kBrickPlaneTolerance + kBrickFaceMargin),
                hit->normal, from.flux * rays_.albedo(*hit)};
        seed = brickHash(seed);
        direction = brickRayDirection(hit->normal, 0, 1, seed);
    }
}

/// Return the last exit within the reach of the source, or else the first one, before a distance. No exit
/// if the position is in the air.
EmissionPaths::Exit EmissionPaths::findExit(Float3 position, Float3 direction, float far) const
{
    Exit exit;
    BrickRay ray = brickMarch(masks_, brickRayInVoxels(masks_.grid, position, direction, far));
    if (ray.steps != 0)
        return exit;
    while (ray.inside != 0 && !(exit.exists && ray.t >= kSourceReach))
    {
        const BrickRay left = brickSkipVoxel(masks_, ray);
        const BrickRay next = brickMarch(masks_, left);
        const bool is_in_air = next.inside == 0 || next.steps != left.steps;
        if (is_in_air && left.t < far && !(exit.exists && left.t >= kSourceReach))
            exit = {{ray.brick, ray.bit},
                    true,
                    brickFace(masks_.bricks[ray.brick], ray.bit, left.face ^ 1u) != kNoFace};
        ray = next;
    }
    return exit;
}

} // namespace hearth::bricks
