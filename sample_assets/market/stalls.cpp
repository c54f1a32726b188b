// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/stalls.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples::market
{

namespace
{

constexpr float kClothHalf = 1.78f;  ///< metres along X
constexpr float kClothThick = 0.02f; ///< metres; thinner ones fight for depth with their own backs far away
constexpr uint32_t kStripes = 9;     ///< of cloths, an odd number: both ends have the same colour

/// Colour of every second stripe; the others are cream.
constexpr std::array<Float3, kClothCount> kClothColors{{{0.50f, 0.045f, 0.035f},
                                                        {0.04f, 0.17f, 0.36f},
                                                        {0.05f, 0.27f, 0.13f},
                                                        {0.62f, 0.30f, 0.03f},
                                                        {0.30f, 0.07f, 0.28f},
                                                        {0.03f, 0.26f, 0.28f}}};

int addClothMaterial(Document& document, uint32_t cloth)
{
    const std::string name = "cloth_" + std::to_string(cloth);
    const auto color = [cloth](Float2 uv)
    {
        const auto stripe = static_cast<uint32_t>(uv.x * kStripes);
        const Float3 dye = stripe % 2 == 0 ? kClothColors[cloth] : Float3{0.62f, 0.55f, 0.42f};
        const float weave = 0.92f + 0.08f * sine(uv.x * 800) * sine(uv.y * 800);
        const float stain = 1 + 0.25f * TileNoise{5, 921 + cloth}.fbm(uv, 4);
        return Float4{dye.x * weave * stain, dye.y * weave * stain, dye.z * weave * stain, 1};
    };
    Material material;
    material.name = name;
    material.base_color_image = add(document.images, paintColor(name, 256, 256, color));
    material.roughness = 0.9f;
    return add(document.materials, material);
}

/// Append a valance below the front edge of a roof: one scallop a stripe, 15 mm thick.
void appendValance(TriangleMesh& cloth, Float2 eave)
{
    constexpr uint32_t kColumns = kStripes * 6;
    for (const bool front : {true, false})
    {
        TriangleMesh side =
            makeGrid(kColumns, 2,
                     [&](Float2 uv, Float3& position, Float2& texture_uv)
                     {
                         const float u = front ? uv.x : 1 - uv.x;
                         const float drop = 0.16f + 0.09f * std::abs(sine(u * kStripes * kPi));
                         position = {(2 * u - 1) * kClothHalf, eave.x + 0.01f - drop * (1 - uv.y),
                                     eave.y + (front ? 0.015f : 0.0f)};
                         texture_uv = {u, 0.1f * uv.y};
                     });
        setFlatNormals(side);
        append(cloth, side);
    }
}

TriangleMesh makeAwning()
{
    const Float2 eave = frontEave(Roof::awning);
    TriangleMesh cloth =
        makeSheet(kStripes, 8, kClothThick,
                  [&](Float2 uv)
                  {
                      const float hang = 0.09f * (uv.y - uv.y * uv.y) * 4;
                      return Float3{(2 * uv.x - 1) * kClothHalf, lerp(eave.x, 2.88f, uv.y) - hang,
                                    lerp(eave.y, -1.2f, uv.y)};
                  });
    appendValance(cloth, eave);
    return cloth;
}

TriangleMesh makeTent()
{
    const Float2 eave = frontEave(Roof::tent);
    TriangleMesh cloth =
        makeSheet(kStripes, 16, kClothThick,
                  [&](Float2 uv)
                  {
                      const float z = lerp(eave.y, -eave.y, uv.y);
                      const float slope = 1 - std::abs(z) / eave.y;
                      const float hang = 0.3f * slope * (1 - slope);
                      return Float3{(2 * uv.x - 1) * kClothHalf, eave.x + 0.85f * slope - hang, z};
                  });
    appendValance(cloth, eave);
    return cloth;
}

/// Append four posts and the beams between them.
/// front, back  heights of the posts, metres
void appendPosts(TriangleMesh& wood, float front, float back)
{
    constexpr float kHalf = 0.045f, kX = 1.5f, kZ = 1.0f;
    constexpr float kSunk = -0.08f; ///< the ground is uneven
    for (const float x : {-kX, kX})
    {
        append(wood, makeBlock({x - kHalf, kSunk, kZ - kHalf}, {x + kHalf, front, kZ + kHalf}));
        append(wood, makeBlock({x - kHalf, kSunk, -kZ - kHalf}, {x + kHalf, back, -kZ + kHalf}));
    }
    append(wood, makeBlock({-kX, front - 0.14f, kZ - 0.03f}, {kX, front - 0.06f, kZ + 0.03f}));
    append(wood, makeBlock({-kX, back - 0.14f, -kZ - 0.03f}, {kX, back - 0.06f, -kZ + 0.03f}));
}

/// Make the counter: boards of uneven shades at its front and sides, and shelves at the back.
TriangleMesh makeCounter()
{
    TriangleMesh wood;
    const auto board = [&](Float3 low, Float3 high)
    {
        const float shade = 0.55f + 0.45f * randomUnit(static_cast<uint32_t>(wood.positions.size()), 931);
        append(wood, tinted(makeBlock(low, high), {shade, shade * 0.97f, shade * 0.93f}));
    };
    constexpr uint32_t kBoards = 10;
    constexpr float kWidth = 2 * 1.42f / kBoards;
    for (uint32_t i = 0; i < kBoards; ++i)
    {
        const float x = -1.42f + kWidth * static_cast<float>(i);
        const float low = 0.05f + 0.03f * randomUnit(i, 932);
        board({x + 0.004f, low, 0.94f}, {x + kWidth - 0.004f, kCounterTop - 0.05f, 0.965f});
    }
    for (const float x : {-1.44f, 1.42f})
        board({x, 0.06f, kCounterFrom + 0.04f}, {x + 0.02f, kCounterTop - 0.05f, 0.94f});
    board({-kCounterHalf, kCounterTop - 0.05f, kCounterFrom}, {kCounterHalf, kCounterTop, kCounterTo});
    for (const float y : {0.55f, 1.05f, 1.55f})
        board({-1.4f, y, -1.02f}, {1.4f, y + 0.025f, -0.72f});
    for (const float x : {-1.43f, 1.4f})
        board({x, -0.08f, -1.02f}, {x + 0.03f, 1.75f, -0.72f});
    return wood;
}

} // namespace

void addStalls(Document& document, const Plan& plan)
{
    const int wood = addPlainMaterial(document, "stall_wood", {0.36f, 0.20f, 0.10f}, 0.7f);
    TriangleMesh awning_posts, tent_posts;
    appendPosts(awning_posts, 2.36f, 2.80f);
    appendPosts(tent_posts, 2.46f, 2.46f);
    const int posts[kRoofCount] = {addMesh(document, "awning_posts", awning_posts, wood),
                                   addMesh(document, "tent_posts", tent_posts, wood)};
    const int counter = addMesh(document, "counter", makeCounter(), wood);
    const TriangleMesh roofs[kRoofCount] = {makeAwning(), makeTent()};

    std::vector<Placement> all, of_roof[kRoofCount], of_cloth[kRoofCount][kClothCount];
    for (const Stall& stall : plan.stalls)
    {
        const auto roof = static_cast<size_t>(stall.roof);
        all.push_back(stall.placement);
        of_roof[roof].push_back(stall.placement);
        of_cloth[roof][stall.cloth].push_back(stall.placement);
    }
    addCopies(document, "counters", counter, all);
    for (size_t roof = 0; roof < kRoofCount; ++roof)
        addCopies(document, "posts", posts[roof], of_roof[roof]);
    for (uint32_t cloth = 0; cloth < kClothCount; ++cloth)
    {
        const int material = addClothMaterial(document, cloth);
        for (size_t roof = 0; roof < kRoofCount; ++roof)
            if (!of_cloth[roof][cloth].empty())
                addCopies(document, "roofs", addMesh(document, "roof", roofs[roof], material),
                          of_cloth[roof][cloth]);
    }
}

} // namespace hearth::samples::market
