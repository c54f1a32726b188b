// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/hearth_scene.h"

#include "sample_assets/dusk.h"
#include "sample_assets/fire.h"
#include "sample_assets/grass.h"
#include "sample_assets/people/arrival.h"
#include "sample_assets/people/character.h"
#include "sample_assets/rock.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/terrain.h"

namespace hearth::samples
{

namespace
{

constexpr float kClearingRadius = 3.2f;

Float4 randomRotation(uint32_t index, uint32_t seed)
{
    const Float4 about_y = rotationAbout({0, 1, 0}, randomUnit(index * 4, seed) * 2 * kPi);
    const Float4 tilt = rotationAbout({1, 0, 0}, (randomUnit(index * 4 + 1, seed) - 0.5f) * 1.4f);
    return multiply(about_y, tilt);
}

void addCampGround(Document& document, const HeightGrid& grid, uint32_t texture_size)
{
    addPlaced(
        document, "ground",
        addMesh(document, "ground", makeTerrain(grid), addTerrainMaterial(document, grid, texture_size)), {});
    addPlaced(document, "hills",
              addMesh(document, "hills", makeHills(14.0f, 180.0f, 384, 77), addDuskHillMaterial(document)),
              {});
    addCopies(document, "grass", addMesh(document, "grass_tuft", makeGrassTuft(), addGrassMaterial(document)),
              scatterGrass(grid, 22000, kClearingRadius - 1.2f, 601));
}

struct BoulderPlacement
{
    float x, z, scale;
};

void addRocks(Document& document, const HeightGrid& grid, uint64_t hero_triangles)
{
    const int material = addRockMaterial(document, 1024);
    const auto sunk = [&](float x, float z, float depth) { return Float3{x, grid.at({x, z}) - depth, z}; };
    addPlaced(document, "hero_rock",
              addMesh(document, "hero_rock", makeRock(hero_triangles, 1, 4.0f), material),
              {sunk(-1.5f, -4.7f, -1.05f),
               multiply(rotationAbout({0, 1, 0}, 0.6f), rotationAbout({0, 0, 1}, 0.12f)),
               {2.5f, 1.9f, 1.9f}});

    constexpr std::array kBoulders{BoulderPlacement{3.4f, -3.2f, 0.85f}, BoulderPlacement{4.6f, -4.4f, 1.3f},
                                   BoulderPlacement{-4.8f, -1.8f, 0.8f}, BoulderPlacement{-6.2f, -4.8f, 1.5f},
                                   BoulderPlacement{2.0f, -6.6f, 1.1f},  BoulderPlacement{6.9f, -1.4f, 0.9f},
                                   BoulderPlacement{-3.9f, 2.6f, 0.45f}, BoulderPlacement{8.2f, -7.6f, 1.9f},
                                   BoulderPlacement{1.2f, -3.6f, 0.32f}, BoulderPlacement{5.4f, 2.0f, 0.5f}};
    std::vector<Placement> of_shape[2];
    for (size_t i = 0; i < kBoulders.size(); ++i)
    {
        const BoulderPlacement& boulder = kBoulders[i];
        const auto index = static_cast<uint32_t>(i);
        const float flat = 0.7f + 0.25f * randomUnit(index, 611);
        of_shape[i % 2].push_back({sunk(boulder.x, boulder.z, -0.45f * boulder.scale * flat),
                                   randomRotation(index, 612),
                                   {boulder.scale, boulder.scale * flat, boulder.scale * 0.95f}});
    }
    addCopies(document, "boulders_a", addMesh(document, "boulder_a", makeRock(50000, 2, 2.0f), material),
              of_shape[0]);
    addCopies(document, "boulders_b", addMesh(document, "boulder_b", makeRock(50000, 3, 2.0f), material),
              of_shape[1]);

    std::vector<Placement> ring;
    constexpr uint32_t kRingStones = 14;
    for (uint32_t i = 0; i < kRingStones; ++i)
    {
        const float angle = (static_cast<float>(i) + 0.35f * randomUnit(i, 621)) * 2 * kPi / kRingStones;
        const float radius = 0.72f + 0.07f * randomUnit(i, 622), scale = 0.145f + 0.055f * randomUnit(i, 623);
        ring.push_back({{radius * cosine(angle), 0.35f * scale, radius * sine(angle)},
                        randomRotation(i, 624),
                        {scale * 1.15f, scale * 0.9f, scale}});
    }
    addCopies(document, "hearth_stones", addMesh(document, "hearth_stone", makeRock(6000, 4, 1.0f), material),
              ring);
}

void addSeatAndCharacter(Document& document)
{
    const int log = addMesh(document, "seat_log", makeLog(0.13f, 6), addLogMaterial(document, false));
    const Float3 seat{-1.55f, 0.24f, 0.35f};
    const Float3 to_fire = normalize(Float3{0, 0, 0} - Float3{seat.x, 0, seat.z});
    const Float3 along = cross({0, 1, 0}, to_fire);
    const float half = 0.85f;
    addPlaced(document, "seat", log,
              {seat - along * half, rotationBetween({0, 1, 0}, along), {1.6f, 2 * half, 1.6f}});
    // the skin is halfway between standing and sitting, so that both look right
    const Pose sitting = sittingPose();
    const CharacterNodes guest =
        addCharacter(document, sitting, blendPoses(standingPose(), sitting, 0.5f), 0.012f);
    const Float3 place{seat.x, 0.01f, seat.z};
    document.nodes[static_cast<size_t>(guest.root)].placement = {
        place, rotationBetween({0, 0, 1}, to_fire), {1, 1, 1}};
    const Float3 stop = place + to_fire * 0.4f;
    addArriveClip(document, guest, {stop - along * 3.0f, stop, place, to_fire});
}

void addLights(Document& document)
{
    // The sun is just above the hills in the back, the fire is the brightest thing nearby.
    addLight(document,
             {.name = "low_sun",
              .kind = LightKind::directional,
              .color = {1.0f, 0.56f, 0.32f},
              .intensity = 0.75f},
             {0, 0, 0}, rotationLookingAt(duskSunDirection(), {0, 0, 0}));
    addLight(document,
             {.name = "fire",
              .kind = LightKind::point,
              .color = {1.0f, 0.43f, 0.13f},
              .intensity = 14,
              .range = 14},
             {0, 0.55f, 0}, {0, 0, 0, 1});
}

} // namespace

Document makeHearthScene(uint64_t hero_triangles, uint32_t texture_size)
{
    Document document;
    const HeightGrid grid =
        makeHeights({.size = 32, .cells = 256, .clearing_radius = kClearingRadius, .seed = 8});
    addCampGround(document, grid, texture_size);
    addRocks(document, grid, hero_triangles);
    addEmbers(document);
    addPlaced(document, "flames", addMesh(document, "flames", makeFlames(), addFlameMaterial(document)),
              {.translation = {0, 0.06f, 0}});
    addBurningLogs(document);
    addSeatAndCharacter(document);
    addLights(document);
    addCamera(document, {.name = "hearth", .y_fov_rad = 0.72f, .z_near = 0.05f}, {2.7f, 1.15f, 4.9f},
              {-0.35f, 1.05f, -0.4f});
    addDuskSky(document, 400);
    dimReflectance(document);
    return document;
}

} // namespace hearth::samples
