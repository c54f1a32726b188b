// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/surfaces.h"

#include "cook/bricks/light/opaque_clusters.h"

namespace hearth::reflections
{

using namespace formats;
using bricks::StaticInstance;
using bricks::SurfaceMaterial;
using bricks::SurfaceSample;

namespace
{

/// Share of the scene's diagonal by which rays keep off surfaces: some roundings of its coordinates.
constexpr float kOffsetShare = 0x1p-17f;

/// Corner weights of the points at which the emission of a triangle is read.
constexpr std::array<Float2, 4> kEmissionPoints{Float2{1 / 3.0f, 1 / 3.0f}, Float2{1 / 6.0f, 1 / 6.0f},
                                                Float2{2 / 3.0f, 1 / 6.0f}, Float2{1 / 6.0f, 2 / 3.0f}};

} // namespace

Result<Surfaces> Surfaces::read(const bricks::StaticScene& scene)
{
    Surfaces surfaces;
    std::vector<Float3> corners;
    Box3 box;
    const auto add =
        [&](const StaticInstance& instance, const ClusterGeometry& geometry, const SurfaceMaterial& material)
    {
        const Affine3d transform = widened(instance.world_from_object);
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        {
            std::array<uint32_t, 3> vertices = geometry.triangle(t);
            if (instance.mirrored)
                std::swap(vertices[1], vertices[2]);
            Attributes attributes{&material, readTriangleAttributes(geometry, vertices, material), {}};
            for (size_t i = 0; i < 3; ++i)
            {
                corners.push_back(narrow(transformPoint(transform, widen(geometry.position(vertices[i])))));
                box.add(corners.back());
                const Double3 normal = geometry.has(kVertexNormal)
                                           ? transformNormal(transform, widen(geometry.normal(vertices[i])))
                                           : Double3{};
                attributes.normals[i] = normalizeOr(narrow(normal * (instance.mirrored ? -1.0 : 1.0)), {});
            }
            surfaces.attributes_.push_back(attributes);
        }
    };
    HEARTH_TRY(bricks::visitOpaqueClusters(scene, bricks::findCutClusters(scene, 0), add));
    const float offset = box.empty() ? 0 : std::max(length(box.max - box.min) * kOffsetShare, 1e-6f);
    surfaces.rays_ = {ray_scene::TriangleRays(std::move(corners)), offset};
    return surfaces;
}

std::optional<SurfaceHit> Surfaces::nearest(Float3 position, Float3 direction) const
{
    const std::optional<ray_scene::TriangleHit> hit = rays_.triangles.nearest(position, direction);
    if (!hit)
        return std::nullopt;
    const auto corner = rays_.triangles.triangle(hit->triangle);
    const Attributes& attributes = attributes_[hit->triangle];
    const Float3 front = normalizeOr(cross(corner[1] - corner[0], corner[2] - corner[0]), -direction);
    const float sign = dot(front, direction) <= 0 ? 1.0f : -1.0f;
    SurfaceHit found;
    found.side = front * sign;
    found.normal = normalizeOr(receivers::interpolate(attributes.normals, hit->weights) * sign, found.side);
    if (dot(found.normal, found.side) <= 0)
        found.normal = found.side;
    found.position = position + direction * hit->distance + found.side * rays_.offset;
    found.triangle = hit->triangle;
    found.weights = hit->weights;
    found.distance = hit->distance;
    found.is_black = sign < 0 && !attributes.material->doubleSided();
    return found;
}

SurfaceSample Surfaces::sample(const SurfaceHit& hit, float footprint) const
{
    const auto corner = rays_.triangles.triangle(hit.triangle);
    const std::array<Float3, 3> corners{corner[0], corner[1], corner[2]};
    const Double3 at = widen(receivers::interpolate(corners, hit.weights));
    bricks::Polygon polygon; // in footprints around the hit, in place of voxels
    for (const Float3& p : corners)
        polygon.add((widen(p) - at) * (1 / double{footprint}));
    const Attributes& attributes = attributes_[hit.triangle];
    if (!(length(bricks::doubleArea(polygon)) > 0))
        return {bricks::meanAlbedo(*attributes.material), {}, 1};
    return bricks::TriangleSurface(*attributes.material, polygon, attributes.values).at({});
}

Box3 Surfaces::box() const
{
    Box3 box;
    for (const Float3& corner : rays_.triangles.corners())
        box.add(corner);
    return box;
}

receivers::MeshLight Surfaces::listEmission(float exposure, std::vector<receivers::Triangle>& triangles) const
{
    receivers::MeshLight light;
    for (uint32_t t = 0; t < attributes_.size(); ++t)
    {
        const SurfaceMaterial& material = *attributes_[t].material;
        if (material.record.emissive == Float3{})
            continue;
        const auto corner = rays_.triangles.triangle(t);
        receivers::Triangle triangle{};
        triangle.corners = {corner[0], corner[1], corner[2]};
        triangle.double_sided = material.doubleSided();
        const float size = std::sqrt(length(receivers::crossEdges(triangle)));
        Float3 emission;
        for (const Float2& weights : kEmissionPoints)
            emission += sample({.triangle = t, .weights = weights}, std::max(size, 1e-6f)).emission /
                        kEmissionPoints.size();
        if (emission == Float3{})
            continue;
        light.triangles.push_back(static_cast<uint32_t>(triangles.size()));
        light.radiance.push_back(emission * exposure);
        triangles.push_back(triangle);
    }
    return light;
}

Status Surfaces::status() const
{
    for (const Attributes& attributes : attributes_)
        for (const auto* texture : {&attributes.material->base_color,
                                    &attributes.material->metallic_roughness, &attributes.material->emissive})
            if (*texture)
                HEARTH_TRY((*texture)->status());
    return success();
}

} // namespace hearth::reflections
