// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/scene/receiver_scene.h"

#include "cook/bricks/light/opaque_clusters.h"
#include "cook/bricks/light/scene_light.h"
#include "cook/receivers/bake/uv_use.h"
#include "formats/base/index.h"

#include <algorithm>

namespace hearth::receivers
{

using namespace formats;

namespace
{

/// UV sets in the order in which they are tried.
constexpr std::array<uint32_t, 4> kUvSetOrder{1, 2, 3, 0};

/// Length of a triangle's longest edge in the units that choose the mips of its textures: about eight texels,
/// for the four points that are read.
constexpr double kTextureSize = 4;

/// Corner weights of the points at which a triangle's material is read.
constexpr std::array<std::array<double, 3>, 4> kMaterialPoints{{{1 / 3.0, 1 / 3.0, 1 / 3.0},
                                                                {2 / 3.0, 1 / 6.0, 1 / 6.0},
                                                                {1 / 6.0, 2 / 3.0, 1 / 6.0},
                                                                {1 / 6.0, 1 / 6.0, 2 / 3.0}}};

/// Triangle of an instance with all of its UV sets.
struct SourceTriangle
{
    Triangle triangle;
    std::array<std::array<Float2, 3>, 4> uv_sets{};
    Float3 emission; ///< radiance before exposure
};

struct SourceInstance
{
    std::vector<SourceTriangle> triangles;
    uint32_t uv_sets = 0b1111; ///< bit for each set that all clusters have; without clusters no matter
};

/// Set albedo and emission to their means over the triangle.
void readMaterial(const ClusterGeometry& geometry, const std::array<uint32_t, 3>& corners,
                  const bricks::SurfaceMaterial& material, SourceTriangle& out)
{
    double longest = 0;
    std::array<Double3, 3> at;
    for (size_t i = 0; i < 3; ++i)
    {
        at[i] = widen(out.triangle.corners[i]);
        longest = std::max(longest, length(widen(out.triangle.corners[(i + 1) % 3]) - at[i]));
    }
    bricks::Polygon polygon;
    for (const Double3& corner : at)
        polygon.add(corner * (kTextureSize / longest));
    const bricks::TriangleAttributes attributes = readTriangleAttributes(geometry, corners, material);
    const bricks::TriangleSurface surface(material, polygon, attributes);
    for (const std::array<double, 3>& weights : kMaterialPoints)
    {
        const bricks::SurfaceSample sample = surface.at(
            polygon.points[0] * weights[0] + polygon.points[1] * weights[1] + polygon.points[2] * weights[2]);
        out.triangle.albedo += sample.albedo / kMaterialPoints.size();
        out.emission += sample.emission / kMaterialPoints.size();
    }
}

void addCluster(const bricks::StaticInstance& from, const ClusterGeometry& geometry,
                const bricks::SurfaceMaterial& material, uint32_t number, SourceInstance& instance)
{
    const Affine3d transform = widened(from.world_from_object);
    for (uint32_t set = 0; set < kUvSetOrder.size(); ++set)
        if (!geometry.has(kVertexUv0 << set))
            instance.uv_sets &= ~(1u << set);
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        std::array<uint32_t, 3> vertices = geometry.triangle(t);
        if (from.mirrored)
            std::swap(vertices[1], vertices[2]);
        SourceTriangle source;
        Triangle& triangle = source.triangle;
        triangle.instance = number;
        triangle.double_sided = material.doubleSided();
        for (size_t i = 0; i < 3; ++i)
            triangle.corners[i] = narrow(transformPoint(transform, widen(geometry.position(vertices[i]))));
        const float area = length(crossEdges(triangle));
        if (!(area > 0) || !std::isfinite(area))
            continue;
        const Float3 side = crossEdges(triangle) / area;
        for (size_t i = 0; i < 3; ++i)
        {
            const Double3 normal = geometry.has(kVertexNormal)
                                       ? transformNormal(transform, widen(geometry.normal(vertices[i])))
                                       : Double3{};
            triangle.normals[i] = normalizeOr(narrow(normal * (from.mirrored ? -1.0 : 1.0)), side);
            for (uint32_t set = 0; set < kUvSetOrder.size(); ++set)
                if (geometry.has(kVertexUv0 << set))
                    source.uv_sets[set][i] = geometry.uv(vertices[i], set);
        }
        readMaterial(geometry, vertices, material, source);
        instance.triangles.push_back(source);
    }
}

Result<std::vector<SourceInstance>> readInstances(const bricks::StaticScene& scene)
{
    std::vector<SourceInstance> instances(scene.instances.size());
    HEARTH_TRY(bricks::visitOpaqueClusters(
        scene, bricks::findCutClusters(scene, 0),
        [&](const bricks::StaticInstance& instance, const ClusterGeometry& geometry,
            const bricks::SurfaceMaterial& material)
        {
            const auto number = static_cast<uint32_t>(&instance - scene.instances.data());
            addCluster(instance, geometry, material, number, instances[number]);
        }));
    return instances;
}

void setUvs(const SourceInstance& instance, uint32_t set, std::span<Triangle> triangles)
{
    for (size_t t = 0; t < triangles.size(); ++t)
        triangles[t].uvs = instance.triangles[t].uv_sets[set];
}

/// Give triangles the first set of UVs that can be used, or of those that are there the first tried.
uint32_t chooseUvs(const SourceInstance& instance, std::span<Triangle> triangles)
{
    uint32_t chosen = kInvalidIndex;
    for (const uint32_t set : kUvSetOrder)
    {
        if ((instance.uv_sets >> set & 1u) == 0)
            continue;
        setUvs(instance, set, triangles);
        if (checkUvsAndOverlap(triangles).use == UvUse::usable)
            return set;
        chosen = chosen == kInvalidIndex ? set : chosen;
    }
    if (chosen != kInvalidIndex)
        setUvs(instance, chosen, triangles);
    return chosen;
}

/// Append an instance's triangles, and its light if it shines.
void addInstance(const SourceInstance& instance, uint32_t number, float exposure, ReceiverScene& scene)
{
    MeshLight light;
    std::vector<Triangle>& triangles = scene.bake.triangles;
    const size_t first = triangles.size();
    for (const SourceTriangle& source : instance.triangles)
    {
        if (source.emission != Float3{})
        {
            light.triangles.push_back(static_cast<uint32_t>(triangles.size()));
            light.radiance.push_back(source.emission * exposure);
        }
        triangles.push_back(source.triangle);
    }
    scene.uv_sets.push_back(instance.triangles.empty()
                                ? kInvalidIndex
                                : chooseUvs(instance, std::span(triangles).subspan(first)));
    if (light.triangles.empty())
        return;
    scene.bake.mesh_lights.push_back(std::move(light));
    scene.mesh_light_instances.push_back(number);
}

/// Return the first error of the textures that the scene has read.
Status checkTextures(const bricks::StaticScene& scene)
{
    for (const auto& materials : scene.materials)
        for (const bricks::SurfaceMaterial& material : materials)
            for (const auto* texture :
                 {&material.base_color, &material.metallic_roughness, &material.emissive})
                if (*texture)
                    HEARTH_TRY((*texture)->status());
    return success();
}

} // namespace

Result<ReceiverScene> makeReceiverScene(const bricks::StaticScene& scene, const shared::SceneProbes& probes)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<SourceInstance> instances, readInstances(scene));
    HEARTH_TRY(checkTextures(scene));
    const shared::SceneLighting lighting = bricks::makeSceneLighting(scene, probes);
    ReceiverScene receivers;
    receivers.bake.instance_count = static_cast<uint32_t>(instances.size());
    receivers.bake.sky = lighting.sky;
    receivers.sky_image = lighting.sky_image;
    for (const shared::Light& light : lighting.lights)
        receivers.bake.lamps.push_back({light, 0});
    receivers.has_default_sun =
        !lighting.lights.empty() && std::ranges::all_of(scene.sources, [](const bricks::SourceParts& source)
                                                        { return source.scene.lights().empty(); });
    for (uint32_t i = 0; i < instances.size(); ++i)
        addInstance(instances[i], i, lighting.exposure, receivers);
    return receivers;
}

} // namespace hearth::receivers
