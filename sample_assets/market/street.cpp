// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/street.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/market/plan.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples::market
{

namespace
{

constexpr float kWaterLevel = -0.015f; ///< metres; the hollows below it are puddles
constexpr float kTileMetres = 2.4f;    ///< of the stones' textures
constexpr int kStonesAlongTile = 16;

struct Paving
{
    float height; ///< 0 in the joints to 1
    float shade;  ///< 0 to 1, of the stone
    float wear;   ///< about -0.5..0.5
};

/// Return the paving at a point of the tile: stones of uneven shape, 15 cm wide.
Paving pavingAt(Float2 uv)
{
    const TileNoise::Cell stone = TileNoise{kStonesAlongTile, 1011}.cellular(uv);
    const float joint = stone.second - stone.nearest;
    const float wear = TileNoise{24, 1012}.fbm(uv, 4);
    const float dome = smoothstep(0.02f, 0.24f, joint);
    return {clamp01(dome * (0.9f + 0.2f * wear)), static_cast<float>(stone.hash >> 24) / 255.0f, wear};
}

Float4 pavingColor(Float2 uv)
{
    const Paving paving = pavingAt(uv);
    const Float3 stone = lerp(Float3{0.13f, 0.12f, 0.115f}, Float3{0.21f, 0.19f, 0.17f}, paving.shade) *
                         (1 + 0.4f * paving.wear);
    const Float3 c = lerp(Float3{0.055f, 0.048f, 0.042f}, stone, smoothstep(0.05f, 0.4f, paving.height));
    return {c.x, c.y, c.z, 1};
}

/// Return occlusion and roughness: the stones' crowns are polished by feet and damp, the joints are rough.
Float4 pavingRoughness(Float2 uv)
{
    const Paving paving = pavingAt(uv);
    const float damp = TileNoise{3, 1013}.fbm(uv, 3);
    const float rough = 0.29f + 0.20f * paving.wear - 0.30f * damp + 0.4f * (1 - paving.height);
    return {0.5f + 0.5f * paving.height, std::clamp(rough, 0.14f, 0.95f), 0, 1};
}

int addPavingMaterial(Document& document)
{
    constexpr uint32_t kTexels = 512;
    Material material;
    material.name = "paving";
    material.base_color_image =
        add(document.images, paintColor("paving_color", kTexels, kTexels, pavingColor));
    material.metallic_roughness_image =
        add(document.images, paintData("paving_roughness", kTexels, kTexels, pavingRoughness));
    material.has_occlusion = true;
    material.metallic = 1; // times the blue channel, which is 0
    material.normal_image = add(document.images, paintNormals("paving_normal", kTexels, 0.010f,
                                                              [](Float2 uv) { return pavingAt(uv).height; }));
    return add(document.materials, material);
}

} // namespace

float groundHeight(Float2 xz)
{
    return 0.06f * fbm({xz.x * 0.3f, 0.5f, xz.y * 0.3f}, 4, 1001);
}

void addStreet(Document& document)
{
    constexpr uint32_t kQuadsX = 128, kQuadsZ = 220;
    TriangleMesh ground =
        makeGrid(kQuadsX, kQuadsZ,
                 [](Float2 uv, Float3& position, Float2& texture_uv)
                 {
                     const Float2 xz{(2 * uv.x - 1) * kHalfWidth, (1 - 2 * uv.y) * kHalfLength};
                     position = {xz.x, groundHeight(xz), xz.y};
                     texture_uv = xz * (1 / kTileMetres);
                 });
    setSmoothNormals(ground);
    addObject(document, "street", {{ground, addPavingMaterial(document)}});

    TriangleMesh puddles =
        makeGrid(8, 14,
                 [](Float2 uv, Float3& position, Float2& texture_uv)
                 {
                     position = {(2 * uv.x - 1) * kHalfWidth, kWaterLevel, (1 - 2 * uv.y) * kHalfLength};
                     texture_uv = uv;
                 });
    setFlatNormals(puddles);
    addObject(document, "puddles",
              {{puddles, addPlainMaterial(document, "water", {0.065f, 0.060f, 0.056f}, 0.14f)}});
}

} // namespace hearth::samples::market
