// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/ray_scene.h"

#include "cook/bricks/light/opaque_clusters.h"
#include "cook/ray_scene/triangle_rays.h"
#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"

#include <algorithm>

namespace hearth::bricks
{

using namespace formats;

/// Triangles of one material, up to those of the next range.
struct MaterialRange
{
    uint32_t first_triangle;
    const SurfaceMaterial* material;
    Float3 albedo;
};

struct RayScene::State
{
    ray_scene::TriangleRays rays;
    std::vector<MaterialRange> materials; ///< in the order of their triangles
    std::vector<Float3> normals;          ///< of the corners, 0 without one; or empty

    const MaterialRange& range(const Hit& hit) const
    {
        return *std::prev(
            std::ranges::upper_bound(materials, hit.triangle, {}, &MaterialRange::first_triangle));
    }
};

namespace
{

/// Append the three corners of each triangle of a cluster, in voxels, counterclockwise from the front.
/// normals  of the corners; or nullptr
void addTriangles(const ClusterGeometry& geometry, const Affine3d& voxels_from_object, bool mirrored,
                  std::vector<Float3>& corners, std::vector<Float3>* normals)
{
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        std::array<uint32_t, 3> vertices = geometry.triangle(t);
        if (mirrored)
            std::swap(vertices[1], vertices[2]);
        for (const uint32_t vertex : vertices)
        {
            corners.push_back(narrow(transformPoint(voxels_from_object, widen(geometry.position(vertex)))));
            if (normals == nullptr)
                continue;
            const Double3 normal = geometry.has(kVertexNormal)
                                       ? transformNormal(voxels_from_object, widen(geometry.normal(vertex)))
                                       : Double3{};
            normals->push_back(normalizeOr(narrow(normal), {}));
        }
    }
}

Status readTriangles(const StaticScene& scene, std::span<const InstancedCluster> placed,
                     const GridFrame& frame, std::vector<MaterialRange>& materials,
                     std::vector<Float3>& corners, std::vector<Float3>* normals)
{
    return visitOpaqueClusters(
        scene, placed,
        [&](const StaticInstance& instance, const ClusterGeometry& geometry, const SurfaceMaterial& material)
        {
            materials.push_back({static_cast<uint32_t>(corners.size() / 3), &material, meanAlbedo(material)});
            addTriangles(geometry, voxelsFromObject(frame, instance.world_from_object), instance.mirrored,
                         corners, normals);
        });
}

} // namespace

RayScene::RayScene(std::unique_ptr<State> state) : state_(std::move(state)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::build(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                 const GridFrame& frame, Normals normals)
{
    std::vector<MaterialRange> materials;
    std::vector<Float3> corners, vertex_normals;
    HEARTH_TRY(readTriangles(scene, placed, frame, materials, corners,
                             normals == Normals::smooth ? &vertex_normals : nullptr));
    return RayScene(std::make_unique<State>(
        State{ray_scene::TriangleRays(std::move(corners)), std::move(materials), std::move(vertex_normals)}));
}

std::optional<RayScene::Hit> RayScene::nearest(Float3 position, Float3 direction) const
{
    const std::optional<ray_scene::TriangleHit> hit = state_->rays.nearest(position, direction);
    if (!hit)
        return std::nullopt;
    const auto corner = state_->rays.triangle(hit->triangle);
    const Float3 front = normalizeOr(cross(corner[1] - corner[0], corner[2] - corner[0]), -direction);
    const bool is_front = dot(front, direction) <= 0;
    return Hit{position + direction * hit->distance, is_front ? front : -front, hit->triangle, is_front};
}

std::vector<RayScene::SurfacePoint> RayScene::sampleSurface(uint32_t count) const
{
    const std::span<const Float3> corners = state_->rays.corners();
    const auto across = [&](size_t triangle)
    {
        const Float3* corner = &corners[3 * triangle];
        return cross(corner[1] - corner[0], corner[2] - corner[0]);
    };
    std::vector<double> areas; // of all triangles up to each
    double area = 0;
    for (size_t triangle = 0; triangle < corners.size() / 3; ++triangle)
        areas.push_back(area += double{length(across(triangle))});
    std::vector<SurfacePoint> points;
    for (uint32_t i = 0; i < count && area > 0; ++i)
    {
        const auto found = std::ranges::upper_bound(areas, area * (i + 0.5) / count);
        const auto triangle = static_cast<size_t>(std::min(found, std::prev(areas.end())) - areas.begin());
        const Float2 weights = sampling::trianglePoint(sampling::unitPoint(sampling::owenSobol(i, 0)));
        const Float3* corner = &corners[3 * triangle];
        points.push_back(
            {corner[0] + (corner[1] - corner[0]) * weights.x + (corner[2] - corner[0]) * weights.y,
             normalizeOr(across(triangle), {0, 1, 0})});
    }
    return points;
}

Float3 RayScene::smoothNormal(const Hit& hit) const
{
    const auto corner = state_->rays.triangle(hit.triangle);
    const Float3* normal = &state_->normals[3 * size_t{hit.triangle}];
    const Float3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);
    Float3 sum;
    for (size_t k = 0; k < 3; ++k) // the area of the triangle that the hit makes with the other two corners
    {
        const Float3 to_next = corner[(k + 1) % 3] - hit.position,
                     to_last = corner[(k + 2) % 3] - hit.position;
        sum += normal[k] * dot(cross(to_next, to_last), across);
    }
    const Float3 smooth = normalizeOr(sum, hit.normal);
    return dot(smooth, hit.normal) < 0 ? -smooth : smooth;
}

Float3 RayScene::albedo(const Hit& hit) const
{
    return state_->range(hit).albedo;
}

const SurfaceMaterial& RayScene::material(const Hit& hit) const
{
    return *state_->range(hit).material;
}

bool RayScene::occluded(Float3 position, Float3 direction, float far) const
{
    return state_->rays.occluded(position, direction, far);
}

} // namespace hearth::bricks
