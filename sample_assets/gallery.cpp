// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/gallery.h"

#include "sample_assets/rock.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

#include <string>

namespace hearth::samples
{

namespace
{

constexpr float kHallHalfWidth = 8, kHallHalfDepth = 5, kHallHeight = 4, kWallThickness = 0.15f;
constexpr float kDoorHalf = 0.9f, kDoorHeight = 2.6f;
constexpr std::array<float, 2> kPartitions{-2.7f, 3.1f}; ///< x of the walls between bays
constexpr Float4 kUpright{0, 0, 0, 1};

/// Make a rectangle that faces the side of cross(a, b).
TriangleMesh makeFace(Float3 corner, Float3 a, Float3 b)
{
    TriangleMesh face = makeGrid(1, 1,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     position = corner + a * uv.x + b * uv.y;
                                     texture_uv = {uv.x * length(a), uv.y * length(b)};
                                 });
    setFlatNormals(face);
    return face;
}

TriangleMesh makeBall(Float3 center, float radius)
{
    constexpr int kRings = 32;
    std::vector<Float2> profile;
    for (int i = 0; i <= kRings; ++i)
    {
        const float angle = kPi * static_cast<float>(i) / kRings;
        profile.push_back({i % kRings == 0 ? 0.0f : radius * sine(angle), radius * cosine(angle)});
    }
    return transformed(makeLathe(profile, 64), {.translation = center});
}

void addShell(Document& document)
{
    const int white = addPlainMaterial(document, "white_plaster", {0.76f, 0.74f, 0.70f}, 0.95f);
    const int red = addPlainMaterial(document, "red_plaster", {0.52f, 0.10f, 0.07f}, 0.95f);
    const int blue = addPlainMaterial(document, "blue_plaster", {0.10f, 0.20f, 0.42f}, 0.95f);
    const int oak = addPlainMaterial(document, "oak", {0.36f, 0.22f, 0.11f}, 0.35f);
    const float x = kHallHalfWidth, z = kHallHalfDepth, t = kWallThickness, high = kHallHeight;
    addObject(document, "floor", {{makeFace({-x, 0, -z}, {0, 0, 2 * z}, {2 * x, 0, 0}), oak}});
    addObject(document, "ceiling", {{makeFace({-x, high, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}), white}});
    addObject(document, "north", {{makeFace({-x, 0, -z}, {2 * x, 0, 0}, {0, high, 0}), white}});
    addObject(document, "south", {{makeFace({x, 0, z}, {-2 * x, 0, 0}, {0, high, 0}), white}});
    addObject(document, "west", {{makeFace({-x, 0, z}, {0, 0, -2 * z}, {0, high, 0}), red}});
    addObject(document, "east", {{makeFace({x, 0, -z}, {0, 0, 2 * z}, {0, high, 0}), blue}});
    for (const float at : kPartitions)
    {
        TriangleMesh wall = makeBlock({at, 0, -z}, {at + t, kHallHeight, -kDoorHalf}, 0.5f);
        append(wall, makeBlock({at, 0, kDoorHalf}, {at + t, kHallHeight, z}, 0.5f));
        append(wall, makeBlock({at, kDoorHeight, -kDoorHalf}, {at + t, kHallHeight, kDoorHalf}, 0.5f));
        addObject(document, at < 0 ? "partition_west" : "partition_east", {{wall, white}});
    }
}

/// Add a painting in a frame that hangs on a wall and faces `out`, which is an axis.
void addPainting(Document& document, const char* name, Float3 center, Float2 half, Float3 out, Float3 color)
{
    const int frame =
        addPlainMaterial(document, (std::string(name) + "_frame").c_str(), {0.62f, 0.42f, 0.16f}, 0.3f, 1);
    const int canvas = addPlainMaterial(document, (std::string(name) + "_canvas").c_str(), color, 0.8f);
    const bool faces_x = std::abs(out.x) > 0.5f;
    const auto extent = [&](float wide, float high, float deep) {
        return faces_x ? Float3{deep, high, wide} : Float3{wide, high, deep};
    };
    addObject(document, name,
              {{makeBox(center + out * 0.03f, extent(half.x + 0.05f, half.y + 0.05f, 0.03f), 0.5f), frame},
               {makeBox(center + out * 0.065f, extent(half.x, half.y, 0.006f), 0.5f), canvas}});
}

void addExhibits(Document& document)
{
    const int plinth = addPlainMaterial(document, "plinth", {0.62f, 0.62f, 0.60f}, 0.7f);
    const int brass = addPlainMaterial(document, "brass", {0.86f, 0.62f, 0.27f}, 0.18f, 1);
    const int glaze = addPlainMaterial(document, "glaze", {0.05f, 0.22f, 0.20f}, 0.12f);
    const int leather = addPlainMaterial(document, "leather", {0.16f, 0.07f, 0.04f}, 0.5f);
    const int stone = addPlainMaterial(document, "stone", {0.48f, 0.45f, 0.40f}, 0.85f);

    addObject(document, "stone_plinth",
              {{makeBlock({-0.55f, 0, -0.55f}, {0.95f, 0.5f, 0.95f}, 0.5f), plinth}});
    addObject(document, "stone",
              {{transformed(makeRock(12000, 9, 1),
                            {.translation = {0.2f, 1.1f, 0.2f}, .scale = {0.7f, 0.7f, 0.7f}}),
                stone}});
    addObject(document, "ball_plinth", {{makeBlock({-5.6f, 0, -1.6f}, {-5.0f, 1.0f, -1.0f}, 0.5f), plinth}});
    addObject(document, "ball", {{makeBall({-5.3f, 1.34f, -1.3f}, 0.34f), brass}});
    addObject(document, "vase_plinth", {{makeBlock({5.2f, 0, -0.9f}, {5.8f, 0.9f, -0.3f}, 0.5f), plinth}});
    const TriangleMesh vase = makeLathe({{0.0f, 0.06f},
                                         {0.14f, 0.06f},
                                         {0.11f, 0.74f},
                                         {0.15f, 0.78f},
                                         {0.13f, 0.72f},
                                         {0.18f, 0.58f},
                                         {0.27f, 0.36f},
                                         {0.24f, 0.14f},
                                         {0.14f, 0.0f},
                                         {0.0f, 0.0f}},
                                        64);
    addObject(document, "vase", {{transformed(vase, {.translation = {5.5f, 0.9f, -0.6f}}), glaze}});
    TriangleMesh bench = makeBlock({-6.4f, 0.40f, 1.7f}, {-4.2f, 0.52f, 2.3f}, 0.5f);
    for (const float x : {-6.3f, -4.4f})
        append(bench, makeBlock({x, 0, 1.78f}, {x + 0.1f, 0.40f, 2.22f}, 0.5f));
    addObject(document, "bench", {{bench, leather}});
    addPainting(document, "painting_north", {0.2f, 1.7f, -kHallHalfDepth}, {1.1f, 0.75f}, {0, 0, 1},
                {0.10f, 0.30f, 0.52f});
    addPainting(document, "painting_west", {-5.3f, 1.7f, -kHallHalfDepth}, {0.7f, 0.9f}, {0, 0, 1},
                {0.72f, 0.42f, 0.06f});
    addPainting(document, "painting_east", {5.5f, 1.7f, -kHallHalfDepth}, {0.9f, 0.6f}, {0, 0, 1},
                {0.16f, 0.42f, 0.14f});
}

/// Add a lamp below a shade at a cord.
void addPendant(Document& document, const char* name, Float3 at, Float3 color, float candela)
{
    const int metal =
        addPlainMaterial(document, (std::string(name) + "_shade").c_str(), {0.30f, 0.30f, 0.32f}, 0.35f, 1);
    TriangleMesh pendant = makeBox({at.x, (at.y + kHallHeight + 0.2f) / 2, at.z},
                                   {0.008f, (kHallHeight - at.y - 0.2f) / 2, 0.008f}, 0.5f);
    append(pendant, transformed(makeLathe({{0.0f, 0.24f},
                                           {0.06f, 0.23f},
                                           {0.26f, 0.02f},
                                           {0.25f, 0.02f},
                                           {0.05f, 0.21f},
                                           {0.0f, 0.215f}},
                                          48),
                                {.translation = at}));
    addObject(document, (std::string(name) + "_fitting").c_str(), {{pendant, metal}});
    addLight(document, {.name = name, .color = color, .intensity = candela, .range = 14}, at, kUpright);
}

void addSpot(Document& document, const char* name, Float3 at, Float3 target, Float3 color, float candela)
{
    addLight(document,
             {.name = name,
              .kind = LightKind::spot,
              .color = color,
              .intensity = candela,
              .range = 10,
              .inner_cone_rad = 0.25f,
              .outer_cone_rad = 0.5f},
             at, rotationLookingAt(at, target));
}

void addLamps(Document& document)
{
    addPendant(document, "pendant_west", {-5.3f, 2.9f, 0.6f}, {1, 0.62f, 0.30f}, 12);
    addPendant(document, "pendant_middle", {0.2f, 3.2f, 2.6f}, {1, 0.86f, 0.68f}, 9);
    addPendant(document, "pendant_east", {5.5f, 2.9f, 1.6f}, {0.62f, 0.78f, 1}, 12);
    addSpot(document, "spot_stone", {2.0f, 3.7f, -1.6f}, {0.2f, 1.0f, 0.2f}, {1, 0.93f, 0.82f}, 16);
    addSpot(document, "spot_painting", {0.2f, 3.8f, -2.6f}, {0.2f, 1.6f, -kHallHalfDepth}, {1, 0.9f, 0.75f},
            14);

    const int rose = addEmissiveMaterial(document, "rose_neon", {1, 0.12f, 0.35f}, 24);
    const int cold = addEmissiveMaterial(document, "light_box", {0.75f, 0.9f, 1}, 6);
    const int green = addEmissiveMaterial(document, "sign_light", {0.12f, 1, 0.32f}, 20);
    addObject(document, "neon",
              {{makeBox({-kHallHalfWidth + 0.04f, 2.6f, 0}, {0.03f, 0.03f, 2.2f}, 0.5f), rose}});
    addObject(document, "light_box",
              {{makeBox({5.5f, kHallHeight - 0.03f, -2.4f}, {0.9f, 0.03f, 0.6f}, 0.5f), cold}});
    addObject(
        document, "sign",
        {{makeBox({kPartitions[1] - 0.03f, kDoorHeight + 0.28f, 0}, {0.03f, 0.12f, 0.5f}, 0.5f), green}});
}

} // namespace

Document makeGallery()
{
    Document document;
    addShell(document);
    addExhibits(document);
    addLamps(document);
    addCamera(document, {.name = "gallery", .y_fov_rad = 1.0f, .z_near = 0.05f, .z_far = 60},
              {2.5f, 1.65f, 4.4f}, {-2.4f, 1.3f, -1.2f});
    addCamera(document, {.name = "east", .y_fov_rad = 1.0f, .z_near = 0.05f, .z_far = 60},
              {7.4f, 1.65f, 4.2f}, {3.4f, 1.3f, -1.6f});
    return document;
}

} // namespace hearth::samples
