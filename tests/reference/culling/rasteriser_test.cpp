// Tests the reference rasteriser with cases that have known answers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cpu_rasteriser.h"

#include <gtest/gtest.h>

#include <random>

namespace hearth::reference
{
namespace
{

using formats::InstanceRecord;
using formats::MaterialRecord;

constexpr uint32_t kSize = 64;

/// Camera at the origin that looks along -Z with a right angle of view: at distance d, x and y in [-d, d] are
/// visible.
shared::FrameView squareView(float z_near = 0.1f)
{
    shared::Camera camera;
    camera.y_fov_rad = 1.57079633f;
    camera.z_near = z_near;
    return shared::makeFrameView(camera, kSize, kSize, 1, 1);
}

/// World position at distance d that projects to pixel coordinates (x, y), from the top left corner.
Float3 atPixel(float x, float y, float d)
{
    return {(x / (kSize / 2) - 1) * d, (1 - y / (kSize / 2)) * d, -d};
}

struct Scene
{
    std::vector<InstanceRecord> instances{InstanceRecord{}};
    std::vector<MaterialRecord> materials{MaterialRecord{}};
    std::vector<SceneTriangle> triangles;

    /// Add a triangle; counter-clockwise as seen is a front face.
    void add(Float3 a, Float3 b, Float3 c)
    {
        triangles.push_back({{a, b, c}, 0, 0, static_cast<uint32_t>(triangles.size())});
    }
    RasterImage draw(float z_near = 0.1f) const
    {
        return rasterise(triangles, {instances, materials}, squareView(z_near));
    }
};

size_t countPixels(const RasterImage& image, uint32_t id)
{
    return static_cast<size_t>(std::count(image.ids.begin(), image.ids.end(), id));
}

TEST(Rasterise, coversExactlyThePixelsOfARectangle)
{
    Scene scene;
    // pixels 8..23 x 16..47; no sample lies on the outline
    scene.add(atPixel(8, 16, 2), atPixel(8, 48, 2), atPixel(24, 48, 2));
    scene.add(atPixel(8, 16, 2), atPixel(24, 48, 2), atPixel(24, 16, 2));
    const RasterImage image = scene.draw();
    for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x)
        {
            const bool inside = x >= 8 && x < 24 && y >= 16 && y < 48;
            EXPECT_EQ(image.ids[y * kSize + x] != kNothing, inside) << x << ", " << y;
            EXPECT_FLOAT_EQ(image.depths[y * kSize + x], inside ? 0.1f / 2 : 0.0f);
        }
    EXPECT_EQ(countPixels(image, 0) + countPixels(image, 1), 16u * 32u);
}

TEST(Rasterise, givesSamplesOnAnEdgeToTheTopOrLeftSide)
{
    Scene scene;
    // the outline passes through samples: (10.5, 20.5) .. (30.5, 40.5)
    scene.add(atPixel(10.5f, 20.5f, 1), atPixel(10.5f, 40.5f, 1), atPixel(30.5f, 40.5f, 1));
    scene.add(atPixel(10.5f, 20.5f, 1), atPixel(30.5f, 40.5f, 1), atPixel(30.5f, 20.5f, 1));
    const RasterImage image = scene.draw();
    EXPECT_EQ(countPixels(image, 0) + countPixels(image, 1), 20u * 20u);
    EXPECT_NE(image.ids[20 * kSize + 10], kNothing);
    EXPECT_EQ(image.ids[20 * kSize + 30], kNothing);
    EXPECT_EQ(image.ids[40 * kSize + 10], kNothing);
    EXPECT_TRUE(image.excused[20 * kSize + 10]);
    EXPECT_TRUE(image.excused[25 * kSize + 15]) << "on the diagonal that both share";
    EXPECT_FALSE(image.excused[25 * kSize + 12]);
}

TEST(Rasterise, drawsAFanOfSliversWithoutHolesOrOverlap)
{
    // Triangles around a centre that is on no grid: each pixel of the disc belongs to one triangle, in any
    // order of drawing.
    Scene scene;
    constexpr int kSlivers = 97;
    std::vector<Float3> rim;
    for (int i = 0; i < kSlivers; ++i)
    {
        const float angle = 6.2831853f * static_cast<float>(i) / kSlivers;
        rim.push_back(atPixel(31.37f + 20 * std::cos(angle), 32.71f - 20 * std::sin(angle), 3));
    }
    for (int i = 0; i < kSlivers; ++i)
        scene.add(atPixel(31.37f, 32.71f, 3), rim[static_cast<size_t>(i)],
                  rim[static_cast<size_t>((i + 1) % kSlivers)]);
    const RasterImage forwards = scene.draw();
    std::reverse(scene.triangles.begin(), scene.triangles.end());
    const RasterImage backwards = scene.draw();
    EXPECT_EQ(forwards.ids, backwards.ids);
    for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x)
        {
            const float dx = static_cast<float>(x) + 0.5f - 31.37f,
                        dy = static_cast<float>(y) + 0.5f - 32.71f;
            if (std::sqrt(dx * dx + dy * dy) < 19.9f)
            {
                EXPECT_NE(forwards.ids[y * kSize + x], kNothing) << x << ", " << y;
            }
        }
}

TEST(Rasterise, keepsTheNearerTriangle)
{
    Scene scene;
    scene.add(atPixel(4, 4, 2), atPixel(4, 60, 2), atPixel(60, 60, 2));
    scene.add(atPixel(4, 4, 5), atPixel(4, 60, 5), atPixel(60, 60, 5));
    EXPECT_EQ(countPixels(scene.draw(), 1), 0u);
    std::swap(scene.triangles[0], scene.triangles[1]);
    EXPECT_EQ(countPixels(scene.draw(), 1), 0u) << "whatever the order";
}

TEST(Rasterise, interpolatesDepthInPerspective)
{
    Scene scene;
    // a floor: y = -1 from distance 1 to 11
    scene.add({-20, -1, -1}, {20, -1, -1}, {20, -1, -11});
    scene.add({-20, -1, -1}, {20, -1, -11}, {-20, -1, -11});
    const RasterImage image = scene.draw();
    for (uint32_t y = 36; y < kSize; ++y)
    {
        // the ray through the sample meets the floor at distance 1 / slope
        const double slope = (y + 0.5) / (kSize / 2) - 1;
        EXPECT_NEAR(double{image.depths[y * kSize + 32]}, 0.1 * slope, 1e-6) << y;
    }
}

TEST(Rasterise, dropsBackFacesUnlessTheMaterialIsDoubleSided)
{
    Scene scene;
    scene.add(atPixel(4, 4, 2), atPixel(60, 60, 2), atPixel(4, 60, 2));
    EXPECT_EQ(countPixels(scene.draw(), 0), 0u);
    scene.materials[0].flags = formats::kMaterialDoubleSided;
    EXPECT_GT(countPixels(scene.draw(), 0), 1000u);
}

TEST(Rasterise, turnsFacesOfMirroredInstances)
{
    Scene scene;
    scene.instances[0].world_from_object.m[0][0] = -1;
    scene.instances[0].flags = formats::kInstanceMirrored;
    scene.add({-1, -1, -2}, {1, -1, -2}, {0, 1, -2});
    EXPECT_GT(countPixels(scene.draw(), 0), 100u);
    scene.instances[0].flags = 0;
    EXPECT_EQ(countPixels(scene.draw(), 0), 0u);
}

TEST(Rasterise, cutsTrianglesAtTheNearPlane)
{
    // A floor that reaches behind the eye. It is visible from distance 0.5 on; there the near plane cuts it,
    // below the image.
    Scene scene;
    scene.add({-9, -1, 9}, {9, -1, 9}, {9, -1, -9});
    scene.add({-9, -1, 9}, {9, -1, -9}, {-9, -1, -9});
    const RasterImage image = scene.draw(0.5f);
    EXPECT_NE(image.ids[63 * kSize + 32], kNothing);
    EXPECT_NEAR(double{image.depths[63 * kSize + 32]}, 0.5 * (63.5 / 32 - 1), 1e-5);
    EXPECT_EQ(image.ids[31 * kSize + 32], kNothing) << "the horizon";

    // A near plane beyond the floor's visible part leaves nothing in the lower rows.
    const RasterImage far_plane = scene.draw(4.0f);
    EXPECT_EQ(far_plane.ids[63 * kSize + 32], kNothing);
    EXPECT_NE(far_plane.ids[37 * kSize + 32], kNothing) << "distance 5.8";
}

TEST(Rasterise, excusesTiesAndMaskedPixels)
{
    Scene scene;
    scene.add(atPixel(4, 4, 2), atPixel(4, 60, 2), atPixel(60, 60, 2));
    scene.add(atPixel(4, 4, 2), atPixel(4, 60, 2), atPixel(60, 60, 2));
    EXPECT_TRUE(scene.draw().excused[50 * kSize + 20]) << "two triangles at one place";

    scene.triangles.pop_back();
    EXPECT_FALSE(scene.draw().excused[50 * kSize + 20]);
    scene.materials.push_back(MaterialRecord{});
    scene.materials[1].alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
    scene.add(atPixel(4, 4, 1), atPixel(4, 60, 1), atPixel(60, 60, 1));
    scene.triangles[1].material = 1;
    const RasterImage image = scene.draw();
    EXPECT_TRUE(image.excused[50 * kSize + 20]) << "behind a mask";
    EXPECT_EQ(image.ids[50 * kSize + 20], 0u);
    scene.triangles[1].corners = {atPixel(4, 4, 9), atPixel(4, 60, 9), atPixel(60, 60, 9)};
    EXPECT_FALSE(scene.draw().excused[50 * kSize + 20]) << "in front of a mask";
}

TEST(Rasterise, agreesWithRaysOnRandomTriangles)
{
    // The nearest hit of the exact ray through each sample without an excuse is the triangle that was drawn.
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-3, 3), depth(-9, 1.5f);
    Scene scene;
    scene.materials[0].flags = formats::kMaterialDoubleSided;
    for (int i = 0; i < 60; ++i)
        scene.add({place(random), place(random), depth(random)},
                  {place(random), place(random), depth(random)},
                  {place(random), place(random), depth(random)});
    const RasterImage image = scene.draw();
    size_t checked = 0, wrong = 0;
    for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x)
        {
            if (image.excused[y * kSize + x])
                continue;
            const double dx = (x + 0.5) / (kSize / 2) - 1, dy = 1 - (y + 0.5) / (kSize / 2);
            double nearest = 1e30;
            uint32_t hit = kNothing;
            for (const SceneTriangle& t : scene.triangles)
            {
                // Intersect the ray (dx, dy, -1) s with the triangle's plane: distance along -Z; then test
                // edge by edge.
                const auto c = [&](size_t i) {
                    return std::array{double{t.corners[i].x}, double{t.corners[i].y}, double{t.corners[i].z}};
                };
                const auto side = [&](const auto& a, const auto& b) {
                    return dx * (a[1] * b[2] - a[2] * b[1]) + dy * (a[2] * b[0] - a[0] * b[2]) -
                           (a[0] * b[1] - a[1] * b[0]);
                };
                const double e0 = side(c(1), c(2)), e1 = side(c(2), c(0)), e2 = side(c(0), c(1));
                if (!((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0)))
                    continue;
                const double s = -(e0 * c(0)[2] + e1 * c(1)[2] + e2 * c(2)[2]) / (e0 + e1 + e2);
                if (s >= 0.1 && s < nearest)
                {
                    nearest = s;
                    hit = t.id;
                }
            }
            ++checked;
            wrong += hit != image.ids[y * kSize + x];
        }
    EXPECT_GT(checked, kSize * kSize * 9u / 10u);
    // Snapping moves an edge by up to 1/512 pixel, and the excuse covers 1/256: no difference may remain.
    EXPECT_EQ(wrong, 0u);
}

TEST(SameTriangle, ignoresOnlyTheFirstCorner)
{
    const SceneTriangle a{{Float3{0, 0, 0}, Float3{1, 0, 0}, Float3{0, 1, 0}}, 3, 1, 0};
    SceneTriangle b{{Float3{1, 0, 0}, Float3{0, 1, 0}, Float3{0, 0, 0}}, 3, 1, 9};
    EXPECT_TRUE(sameTriangle(a, b));
    std::swap(b.corners[0], b.corners[1]);
    EXPECT_FALSE(sameTriangle(a, b)) << "the other side";
    b = a;
    b.instance = 4;
    EXPECT_FALSE(sameTriangle(a, b));
}

} // namespace
} // namespace hearth::reference
