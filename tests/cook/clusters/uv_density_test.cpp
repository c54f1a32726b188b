// Tests the density of texture coordinates that clusters store.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/uv_density.h"

#include "cook/clusters/core/hierarchy.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hearth::clusters
{

namespace
{

double densityFromCode(uint32_t code)
{
    return std::exp2((code - 128.0) / 8);
}

struct Surface
{
    std::vector<Float3> places;
    std::vector<Float2> uvs;

    /// Add a right triangle whose legs have these lengths, in space and in UV.
    void add(float x, float y, float u, float v)
    {
        places.insert(places.end(), {{0, 0, 0}, {x, 0, 0}, {0, 0, y}});
        uvs.insert(uvs.end(), {{0, 0}, {u, 0}, {0, v}});
    }
};

TEST(UvDensity, codesAreThePowersBelow)
{
    for (uint32_t code = 1; code < 256; ++code)
    {
        EXPECT_EQ(encodeUvDensity(densityFromCode(code) * (1 + 1e-12)), code);
        EXPECT_EQ(encodeUvDensity(densityFromCode(code) * (1 - 1e-12)), std::max(code - 1, 1u));
    }
    EXPECT_EQ(encodeUvDensity(0), 1);
    EXPECT_EQ(encodeUvDensity(1e30), 255);
    EXPECT_EQ(encodeUvDensity(1e-30), 1);
}

TEST(UvDensity, isTheSmallerScaleButAnEighthOfTheGreater)
{
    Surface surface;
    surface.add(2, 0.5f, 1, 1); // half a unit a metre along one axis, 2 along the other
    EXPECT_NEAR(measureUvDensity(surface.places, surface.uvs), 0.5, 1e-6);
    Surface stretched;
    stretched.add(1, 1, 0.01f, 16);
    EXPECT_NEAR(measureUvDensity(stretched.places, stretched.uvs), 2, 1e-6);
    Surface line;
    line.add(1, 1, 0, 4);
    EXPECT_NEAR(measureUvDensity(line.places, line.uvs), 0.5, 1e-6);
    Surface none;
    none.add(0, 1, 1, 1);
    EXPECT_EQ(measureUvDensity(none.places, none.uvs), 0);
}

TEST(UvDensity, leavesOutATwentiethOfTheArea)
{
    for (const int coarse : {4, 6})
    {
        Surface surface;
        for (int i = 0; i < 100; ++i)
        {
            const float scale = i < coarse ? 0.125f : 4.0f;
            surface.add(1, 1, scale, scale);
        }
        EXPECT_NEAR(measureUvDensity(surface.places, surface.uvs), coarse == 4 ? 4 : 0.125, 1e-6);
    }
}

TEST(UvDensity, equalsSingularValuesOfRandomTriangles)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-1, 1);
    for (int i = 0; i < 1000; ++i)
    {
        Surface surface;
        for (int corner = 0; corner < 3; ++corner)
        {
            surface.places.push_back({number(random), number(random), number(random)});
            surface.uvs.push_back({number(random), number(random)});
        }
        // the map from an orthonormal frame of the surface to UV
        Eigen::Matrix<double, 3, 2> edges;
        Eigen::Matrix2d mapped;
        for (int k = 0; k < 2; ++k)
        {
            const Float3 e = surface.places[static_cast<size_t>(k) + 1] - surface.places[0];
            edges.col(k) = Eigen::Vector3d(double{e.x}, double{e.y}, double{e.z});
            mapped.col(k) =
                Eigen::Vector2d(double{surface.uvs[static_cast<size_t>(k) + 1].x} - double{surface.uvs[0].x},
                                double{surface.uvs[static_cast<size_t>(k) + 1].y} - double{surface.uvs[0].y});
        }
        const Eigen::HouseholderQR<Eigen::Matrix<double, 3, 2>> qr(edges);
        const Eigen::Matrix2d r = qr.matrixQR().topRows<2>().triangularView<Eigen::Upper>();
        const Eigen::Vector2d values =
            Eigen::JacobiSVD<Eigen::Matrix2d>(mapped * r.inverse()).singularValues();
        const double expected = std::max(values[1], values[0] / 8);
        EXPECT_NEAR(measureUvDensity(surface.places, surface.uvs) / expected, 1, 1e-3);
    }
}

TEST(UvDensity, clustersHaveTheirs)
{
    const Hierarchy quad = buildHierarchy(test::makeQuad(4, 4)); // a quarter of a unit a metre
    ASSERT_EQ(quad.clusters.size(), 1u);
    EXPECT_EQ(quad.clusters[0].uv_density, 128 - 16);
    mesh::SourceMesh bare = test::makeQuad(4, 4);
    bare.uvs[0].clear();
    bare.tangents.clear();
    EXPECT_EQ(buildHierarchy(bare).clusters.at(0).uv_density, 0);
    mesh::SourceMesh twice = test::makeQuad(4, 4);
    for (const Float2& uv : twice.uvs[0])
        twice.uvs[1].push_back({uv.x / 2, uv.y / 2});
    EXPECT_EQ(buildHierarchy(twice).clusters.at(0).uv_density, 128 - 24) << "the set with fewer units";

    // a second set of zeros, which wants the finest mips of all, counts only where a texture reads it
    for (Float2& uv : twice.uvs[1])
        uv = {};
    for (uint32_t& material : twice.triangle_materials)
        material = 1;
    const auto density = [&](std::vector<uint8_t> sets)
    {
        Config config;
        config.read_uv_sets = std::move(sets);
        return buildHierarchy(twice, config).clusters.at(0).uv_density;
    };
    EXPECT_EQ(density({}), 1) << "nothing is known of the material";
    EXPECT_EQ(density({0b10}), 1) << "it is not this material";
    EXPECT_EQ(density({0b10, 0b01}), 128 - 16);
    EXPECT_EQ(density({0b01, 0b11}), 1);
    EXPECT_EQ(density({0b01, 0}), 0) << "it has no textures";
}

} // namespace

} // namespace hearth::clusters
