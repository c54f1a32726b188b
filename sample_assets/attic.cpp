// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/attic.h"

#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples
{

namespace
{

// The main wing goes from west to east below the northern roof, the side wing from the ridge to the south.
constexpr float kWest = -3.47f, kEast = 3.36f, kNorth = -2.08f, kRidge = 1.93f, kSouth = 4.77f;
constexpr float kSideWingEast = -0.41f; ///< of the side wing; its west is the main wing's
constexpr float kNorthHeight = 1.15f, kRidgeHeight = 3.05f, kSouthHeight = 1.45f; ///< of the ceiling
constexpr float kThick = 0.24f;                 ///< of walls, floor and roof
constexpr float kWallTop = kRidgeHeight + 0.1f; ///< walls end above the ceiling

TriangleMesh makeTurnedBox(Float3 center, Float3 half, float angle_rad)
{
    return transformed(makeBox({0, 0, 0}, half, 1),
                       {.translation = center, .rotation = rotationAbout({0, 1, 0}, angle_rad)});
}

/// Make a slab of roof whose lower side goes through two points (z, height), and a little beyond both.
TriangleMesh makeRoof(float west, float east, Float2 north, Float2 south)
{
    const Float2 step{south.x - north.x, south.y - north.y};
    const float length = std::sqrt(step.x * step.x + step.y * step.y);
    const Float3 along{0, step.y / length, step.x / length}, up{0, along.z, -along.y};
    const Float3 middle{(west + east) / 2, (north.y + south.y) / 2, (north.x + south.x) / 2};
    const Float3 half{(east - west) / 2 + kThick, kThick / 2, length / 2 + kThick};
    return transformed(makeBox({0, 0, 0}, half, 1), {.translation = middle + up * (kThick / 2),
                                                     .rotation = rotationBetween({0, 0, 1}, along)});
}

void addShell(Document& document, int plaster, int terracotta, int boards)
{
    TriangleMesh walls =
        makeBlock({kWest - kThick, 0, kNorth - kThick}, {kEast + kThick, kWallTop, kNorth}, 1);
    append(walls, makeBlock({kWest - kThick, 0, kNorth}, {kWest, kWallTop, kSouth + kThick}, 1));
    append(walls, makeBlock({kWest, 0, kSouth}, {kSideWingEast + kThick, kWallTop, kSouth + kThick}, 1));
    append(walls,
           makeBlock({kSideWingEast, 0, kRidge + kThick}, {kSideWingEast + kThick, kWallTop, kSouth}, 1));
    append(walls, makeBlock({kSideWingEast, 0, kRidge}, {kEast + kThick, kWallTop, kRidge + kThick}, 1));
    // the eastern wall around a window from 0.8 to 2 m
    constexpr float kFrom = 0.13f, kTo = 1.52f, kSill = 0.83f, kLintel = 2.04f;
    append(walls, makeBlock({kEast, 0, kNorth}, {kEast + kThick, kSill, kRidge}, 1));
    append(walls, makeBlock({kEast, kLintel, kNorth}, {kEast + kThick, kWallTop, kRidge}, 1));
    append(walls, makeBlock({kEast, kSill, kNorth}, {kEast + kThick, kLintel, kFrom}, 1));
    append(walls, makeBlock({kEast, kSill, kTo}, {kEast + kThick, kLintel, kRidge}, 1));
    const TriangleMesh floor =
        makeBlock({kWest - kThick, -kThick, kNorth - kThick}, {kEast + kThick, 0, kSouth + kThick}, 1);
    TriangleMesh roof = makeRoof(kWest, kEast, {kNorth, kNorthHeight}, {kRidge, kRidgeHeight});
    append(roof, makeRoof(kWest, kSideWingEast, {kRidge, kRidgeHeight}, {kSouth, kSouthHeight}));
    addObject(document, "shell", {{walls, plaster}, {floor, terracotta}, {roof, boards}});
}

/// Add a sofa that stands askew, a steel post, a folding screen and two crates.
void addFurniture(Document& document, int boards)
{
    const int green = addPlainMaterial(document, "green_cloth", {0.06f, 0.26f, 0.10f}, 0.9f);
    const int steel = addPlainMaterial(document, "steel", {0.56f, 0.57f, 0.58f}, 0.3f, 1);
    const int paper = addPlainMaterial(document, "screen_paper", {0.70f, 0.18f, 0.12f}, 0.8f);
    constexpr float kAskew = 0.44f;
    const Float3 at{-0.35f, 0, -0.42f};
    const auto place = [&](Float3 offset) { return at + rotate(rotationAbout({0, 1, 0}, kAskew), offset); };
    TriangleMesh sofa = makeTurnedBox(place({0, 0.215f, 0}), {0.93f, 0.215f, 0.41f}, kAskew);
    append(sofa, makeTurnedBox(place({0, 0.62f, -0.33f}), {0.93f, 0.19f, 0.08f}, kAskew));
    for (const float side : {-0.86f, 0.86f})
        append(sofa, makeTurnedBox(place({side, 0.53f, 0.08f}), {0.07f, 0.1f, 0.33f}, kAskew));
    const TriangleMesh post =
        transformed(makeLathe({{0.0f, 3.2f}, {0.083f, 3.2f}, {0.083f, -0.05f}, {0.0f, -0.05f}}, 32),
                    {.translation = {-0.52f, 0, 1.84f}});
    TriangleMesh screen = makeTurnedBox({-2.16f, 0.83f, 1.71f}, {0.52f, 0.83f, 0.017f}, 0.61f);
    append(screen, makeTurnedBox({-1.31f, 0.83f, 1.73f}, {0.52f, 0.83f, 0.017f}, -0.55f));
    TriangleMesh crates = makeTurnedBox({2.31f, 0.27f, -1.17f}, {0.38f, 0.27f, 0.29f}, 0.29f);
    append(crates, makeTurnedBox({2.24f, 0.71f, -1.21f}, {0.22f, 0.17f, 0.19f}, -0.38f));
    addObject(document, "furniture", {{sofa, green}, {post, steel}, {screen, paper}, {crates, boards}});
}

void addSunAndLantern(Document& document)
{
    const int lantern = addEmissiveMaterial(document, "lantern", {1, 0.66f, 0.36f}, 5);
    std::vector<Float2> ball;
    for (int i = 0; i <= 24; ++i)
    {
        const float angle = kPi * static_cast<float>(i) / 24;
        ball.push_back({i % 24 == 0 ? 0.0f : 0.21f * sine(angle), 0.21f * cosine(angle)});
    }
    addObject(document, "lantern",
              {{transformed(makeLathe(ball, 48), {.translation = {-2.07f, 1.72f, 3.34f}}), lantern}});
    addLight(document,
             {.name = "sun", .kind = LightKind::directional, .color = {1, 0.93f, 0.82f}, .intensity = 2.2f},
             {0, 0, 0}, rotationLookingAt({1.0f, 0.62f, 0.31f}, {0, 0, 0}));
}

} // namespace

Document makeAttic()
{
    Document document;
    const int plaster = addPlainMaterial(document, "whitewash", {0.74f, 0.72f, 0.67f}, 0.95f);
    const int terracotta = addPlainMaterial(document, "terracotta", {0.42f, 0.17f, 0.09f}, 0.7f);
    const int boards = addPlainMaterial(document, "roof_boards", {0.40f, 0.26f, 0.14f}, 0.8f);
    addShell(document, plaster, terracotta, boards);
    addFurniture(document, boards);
    addSunAndLantern(document);
    addCamera(document, {.name = "attic", .y_fov_rad = 1.05f}, {2.87f, 1.52f, 1.21f}, {-1.6f, 0.85f, 0.5f});
    addCamera(document, {.name = "side_wing", .y_fov_rad = 1.05f}, {-2.93f, 1.21f, 4.32f},
              {-0.4f, 0.9f, -0.6f});
    return document;
}

} // namespace hearth::samples
