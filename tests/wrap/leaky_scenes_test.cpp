// Tests that wraps keep light out of models whose own walls let it in: light inside over light outside.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"
#include "cook/bricks/light/settled_light.h"
#include "cook/bricks/voxels/leaks.h"
#include "cook/wrap/wrap_mesh.h"
#include "tests/cook/bricks/bricks_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

namespace
{

using namespace hearth;
using namespace hearth::bricks;

/// Triangles in voxels, and a place that people would call inside of them.
struct LeakyScene
{
    const char* name;
    std::vector<Corners> triangles;
    double alpha; ///< over the diagonal: larger than the gaps
    std::function<bool(const Double3&)> isInside;
};

void addQuad(std::vector<Corners>& triangles, const Double3& corner, const Double3& u, const Double3& v)
{
    triangles.push_back({{corner, corner + u, corner + u + v}});
    triangles.push_back({{corner, corner + u + v, corner + v}});
}

/// Plate 1.2 voxels thick, closed by itself.
void addPlate(std::vector<Corners>& triangles, const Double3& middle, const Double3& u, const Double3& v)
{
    const Double3 normal = cross(u, v);
    addBox(triangles, middle, u, v, normal * (0.6 / length(normal)), false);
}

/// House of plates that do not meet at the corners and under the roof; its wall at the front has one face,
/// that at the back lacks a quad in its middle.
LeakyScene makeHouse()
{
    std::vector<Corners> triangles;
    addPlate(triangles, {24, 8, 24}, {16, 0, 0}, {0, 0, 12}); // floor
    addPlate(triangles, {8, 17, 24}, {0, 0, 10.5}, {0, 8, 0});
    addPlate(triangles, {40, 17, 24}, {0, 0, 10.5}, {0, 8, 0});
    addQuad(triangles, {9.5, 9, 36}, {29, 0, 0}, {0, 16, 0}); // the front
    for (const double x : {15.0, 33.0})
        addPlate(triangles, {x, 17, 12}, {5.5, 0, 0}, {0, 8, 0});
    addPlate(triangles, {24, 11, 12}, {3.5, 0, 0}, {0, 2, 0});
    addPlate(triangles, {24, 23, 12}, {3.5, 0, 0}, {0, 2, 0});
    for (const double side : {-1.0, 1.0}) // the roof, open along its ridge
        addPlate(triangles, {24, 30.5, 24 + side * 7.3}, {17, 0, 0}, {0, -4.5 * side, 6.2});
    for (const double x : {8.2, 39.8}) // gables
        triangles.push_back({{Double3{x, 26, 13}, Double3{x, 26, 35}, Double3{x, 34, 24}}});
    return {"house", std::move(triangles), 0.1, [](const Double3& p) {
                return p.x > 10 && p.x < 38 && p.y > 10 && p.y < 24 && p.z > 16 && p.z < 34;
            }};
}

/// Tree: a trunk, and leaves in a shell around a hollow crown.
LeakyScene makeTree()
{
    std::vector<Corners> triangles;
    addBox(triangles, {24, 8, 24}, {1.3, 0, 0}, {0, 7, 0}, {0, 0, 1.3}, false);
    Random random(31);
    for (int leaf = 0; leaf < 1500; ++leaf)
    {
        const std::array<Double3, 3> frame = randomFrame(random);
        const Double3 middle = Double3{24, 27, 24} + randomFrame(random)[0] * uniform(random, 9, 14);
        addQuad(triangles, middle - frame[0] - frame[1] * 0.7, frame[0] * 2, frame[1] * 1.4);
    }
    return {"tree", std::move(triangles), 0.06, [](const Double3& p) {
                return length(p - Double3{24, 27, 24}) < 7;
            }};
}

/// Car of shells that overlap and do not close: a tub without a top, a bonnet and a boot without bottoms, a
/// cabin without a bottom whose windows are one-sided panes with gaps around them.
LeakyScene makeCar()
{
    std::vector<Corners> triangles;
    const auto without = [&](const Double3& middle, const Double3& half, double missing_y)
    {
        std::vector<Corners> box;
        addBox(box, middle, {half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}, false);
        std::erase_if(box,
                      [&](const Corners& triangle) {
                          return std::ranges::all_of(triangle.at, [&](const Double3& corner)
                                                     { return corner.y == missing_y; });
                      });
        triangles.insert(triangles.end(), box.begin(), box.end());
    };
    without({28, 10, 16}, {22, 4, 9}, 14);
    without({12, 12.3, 16}, {6.5, 3, 9.4}, 9.3);
    without({44, 12.3, 16}, {6.5, 3, 9.4}, 9.3);
    addPlate(triangles, {28, 23, 16}, {8, 0, 0}, {0, 0, 7.5}); // roof
    for (const double side : {-1.0, 1.0})
    {
        addQuad(triangles, {20.5, 15.6, 16 + side * 8.4}, {15, 0, 0}, {0, 6.2, -side * 0.6}); // side panes
        addBox(triangles, {28 + side * 9.6, 18.5, 16}, {0.6, -side * 0.2, 0}, {0.4 * -side, 4.6, 0},
               {0, 0, 7}, false); // screens
        for (const double x : {12.0, 44.0})
            addBox(triangles, {x, 6, 16 + side * 9}, {3, 0, 0}, {0, 3, 0}, {0, 0, 1}, false); // wheels
    }
    return {"car", std::move(triangles), 0.06, [](const Double3& p) {
                return p.x > 21 && p.x < 35 && p.y > 9 && p.y < 21 && p.z > 10 && p.z < 22;
            }};
}

const GridFrame kFrame = frameOfSize(60, 48, 48);

ClosedSurface wrapScene(const LeakyScene& scene, double offset)
{
    mesh::SourceMesh source;
    for (const Corners& triangle : scene.triangles)
        for (const Double3& corner : triangle.at)
        {
            source.indices.push_back(static_cast<uint32_t>(source.positions.size()));
            source.positions.push_back(narrow(corner));
        }
    source.triangle_materials.assign(scene.triangles.size(), 0);
    const mesh::SourceMesh wrap =
        wrap::wrapMesh(source, {.alpha = scene.alpha, .offset = offset}, scene.name, 0).value();
    ClosedSurface surface{{}, wrap.indices};
    for (const Float3& position : wrap.positions)
        surface.positions.push_back(widen(position));
    return surface;
}

/// Mean radiance from all directions at empty places, under an even sky and a sun.
struct Brightness
{
    double inside = 0;
    double outside = 0;
    double ratio() const { return inside / outside; }
};

Brightness measure(const LeakyScene& scene, SolidGrid solid)
{
    // a camera inside, so that its walls have faces
    Random random(32);
    std::vector<Double3> inside, outside;
    while (inside.size() < 200 || outside.size() < 200)
    {
        const Double3 at = uniformPoint(random, 0, 48);
        const Cell cell{static_cast<uint32_t>(at.x), static_cast<uint32_t>(at.y),
                        static_cast<uint32_t>(at.z)};
        if (solid.voxelAt(cell) != kInvalidIndex)
            continue;
        if (scene.isInside(at) && inside.size() < 200)
            inside.push_back(at);
        const double beside = std::min({at.x, at.y, at.z, 48 - at.x, 48 - at.y, 48 - at.z});
        if (beside < 3 && outside.size() < 200)
            outside.push_back(at);
    }
    std::vector<Float3> cameras;
    for (const Double3& at : inside)
        cameras.push_back(narrow(at));
    const GridWithFaces faced = addFaces(std::move(solid), cameras);
    BrickTables tables = makeBrickTables(faced.solid, faced.faces);
    shared::SceneLighting lighting{.sky = {}, .lights = {}};
    lighting.sky = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    shared::Light& sun = lighting.lights.emplace_back();
    sun.type = shared::kLightDirectional;
    sun.direction = Float3{0.3f, -0.8f, 0.52f} / length(Float3{0.3f, -0.8f, 0.52f});
    sun.intensity = {4, 4, 4};
    tables.lighting = settleLight(makeBrickView(tables), lighting).codes;
    const FaceLighting lit(makeBrickView(tables));
    const auto computeMean = [&](const std::vector<Double3>& points)
    {
        double sum = 0;
        constexpr int kRays = 64;
        for (const Double3& at : points)
            for (int ray = 0; ray < kRays; ++ray)
                sum += shared::brickRayLight(lit.scene(), lighting.sky, narrow(at),
                                             narrow(randomFrame(random)[0]))
                           .radiance.y;
        return sum / (static_cast<double>(points.size()) * kRays);
    };
    return {computeMean(inside), computeMean(outside)};
}

class LeakyScenes : public ::testing::TestWithParam<LeakyScene (*)()>
{
};

} // namespace

TEST_P(LeakyScenes, areDarkInsideWithTheirWraps)
{
    const LeakyScene scene = GetParam()();
    const SolidGrid solid = makeSolidGrid(scene.triangles, kFrame);
    const Brightness before = measure(scene, solid);
    for (const double offset : {1 / 600., 1 / 60.})
    {
        SolidGrid grid = solid;
        const LeakStatistics statistics =
            closeLeaks(grid, 1, [&](size_t) { return wrapScene(scene, offset); });
        const Brightness after = measure(scene, std::move(grid));
        std::printf("%s, wrap at %.4f: light inside over outside %.5f, without the wrap %.3f; %zu of %zu "
                    "voxels in gaps; outside %.3f, %.3f\n",
                    scene.name, offset, after.ratio(), before.ratio(), static_cast<size_t>(statistics.voxels),
                    solid.voxels.size(), after.outside, before.outside);
        EXPECT_LE(after.ratio(), 0.01);
        EXPECT_NEAR(after.outside, before.outside, 0.03 * before.outside);
    }
    EXPECT_GT(before.ratio(), 0.01) << "the scene has no leak";
}

INSTANTIATE_TEST_SUITE_P(All, LeakyScenes, ::testing::Values(&makeHouse, &makeTree, &makeCar));
