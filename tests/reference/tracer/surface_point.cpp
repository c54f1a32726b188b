// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/surface_point.h"

namespace hearth::reference
{

using namespace formats;

namespace
{

Double3 normalizeOr(Double3 v, Double3 fallback)
{
    return dot(v, v) > 1e-60 ? normalize(v) : fallback;
}

Double3 anyAcross(Double3 n)
{
    return normalize(cross(n, std::abs(n.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
}

double computeArea(Float2 a, Float2 b, Float2 c)
{
    return (double{b.x} - double{a.x}) * (double{c.y} - double{a.y}) -
           (double{c.x} - double{a.x}) * (double{b.y} - double{a.y});
}

/// Direction in which u increases, from the triangle's world positions and UVs; zero if the UVs have no area.
Double3 directionOfU(const Double3 corners[3], const Float2 uv[3])
{
    const double area = computeArea(uv[0], uv[1], uv[2]);
    if (area == 0)
        return {};
    return ((corners[1] - corners[0]) * (double{uv[2].y} - double{uv[0].y}) -
            (corners[2] - corners[0]) * (double{uv[1].y} - double{uv[0].y})) /
           area;
}

} // namespace

SurfacePoint surfaceAt(const Placement& placement, const SurfaceHit& hit, uint32_t tangent_set)
{
    const ClusterGeometry cluster = placement.geometry().cluster(hit.cluster);
    const auto vertices = cluster.triangle(hit.triangle);

    SurfacePoint point;
    Double3 corners[3], normal, tangent;
    double turn = 1;
    for (size_t i = 0; i < 3; ++i)
    {
        const PlacedVertex vertex = placement.vertex(hit.instance, cluster, vertices[i]);
        corners[i] = vertex.position;
        point.position += corners[i] * hit.weights[i];
        normal += vertex.normal * hit.weights[i];
        tangent += vertex.tangent * hit.weights[i];
        turn = vertex.mirrored ? -1 : 1;
    }
    const Double3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    point.geometric_normal = normalizeOr(area * turn, {0, 1, 0});
    point.normal = normalizeOr(normal, point.geometric_normal);

    Float2 uvs[4][3] = {};
    for (uint32_t set = 0; set < 4; ++set)
    {
        if (!cluster.has(uint32_t{kVertexUv0} << set))
            continue;
        for (size_t i = 0; i < 3; ++i)
        {
            uvs[set][i] = cluster.uv(vertices[i], set);
            point.uv[set] = point.uv[set] + uvs[set][i] * static_cast<float>(hit.weights[i]);
        }
        const double world_area = length(area);
        if (world_area > 0)
            point.uv_per_metre[set] =
                std::sqrt(std::abs(computeArea(uvs[set][0], uvs[set][1], uvs[set][2])) / world_area);
    }

    // glTF: bitangent = w cross(normal, tangent). Without stored tangents, u increases along the tangent, and
    // the green of a normal map points in the direction of decreasing v, up in the image.
    double side;
    if (cluster.has(kVertexTangent))
        side = double{cluster.tangent(vertices[0]).w} * turn;
    else
    {
        const Float2* const uv = uvs[tangent_set];
        tangent = directionOfU(corners, uv);
        side = (computeArea(uv[0], uv[1], uv[2]) > 0 ? -1 : 1) * turn;
    }
    point.tangent = normalizeOr(tangent, anyAcross(point.normal));
    point.bitangent = normalizeOr(cross(point.normal, point.tangent), anyAcross(point.tangent)) * side;

    if (cluster.has(kVertexColor))
    {
        point.color = {0, 0, 0, 0};
        for (size_t i = 0; i < 3; ++i)
        {
            const Float4 c = cluster.color(vertices[i]);
            const auto w = static_cast<float>(hit.weights[i]);
            point.color = {point.color.x + c.x * w, point.color.y + c.y * w, point.color.z + c.z * w,
                           point.color.w + c.w * w};
        }
    }
    return point;
}

} // namespace hearth::reference
