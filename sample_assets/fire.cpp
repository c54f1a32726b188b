// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/fire.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples
{

namespace
{

/// Return the colour of a glowing body, from dull red over orange to pale yellow.
Float3 glowColor(float heat)
{
    const float h = clamp01(heat);
    return {smoothstep(0.0f, 0.45f, h), 0.75f * h * h, 0.28f * h * h * h * h};
}

float barkHeight(Float2 uv)
{
    const float warp = 0.06f * TileNoise{4, 401}.fbm(uv, 3);
    const float ridge = TileNoise{10, 402}.ridged({uv.x + warp, uv.y * 0.15f}, 3);
    const float scales = TileNoise{14, 403}.cellular({uv.x + warp, uv.y}).nearest;
    return clamp01(0.6f * ridge + 0.5f * (1 - scales) + 0.2f * TileNoise{24, 404}.fbm(uv, 3));
}

Float4 barkColor(Float2 uv)
{
    const float h = barkHeight(uv);
    const Float3 c = lerp(Float3{0.028f, 0.018f, 0.012f}, Float3{0.16f, 0.105f, 0.065f}, h);
    return {c.x, c.y, c.z, 1};
}

/// Return the heat of charred wood: 0 cold, 1 white hot; hot in the cracks and at v = 0.
float charHeat(Float2 uv)
{
    const TileNoise::Cell plate = TileNoise{11, 411}.cellular({uv.x, uv.y});
    const float crack = smoothstep(0.16f, 0.0f, plate.second - plate.nearest);
    const float reach = smoothstep(0.5f, 0.0f, uv.y + 0.25f * TileNoise{5, 412}.fbm(uv, 3));
    return crack * reach;
}

Float4 charColor(Float2 uv)
{
    const float ash = smoothstep(0.1f, 0.4f, TileNoise{7, 413}.fbm(uv, 4));
    const Float3 burnt = lerp(Float3{0.012f, 0.011f, 0.011f}, Float3{0.12f, 0.115f, 0.11f}, ash * 0.6f);
    const Float4 bark = barkColor(uv);
    const Float3 c = lerp(burnt, Float3{bark.x, bark.y, bark.z}, smoothstep(0.6f, 0.95f, uv.y));
    return {c.x, c.y, c.z, 1};
}

Float4 charGlow(Float2 uv)
{
    const Float3 c = glowColor(charHeat(uv)) * charHeat(uv);
    return {c.x, c.y, c.z, 1};
}

float coalHeight(Float2 uv)
{
    const TileNoise::Cell coal = TileNoise{9, 421}.cellular(uv);
    return clamp01(1 - coal.nearest * 1.1f) + 0.15f * TileNoise{20, 422}.fbm(uv, 3);
}

float coalHeat(Float2 uv)
{
    const float breath = TileNoise{3, 423}.fbm(uv, 4);
    return clamp01(1.05f - 0.95f * coalHeight(uv) + 0.9f * breath);
}

Float4 coalColor(Float2 uv)
{
    const float h = coalHeight(uv);
    return {0.015f + 0.05f * h, 0.014f + 0.045f * h, 0.014f + 0.042f * h, 1};
}

Float4 coalGlow(Float2 uv)
{
    const float heat = coalHeat(uv);
    const Float3 c = glowColor(heat) * (heat * heat);
    return {c.x, c.y, c.z, 1};
}

/// Return the depth inside the flame: below 0 outside, 1 at the core.
float flameDepth(Float2 uv)
{
    const float up = 1 - uv.y;
    const float sway = 0.22f * up * TileNoise{3, 431}.fbm({uv.x * 0.3f, uv.y * 0.5f}, 3) +
                       0.16f * up * TileNoise{6, 432}.fbm({uv.x, uv.y * 0.7f}, 3);
    const float across = std::abs(uv.x - 0.5f + sway);
    // a drop: round at the bottom, long at the top, with tongues torn out of the upper part
    const float width = 0.42f * smoothstep(-0.04f, 0.16f, up) * (1 - up) * (1 + 0.4f * up);
    const float tongues = 0.30f * up * TileNoise{5, 433}.ridged({uv.x, uv.y * 0.45f}, 3);
    return (width - tongues * 0.45f - across) / 0.30f;
}

Float4 flameColor(Float2 uv)
{
    const float depth = flameDepth(uv);
    const float heat = clamp01(0.45f + 0.75f * depth + 0.15f * uv.y);
    const Float3 c = exposeGlow(glowColor(heat) * 5);
    return {c.x, c.y, c.z, depth > 0 ? 1.0f : 0.0f};
}

} // namespace

TriangleMesh makeLog(float radius, uint32_t seed)
{
    constexpr uint32_t kRings = 40;
    std::vector<Float2> profile;
    profile.push_back({0, 1});
    for (uint32_t ring = 0; ring <= kRings; ++ring)
    {
        const float t = 1 - static_cast<float>(ring) / kRings;
        profile.push_back({radius * (1 - 0.15f * t), t});
    }
    profile.push_back({0, 0});
    TriangleMesh log = makeLathe(profile, 36);
    for (Float3& p : log.positions)
    {
        const Float3 q = p * 9.0f + Float3{static_cast<float>(seed) * 7.0f, 0, 0};
        const float swell = 1 + 0.25f * fbm({q.x, q.y * 0.35f, q.z}, 4, seed);
        p.x *= swell;
        p.z *= swell;
        p.x += 0.05f * fbm({p.y * 1.7f, 0, 4.5f}, 2, seed + 7); // no branch is straight
        p.y += 0.03f * fbm({q.x * 2, q.z * 2, 0}, 2, seed + 8);
    }
    setSmoothNormals(log);
    return log;
}

int addLogMaterial(Document& document, bool burning)
{
    Material material;
    material.name = burning ? "charred_log" : "log";
    material.base_color_image = add(document.images, paintColor(burning ? "charred_color" : "bark_color", 512,
                                                                512, burning ? charColor : barkColor));
    material.normal_image = add(
        document.images, paintNormals(burning ? "charred_normal" : "bark_normal", 512, 0.03f, barkHeight));
    material.roughness = 0.9f;
    if (burning)
    {
        material.emissive_image = add(document.images, paintColor("charred_glow", 512, 512, charGlow));
        material.emissive = {1, 1, 1};
        material.emissive_strength = 4;
    }
    return add(document.materials, material);
}

TriangleMesh makeEmberBed()
{
    TriangleMesh bed =
        makeGrid(64, 64,
                 [](Float2 uv, Float3& position, Float2& texture_uv)
                 {
                     const Float2 d{uv.x * 2 - 1, 1 - uv.y * 2};
                     const float r = std::min(1.0f, std::sqrt(d.x * d.x + d.y * d.y));
                     const float mound = 0.10f * (1 - r * r);
                     position = {d.x * 0.5f, mound + 0.05f * coalHeight(uv) * (1 - r) - 0.015f, d.y * 0.5f};
                     texture_uv = uv;
                 });
    setSmoothNormals(bed);
    return bed;
}

int addEmberMaterial(Document& document)
{
    Material material;
    material.name = "embers";
    material.base_color_image = add(document.images, paintColor("coal_color", 512, 512, coalColor));
    material.normal_image = add(document.images, paintNormals("coal_normal", 512, 0.05f, coalHeight));
    material.emissive_image = add(document.images, paintColor("coal_glow", 512, 512, coalGlow));
    material.emissive = {1, 1, 1};
    material.emissive_strength = 8;
    return add(document.materials, material);
}

TriangleMesh makeFlames()
{
    TriangleMesh flames;
    for (int card = 0; card < 5; ++card)
    {
        const auto index = static_cast<uint32_t>(card);
        const float height = card == 0 ? 0.85f : 0.38f + 0.3f * randomUnit(index, 441);
        const float width = height * 0.62f;
        const TriangleMesh mesh = makeGrid(4, 8,
                                           [&](Float2 uv, Float3& position, Float2& texture_uv)
                                           {
                                               const float bow = 0.10f * (uv.x - 0.5f) * (uv.x - 0.5f) * 4;
                                               position = {(uv.x - 0.5f) * width, uv.y * height, bow};
                                               texture_uv = {card % 2 == 0 ? uv.x : 1 - uv.x, 1 - uv.y};
                                           });
        const float turn = static_cast<float>(card) * 1.2566371f;
        const float away = card == 0 ? 0.0f : 0.12f;
        TriangleMesh lit = transformed(mesh, {.translation = {away * sine(turn), 0.02f, away * cosine(turn)},
                                              .rotation = rotationAbout({0, 1, 0}, turn)});
        setSmoothNormals(lit);
        append(flames, lit);
    }
    return flames;
}

int addFlameMaterial(Document& document)
{
    Material material;
    material.name = "flames";
    material.base_color_image = add(document.images, paintColor("flame", 256, 512, flameColor));
    material.unlit = true; // flames hold the fire's light, and shadow nothing
    material.alpha_cutoff = 0.5f;
    material.double_sided = true;
    return add(document.materials, material);
}

void addEmbers(Document& document)
{
    addPlaced(document, "embers", addMesh(document, "embers", makeEmberBed(), addEmberMaterial(document)),
              {.scale = {1.25f, 1.0f, 1.25f}});
}

void addBurningLogs(Document& document)
{
    std::vector<Placement> logs;
    constexpr uint32_t kLogs = 6;
    for (uint32_t i = 0; i < kLogs; ++i)
    {
        const float angle = (static_cast<float>(i) + 0.5f * randomUnit(i, 631)) * 2 * kPi / kLogs;
        const float length = 0.62f + 0.2f * randomUnit(i, 632);
        const Float3 outwards = normalize({cosine(angle), 0.62f + 0.25f * randomUnit(i, 633), sine(angle)});
        // the burning ends meet low over the embers, the cold ends stick out and up
        const Float3 foot{-0.10f * outwards.x, 0.06f, -0.10f * outwards.z};
        logs.push_back({foot, rotationBetween({0, 1, 0}, outwards), {length, length, length}});
    }
    addCopies(document, "logs",
              addMesh(document, "burning_log", makeLog(0.075f, 5), addLogMaterial(document, true)), logs);
}

} // namespace hearth::samples
