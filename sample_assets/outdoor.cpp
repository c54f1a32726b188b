// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/outdoor.h"

#include "sample_assets/grass.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples
{

namespace
{

constexpr float kHalfGround = 14;      ///< metres
constexpr float kWallThickness = 0.2f; ///< of walls

/// Append a box that stands on the ground.
/// size  metres
void stand(TriangleMesh& mesh, Float2 center, Float3 size, float angle_rad = 0)
{
    const TriangleMesh box = makeBox({0, size.y / 2, 0}, size * 0.5f, 1);
    append(mesh, transformed(box, {.translation = {center.x, 0, center.y},
                                   .rotation = rotationAbout({0, 1, 0}, angle_rad)}));
}

/// Make rolling ground: about 0.1 m of height, flat about the walls.
TriangleMesh makeGround()
{
    constexpr uint32_t kQuads = 64;
    TriangleMesh ground = makeGrid(
        kQuads, kQuads,
        [](Float2 uv, Float3& position, Float2& texture_uv)
        {
            const Float2 xz{(2 * uv.x - 1) * kHalfGround, (1 - 2 * uv.y) * kHalfGround};
            const float distance = std::sqrt(xz.x * xz.x + xz.y * xz.y);
            const float bumps = TileNoise{8, 811}.fbm({uv.x, uv.y}, 4) * smoothstep(5.5f, 11.0f, distance);
            position = {xz.x, 0.6f * bumps, xz.y};
            texture_uv = uv;
        });
    setSmoothNormals(ground);
    return ground;
}

/// Add the walls: a corner that is open to two sides, and a roof on posts before it.
void addWalls(Document& document)
{
    const int plaster = addPlainMaterial(document, "plaster", {0.68f, 0.65f, 0.58f}, 0.9f);
    const int timber = addPlainMaterial(document, "timber", {0.34f, 0.20f, 0.10f}, 0.7f);
    TriangleMesh walls, roof;
    stand(walls, {-0.5f, -2.6f}, {5.0f, 2.8f, kWallThickness});
    stand(walls, {-2.9f, -0.6f}, {kWallThickness, 2.8f, 3.8f});
    stand(roof, {1.95f, -0.4f}, {0.16f, 2.3f, 0.16f});
    stand(roof, {-0.7f, -0.4f}, {0.16f, 2.3f, 0.16f});
    append(roof, makeBox({0.6f, 2.36f, -1.45f}, {1.75f, 0.06f, 1.25f}, 1));
    addObject(document, "walls", {{walls, plaster}, {roof, timber}});
}

/// Add crates that lean on each other, with gaps, and a bench whose seat is near to the ground.
void addCrates(Document& document)
{
    const int red = addPlainMaterial(document, "red_crate", {0.45f, 0.07f, 0.05f}, 0.5f);
    const int white = addPlainMaterial(document, "white_crate", {0.80f, 0.79f, 0.76f}, 0.4f);
    const int steel = addPlainMaterial(document, "steel", {0.56f, 0.57f, 0.58f}, 0.35f, 1);
    TriangleMesh reds, whites, bench;
    stand(reds, {-2.1f, -1.8f}, {0.9f, 0.9f, 0.9f}, 0.12f);
    stand(whites, {-1.05f, -1.95f}, {0.7f, 0.7f, 0.7f}, -0.3f);
    stand(whites, {-1.75f, -0.75f}, {0.6f, 0.6f, 0.6f}, 0.5f);
    append(reds,
           transformed(makeBox({0, 0, 0}, {0.25f, 0.25f, 0.25f}, 1),
                       {.translation = {-1.0f, 0.95f, -1.95f}, .rotation = rotationAbout({0, 1, 0}, 0.4f)}));
    append(bench, makeBox({1.0f, 0.42f, -1.9f}, {0.8f, 0.03f, 0.2f}, 1));
    for (const float side : {-0.7f, 0.7f})
        append(bench, makeBox({1.0f + side, 0.2f, -1.9f}, {0.04f, 0.2f, 0.18f}, 1));
    addObject(document, "crates", {{reds, red}, {whites, white}, {bench, steel}});
}

/// Add cards of grass in a strip before the wall, with the normals of their surfaces and two sides: normals
/// that lean upwards have no meaning to a path tracer.
void addTufts(Document& document)
{
    TriangleMesh tuft = makeGrassTuft();
    setSmoothNormals(tuft);
    const int grass = addGrassMaterial(document);
    document.materials[static_cast<size_t>(grass)].double_sided = true;
    Node node;
    node.name = "tufts";
    node.mesh = add(document.meshes, Mesh{"tuft", {{tuft, grass}}});
    for (uint32_t i = 0; i < 60; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 821); };
        const float scale = 0.8f + 0.7f * random(2);
        node.instances.push_back(
            {.translation = {lerp(-0.2f, 3.4f, random(0)), 0, lerp(0.2f, 2.2f, random(1))},
             .rotation = rotationAbout({0, 1, 0}, 2 * kPi * random(3)),
             .scale = {scale, scale, scale}});
    }
    addRoot(document, node);
}

} // namespace

Document makeOutdoor()
{
    Document document;
    const int soil = addPlainMaterial(document, "soil", {0.26f, 0.20f, 0.12f}, 0.95f);
    addObject(document, "ground", {{makeGround(), soil}});
    addWalls(document);
    addCrates(document);
    addTufts(document);
    addCamera(document, {.name = "outdoor", .y_fov_rad = 0.72f}, {4.4f, 2.5f, 5.4f}, {-0.4f, 0.75f, -0.9f});
    return document;
}

} // namespace hearth::samples
