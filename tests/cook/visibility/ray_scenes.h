// Small meshes for ray tests, and the visibility from points on them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/rays.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

namespace hearth::visibility
{

inline constexpr double kPi = std::numbers::pi;
inline constexpr float kFar = 3000; ///< practically infinite beside geometry of size 1

struct Mesh
{
    std::vector<Float3> positions;
    std::vector<uint32_t> corners;

    /// Front side: counter-clockwise.
    void addQuad(Float3 a, Float3 b, Float3 c, Float3 d)
    {
        const auto first = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), {a, b, c, d});
        corners.insert(corners.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }

    OccluderMesh occluder() const { return {positions, corners}; }
};

inline Mesh makeMesh(const mesh::SourceMesh& source)
{
    return {source.positions, source.indices};
}

/// z = 0, facing up.
inline Mesh makeFloor(float size)
{
    Mesh mesh;
    mesh.addQuad({-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0});
    return mesh;
}

/// Part of a sphere of radius 1 from the bottom up to polar angle `top` * pi (1: whole sphere).
inline Mesh makeSphere(uint32_t rings, uint32_t sectors, double top, bool inwards)
{
    Mesh mesh;
    const auto at = [&](uint32_t ring, uint32_t sector)
    {
        const double polar = kPi * top * ring / rings, azimuth = 2 * kPi * (sector % sectors) / sectors;
        if (top == 1 && ring == rings)
            return Float3{0, 0, 1}; // sin(kPi) is not 0
        return Float3{static_cast<float>(std::sin(polar) * std::cos(azimuth)),
                      static_cast<float>(std::sin(polar) * std::sin(azimuth)),
                      static_cast<float>(-std::cos(polar))};
    };
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector)
        {
            const Float3 a = at(ring, sector), b = at(ring, sector + 1), c = at(ring + 1, sector + 1),
                         d = at(ring + 1, sector);
            if (inwards)
                mesh.addQuad(a, d, c, b);
            else
                mesh.addQuad(a, b, c, d);
        }
    return mesh;
}

inline Mesh transformed(Mesh mesh, const Affine3& transform)
{
    for (Float3& p : mesh.positions)
        p = transformPoint(transform, p);
    if (determinant(transform) < 0) // keep front faces in front
        for (size_t c = 0; c < mesh.corners.size(); c += 3)
            std::swap(mesh.corners[c + 1], mesh.corners[c + 2]);
    return mesh;
}

inline Affine3 scaledAndMoved(float scale, Float3 by)
{
    return {{{scale, 0, 0, by.x}, {0, scale, 0, by.y}, {0, 0, scale, by.z}}};
}

inline Occluders makeOccluders(std::initializer_list<OccluderMesh> meshes)
{
    Occluders occluders;
    for (const OccluderMesh& mesh : meshes)
        occluders.place(occluders.add(mesh));
    occluders.finish();
    return occluders;
}

inline Moments seenFrom(const Occluders& occluders, Float3 position, Float3 normal, RaySettings settings = {})
{
    settings.rays_per_sample = 1 << 16;
    const SamplePoint point{position, normal, 1e-6f};
    return visibilityMoments(occluders, {&point, 1}, settings).value()[0];
}

inline double computeOcclusion(const Moments& m, Float3 normal)
{
    return double{dot(m.m1, normal)} / kPi;
}

inline std::vector<SamplePoint> makePoints(const Mesh& mesh, double per_vertex,
                                           const Affine3& world_from_mesh = {})
{
    return samplePoints(mesh.positions, mesh.corners,
                        surfaceSamples(mesh.positions, mesh.corners, {.samples_per_vertex = per_vertex}),
                        world_from_mesh);
}

inline constexpr Float3 kUp{0, 0, 1};

} // namespace hearth::visibility
