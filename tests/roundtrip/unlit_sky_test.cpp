// Tests that painted skies let the sky's light through: ambient occlusion of `hearth cook --visibility` below
// an unlit dome, against rays of tests/reference that ignore unlit surfaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/pack.h"
#include "sample_assets/hearth_scene.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/sky.h"
#include "tests/reference/tracer/irradiance.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::test
{

namespace
{

using reference::Double3;

/// Cook the document with `--visibility` by the real programs.
pack::Pack cook(Sandbox& sandbox, const samples::Document& document)
{
    EXPECT_TRUE(samples::writeFile(sandbox / "scene.glb", samples::encodeGlb(document)).ok());
    const ProgramEnd end =
        sandbox.run({HEARTH_BIN "/hearth", "cook", "scene.glb", "-o", "scene.hearth", "-q", "--visibility"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    return pack::Pack::open(sandbox / "scene.hearth").value();
}

/// Ambient occlusion of what a camera sees, by the pack and by rays.
struct Compared
{
    size_t points = 0;
    double rms = 0; ///< difference of means over squares of 8 x 8 rays: vertices cannot hold finer detail
    double mean_traced = 0;
};

/// Sees a pack's surfaces through rays.
class OcclusionRays
{
public:
    explicit OcclusionRays(const formats::PackView& view)
        : geometry_(reference::PackGeometry::decode(view).value()),
          textures_(reference::TextureSet::load(view).value()),
          scene_(geometry_, textures_, nullptr)
    {
    }

    /// Compare at the surfaces that width x height rays from the eye meet.
    /// slope  half of the image's height at a distance of 1
    Compared compare(Double3 eye, Double3 target, double slope, uint32_t width, uint32_t height) const
    {
        constexpr uint32_t kSide = 8;
        const Double3 forward = normalize(target - eye), right = normalize(cross(forward, {0, 1, 0}));
        const Double3 up = cross(right, forward);
        Compared compared;
        double squares = 0, traced_sum = 0;
        for (uint32_t square = 0; square < width / kSide * (height / kSide); ++square)
        {
            double difference = 0;
            size_t points = 0;
            for (uint32_t ray = 0; ray < kSide * kSide; ++ray)
            {
                const uint32_t x = square % (width / kSide) * kSide + ray % kSide;
                const uint32_t y = square / (width / kSide) * kSide + ray / kSide;
                const double across = ((x + 0.5) / width * 2 - 1) * slope * width / height;
                const double upwards = (1 - (y + 0.5) / height * 2) * slope;
                const auto point =
                    scene_.nearest({eye, normalize(forward + right * across + up * upwards)}, 0);
                if (!point || point->unlit)
                    continue;
                const double traced = trace(*point);
                difference += baked(point->hit) - traced;
                traced_sum += traced;
                ++points;
            }
            if (points > 0)
                squares += difference * difference / static_cast<double>(points);
            compared.points += points;
        }
        compared.rms = std::sqrt(squares / static_cast<double>(compared.points));
        compared.mean_traced = traced_sum / static_cast<double>(compared.points);
        return compared;
    }

private:
    /// Ambient occlusion of the interpolated moments.
    double baked(const reference::SurfaceHit& hit) const
    {
        const formats::ClusterGeometry cluster = geometry_.cluster(hit.cluster);
        const auto vertices = cluster.triangle(hit.triangle);
        Double3 normal, moment;
        for (size_t corner = 0; corner < 3; ++corner)
        {
            normal += Double3(cluster.normal(vertices[corner])) * hit.weights[corner];
            moment += Double3(cluster.visibility(vertices[corner]).m1) * hit.weights[corner];
        }
        return std::clamp(dot(normalize(normal), moment) / std::numbers::pi, 0.0, 1.0);
    }

    double trace(const reference::ShadedPoint& point) const
    {
        // a lattice of the square with the golden ratio, cosine-weighted
        constexpr uint32_t kRays = 256;
        const Double3 start = lifted(point), normal = litNormal(point);
        uint32_t open = 0;
        for (uint32_t i = 0; i < kRays; ++i)
            open += scene_.occluded({start, reference::cosineDirection(normal, (i + 0.5) / kRays,
                                                                       std::fmod(i * 0.6180339887, 1.0))})
                        ? 0
                        : 1;
        return double{1} * open / kRays;
    }

    reference::PackGeometry geometry_;
    reference::TextureSet textures_;
    reference::ShadedScene scene_;
};

/// Drop the nodes that a pack has no visibility of their own for: characters occlude only themselves, and
/// instances share the visibility of their mesh.
void dropShared(samples::Document& document)
{
    std::vector<int> uses(document.meshes.size(), 0);
    const auto count = [&](auto&& self, int node) -> void
    {
        const samples::Node& n = document.nodes[static_cast<size_t>(node)];
        if (n.mesh != samples::kNoIndex)
            uses[static_cast<size_t>(n.mesh)] +=
                n.skin != samples::kNoIndex ? 2 : std::max(1, static_cast<int>(n.instances.size()));
        for (const int child : n.children)
            self(self, child);
    };
    for (const int root : document.roots)
        count(count, root);
    const auto isShared = [&](auto&& self, int node) -> bool
    {
        const samples::Node& n = document.nodes[static_cast<size_t>(node)];
        return (n.mesh != samples::kNoIndex && uses[static_cast<size_t>(n.mesh)] > 1) ||
               std::ranges::any_of(n.children, [&](int child) { return self(self, child); });
    };
    std::erase_if(document.roots, [&](int root) { return isShared(isShared, root); });
}

} // namespace

TEST(UnlitSky, leavesAFloorOpenAndTheWallOnItHalfOpen)
{
    samples::Document document;
    const int material = samples::addPlainMaterial(document, "plain", {0.5f, 0.5f, 0.5f});
    samples::TriangleMesh floor = samples::makeGrid(40, 40,
                                                    [](Float2 uv, Float3& position, Float2& texture_uv)
                                                    {
                                                        position = {40 * uv.x - 20, 0, 20 - 40 * uv.y};
                                                        texture_uv = uv;
                                                    });
    samples::setSmoothNormals(floor);
    samples::addObject(document, "floor", {{std::move(floor), material}});
    samples::addObject(document, "wall", {{samples::makeBox({0, 2, 0}, {3, 2, 0.2f}, 1), material}});
    samples::addSky(document, "day", 50, [](Float2) { return Float4{0.2f, 0.4f, 0.8f, 1}; });
    Sandbox sandbox;
    const pack::Pack pack = cook(sandbox, document);
    const OcclusionRays rays(pack.view());
    const Compared floor_seen = rays.compare({10, 12, 10}, {12, 0, 12}, 0.3, 32, 32);
    EXPECT_EQ(floor_seen.points, 32u * 32);
    EXPECT_GT(floor_seen.mean_traced, 0.95);
    EXPECT_LT(floor_seen.rms, 0.02);
    const Compared wall_seen = rays.compare({0, 2, 6}, {0, 2, 0}, 0.2, 32, 32);
    EXPECT_NEAR(wall_seen.mean_traced, 0.5, 0.1);
    EXPECT_LT(wall_seen.rms, 0.02);
}

/// The demo with fewer triangles of its boulder.
TEST(UnlitSky, letsTheDemoSeeTheSky)
{
    samples::Document document = samples::makeHearthScene(20000, 64);
    dropShared(document);
    Sandbox sandbox;
    const pack::Pack pack = cook(sandbox, document);
    const Compared seen =
        OcclusionRays(pack.view()).compare({2.7, 1.15, 4.9}, {-0.35, 1.05, -0.4}, std::tan(0.36), 160, 96);
    std::printf("%zu points, rms %.4f, mean %.3f\n", seen.points, seen.rms, seen.mean_traced);
    EXPECT_GT(seen.points, 8000u);
    EXPECT_GT(seen.mean_traced, 0.5);
    EXPECT_LT(seen.rms, 0.02);
}

} // namespace hearth::test
