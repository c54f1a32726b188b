// Tests the sky's light that `hearth cook --visibility` lets arrive against rays of tests/reference: on walls
// that stand on real ground, and below unlit domes, which let it through.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/ambient_occlusion.h"
#include "formats/scene/scene_lighting.h"
#include "formats/scene/sky_table.h"
#include "runtime/pack/pack.h"
#include "sample_assets/hearth_scene.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/sky.h"
#include "tests/reference/tracer/irradiance.h"
#include "tests/reference/tracer/sky_tracer.h"
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
    const ProgramEnd end = sandbox.run(
        {HEARTH_BIN "/hearth", "cook", "scene.glb", "-o", "scene.hearth", "-q", "--bricks", "off"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    return pack::Pack::open(sandbox / "scene.hearth").value();
}

/// A value at the surfaces that a camera sees, by the pack and by rays.
struct Compared
{
    size_t points = 0;
    double rms = 0; ///< difference of means over squares of 8 x 8 rays: vertices cannot hold finer detail
    double mean_traced = 0, mean_baked = 0;
};

/// Camera of width x height rays.
struct Look
{
    Double3 eye, target;
    double slope; ///< half of the image's height at a distance of 1
    uint32_t width, height;
};

/// Sees a pack's surfaces through rays.
class SkyRays
{
public:
    explicit SkyRays(const formats::PackView& view)
        : geometry_(reference::PackGeometry::decode(view).value()),
          textures_(reference::TextureSet::load(view).value()),
          scene_(geometry_, textures_, nullptr)
    {
    }

    Compared compareOcclusion(const Look& look) const
    {
        return compare(
            look, [&](const reference::ShadedPoint& point) { return traceOcclusion(point); },
            [&](const reference::ShadedPoint& point) { return bakedOcclusion(moments(point.hit)); });
    }

    /// Irradiance over pi of the sky, mean of the colours.
    Compared compareLight(const Look& look) const
    {
        uint64_t seed = 0;
        return compare(
            look,
            [&](const reference::ShadedPoint& point)
            {
                const Double3 view = normalize(look.eye - point.surface.position);
                return mean(traceSky(scene_, point, view, {.rays = 128}, ++seed).irradiance);
            },
            [&](const reference::ShadedPoint& point) { return bakedLight(moments(point.hit)); });
    }

private:
    struct Moments
    {
        double m0 = 0;
        Double3 m1, normal;
    };

    static double mean(Double3 v) { return (v.x + v.y + v.z) / 3; }

    template <typename Trace, typename Bake>
    Compared compare(const Look& look, const Trace& trace, const Bake& bake) const
    {
        constexpr uint32_t kSide = 8;
        const Double3 forward = normalize(look.target - look.eye),
                      right = normalize(cross(forward, {0, 1, 0}));
        const Double3 up = cross(right, forward);
        const uint32_t columns = look.width / kSide;
        Compared compared;
        double squares = 0;
        for (uint32_t square = 0; square < columns * (look.height / kSide); ++square)
        {
            double traced = 0, baked = 0;
            size_t points = 0;
            for (uint32_t ray = 0; ray < kSide * kSide; ++ray)
            {
                const uint32_t x = square % columns * kSide + ray % kSide;
                const uint32_t y = square / columns * kSide + ray / kSide;
                const double across =
                    ((x + 0.5) / look.width * 2 - 1) * look.slope * look.width / look.height;
                const double upwards = (1 - (y + 0.5) / look.height * 2) * look.slope;
                const auto point =
                    scene_.nearest({look.eye, normalize(forward + right * across + up * upwards)}, 0);
                if (!point || point->unlit)
                    continue;
                traced += trace(*point);
                baked += bake(*point);
                ++points;
            }
            if (points > 0)
                squares += std::pow(baked - traced, 2) / static_cast<double>(points);
            compared.points += points;
            compared.mean_traced += traced;
            compared.mean_baked += baked;
        }
        const auto count = static_cast<double>(compared.points);
        compared.rms = std::sqrt(squares / count);
        compared.mean_traced /= count;
        compared.mean_baked /= count;
        return compared;
    }

    /// Interpolate moments and normal; instances are not rotated.
    Moments moments(const reference::SurfaceHit& hit) const
    {
        const formats::ClusterGeometry cluster = geometry_.cluster(hit.cluster);
        const auto vertices = cluster.triangle(hit.triangle);
        Moments found;
        for (size_t corner = 0; corner < 3; ++corner)
        {
            const shared::VisibilityMoments vertex = cluster.visibility(vertices[corner]);
            found.m0 += double{vertex.m0} * hit.weights[corner];
            found.m1 += Double3(vertex.m1) * hit.weights[corner];
            found.normal += Double3(cluster.normal(vertices[corner])) * hit.weights[corner];
        }
        found.normal = normalize(found.normal);
        return found;
    }

    static double bakedOcclusion(const Moments& at)
    {
        return std::clamp(dot(at.normal, at.m1) / std::numbers::pi, 0.0, 1.0);
    }

    /// Light of the sky as the runtime computes it.
    static double bakedLight(const Moments& at)
    {
        const auto narrow = [](Double3 v) {
            return Float3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        };
        const Float3 normal = narrow(at.normal);
        const shared::VisibilityCone cone =
            shared::visibilityCone(static_cast<float>(at.m0), narrow(at.m1), normal);
        const shared::Sky sky{shared::kSkyZenith, shared::kSkyHorizon, shared::kSkyGround};
        return bakedOcclusion(at) *
               mean(Double3(shared::skyConeRadiance(sky, shared::visibleCosineCone(cone, normal))));
    }

    double traceOcclusion(const reference::ShadedPoint& point) const
    {
        // a lattice of the square with the golden ratio, cosine-weighted
        constexpr uint32_t kRays = 256;
        const Double3 start = lifted(point), normal = litNormal(point);
        uint32_t open = 0;
        for (uint32_t i = 0; i < kRays; ++i)
            open += scene_.occluded({start, reference::cosineDirection(normal, (i + 0.5) / kRays,
                                                                       std::fmod(i * 0.6180339887, 1.0))})
                        ? 0u
                        : 1u;
        return double{1} * open / kRays;
    }

    reference::PackGeometry geometry_;
    reference::TextureSet textures_;
    reference::ShadedScene scene_;
};

/// Add a parallelogram of n x n quads that faces cross(u, v).
void addSheet(samples::Document& document, int material, Float3 corner, Float3 u, Float3 v, uint32_t n)
{
    samples::TriangleMesh sheet = samples::makeGrid(n, n,
                                                    [&](Float2 uv, Float3& position, Float2& texture_uv)
                                                    {
                                                        position = corner + u * uv.x + v * uv.y;
                                                        texture_uv = uv;
                                                    });
    samples::setSmoothNormals(sheet);
    samples::addObject(document, "sheet", {{std::move(sheet), material}});
}

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

TEST(SkyLight, comesThroughAnUnlitDome)
{
    samples::Document document;
    const int material = samples::addPlainMaterial(document, "plain", {0.5f, 0.5f, 0.5f});
    addSheet(document, material, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, 40);
    samples::addObject(document, "wall", {{samples::makeBox({0, 2, 0}, {3, 2, 0.2f}, 1), material}});
    samples::addSky(document, "day", 50, [](Float2) { return Float4{0.2f, 0.4f, 0.8f, 1}; });
    Sandbox sandbox;
    const pack::Pack pack = cook(sandbox, document);
    const SkyRays rays(pack.view());
    const Compared floor = rays.compareOcclusion({{10, 12, 10}, {12, 0, 12}, 0.3, 32, 32});
    EXPECT_EQ(floor.points, 32u * 32);
    EXPECT_GT(floor.mean_traced, 0.95);
    EXPECT_LT(floor.rms, 0.02);
    const Compared wall = rays.compareOcclusion({{0, 2, 6}, {0, 2, 0}, 0.2, 32, 32});
    EXPECT_NEAR(wall.mean_traced, 0.5, 0.1);
    EXPECT_LT(wall.rms, 0.02);
}

/// A house, and a lower one beside it, on a wide plain.
TEST(SkyLight, lightsWallsOnRealGroundWithinThreePercent)
{
    samples::Document document;
    const int material = samples::addPlainMaterial(document, "plain", {0.5f, 0.5f, 0.5f});
    addSheet(document, material, {-100, 0, 100}, {200, 0, 0}, {0, 0, -200}, 100);
    addSheet(document, material, {-4, 0, 3}, {8, 0, 0}, {0, 5, 0}, 12);  // to +z
    addSheet(document, material, {4, 0, 3}, {0, 0, -6}, {0, 5, 0}, 12);  // to +x
    addSheet(document, material, {4, 0, -3}, {-8, 0, 0}, {0, 5, 0}, 12); // to -z
    addSheet(document, material, {-4, 0, -3}, {0, 0, 6}, {0, 5, 0}, 12); // to -x
    addSheet(document, material, {-4, 5, 3}, {8, 0, 0}, {0, 0, -6}, 12); // roof
    addSheet(document, material, {9, 0, 2}, {3, 0, 0}, {0, 2, 0}, 8);
    addSheet(document, material, {9, 0, -2}, {0, 0, 4}, {0, 2, 0}, 8);
    addSheet(document, material, {9, 2, 2}, {3, 0, 0}, {0, 0, -4}, 8);
    addSheet(document, material, {12, 0, 2}, {0, 0, -4}, {0, 2, 0}, 8);
    addSheet(document, material, {12, 0, -2}, {-3, 0, 0}, {0, 2, 0}, 8);
    Sandbox sandbox;
    const pack::Pack pack = cook(sandbox, document);
    const SkyRays rays(pack.view());
    const auto expectClose = [&](const char* name, const Look& look)
    {
        const Compared seen = rays.compareLight(look);
        EXPECT_EQ(seen.points, size_t{look.width} * look.height) << name;
        std::printf("%s: %.4f, of rays %.4f, %+.1f %%, rms %.1f %%\n", name, seen.mean_baked,
                    seen.mean_traced, 100 * (seen.mean_baked / seen.mean_traced - 1),
                    100 * seen.rms / seen.mean_traced);
        EXPECT_NEAR(seen.mean_baked, seen.mean_traced, 0.03 * seen.mean_traced) << name;
        EXPECT_LT(seen.rms, 0.04 * seen.mean_traced) << name;
    };
    expectClose("wall to the open", {{0, 2.4, 13}, {0, 2.4, 3}, 0.2, 64, 48});
    expectClose("wall to the side", {{-14, 2.4, 0}, {-4, 2.4, 0}, 0.2, 48, 48});
    expectClose("wall of the low house", {{10.5, 1.1, 8}, {10.5, 1, 2}, 0.12, 48, 32});
    expectClose("wall that faces the other house", {{8.2, 2.6, 0}, {4, 2.4, 0}, 0.5, 48, 48});
    expectClose("roof", {{0, 14, 0.1}, {0, 5, 0}, 0.25, 48, 32});
    expectClose("ground", {{-12, 8, 12}, {-14, 0, 14}, 0.2, 48, 32});
}

/// The demo with fewer triangles of its boulder.
TEST(SkyLight, comesThroughTheDomeOfTheDemo)
{
    samples::Document document = samples::makeHearthScene(20000, 64);
    dropShared(document);
    Sandbox sandbox;
    const pack::Pack pack = cook(sandbox, document);
    const Compared seen =
        SkyRays(pack.view())
            .compareOcclusion({{2.7, 1.15, 4.9}, {-0.35, 1.05, -0.4}, std::tan(0.36), 160, 96});
    std::printf("%zu points, rms %.4f, mean %.3f\n", seen.points, seen.rms, seen.mean_traced);
    EXPECT_GT(seen.points, 8000u);
    EXPECT_GT(seen.mean_traced, 0.5);
    EXPECT_LT(seen.rms, 0.02);
}

} // namespace hearth::test
