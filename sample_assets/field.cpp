// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/field.h"

#include "formats/base/assert.h"
#include "sample_assets/grass.h"
#include "sample_assets/rock.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/sky.h"
#include "sample_assets/terrain.h"

#include <cmath>
#include <string>

namespace hearth::samples
{

namespace
{

constexpr float kFieldSize = 256; // metres: a tile is 4 m wide
constexpr uint32_t kTilesAcross = 64;
constexpr uint32_t kTileColumns = 32; // x 16 quads: 1024 triangles
constexpr uint32_t kTileRows = 16;
// 8 x 8 tiles are one mesh: a mesh of 1024 triangles would be a single page, which is always resident
constexpr uint32_t kPlotsAcross = 8;
constexpr uint32_t kPlotColumns = kTileColumns * kTilesAcross / kPlotsAcross;
constexpr uint32_t kPlotRows = kTileRows * kTilesAcross / kPlotsAcross;
constexpr uint32_t kRockCount = 40;
constexpr uint32_t kTuftCount = 10000;
constexpr Float2 kEye{0, 62}; // x z

/// Make a plot of ground with a skirt. Neighbouring plots are simplified independently and separate by up to
/// a pixel: the outermost quads hang down from the border and hide the gap.
TriangleMesh makePlot(const HeightGrid& grid, uint32_t column, uint32_t row)
{
    constexpr float kSkirt = 0.4f; // metres
    const auto inner = [](float unit, uint32_t quads)
    {
        const auto count = static_cast<float>(quads);
        return clamp01((std::floor(unit * count + 0.5f) - 1) / (count - 2));
    };
    TriangleMesh plot =
        makeGrid(kPlotColumns, kPlotRows,
                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                 {
                     // rows run towards -Z, so that the triangles face up
                     const Float2 within{inner(uv.x, kPlotColumns), 1 - inner(uv.y, kPlotRows)};
                     const bool hangs = uv.x == 0 || uv.x == 1 || uv.y == 0 || uv.y == 1;
                     texture_uv = {(static_cast<float>(column) + within.x) / kPlotsAcross,
                                   (static_cast<float>(row) + within.y) / kPlotsAcross};
                     const Float2 xz{(texture_uv.x - 0.5f) * kFieldSize, (texture_uv.y - 0.5f) * kFieldSize};
                     position = {xz.x, grid.at(xz) - (hangs ? kSkirt : 0.0f), xz.y};
                 });
    for (const Float3& position : plot.positions)
        plot.normals.push_back(grid.normalAt({position.x, position.z})); // the same on both sides of a border
    return plot;
}

void addGround(Document& document, const HeightGrid& grid, uint32_t texture_size)
{
    const int material = addTerrainMaterial(document, grid, texture_size);
    for (uint32_t row = 0; row < kPlotsAcross; ++row)
        for (uint32_t column = 0; column < kPlotsAcross; ++column)
        {
            Node node;
            node.name = "ground_" + std::to_string(column) + "_" + std::to_string(row);
            node.mesh = add(document.meshes, Mesh{node.name, {{makePlot(grid, column, row), material}}});
            addRoot(document, node);
        }
}

void addInstances(Document& document, const std::string& name, TriangleMesh mesh, int material,
                  std::vector<Placement> instances)
{
    Node node;
    node.name = name;
    node.mesh = add(document.meshes, Mesh{name, {{std::move(mesh), material}}});
    node.instances = std::move(instances);
    addRoot(document, node);
}

/// Place rock `index` left or right of the camera's path, larger ones farther away.
Placement rockPlacement(const HeightGrid& grid, uint32_t index)
{
    const auto random = [&](uint32_t which) { return randomUnit(index * 8 + which, 811); };
    const float along = (static_cast<float>(index) + 0.5f) / kRockCount;
    const float scale = (1.2f + 1.4f * random(0)) * (1 + 2.2f * along);
    const float side = index % 2 ? 1.0f : -1.0f;
    const Float2 xz{side * (scale + 1.5f + (6 + 60 * along) * random(1)), kEye.y - 8 - 150 * along};
    const float flat = 0.75f + 0.35f * random(2);
    return {{xz.x, grid.at(xz) + 0.2f * scale * flat, xz.y},
            multiply(rotationAbout({0, 1, 0}, random(3) * 2 * kPi),
                     rotationAbout({1, 0, 0}, (random(4) - 0.5f) * 0.8f)),
            {scale, scale * flat, scale}};
}

void addRocks(Document& document, const HeightGrid& grid, uint64_t triangles, uint32_t shapes)
{
    const int material = addRockMaterial(document, 1024);
    for (uint32_t shape = 0; shape < shapes; ++shape)
    {
        std::vector<Placement> instances;
        for (uint32_t rock = shape; rock < kRockCount; rock += shapes)
            instances.push_back(rockPlacement(grid, rock));
        addInstances(document, "rock_" + std::to_string(shape), makeRock(triangles, shape + 1, 3.0f),
                     material, std::move(instances));
    }
}

/// Place tufts of grass, denser near the camera's starting point.
std::vector<Placement> scatterMeadow(const HeightGrid& grid)
{
    constexpr float kRadius = 70;
    std::vector<Placement> tufts;
    for (uint32_t i = 0; tufts.size() < kTuftCount; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 821); };
        const float angle = random(0) * 2 * kPi, radius = kRadius * random(1);
        const Float2 xz{kEye.x + radius * cosine(angle), kEye.y - 10 + radius * sine(angle)};
        const float patches = fbm({xz.x * 0.12f, 3, xz.y * 0.12f}, 3, 71);
        if (random(2) >= smoothstep(0.25f, -0.2f, patches))
            continue;
        const float scale = 0.8f + 0.9f * random(3);
        tufts.push_back({{xz.x, grid.at(xz) - 0.03f, xz.y},
                         multiply(rotationBetween({0, 1, 0}, grid.normalAt(xz)),
                                  rotationAbout({0, 1, 0}, random(4) * 2 * kPi)),
                         {scale, scale * (0.8f + 0.5f * random(5)), scale}});
    }
    return tufts;
}

/// Return the colour of a summer sky: blue over haze, with fair-weather clouds.
Float4 daySkyColor(Float2 uv)
{
    const float up = skyDirection(uv).y;
    Float3 color =
        lerp(Float3{0.46f, 0.58f, 0.68f}, Float3{0.085f, 0.21f, 0.47f}, smoothstep(-0.1f, 0.7f, up));
    // the clouds are seen from below: they flatten towards the horizon
    const float heaps = TileNoise{7, 841}.fbm({uv.x, uv.y * uv.y * 3.0f}, 6);
    const float cloud = smoothstep(0.02f, 0.3f, heaps) * smoothstep(0.02f, 0.12f, up);
    const float lit = smoothstep(0.55f, 0.1f, heaps);
    color = lerp(color, lerp(Float3{0.55f, 0.57f, 0.62f}, Float3{0.92f, 0.90f, 0.86f}, lit), cloud * 0.85f);
    return {color.x, color.y, color.z, 1};
}

void addSunAndCamera(Document& document, const HeightGrid& grid)
{
    Node sun;
    sun.name = "sun";
    sun.light = add(document.lights, Light{.name = "sun",
                                           .kind = LightKind::directional,
                                           .color = {1.0f, 0.90f, 0.74f},
                                           .intensity = 2.2f});
    sun.placement.rotation = rotationLookingAt({-0.8f, 0.42f, 0.2f}, {0, 0, 0});
    addRoot(document, sun);
    Node camera;
    camera.name = "field";
    camera.camera = add(document.cameras, Camera{.name = "field", .y_fov_rad = 0.87f});
    const Float3 eye{kEye.x, grid.at(kEye) + 3.2f, kEye.y};
    camera.placement = {eye, rotationLookingAt(eye, eye + Float3{0, -0.2f, -1}), {1, 1, 1}};
    addRoot(document, camera);
}

} // namespace

Document makeField(uint64_t rock_triangles, uint32_t rock_shapes, uint32_t texture_size)
{
    HEARTH_ASSERT(rock_shapes > 0 && kRockCount % rock_shapes == 0);
    Document document;
    const HeightGrid grid =
        makeHeights({.size = kFieldSize, .cells = kTilesAcross * kTileColumns, .seed = 8});
    addGround(document, grid, texture_size);
    addRocks(document, grid, rock_triangles, rock_shapes);
    addInstances(document, "grass", makeGrassTuft({.cards = 5, .columns = 1, .rows = 2}),
                 addGrassMaterial(document), scatterMeadow(grid));
    addSky(document, "day_sky", 400, daySkyColor);
    addSunAndCamera(document, grid);
    return document;
}

} // namespace hearth::samples
