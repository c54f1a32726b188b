// Tests that cones bring the image nearer to ray tracing: a room whose vertices bake visibility by rays,
// drawn and traced under the same sky.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/reference_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;
using reference::Double3;

/// n x n quads between `corner`, corner + u and corner + v, facing cross(u, v).
mesh::SourceMesh patch(Float3 corner, Float3 u, Float3 v, uint32_t n)
{
    mesh::SourceMesh mesh;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i)
        {
            mesh.positions.push_back(corner + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                     v * (static_cast<float>(j) / static_cast<float>(n)));
            mesh.normals.push_back(normalizeOr(cross(u, v), {}));
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i)
        {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    mesh.face_count = n * n;
    mesh.triangle_materials.assign(size_t{2} * n * n, kInvalidIndex);
    mesh.source_vertex_count = static_cast<uint32_t>(mesh.positions.size());
    return mesh;
}

/// Five sides of a box that stands on the floor.
void appendBox(mesh::SourceMesh& mesh, Float3 low, Float3 high, uint32_t n)
{
    const Float3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    shapes::append(mesh, patch(low + z, x, y, n));
    shapes::append(mesh, patch(low + x + z, z * -1.0f, y, n));
    shapes::append(mesh, patch(low + x, x * -1.0f, y, n));
    shapes::append(mesh, patch(low, z, y, n));
    shapes::append(mesh, patch(low + y + z, x, z * -1.0f, n));
}

constexpr Float3 kMiddle{0, 1.2f, 0};

/// Floor, two walls, a lid over a part of it, a box and a ball.
mesh::SourceMesh room()
{
    mesh::SourceMesh mesh = patch({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 24);
    shapes::append(mesh, patch({-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, 20));
    shapes::append(mesh, patch({-2, 0, 2}, {0, 0, -4}, {0, 2.5f, 0}, 20));
    shapes::append(mesh, patch({-2, 2.4f, -2}, {2.5f, 0, 0}, {0, 0, 2.5f}, 14));
    appendBox(mesh, {0.2f, 0, -1.3f}, {1.4f, 1, -0.3f}, 8);
    mesh::SourceMesh ball = shapes::rock(10, 0);
    ball.uvs = {};
    float radius = 0;
    for (const Float3 p : ball.positions)
        radius = std::max(radius, length(p));
    for (Float3& p : ball.positions)
        p = p * (0.5f / radius) + Float3{-0.7f, 0.52f, 0.4f};
    shapes::append(mesh, ball);
    return mesh;
}

struct Placed
{
    TestScene test;
    std::optional<formats::PackView> pack;

    explicit Placed(bool visibility, const TestScene::Visibility& baked = {})
    {
        formats::MaterialRecord material = plainMaterial();
        material.base_color = {0.7f, 0.65f, 0.6f, 1};
        material.roughness = 0.4f;
        clusters::Config config;
        config.visibility = visibility;
        test.addInstance(test.addMesh(withMaterial(room(), test.addMaterial(material)), config),
                         translated({}));
        if (baked)
            test.setVisibility(baked);
        pack.emplace(test.build());
    }
};

/// Bake the visibility of a vertex. Rays start a little off its surface and towards the middle of the room,
/// because vertices on edges lie in other surfaces.
VisibilityMoments lookAbout(const reference::EmbreeScene& rays, Float3 position, Float3 normal)
{
    constexpr uint32_t kRays = 256;
    const Double3 n(normal), middle = Double3(kMiddle) - Double3(position);
    const Double3 from = Double3(position) + n * 0.04 + normalize(middle) * 0.02;
    const Double3 x = normalize(cross(n, std::abs(n.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0})),
                  y = cross(n, x);
    const double solid = 2 * 3.14159265358979 / kRays;
    double m0 = 0;
    Double3 m1;
    for (uint32_t i = 0; i < kRays; ++i)
    {
        const double z = (i + 0.5) / kRays, phi = i * 2.39996322972865, r = std::sqrt(1 - z * z);
        const Double3 direction = x * (r * std::cos(phi)) + y * (r * std::sin(phi)) + n * z;
        if (rays.occluded({from, direction}))
            continue;
        m0 += solid;
        m1 += direction * solid;
    }
    return {static_cast<float>(m0),
            {static_cast<float>(m1.x), static_cast<float>(m1.y), static_cast<float>(m1.z)}};
}

class SkyImageTest : public GpuTest
{
};

/// Root mean square of the difference of two displayed images, on surfaces of the runtime's image; of 255.
double rms(const Image& drawn, const reference::Image& traced)
{
    double sum = 0, count = 0;
    for (uint32_t y = 0; y < drawn.height; ++y)
        for (uint32_t x = 0; x < drawn.width; ++x)
        {
            if (drawn.visibility[y * drawn.width + x] == kVisibilitySky)
                continue;
            for (int c = 0; c < 3; ++c)
                sum += std::pow(channel(drawn.at(x, y), c) - int{traced.at(x, y)[c]}, 2);
            count += 3;
        }
    return std::sqrt(sum / count);
}

} // namespace

TEST_F(SkyImageTest, conesHalveTheErrorOfTheRoom)
{
    const Placed open(false);
    const reference::PackGeometry geometry = reference::PackGeometry::decode(*open.pack).value();
    const reference::Placement placement(geometry);
    const reference::EmbreeScene rays(placement, [](const reference::SurfaceHit&) { return true; });
    const Placed baked(true, [&](uint32_t, Float3 position, Float3 normal)
                       { return lookAbout(rays, position, normal); });

    const Camera camera{
        .position = {3.2f, 2.2f, 3.6f}, .target = {-0.3f, 0.7f, -0.3f}, .y_fov_rad = 0.8f, .z_near = 0.05f};
    reference::ReferenceOptions options;
    options.camera = camera;
    options.width = 80;
    options.height = 60;
    options.samples_per_side = 1;
    options.sky.rays = 96;
    const reference::Image traced = reference::renderReference(*open.pack, options).value();

    const auto scene = upload(*baked.pack);
    const auto error = [&](uint32_t ambient, uint32_t specular)
    {
        return rms(draw(*scene, camera,
                        {.width = options.width,
                         .height = options.height,
                         .error_pixels = 0,
                         .ambient_occlusion = ambient,
                         .specular_occlusion = specular}),
                   traced);
    };
    const double without = error(kAmbientOcclusionOff, kSpecularOcclusionOff);
    const double with = error(kAmbientOcclusionExact, kSpecularOcclusionFit);
    const double cheap = error(kAmbientOcclusionSmoothstep, kSpecularOcclusionFit);
    const double diffuse_only = error(kAmbientOcclusionExact, kSpecularOcclusionOff);
    RecordProperty("rms", std::to_string(without) + " " + std::to_string(with) + " " + std::to_string(cheap) +
                              " " + std::to_string(diffuse_only));
    EXPECT_GT(without, 8);
    EXPECT_LT(with, 0.35 * without);
    EXPECT_LT(cheap, 0.4 * without);
    EXPECT_LT(with, diffuse_only);
}

} // namespace hearth::test
