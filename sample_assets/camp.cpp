// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/camp.h"

#include "sample_assets/fire.h"
#include "sample_assets/grass.h"
#include "sample_assets/people/character.h"
#include "sample_assets/rock.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/terrain.h"

namespace hearth::samples
{

namespace
{

constexpr float kCampRadius = 5.5f;              ///< metres of flat ground around the fire
constexpr Float3 kLampGlass{0, 2.36f, 0};        ///< middle of a lamp's glass, in the frame of its post
constexpr Float3 kLampColor{1.0f, 0.66f, 0.34f}; ///< linear

/// Return a point on the ground, sunk by `depth` metres.
Float3 onGround(const HeightGrid& grid, Float2 xz, float depth = 0)
{
    return {xz.x, grid.at(xz) - depth, xz.y};
}

void addCampsite(Document& document, const HeightGrid& grid, uint32_t texture_size)
{
    const int earth = addTerrainMaterial(document, grid, texture_size);
    addObject(document, "ground", {{makeTerrain(grid), earth}});
    const int far_hills = addPlainMaterial(document, "hills", {0.14f, 0.16f, 0.10f}, 0.95f);
    addObject(document, "hills", {{makeHills(21.0f, 190.0f, 256, 41), far_hills}});
    TriangleMesh tuft = makeGrassTuft();
    addCopies(document, "grass", addMesh(document, "grass_tuft", std::move(tuft), addGrassMaterial(document)),
              scatterGrass(grid, 14000, kCampRadius - 1.6f, 901));
}

struct CampRock
{
    float x, z, scale;
};

void addCampRocks(Document& document, const HeightGrid& grid, uint32_t texture_size)
{
    constexpr std::array kRocks{
        CampRock{-3.2f, -6.6f, 2.6f}, CampRock{1.1f, -7.9f, 3.1f}, CampRock{5.2f, -5.8f, 1.7f},
        CampRock{-7.4f, -3.4f, 1.8f}, CampRock{7.6f, -1.2f, 1.2f}, CampRock{-6.6f, 2.8f, 0.9f},
        CampRock{-9.5f, -8.8f, 3.4f}, CampRock{9.4f, -9.6f, 2.9f}, CampRock{3.4f, -4.6f, 0.6f},
        CampRock{-4.9f, -3.0f, 0.5f}, CampRock{12.0f, 3.5f, 1.9f}, CampRock{-12.5f, 6.0f, 2.2f},
        CampRock{-2.4f, 11.5f, 1.4f}, CampRock{6.2f, 9.4f, 1.1f}};
    const int material = addRockMaterial(document, texture_size);
    std::array<std::vector<Placement>, 2> of_shape;
    for (uint32_t i = 0; i < kRocks.size(); ++i)
    {
        const CampRock& rock = kRocks[i];
        const float flat = 0.75f + 0.3f * randomUnit(i, 911);
        const Float4 turn = multiply(rotationAbout({0, 1, 0}, 2 * kPi * randomUnit(i, 912)),
                                     rotationAbout({1, 0, 0}, 0.6f * (randomUnit(i, 913) - 0.5f)));
        of_shape[i % 2].push_back({onGround(grid, {rock.x, rock.z}, -0.35f * rock.scale * flat),
                                   turn,
                                   {rock.scale, rock.scale * flat, rock.scale * 0.9f}});
    }
    addCopies(document, "rocks_a", addMesh(document, "rock_a", makeRock(15000, 2, 2.0f), material),
              of_shape[0]);
    addCopies(document, "rocks_b", addMesh(document, "rock_b", makeRock(15000, 3, 2.0f), material),
              of_shape[1]);

    std::vector<Placement> ring;
    constexpr uint32_t kStones = 13;
    for (uint32_t i = 0; i < kStones; ++i)
    {
        const float angle = (static_cast<float>(i) + 0.3f * randomUnit(i, 921)) * 2 * kPi / kStones;
        const float scale = 0.15f + 0.05f * randomUnit(i, 922);
        ring.push_back({{0.76f * cosine(angle), 0.3f * scale, 0.76f * sine(angle)},
                        rotationAbout({0, 1, 0}, 2 * kPi * randomUnit(i, 923)),
                        {scale * 1.15f, scale * 0.9f, scale}});
    }
    addCopies(document, "fire_stones", addMesh(document, "fire_stone", makeRock(1200, 4, 1.0f), material),
              ring);
}

/// Make a shed that is open to the fire: posts, a slanted roof of planks, a back of planks.
void addShelter(Document& document)
{
    const int timber = addPlainMaterial(document, "timber", {0.30f, 0.18f, 0.09f}, 0.75f);
    const int planks = addPlainMaterial(document, "planks", {0.42f, 0.29f, 0.17f}, 0.8f);
    TriangleMesh posts, boards;
    for (const float x : {-1.5f, 1.5f})
    {
        append(posts, makeBlock({x - 0.07f, 0, 0.93f}, {x + 0.07f, 2.25f, 1.07f}, 1));
        append(posts, makeBlock({x - 0.07f, 0, -1.07f}, {x + 0.07f, 1.75f, -0.93f}, 1));
    }
    append(posts, makeBlock({-1.7f, 2.2f, 0.94f}, {1.7f, 2.32f, 1.06f}, 1));
    constexpr int kPlanks = 9;
    for (int i = 0; i < kPlanks; ++i)
    {
        const float x = -1.6f + 3.2f * static_cast<float>(i) / (kPlanks - 1);
        const float uneven = 0.06f * randomUnit(static_cast<uint32_t>(i), 931);
        append(boards,
               transformed(makeBox({0, 0, 0}, {0.17f, 0.02f, 1.36f + uneven}, 1),
                           {.translation = {x, 2.09f, 0}, .rotation = rotationAbout({1, 0, 0}, -0.27f)}));
        append(boards, makeBlock({x - 0.16f, 0.02f, -1.05f}, {x + 0.16f, 1.68f + uneven, -1.02f}, 1));
    }
    const Float4 turn = rotationAbout({0, 1, 0}, -0.95f);
    addPlaced(document, "shelter", add(document.meshes, Mesh{"shelter", {{posts, timber}, {boards, planks}}}),
              {{3.6f, 0, -2.0f}, turn, {1, 1, 1}});
    const int bark = addLogMaterial(document, false);
    addPlaced(
        document, "seat", addMesh(document, "seat_log", makeLog(0.13f, 6), bark),
        {{-2.2f, 0.2f, -0.8f}, rotationBetween({0, 1, 0}, normalize({0.55f, 0, 0.85f})), {1.6f, 1.7f, 1.6f}});
}

void addCampLamps(Document& document, const HeightGrid& grid)
{
    constexpr std::array<Float2, 4> kLamps{{{-2.9f, 2.6f}, {2.9f, 3.4f}, {-3.4f, 7.6f}, {2.6f, 9.0f}}};
    const int iron = addPlainMaterial(document, "iron", {0.05f, 0.05f, 0.055f}, 0.5f, 1);
    const int glass = addEmissiveMaterial(document, "lamp_glass", kLampColor, 3);
    // the lamp hangs from an arm, so that the post does not stand in its light
    TriangleMesh post =
        transformed(makeLathe({{0, 2.78f}, {0.03f, 2.76f}, {0.035f, 0.3f}, {0.09f, 0.1f}, {0.1f, -0.3f}}, 12),
                    {.translation = {0.45f, 0, 0}});
    append(post, makeBlock({-0.04f, 2.66f, -0.02f}, {0.45f, 2.71f, 0.02f}, 1));
    append(post, makeLathe({{0, 2.68f}, {0.2f, 2.5f}, {0.18f, 2.49f}, {0, 2.52f}}, 12));
    const TriangleMesh bulb =
        makeLathe({{0, 2.49f}, {0.09f, 2.46f}, {0.11f, 2.36f}, {0.05f, 2.24f}, {0, 2.24f}}, 12);
    std::vector<Placement> posts;
    for (size_t i = 0; i < kLamps.size(); ++i)
    {
        const Float3 foot = onGround(grid, kLamps[i]);
        posts.push_back({.translation = foot});
        addLight(document,
                 {.name = "lamp_" + std::to_string(i + 1),
                  .kind = LightKind::spot,
                  .color = kLampColor,
                  .intensity = 40,
                  .range = 9,
                  .inner_cone_rad = 0.4f,
                  .outer_cone_rad = 0.95f},
                 foot + kLampGlass - Float3{0, 0.2f, 0}, rotationAbout({1, 0, 0}, -kPi / 2));
    }
    addCopies(document, "lamps", add(document.meshes, Mesh{"lamp", {{post, iron}, {bulb, glass}}}), posts);
}

void addHero(Document& document)
{
    const Pose pose = standingPose();
    const CharacterNodes hero = addCharacter(document, pose, pose, 0.014f);
    addIdleClip(document, hero, pose);
    addWalkClip(document, hero, pose);
    addRunClip(document, hero, pose);
    addWaveClip(document, hero, pose);
}

} // namespace

Document makeCamp(uint64_t ground_triangles, uint32_t texture_size)
{
    Document document;
    const auto cells = static_cast<uint32_t>(std::sqrt(static_cast<double>(ground_triangles) / 2) + 0.5);
    const HeightGrid grid =
        makeHeights({.size = 48, .cells = std::max(1u, cells), .clearing_radius = kCampRadius, .seed = 12});
    addCampsite(document, grid, texture_size);
    addCampRocks(document, grid, texture_size);
    addEmbers(document);
    addBurningLogs(document);
    addShelter(document);
    addCampLamps(document, grid);
    addHero(document);
    addLight(document, {.name = "sun", .kind = LightKind::directional, .intensity = 3}, {0, 0, 0},
             rotationLookingAt({0.5f, 0.6f, 0.4f}, {0, 0, 0}));
    addLight(document,
             {.name = "fire",
              .kind = LightKind::point,
              .color = {1.0f, 0.43f, 0.13f},
              .intensity = 20,
              .range = 14,
              .flicker = {.rate = 8, .amplitude = 0.3f, .seed = 5}},
             {0, 0.6f, 0}, {0, 0, 0, 1});
    addCamera(document, {.name = "camp", .y_fov_rad = 0.8f}, {1.4f, 2.1f, 8.4f}, {0.2f, 1.0f, 0});
    addCamera(document, {.name = "shelter", .y_fov_rad = 0.8f}, {-3.5f, 1.6f, 3.5f}, {2.4f, 1.0f, -1.6f});
    return document;
}

} // namespace hearth::samples
