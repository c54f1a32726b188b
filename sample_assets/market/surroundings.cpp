// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/surroundings.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples::market
{

namespace
{

constexpr uint32_t kHouseKinds = 4;

/// Append a window: a frame, a cross and a pane, on the wall z = 0.
void appendWindow(TriangleMesh& frame, TriangleMesh& pane, Float2 center, Float2 half)
{
    constexpr float kWide = 0.07f;
    const float x = center.x, y = center.y;
    append(pane, makeBlock({x - half.x, y - half.y, -0.02f}, {x + half.x, y + half.y, 0.03f}));
    for (const float side : {-1.0f, 1.0f})
    {
        const float edge = x + side * (half.x + kWide / 2), end = y + side * (half.y + kWide / 2);
        append(frame, makeBlock({edge - kWide / 2, y - half.y - kWide, -0.02f},
                                {edge + kWide / 2, y + half.y + kWide, 0.09f}));
        append(frame,
               makeBlock({x - half.x, end - kWide / 2, -0.02f}, {x + half.x, end + kWide / 2, 0.085f}));
    }
    append(frame, makeBlock({x - 0.025f, y - half.y, 0.02f}, {x + 0.025f, y + half.y, 0.06f}));
    append(frame, makeBlock({x - half.x, y + 0.2f, 0.02f}, {x + half.x, y + 0.25f, 0.055f}));
    append(frame, makeBlock({x - half.x - 0.15f, y - half.y - 0.14f, -0.02f},
                            {x + half.x + 0.15f, y - half.y - 0.06f, 0.16f}));
}

/// Materials of houses; walls differ by kind.
struct HouseMaterials
{
    int trim, dark_pane, lit_pane, cool_pane, roof;
};

/// Make a gable roof, a closed prism with its ridge along X; its eaves reach beyond the walls.
TriangleMesh makeGable(float half_width)
{
    constexpr float kFront = 0.45f, kBack = -5.05f, kMiddle = (kFront + kBack) / 2, kRise = 2.5f;
    constexpr float kLow = kHouseEaves - 0.02f;
    const Float3 corners[3] = {{0, kLow, kFront}, {0, kLow + kRise, kMiddle}, {0, kLow, kBack}};
    const Float3 right{half_width, 0, 0};
    TriangleMesh roof;
    for (size_t i = 0; i < 3; ++i)
    {
        const Float3 from = corners[i], to = corners[(i + 1) % 3];
        TriangleMesh side = makeGrid(1, 1,
                                     [&](Float2 uv, Float3& position, Float2& texture_uv)
                                     {
                                         position = lerp(from, to, uv.y) + right * (2 * uv.x - 1);
                                         texture_uv = uv;
                                     });
        setFlatNormals(side);
        append(roof, side);
    }
    for (const float end : {-1.0f, 1.0f})
    {
        TriangleMesh gable;
        for (const Float3 corner : corners)
        {
            gable.positions.push_back(corner + right * end);
            gable.uvs.push_back({corner.z, corner.y});
        }
        gable.indices = end > 0 ? std::vector<uint32_t>{0, 2, 1} : std::vector<uint32_t>{0, 1, 2};
        setFlatNormals(gable);
        append(roof, gable);
    }
    return roof;
}

int addHouse(Document& document, uint32_t kind, Float3 color, const HouseMaterials& materials)
{
    const std::string name = "house_" + std::to_string(kind);
    const int wall = addPlainMaterial(document, (name + "_wall").c_str(), color, 0.92f);
    TriangleMesh walls = makeBlock({-3.5f, -0.2f, -4.6f}, {3.5f, kHouseEaves, 0});
    TriangleMesh trim, dark, lit, cool;
    append(trim, makeBlock({-3.52f, kHouseLedge - 0.12f, -0.05f}, {3.52f, kHouseLedge, 0.14f}));
    append(trim, makeBlock({-3.52f, kHouseEaves - 0.16f, -0.05f}, {3.52f, kHouseEaves, 0.2f}));
    append(trim, makeBlock({-3.51f, -0.2f, -0.05f}, {3.51f, 0.45f, 0.06f}));
    for (uint32_t storey = 0; storey < 2; ++storey)
        for (uint32_t column = 0; column < 3; ++column)
        {
            if (storey == 0 && column == kind % 3)
                continue; // the door
            const float chance = randomUnit(kind * 8 + storey * 3 + column, 1021);
            const Float2 center{-2.2f + 2.2f * static_cast<float>(column), storey == 0 ? 1.85f : 5.35f};
            appendWindow(trim, chance < 0.42f ? lit : (chance < 0.5f ? cool : dark), center, {0.5f, 0.78f});
        }
    const float door = -2.2f + 2.2f * static_cast<float>(kind % 3);
    append(trim, makeBlock({door - 0.62f, -0.1f, -0.05f}, {door + 0.62f, 2.45f, 0.07f}));
    append(dark, makeBlock({door - 0.5f, -0.05f, 0}, {door + 0.5f, 2.3f, 0.085f}));
    std::vector<Primitive> primitives{{walls, wall},
                                      {trim, materials.trim},
                                      {dark, materials.dark_pane},
                                      {lit, materials.lit_pane},
                                      {cool, materials.cool_pane},
                                      {makeGable(kHouseHalfWidth), materials.roof}};
    std::erase_if(primitives, [](const Primitive& p) { return p.mesh.positions.empty(); });
    return add(document.meshes, Mesh{name, std::move(primitives)});
}

/// Make a crown of leaves: overlapping balls, dented by noise.
TriangleMesh makeCrown()
{
    TriangleMesh crown;
    for (uint32_t i = 0; i < 9; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 1031) - 0.5f; };
        const float radius = 0.62f + 0.3f * random(0);
        const Float3 at =
            kCrownMiddle + kCrownHalf * Float3{1.35f * random(1), 1.2f * random(2), 1.35f * random(3)};
        TriangleMesh ball = makeBall({radius, radius * 0.9f, radius}, 28);
        for (Float3& p : ball.positions)
            p = p * (1 + 0.30f * fbm(p * 5.0f + at * 3.0f, 3, 1032)) + at;
        setSmoothNormals(ball);
        append(crown, ball);
    }
    return crown;
}

TriangleMesh makeTrunk()
{
    TriangleMesh trunk =
        makeTurned({{0.05f, 3.2f}, {0.085f, 2.2f}, {0.11f, 1.0f}, {0.15f, 0.2f}, {0.22f, -0.12f}}, 14);
    for (Float3& p : trunk.positions)
        p.x += 0.06f * sine(p.y * 1.7f);
    setSmoothNormals(trunk);
    for (uint32_t i = 0; i < 4; ++i)
    {
        const float angle = 1.6f * static_cast<float>(i);
        append(trunk, makeRod({0.05f, 1.9f + 0.15f * static_cast<float>(i), 0},
                              {0.7f * cosine(angle), 2.8f, 0.7f * sine(angle)}, 0.035f));
    }
    return trunk;
}

/// Make the wire of a string, `span` metres long, along +X from its first end.
TriangleMesh makeWire(float span)
{
    constexpr uint32_t kPieces = 16;
    const LampString string{{0, 0, 0}, {span, 0, 0}};
    TriangleMesh wire;
    for (uint32_t i = 0; i < kPieces; ++i)
        append(wire, makeRod(stringPoint(string, static_cast<float>(i) / kPieces),
                             stringPoint(string, static_cast<float>(i + 1) / kPieces), 0.011f, 5));
    return wire;
}

} // namespace

void addHouses(Document& document, const Plan& plan)
{
    const HouseMaterials materials{addPlainMaterial(document, "house_trim", {0.20f, 0.17f, 0.14f}, 0.8f),
                                   addPlainMaterial(document, "dark_pane", {0.02f, 0.022f, 0.025f}, 0.12f),
                                   addEmissiveMaterial(document, "lit_pane", {1.0f, 0.55f, 0.2f}, 1.2f),
                                   addEmissiveMaterial(document, "cool_pane", {0.35f, 0.6f, 1.0f}, 0.5f),
                                   addPlainMaterial(document, "roof_tiles", {0.16f, 0.07f, 0.05f}, 0.8f)};
    constexpr std::array<Float3, kHouseKinds> kWalls{
        {{0.42f, 0.30f, 0.20f}, {0.36f, 0.34f, 0.31f}, {0.34f, 0.17f, 0.12f}, {0.24f, 0.30f, 0.30f}}};
    std::vector<Placement> of_kind[kHouseKinds];
    for (size_t i = 0; i < plan.houses.size(); ++i)
        of_kind[(i * 5 + i / 4) % kHouseKinds].push_back(plan.houses[i]);
    for (uint32_t kind = 0; kind < kHouseKinds; ++kind)
        addCopies(document, "houses", addHouse(document, kind, kWalls[kind], materials), of_kind[kind]);
}

void addTrees(Document& document, const Plan& plan)
{
    const int leaves = addPlainMaterial(document, "leaves", {0.06f, 0.13f, 0.035f}, 0.7f);
    const int bark = addPlainMaterial(document, "bark", {0.14f, 0.09f, 0.055f}, 0.9f);
    const int mesh = add(document.meshes, Mesh{"tree", {{makeCrown(), leaves}, {makeTrunk(), bark}}});
    addCopies(document, "trees", mesh, plan.trees);
}

void addTown(Document& document)
{
    const int earth = addPlainMaterial(document, "earth", {0.06f, 0.055f, 0.05f}, 0.95f);
    const TriangleMesh ground = makeTurned({{kSkyRadius + 3, -0.14f}, {kSkyRadius + 3, -1.0f}}, 48);
    addObject(document, "outskirts", {{ground, earth}});

    const int wall = addPlainMaterial(document, "town_wall", {0.16f, 0.14f, 0.13f}, 0.95f);
    const int window = addEmissiveMaterial(document, "town_window", {1.0f, 0.62f, 0.28f}, 0.7f);
    TriangleMesh windows;
    for (uint32_t i = 0; i < 64; ++i)
        if (randomUnit(i, 1051) < 0.4f)
        {
            const float x = -3.3f + 0.94f * static_cast<float>(i % 8),
                        y = 2.0f + 1.5f * static_cast<float>(i / 8);
            append(windows, makeBlock({x - 0.22f, y - 0.35f, 3.9f}, {x + 0.22f, y + 0.35f, 4.02f}));
        }
    const int block =
        add(document.meshes,
            Mesh{"town_block", {{makeBlock({-4, -0.3f, -4}, {4, 14.5f, 4}), wall}, {windows, window}}});
    std::vector<Placement> placements;
    constexpr uint32_t kBlocks = 54;
    for (uint32_t i = 0; i < kBlocks; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 4 + which, 1052); };
        const float angle = 2 * kPi * (static_cast<float>(i) + 0.4f * random(0)) / kBlocks;
        const float away = 58 + 12 * random(1);
        Placement placement = standing({away * sine(angle), 0, away * cosine(angle)}, angle + kPi);
        placement.scale = {1, 0.5f + 0.75f * random(2), 1};
        placements.push_back(placement);
    }
    addCopies(document, "town", block, placements);
}

void addPoles(Document& document, const Plan& plan)
{
    const int iron = addPlainMaterial(document, "iron", {0.10f, 0.10f, 0.11f}, 0.45f, 1);
    const TriangleMesh pole = makeTurned({{0.0f, 4.62f},
                                          {0.055f, 4.58f},
                                          {0.06f, 4.5f},
                                          {0.035f, 4.45f},
                                          {0.045f, 0.35f},
                                          {0.10f, 0.25f},
                                          {0.12f, -0.1f}},
                                         14);
    std::vector<Placement> poles;
    for (const Float3 foot : plan.poles)
        poles.push_back({.translation = foot});
    addCopies(document, "poles", addMesh(document, "pole", pole, iron), poles);

    std::vector<std::pair<float, std::vector<Placement>>> of_span;
    for (const LampString& string : plan.strings)
    {
        const float span = string.to.x - string.from.x;
        if (of_span.empty() || std::abs(of_span.front().first - span) > 0.01f)
            of_span.insert(of_span.begin(), {span, {}});
        const auto found =
            std::find_if(of_span.begin(), of_span.end(),
                         [&](const auto& entry) { return std::abs(entry.first - span) < 0.01f; });
        found->second.push_back({.translation = string.from});
    }
    for (const auto& [span, placements] : of_span)
        addCopies(document, "wires", addMesh(document, "wire", makeWire(span), iron), placements);
}

Float3 moonDirection()
{
    return normalize({0.86f, 0.66f, -0.38f});
}

Float4 nightSkyColor(Float2 uv)
{
    const float azimuth = uv.x * 2 * kPi, elevation = (1 - uv.y) * 0.5f * kPi;
    const Float3 direction{cosine(elevation) * cosine(azimuth), sine(elevation),
                           -cosine(elevation) * sine(azimuth)};
    const float up = direction.y;
    Float3 color =
        lerp(Float3{0.020f, 0.022f, 0.042f}, Float3{0.004f, 0.006f, 0.016f}, smoothstep(0, 0.7f, up));
    color = lerp(Float3{0.075f, 0.045f, 0.030f}, color, smoothstep(0.0f, 0.30f, up)); // the town's glow
    const float cloud =
        smoothstep(0.0f, 0.45f, TileNoise{6, 1041}.fbm({uv.x, uv.y * 0.5f}, 6)) * smoothstep(0.9f, 0.3f, up);
    color = lerp(color, Float3{0.030f, 0.026f, 0.032f}, cloud * 0.7f);

    const float towards_moon = dot(direction, moonDirection());
    const float halo = smoothstep(0.90f, 1.0f, towards_moon);
    color += Float3{0.07f, 0.08f, 0.10f} * (halo * halo);
    color = lerp(color, Float3{0.95f, 0.93f, 0.86f}, smoothstep(0.99935f, 0.99950f, towards_moon));

    const TileNoise::Cell star = TileNoise{150, 1042}.cellular({uv.x, uv.y * 0.25f});
    const float size = 0.02f + 0.05f * static_cast<float>(star.hash >> 24) / 255.0f;
    const float bright = (star.hash & 7u) == 0 ? smoothstep(size * 1.6f, 0, star.nearest) : 0.0f;
    color = lerp(color, Float3{0.75f, 0.80f, 0.95f},
                 bright * (1 - cloud) * (1 - halo) * smoothstep(0.2f, 0.6f, up));
    return {color.x, color.y, color.z, 1};
}

void addNightShell(Document& document)
{
    constexpr uint32_t kAround = 96, kUp = 48;
    constexpr float kRadius = kSkyRadius + 2, kBelow = 0.12f; ///< reaches a little below the horizon
    constexpr float kOpeningCosine = 0.87f;                   ///< opening around the moon: 30 degrees
    TriangleMesh shell = makeGrid(
        kAround, kUp,
        [&](Float2 uv, Float3& position, Float2& texture_uv)
        {
            const float azimuth = uv.x == 1.0f ? 0.0f : uv.x * 2 * kPi;
            const float elevation = lerp(-kBelow, kPi / 2, uv.y);
            const float around = uv.y == 1.0f ? 0.0f : cosine(elevation);
            position = Float3{around * cosine(azimuth), sine(elevation), -around * sine(azimuth)} * kRadius;
            texture_uv = uv;
        });
    std::vector<uint32_t> closed; // the inside is the front
    for (size_t i = 0; i < shell.indices.size(); i += 3)
    {
        const uint32_t a = shell.indices[i], b = shell.indices[i + 1], c = shell.indices[i + 2];
        const Float3 middle = normalize(shell.positions[a] + shell.positions[b] + shell.positions[c]);
        if (dot(middle, moonDirection()) < kOpeningCosine)
            closed.insert(closed.end(), {a, c, b});
    }
    shell.indices = closed;
    setSmoothNormals(shell);
    addObject(document, "night_shell", {{shell, addPlainMaterial(document, "night", {0, 0, 0}, 1)}});
}

} // namespace hearth::samples::market
