// Tests bindings of vertices, and distances between a mesh and its proxy.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/binding.h"
#include "formats/base/double3.h"
#include "tests/cook/proxy/surfaces.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/certified_distance.h"

#include <ctime>
#include <gtest/gtest.h>
#include <tuple>

namespace hearth::test
{

namespace
{

using formats::ProxyBindingRecord;
using proxy::FinestVertices;
using proxy::Surface;

/// Return the place that a binding names.
Double3 findPlace(const Surface& surface, const ProxyBindingRecord& binding)
{
    const auto [a, b, c] = surface.corners(binding.triangle);
    const double u = binding.weights[0] / 65535.0, v = binding.weights[1] / 65535.0;
    return widen(a) * (1 - u - v) + widen(b) * u + widen(c) * v;
}

TEST(ProxyBinding, isThePlaceAtItsDistance)
{
    const Surface proxy = toSurface(shapes::rock(6, 0.2f));
    const mesh::SourceMesh fine = shapes::rock(24, 0.3f);
    const std::vector<ProxyBindingRecord> bindings = bindVertices({fine.positions, fine.normals}, proxy);
    ASSERT_EQ(bindings.size(), fine.positions.size());
    const SurfaceDistance closest(proxy.positions, proxy.indices);
    const double rounding = 2e-5 * double{findDiagonal(proxy)}; // of the weights
    size_t nearest = 0;
    for (size_t v = 0; v < bindings.size(); ++v)
    {
        const double distance = length(findPlace(proxy, bindings[v]) - widen(fine.positions[v]));
        EXPECT_NEAR(distance, double{bindings[v].distance}, rounding);
        const double least = closest.to(fine.positions[v]);
        EXPECT_GE(distance, least - rounding);
        nearest += distance <= least + rounding ? 1 : 0;
        EXPECT_LE(uint32_t{bindings[v].weights[0]} + bindings[v].weights[1], 65535u);
    }
    EXPECT_GT(nearest, bindings.size() * 9 / 10) << "only creases have a nearer place that faces away";
}

TEST(ProxyBinding, prefersTheSideThatTheVertexFaces)
{
    const Surface slab = makeBox({-1, 0, -1}, {1, 0.1f, 1});
    // above the middle of the slab, but facing down: the lower side is a little farther
    const FinestVertices vertices{{{0.3f, 0.04f, 0.2f}, {0.3f, 0.06f, 0.2f}, {0.3f, 0.0999f, 0.2f}},
                                  {{0, 1, 0}, {0, -1, 0}, {0, -1, 0}}};
    const std::vector<ProxyBindingRecord> bindings = bindVertices(vertices, slab);
    EXPECT_NEAR(bindings[0].distance, 0.06, 1e-4);
    EXPECT_NEAR(bindings[1].distance, 0.06, 1e-4);
    EXPECT_NEAR(bindings[2].distance, 0.0001, 1e-4) << "the other side is a thousand times as far";
}

TEST(ProxyDistances, copiesOfTrianglesCostNothing)
{
    Surface mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.add({0, 1, 2}, 0);
    Surface copies = mesh;
    for (int copy = 0; copy < 20'000; ++copy)
        copies.add({1, 2, 0}, 1);
    const Surface proxy = toSurface(shapes::rock(12, 0.2f));
    const auto measure = [&](const Surface& surface)
    {
        const std::clock_t start = std::clock();
        const proxy::Distances distances = boundDistances(surface, proxy, 1e-2);
        return std::tuple(std::clock() - start, distances.of_proxy, distances.of_mesh);
    };
    const auto [time, of_proxy, of_mesh] = measure(mesh);
    const auto [time_of_copies, of_proxy_of_copies, of_mesh_of_copies] = measure(copies);
    EXPECT_EQ(of_proxy_of_copies, of_proxy);
    EXPECT_EQ(of_mesh_of_copies, of_mesh);
    EXPECT_LT(time_of_copies, 10 * time + CLOCKS_PER_SEC / 5);
}

TEST(ProxyDistances, areBoundsOfBothSides)
{
    Surface mesh = toSurface(shapes::rock(16, 0.2f));
    const Surface proxy = mesh;
    append(mesh, makeBox({2.5f, 0, 0}, {2.6f, 0.1f, 0.1f})); // a part that the proxy lacks
    const proxy::Distances distances = boundDistances(mesh, proxy, 1e-4);
    const DistanceBounds of_mesh =
        certifyOneSided(mesh.positions, mesh.indices, SurfaceDistance(proxy.positions, proxy.indices), {});
    EXPECT_GE(double{distances.of_mesh}, of_mesh.lower);
    EXPECT_LE(double{distances.of_mesh}, 1.1 * of_mesh.upper);
    EXPECT_GT(double{distances.of_mesh}, 1);
    EXPECT_LT(distances.of_proxy, 2e-4f * findDiagonal(mesh));
}

} // namespace

} // namespace hearth::test
