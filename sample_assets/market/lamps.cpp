// Draws the lamps of the fixtures. Every lamp glows, also one that the light count leaves without a light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/fixtures.h"
#include "sample_assets/market/pieces.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples::market
{

namespace
{

constexpr float kBulbNits = 9, kNeonNits = 4;      ///< emission; bulbs are a few pixels wide
constexpr float kPaperGlow = 3.2f, kGlassGlow = 9; ///< of shells around a light, as a factor of white

struct LampMaterials
{
    int iron, wax, bulb, cold_bulb, flame, glass;
};

/// Add a material that glows through and through: it reflects its own colour, too.
int addGlowingMaterial(Document& document, const std::string& name, Float3 color, float nits)
{
    const int index = addEmissiveMaterial(document, name.c_str(), color, nits);
    document.materials[static_cast<size_t>(index)].base_color = {0.5f * color.x, 0.5f * color.y,
                                                                 0.5f * color.z, 1};
    return index;
}

/// Add a material of paper or glass around a light, which it lets through: unlit surfaces cast no shadows.
int addShellMaterial(Document& document, const std::string& name, Float3 glow)
{
    const int index = addPlainMaterial(document, name.c_str(), exposeGlow(glow));
    document.materials[static_cast<size_t>(index)].unlit = true;
    return index;
}

/// Return the positions of the fixtures of a kind and look; a `look` of kAnyLook takes all.
constexpr uint32_t kAnyLook = 0xFFFFFFFFu;
std::vector<Placement> findPlacements(const std::vector<Fixture>& fixtures, FixtureKind kind, uint32_t look)
{
    std::vector<Placement> placements;
    for (const Fixture& fixture : fixtures)
        if (fixture.kind == kind && (look == kAnyLook || fixture.look == look))
            placements.push_back({.translation = fixture.position});
    return placements;
}

/// Add the lamps of the stalls: a bulb on a cord, in a shade of enamel if it is a spot.
void addStallLampMeshes(Document& document, const LampMaterials& materials,
                        const std::vector<Fixture>& fixtures)
{
    const TriangleMesh ball = makeBall({0.04f, 0.045f, 0.04f}, 16);
    TriangleMesh cord = makeRod({0, 0.05f, 0}, {0, 0.42f, 0}, 0.008f, 6);
    append(cord, makeTurned({{0.02f, 0.11f}, {0.024f, 0.05f}, {0.024f, 0.045f}}, 12));
    add(document.meshes, Mesh{"bare_bulb", {{ball, materials.bulb}, {cord, materials.iron}}});
    addCopies(document, "stall_lamps", static_cast<int>(document.meshes.size()) - 1,
              findPlacements(fixtures, FixtureKind::stall_lamp, 0));
    const TriangleMesh shade = makeLathe(
        {{0.0f, 0.14f}, {0.05f, 0.13f}, {0.17f, 0.02f}, {0.165f, 0.012f}, {0.045f, 0.115f}, {0.0f, 0.12f}},
        24);
    const int enamel = addPlainMaterial(document, "enamel", {0.03f, 0.10f, 0.07f}, 0.3f);
    add(document.meshes, Mesh{"shaded_bulb",
                              {{moved(ball, {0, 0.04f, 0}), materials.bulb},
                               {moved(cord, {0, 0.09f, 0}), materials.iron},
                               {shade, enamel}}});
    addCopies(document, "stall_lamps", static_cast<int>(document.meshes.size()) - 1,
              findPlacements(fixtures, FixtureKind::stall_lamp, 1));
}

/// Add posts with an arm, and a lantern of glass at its end.
void addLampPostMeshes(Document& document, const LampMaterials& materials, const Plan& plan)
{
    TriangleMesh post = makeTurned({{0.0f, 3.75f},
                                    {0.03f, 3.7f},
                                    {0.04f, 0.9f},
                                    {0.07f, 0.8f},
                                    {0.08f, 0.1f},
                                    {0.14f, 0.06f},
                                    {0.14f, -0.1f}},
                                   14);
    append(post, makeRod({0, 3.62f, 0}, {0, 3.68f, kPostLamp.z}, 0.02f, 8));
    append(post, makeRod({0, 3.3f, 0.02f}, {0, 3.63f, 0.36f}, 0.014f, 8));
    append(post, moved(makeTurned({{0.015f, 0.27f}, {0.03f, 0.2f}, {0.15f, 0.13f}, {0.15f, 0.115f}}, 6),
                       kPostLamp));
    append(post, moved(makeTurned({{0.09f, -0.12f}, {0.07f, -0.15f}}, 6), kPostLamp));
    const TriangleMesh glass = moved(makeTurned({{0.12f, 0.115f}, {0.085f, -0.12f}}, 6), kPostLamp);
    const int mesh =
        add(document.meshes, Mesh{"lamp_post", {{post, materials.iron}, {glass, materials.glass}}});
    addCopies(document, "lamp_posts", mesh, plan.lamp_posts);
}

/// Add neon signs: a board, a frame of tube and two strokes.
void addSignMeshes(Document& document, const LampMaterials& materials, const Plan& plan)
{
    TriangleMesh tube;
    const auto stroke = [&](Float3 from, Float3 to) { append(tube, makeRod(from, to, 0.016f, 8)); };
    constexpr float kX = 0.62f, kY = 0.2f, kZ = 0.05f;
    stroke({-kX, -kY, kZ}, {kX, -kY, kZ});
    stroke({-kX, kY, kZ}, {kX, kY, kZ});
    stroke({-kX, -kY, kZ}, {-kX, kY, kZ});
    stroke({kX, -kY, kZ}, {kX, kY, kZ});
    // letters of no script: strokes that look written
    for (uint32_t i = 0; i < 5; ++i)
    {
        const float x = -0.44f + 0.22f * static_cast<float>(i);
        stroke({x, -0.12f, kZ}, {x + 0.02f, 0.12f, kZ});
        stroke({x, i % 2 == 0 ? 0.1f : -0.02f, kZ}, {x + 0.12f, i % 2 == 0 ? 0.11f : 0.02f, kZ});
        if (i % 3 != 1)
            stroke({x + 0.01f, -0.1f, kZ}, {x + 0.13f, i % 3 == 0 ? -0.1f : 0.0f, kZ});
    }
    const TriangleMesh board = makeBlock({-0.7f, -0.28f, -0.02f}, {0.7f, 0.28f, 0.02f});
    std::vector<Placement> of_color[kPaperCount];
    for (const Sign& sign : placeSigns(plan))
        of_color[sign.color].push_back(sign.placement);
    for (uint32_t color = 0; color < kPaperCount; ++color)
    {
        const std::string name = "neon_" + std::to_string(color);
        const int neon = addGlowingMaterial(document, name, kPaperColors[color], kNeonNits);
        addCopies(document, "signs",
                  add(document.meshes, Mesh{"sign", {{board, materials.iron}, {tube, neon}}}),
                  of_color[color]);
    }
}

/// Add bulbs of strings: warm, of many colours, and cold.
void addBulbMeshes(Document& document, const LampMaterials& materials, const std::vector<Fixture>& fixtures)
{
    const TriangleMesh ball = makeBall({0.026f, 0.034f, 0.026f}, 8);
    const int warm = addMesh(document, "string_bulb", ball, materials.bulb);
    const int cold = addMesh(document, "cold_bulb", ball, materials.cold_bulb);
    for (const FixtureKind kind :
         {FixtureKind::eave_bulb, FixtureKind::string_bulb, FixtureKind::tree_bulb, FixtureKind::facade_bulb})
        addCopies(document, "bulbs", warm, findPlacements(fixtures, kind, 0));
    addCopies(document, "bulbs", cold, findPlacements(fixtures, FixtureKind::tree_bulb, 2));

    std::vector<Placement> of_color[kPaperCount];
    for (const Fixture& fixture : fixtures)
        if (fixture.kind == FixtureKind::eave_bulb && fixture.look == 1)
            for (uint32_t color = 0; color < kPaperCount; ++color)
                if (fixture.color == kPaperColors[color])
                    of_color[color].push_back({.translation = fixture.position});
    for (uint32_t color = 0; color < kPaperCount; ++color)
    {
        const std::string name = "coloured_bulb_" + std::to_string(color);
        const int material = addGlowingMaterial(document, name, kPaperColors[color], kBulbNits / 2);
        addCopies(document, "bulbs", addMesh(document, "coloured_bulb", ball, material), of_color[color]);
    }
}

/// Add candles, 0.14 m high below their flame, and the same in glasses on the ground.
void addCandleMeshes(Document& document, const LampMaterials& materials, const std::vector<Fixture>& fixtures)
{
    const TriangleMesh wax = makeTurned({{0.022f, -0.03f}, {0.025f, -0.045f}, {0.026f, -0.16f}}, 12);
    const TriangleMesh flame = makeTurned({{0, 0.035f}, {0.007f, 0.01f}, {0.01f, -0.012f}, {0, -0.032f}}, 8);
    const int mesh = add(document.meshes, Mesh{"candle", {{wax, materials.wax}, {flame, materials.flame}}});
    for (const FixtureKind kind : {FixtureKind::candle, FixtureKind::ground_candle})
        addCopies(document, "candles", mesh, findPlacements(fixtures, kind, kAnyLook));
}

/// Make the paper of a lantern, with the ribs of bamboo below it.
TriangleMesh makePaper()
{
    std::vector<Float2> profile;
    constexpr uint32_t kRibs = 18;
    for (uint32_t i = 0; i <= kRibs; ++i)
    {
        const float angle = kPi * (0.12f + 0.76f * static_cast<float>(i) / kRibs);
        const float rib = i % 2 == 0 ? 1.0f : 0.965f;
        profile.push_back({0.235f * sine(angle) * rib, 0.22f * cosine(angle)});
    }
    return makeTurned(profile, 28);
}

/// Make the rings, the cord and the tassel of a lantern.
TriangleMesh makeLanternFrame()
{
    TriangleMesh frame =
        moved(makeTurned({{0.09f, 0.03f}, {0.1f, 0.02f}, {0.1f, -0.02f}}, 18), {0, 0.21f, 0});
    append(frame, moved(makeTurned({{0.1f, 0.02f}, {0.1f, -0.02f}, {0.085f, -0.03f}}, 18), {0, -0.21f, 0}));
    append(frame, makeRod({0, 0.23f, 0}, {0, kLanternDrop, 0}, 0.008f, 6));
    append(frame, makeTurned({{0.006f, -0.23f}, {0.012f, -0.27f}, {0.015f, -0.36f}}, 8));
    return frame;
}

/// Add the meshes of paper lanterns, one of each colour.
std::array<int, kPaperCount> addLanternMeshes(Document& document)
{
    const int wood = addPlainMaterial(document, "lantern_wood", {0.05f, 0.025f, 0.018f}, 0.6f);
    std::array<int, kPaperCount> meshes{};
    for (uint32_t paper = 0; paper < kPaperCount; ++paper)
    {
        const std::string name = "lantern_" + std::to_string(paper);
        const int material = addShellMaterial(document, name, kPaperColors[paper] * kPaperGlow);
        meshes[paper] =
            add(document.meshes, Mesh{name, {{makePaper(), material}, {makeLanternFrame(), wood}}});
    }
    return meshes;
}

} // namespace

LampModels addLamps(Document& document, const Plan& plan, const std::vector<Fixture>& fixtures)
{
    const LampMaterials materials{addPlainMaterial(document, "lamp_iron", {0.05f, 0.05f, 0.055f}, 0.5f, 1),
                                  addPlainMaterial(document, "wax", {0.62f, 0.52f, 0.36f}, 0.5f),
                                  addGlowingMaterial(document, "bulb", kBulbColor, kBulbNits),
                                  addEmissiveMaterial(document, "cold_bulb", {0.55f, 0.72f, 1.0f}, kBulbNits),
                                  addEmissiveMaterial(document, "flame", {1.0f, 0.55f, 0.18f}, kBulbNits),
                                  addShellMaterial(document, "lamp_glass", kBulbColor * kGlassGlow)};
    addStallLampMeshes(document, materials, fixtures);
    const LampModels models{addLanternMeshes(document), materials.iron, materials.bulb};
    for (uint32_t paper = 0; paper < kPaperCount; ++paper)
        addCopies(document, "lanterns", models.lanterns[paper],
                  findPlacements(fixtures, FixtureKind::lantern, paper));
    addLampPostMeshes(document, materials, plan);
    addSignMeshes(document, materials, plan);
    addBulbMeshes(document, materials, fixtures);
    addCandleMeshes(document, materials, fixtures);
    return models;
}

} // namespace hearth::samples::market
