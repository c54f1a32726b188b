// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/land.h"

#include "sample_assets/rock.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/terrain.h"

#include <cmath>
#include <string>

namespace hearth::samples
{

namespace
{

constexpr float kLandSize = 512;
constexpr float kHillSteepness = 2.8f; // steeper than hills elsewhere, to use the height of 128 m
constexpr uint32_t kLandPlotsAcross = 8;
constexpr uint32_t kRockShapes = 4;
constexpr uint32_t kRocksOfShape = 30;
constexpr uint64_t kRockTriangles = 100000;
constexpr uint32_t kHouseCount = 12;
constexpr float kHouseHalfWidth = 6, kHouseHalfDepth = 4.5f, kWallHeight = 4,
                kWall = 0.25f; // metres; kWall is half a wall

TriangleMesh makePlot(const HeightGrid& grid, uint32_t column, uint32_t row, uint32_t quads)
{
    TriangleMesh plot =
        makeGrid(quads, quads,
                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                 {
                     // rows run towards -Z, so that the triangles face up
                     texture_uv = {(static_cast<float>(column) + uv.x) / kLandPlotsAcross,
                                   (static_cast<float>(row) + 1 - uv.y) / kLandPlotsAcross};
                     const Float2 xz{(texture_uv.x - 0.5f) * kLandSize, (texture_uv.y - 0.5f) * kLandSize};
                     position = {xz.x, grid.at(xz), xz.y};
                 });
    for (const Float3& position : plot.positions)
        plot.normals.push_back(grid.normalAt({position.x, position.z}));
    return plot;
}

void addPlots(Document& document, const HeightGrid& grid, uint32_t texture_size)
{
    const int material = addTerrainMaterial(document, grid, texture_size);
    for (uint32_t row = 0; row < kLandPlotsAcross; ++row)
        for (uint32_t column = 0; column < kLandPlotsAcross; ++column)
        {
            Node node;
            node.name = "ground_" + std::to_string(column) + "_" + std::to_string(row);
            node.mesh =
                add(document.meshes,
                    Mesh{node.name,
                         {{makePlot(grid, column, row, grid.shape.cells / kLandPlotsAcross), material}}});
            addRoot(document, node);
        }
}

void addInstances(Document& document, const std::string& name, std::vector<Primitive> primitives,
                  std::vector<Placement> instances)
{
    Node node;
    node.name = name;
    node.mesh = add(document.meshes, Mesh{name, std::move(primitives)});
    node.instances = std::move(instances);
    addRoot(document, node);
}

/// Return a position that is not too near to the border.
Float2 randomPosition(uint32_t index, uint32_t seed)
{
    return {(randomUnit(2 * index, seed) - 0.5f) * 0.9f * kLandSize,
            (randomUnit(2 * index + 1, seed) - 0.5f) * 0.9f * kLandSize};
}

void addRocks(Document& document, const HeightGrid& grid)
{
    const int material = addRockMaterial(document, 512);
    for (uint32_t shape = 0; shape < kRockShapes; ++shape)
    {
        std::vector<Placement> instances;
        for (uint32_t i = shape; i < kRockShapes * kRocksOfShape; i += kRockShapes)
        {
            const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 911); };
            const Float2 xz = randomPosition(i, 912);
            const float scale = 1.5f + 5 * random(0) * random(1);
            instances.push_back({{xz.x, grid.at(xz) + 0.3f * scale, xz.y},
                                 multiply(rotationAbout({0, 1, 0}, random(2) * 2 * kPi),
                                          rotationAbout({1, 0, 0}, (random(3) - 0.5f) * 0.8f)),
                                 {scale, scale * (0.75f + 0.35f * random(4)), scale}});
        }
        addInstances(document, "rock_" + std::to_string(shape),
                     {{makeRock(kRockTriangles, shape + 1, 3.0f), material}}, std::move(instances));
    }
}

/// Make a house of one room around the origin, its floor at height 0: the front has a door, each side a
/// window.
std::vector<Primitive> makeHouse(Document& document)
{
    const int plaster = addPlainMaterial(document, "plaster", {0.62f, 0.56f, 0.47f});
    const int red = addPlainMaterial(document, "red_plaster", {0.52f, 0.12f, 0.08f});
    const int tiles = addPlainMaterial(document, "tiles", {0.24f, 0.10f, 0.06f});
    Material lamp;
    lamp.name = "lamp";
    lamp.base_color = {0.8f, 0.8f, 0.8f, 1};
    lamp.emissive = {1, 0.8f, 0.5f};
    lamp.emissive_strength = 6;
    const int shining = add(document.materials, lamp);

    constexpr float kMiddle = kWallHeight / 2;
    TriangleMesh walls, back, roof;
    append(roof, makeBox({0, -0.75f, 0}, {kHouseHalfWidth + kWall, 0.75f, kHouseHalfDepth + kWall},
                         0.5f)); // its foot is below the slope
    append(roof, makeBox({0, kWallHeight + kWall, 0},
                         {kHouseHalfWidth + 0.75f, kWall, kHouseHalfDepth + 0.75f}, 0.5f));
    append(back, makeBox({0, kMiddle, -kHouseHalfDepth}, {kHouseHalfWidth + kWall, kMiddle, kWall}, 0.5f));
    // front wall left and right of a door of 2 x 3 m, and above the door
    for (const float side : {-1.0f, 1.0f})
        append(walls, makeBox({side * (kHouseHalfWidth + kWall + 1) / 2, kMiddle, kHouseHalfDepth},
                              {(kHouseHalfWidth + kWall - 1) / 2, kMiddle, kWall}, 0.5f));
    append(walls,
           makeBox({0, (kWallHeight + 3) / 2, kHouseHalfDepth}, {1, (kWallHeight - 3) / 2, kWall}, 0.5f));
    // side walls, with windows from 1 to 3 m, 3 m wide
    for (const float side : {-kHouseHalfWidth, kHouseHalfWidth})
    {
        constexpr float kInner = kHouseHalfDepth - kWall;
        append(walls, makeBox({side, 0.5f, 0}, {kWall, 0.5f, kInner}, 0.5f));
        append(walls,
               makeBox({side, (kWallHeight + 3) / 2, 0}, {kWall, (kWallHeight - 3) / 2, kInner}, 0.5f));
        for (const float end : {-1.0f, 1.0f})
            append(walls,
                   makeBox({side, 2, end * (kInner + 1.5f) / 2}, {kWall, 1, (kInner - 1.5f) / 2}, 0.5f));
    }
    return {{std::move(walls), plaster},
            {std::move(back), red},
            {std::move(roof), tiles},
            {makeBox({0, kWallHeight - 0.2f, 0}, {0.6f, 0.1f, 0.6f}, 1), shining}};
}

void addHouses(Document& document, const HeightGrid& grid)
{
    std::vector<Placement> instances;
    for (uint32_t i = 0; i < kHouseCount; ++i)
    {
        const Float2 xz = randomPosition(i, 921);
        // on the highest ground below it, so that no hill reaches into the room
        float height = grid.at(xz);
        for (const float x : {-6.5f, 0.0f, 6.5f})
            for (const float z : {-6.5f, 0.0f, 6.5f})
                height = std::max(height, grid.at({xz.x + x, xz.y + z}));
        instances.push_back(
            {{xz.x, height, xz.y}, rotationAbout({0, 1, 0}, randomUnit(i, 922) * 2 * kPi), {1, 1, 1}});
    }
    addInstances(document, "house", makeHouse(document), std::move(instances));
}

void addNoonSunAndCamera(Document& document, const HeightGrid& grid)
{
    Node sun;
    sun.name = "sun";
    sun.light = add(document.lights, Light{.name = "sun",
                                           .kind = LightKind::directional,
                                           .color = {1.0f, 0.90f, 0.74f},
                                           .intensity = 2.2f});
    sun.placement.rotation = rotationLookingAt({-0.8f, 0.6f, 0.3f}, {0, 0, 0});
    addRoot(document, sun);
    Node camera;
    camera.name = "land";
    camera.camera = add(document.cameras, Camera{.name = "land", .y_fov_rad = 0.87f});
    const Float3 eye{0, grid.at({0, 0}) + 12, 0};
    camera.placement = {eye, rotationLookingAt(eye, eye + Float3{0, -0.25f, -1}), {1, 1, 1}};
    addRoot(document, camera);
}

} // namespace

Document makeLand(uint64_t ground_triangles, uint32_t texture_size)
{
    Document document;
    const auto wanted = static_cast<uint32_t>(std::sqrt(static_cast<double>(ground_triangles) / 2) + 0.5);
    const uint32_t cells = std::max(1u, wanted / kLandPlotsAcross) * kLandPlotsAcross;
    HeightGrid grid = makeHeights({.size = kLandSize, .cells = cells, .seed = 11});
    for (float& height : grid.heights)
        height *= kHillSteepness;
    addPlots(document, grid, texture_size);
    addRocks(document, grid);
    addHouses(document, grid);
    addNoonSunAndCamera(document, grid);
    return document;
}

} // namespace hearth::samples
