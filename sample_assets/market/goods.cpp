// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/goods.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/market/street.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples::market
{

namespace
{

/// Materials of goods; their colours are those of the vertices.
struct GoodsMaterials
{
    int matt, waxed, glazed, metal;
};

/// Return the colour number `i` of a list.
template <size_t N>
Float3 pick(const std::array<Float3, N>& colors, uint32_t i)
{
    return colors[i % N];
}

constexpr std::array<Float3, 6> kFruit{{{0.70f, 0.20f, 0.015f},
                                        {0.52f, 0.03f, 0.02f},
                                        {0.68f, 0.50f, 0.03f},
                                        {0.22f, 0.42f, 0.04f},
                                        {0.20f, 0.02f, 0.10f},
                                        {0.66f, 0.12f, 0.10f}}};
constexpr std::array<Float3, 6> kDyes{{{0.55f, 0.05f, 0.05f},
                                       {0.05f, 0.20f, 0.45f},
                                       {0.65f, 0.45f, 0.05f},
                                       {0.05f, 0.35f, 0.25f},
                                       {0.40f, 0.10f, 0.40f},
                                       {0.70f, 0.60f, 0.50f}}};
constexpr std::array<Float3, 5> kGlazes{{{0.10f, 0.28f, 0.34f},
                                         {0.45f, 0.12f, 0.05f},
                                         {0.50f, 0.44f, 0.34f},
                                         {0.08f, 0.16f, 0.32f},
                                         {0.14f, 0.30f, 0.12f}}};
constexpr Float3 kStraw{0.50f, 0.36f, 0.17f}, kWood{0.34f, 0.21f, 0.11f};

/// Make an open crate: a floor and four walls; 2 * half metres long, its floor at height 0.
TriangleMesh makeCrate(Float3 half)
{
    constexpr float kThick = 0.014f;
    TriangleMesh crate = makeBlock({-half.x, 0, -half.z}, {half.x, kThick, half.z});
    for (const float side : {-1.0f, 1.0f})
    {
        const float x = side * (half.x - kThick / 2), z = side * (half.z - kThick / 2);
        append(crate, makeBlock({x - kThick / 2, kThick, -half.z}, {x + kThick / 2, 2 * half.y, half.z}));
        append(crate, makeBlock({kThick - half.x, kThick, z - kThick / 2},
                                {half.x - kThick, 2 * half.y, z + kThick / 2}));
    }
    return crate;
}

/// Add a mesh that has one primitive for each material that is not empty.
int addGoodsMesh(Document& document, const char* name, std::vector<Primitive> primitives)
{
    std::erase_if(primitives, [](const Primitive& p) { return p.mesh.positions.empty(); });
    return add(document.meshes, Mesh{name, std::move(primitives)});
}

/// Crates in two rows, each with a heap of one kind of fruit.
int addFruit(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh wood, fruit;
    uint32_t number = 0;
    for (uint32_t column = 0; column < 5; ++column)
        for (uint32_t row = 0; row < 2; ++row)
        {
            const Float3 at{-1.16f + 0.58f * static_cast<float>(column),
                            kCounterTop + (row == 0 ? 0.0f : 0.1f), row == 0 ? 0.82f : 0.48f};
            if (row == 1)
                append(wood, tinted(moved(makeBlock({-0.25f, -0.1f, -0.15f}, {0.25f, 0, 0.15f}), at), kWood));
            append(wood, tinted(moved(makeCrate({0.26f, 0.05f, 0.155f}), at), kStraw));
            const uint32_t kind = column * 2 + row;
            const float radius = 0.042f + 0.012f * randomUnit(kind, 941);
            for (uint32_t i = 0; i < 26; ++i, ++number)
            {
                const auto random = [&](uint32_t which) { return randomUnit(number * 4 + which, 942); };
                const bool top = i >= 18;
                const float x = top ? 0.26f * (random(0) - 0.5f)
                                    : -0.2f + 0.08f * static_cast<float>(i % 6) + 0.015f * random(0);
                const float z = top ? 0.12f * (random(1) - 0.5f)
                                    : -0.085f + 0.085f * static_cast<float>(i / 6) + 0.015f * random(1);
                const float y = (top ? 0.105f : 0.06f) + 0.015f * random(2);
                const Float3 color = pick(kFruit, kind) * (0.75f + 0.5f * random(3));
                append(fruit,
                       tinted(moved(makeBall({radius, radius * 0.93f, radius}, 10), at + Float3{x, y, z}),
                              color));
            }
        }
    return addGoodsMesh(document, "fruit", {{wood, materials.matt}, {fruit, materials.waxed}});
}

/// Jars of three sizes with lids of metal.
int addJars(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh jars, lids;
    for (uint32_t i = 0; i < 30; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 951); };
        const uint32_t row = i / 10;
        const float r = 0.055f + 0.03f * random(0),
                    h = 0.13f + 0.1f * random(1) + 0.05f * static_cast<float>(row);
        const Float3 at{-1.32f + 0.29f * static_cast<float>(i % 10) + 0.03f * random(2), kCounterTop,
                        0.86f - 0.2f * static_cast<float>(row)};
        const TriangleMesh jar = makeTurned(
            {{r * 0.7f, h}, {r * 0.75f, h * 0.9f}, {r, h * 0.78f}, {r, h * 0.08f}, {r * 0.88f, 0}}, 18);
        append(jars, tinted(moved(jar, at), pick(kGlazes, i * 3 + row)));
        const TriangleMesh lid =
            makeTurned({{r * 0.76f, h + 0.025f}, {r * 0.8f, h + 0.015f}, {r * 0.8f, h - 0.004f}}, 18);
        append(lids, tinted(moved(lid, at), {0.80f, 0.62f, 0.32f}));
    }
    return addGoodsMesh(document, "jars", {{jars, materials.glazed}, {lids, materials.metal}});
}

/// Folded cloth in stacks, and rolls behind them.
int addFabrics(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh cloth;
    uint32_t number = 0;
    for (uint32_t stack = 0; stack < 7; ++stack)
    {
        float y = kCounterTop;
        const uint32_t folds = 3 + static_cast<uint32_t>(4 * randomUnit(stack, 961));
        for (uint32_t i = 0; i < folds; ++i, ++number)
        {
            const auto random = [&](uint32_t which) { return randomUnit(number * 4 + which, 962); };
            const float high = 0.035f + 0.02f * random(0);
            const TriangleMesh fold = makeBall({0.185f, high * 0.55f, 0.15f}, 16);
            TriangleMesh flat = fold;
            for (Float3& p : flat.positions) // press the ellipsoid to a cushion
            {
                p.x = std::clamp(p.x * 1.25f, -0.185f, 0.185f);
                p.z = std::clamp(p.z * 1.25f, -0.15f, 0.15f);
            }
            setSmoothNormals(flat);
            const Placement place{{-1.2f + 0.4f * static_cast<float>(stack), y + high / 2, 0.78f},
                                  rotationAbout({0, 1, 0}, 0.12f * (random(1) - 0.5f)),
                                  {1, 1, 1}};
            append(cloth, tinted(transformed(flat, place), pick(kDyes, number * 5 + stack)));
            y += high;
        }
    }
    for (uint32_t i = 0; i < 9; ++i)
    {
        const float r = 0.055f + 0.02f * randomUnit(i, 963);
        const float x = -1.28f + 0.32f * static_cast<float>(i);
        append(cloth, tinted(makeRod({x, kCounterTop, 0.46f}, {x + 0.03f, kCounterTop + 0.5f, 0.40f}, r, 14),
                             pick(kDyes, i * 2 + 1)));
    }
    return addGoodsMesh(document, "fabrics", {{cloth, materials.matt}});
}

/// Pots and pans of copper and brass, and a big kettle.
int addPots(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh metal, glazed;
    for (uint32_t i = 0; i < 11; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 971); };
        const float r = 0.08f + 0.06f * random(0), h = 0.1f + 0.12f * random(1);
        const Float3 at{-1.28f + 0.257f * static_cast<float>(i), kCounterTop, 0.5f + 0.36f * random(2)};
        const Float3 color = i % 3 == 0 ? Float3{0.86f, 0.46f, 0.30f} : Float3{0.82f, 0.64f, 0.34f};
        const TriangleMesh pot = makeTurned({{0, 0.02f},
                                             {r * 0.82f, 0.02f},
                                             {r * 0.95f, h * 0.9f},
                                             {r * 1.04f, h},
                                             {r, h * 0.9f},
                                             {r * 0.9f, 0.03f},
                                             {r * 0.7f, 0}},
                                            24);
        append(i % 4 == 3 ? glazed : metal, tinted(moved(pot, at), i % 4 == 3 ? pick(kGlazes, i) : color));
    }
    const TriangleMesh kettle = makeTurned({{0.03f, 0.46f},
                                            {0.05f, 0.42f},
                                            {0.12f, 0.38f},
                                            {0.21f, 0.26f},
                                            {0.22f, 0.14f},
                                            {0.15f, 0.02f},
                                            {0.13f, 0}},
                                           28);
    append(metal, tinted(moved(kettle, {0.9f, kCounterTop, 0.45f}), {0.86f, 0.46f, 0.30f}));
    return addGoodsMesh(document, "pots", {{metal, materials.metal}, {glazed, materials.glazed}});
}

/// Loaves and buns on boards and in flat baskets.
int addBread(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh bread, wood;
    for (uint32_t basket = 0; basket < 4; ++basket)
    {
        const Float3 at{-1.1f + 0.74f * static_cast<float>(basket), kCounterTop, 0.64f};
        append(wood,
               tinted(moved(makeTurned({{0.26f, 0.02f}, {0.31f, 0.07f}, {0.33f, 0.07f}, {0.27f, 0}}, 28), at),
                      kStraw));
        const bool long_ones = basket % 2 == 0;
        for (uint32_t i = 0; i < 9; ++i)
        {
            const auto random = [&](uint32_t which) { return randomUnit((basket * 9 + i) * 8 + which, 981); };
            const Float3 half = long_ones ? Float3{0.15f, 0.045f, 0.055f} : Float3{0.07f, 0.05f, 0.07f};
            const float angle = 0.7f * static_cast<float>(i), away = i == 0 ? 0.0f : 0.15f;
            const Placement place{
                at + Float3{away * cosine(angle), 0.07f + (i % 3 == 0 ? 0.075f : 0.0f), away * sine(angle)},
                rotationAbout({0, 1, 0}, 6 * random(0)),
                {1, 1, 1}};
            append(bread, tinted(transformed(makeBall(half, 12), place),
                                 Float3{0.52f, 0.28f, 0.09f} * (0.7f + 0.5f * random(1))));
        }
    }
    return addGoodsMesh(document, "bread", {{bread, materials.matt}, {wood, materials.matt}});
}

/// Tops, balls and masks of bright lacquer, on a stepped stand.
int addToys(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh lacquer, wood;
    for (uint32_t step = 0; step < 3; ++step)
    {
        const float y = kCounterTop + 0.09f * static_cast<float>(step);
        const float z = 0.88f - 0.2f * static_cast<float>(step);
        if (step > 0)
            append(wood, tinted(makeBlock({-1.35f, kCounterTop, z - 0.09f}, {1.35f, y, z + 0.09f}), kWood));
        for (uint32_t i = 0; i < 9; ++i)
        {
            const uint32_t id = step * 9 + i;
            const Float3 at{-1.2f + 0.3f * static_cast<float>(i), y, z};
            const Float3 color = pick(kDyes, id * 5 + step);
            if (id % 3 == 0)
                append(
                    lacquer,
                    tinted(moved(makeBall({0.065f, 0.065f, 0.065f}, 14), at + Float3{0, 0.065f, 0}), color));
            else if (id % 3 == 1)
                append(lacquer, tinted(moved(makeTurned({{0.012f, 0.16f},
                                                         {0.014f, 0.1f},
                                                         {0.07f, 0.075f},
                                                         {0.06f, 0.05f},
                                                         {0.006f, 0}},
                                                        16),
                                             at),
                                       color));
            else
                append(lacquer,
                       tinted(moved(makeBall({0.065f, 0.09f, 0.03f}, 14), at + Float3{0, 0.09f, 0}), color));
        }
    }
    return addGoodsMesh(document, "toys", {{lacquer, materials.glazed}, {wood, materials.matt}});
}

/// Bottles and boxes for the shelves at the back.
int addShelfGoods(Document& document, const GoodsMaterials& materials)
{
    TriangleMesh glazed, boxes;
    for (uint32_t i = 0; i < 48; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 991); };
        const Float3 at{-1.3f + 0.17f * static_cast<float>(i % 16),
                        i < 16 ? 0.575f : (i < 32 ? 1.075f : 1.575f), -0.9f + 0.06f * random(0)};
        if (random(1) < 0.55f)
        {
            const float r = 0.04f + 0.015f * random(2), h = 0.16f + 0.12f * random(3);
            append(
                glazed,
                tinted(moved(makeTurned({{r * 0.35f, h}, {r * 0.35f, h * 0.75f}, {r, h * 0.55f}, {r, 0}}, 12),
                             at),
                       pick(kGlazes, i * 3)));
        }
        else if (random(1) < 0.9f)
            append(boxes, tinted(makeBlock(at - Float3{0.07f, 0, 0.07f},
                                           at + Float3{0.07f, 0.08f + 0.16f * random(3), 0.07f}),
                                 pick(kDyes, i * 7)));
    }
    return addGoodsMesh(document, "shelf_goods", {{glazed, materials.glazed}, {boxes, materials.matt}});
}

/// Add closed crates, barrels and sacks at the sides of the stalls.
void addStores(Document& document, const Plan& plan, const GoodsMaterials& materials)
{
    TriangleMesh crate = makeBlock({-0.28f, 0.02f, -0.22f}, {0.28f, 0.38f, 0.22f});
    for (const float y : {0.0f, 0.155f, 0.31f})
        append(crate, makeBlock({-0.3f, y, -0.24f}, {0.3f, y + 0.09f, 0.24f}));
    TriangleMesh barrel =
        makeTurned({{0.21f, 0.8f}, {0.27f, 0.62f}, {0.285f, 0.4f}, {0.27f, 0.18f}, {0.21f, 0}}, 20);
    const TriangleMesh sack = makeTurned(
        {{0.05f, 0.6f}, {0.08f, 0.55f}, {0.19f, 0.45f}, {0.25f, 0.22f}, {0.22f, 0.03f}, {0.15f, 0}}, 16);
    const int meshes[3] = {addMesh(document, "crate", tinted(crate, kWood), materials.matt),
                           addMesh(document, "barrel", tinted(barrel, kWood * 0.7f), materials.matt),
                           addMesh(document, "sack", tinted(sack, {0.42f, 0.34f, 0.22f}), materials.matt)};
    std::vector<Placement> placements[3];
    for (uint32_t i = 0; i < plan.stalls.size(); ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 16 + which, 995); };
        const Placement& stall = plan.stalls[i].placement;
        const auto put = [&](size_t kind, Float3 at, float turn)
        {
            Placement placement = standing(fromPlacement(stall, at), turn);
            const Float3 foot = placement.translation;
            placement.translation.y += groundHeight({foot.x, foot.z});
            placement.rotation = multiply(stall.rotation, placement.rotation);
            placements[kind].push_back(placement);
        };
        const float side = random(0) < 0.5f ? -1.0f : 1.0f;
        if (random(1) < 0.75f)
        {
            put(0, {side * 1.0f, 0, -0.3f}, 0.3f * (random(2) - 0.5f));
            if (random(3) < 0.5f)
                put(0, {side * 1.0f, 0.4f, -0.3f}, 0.6f * (random(4) - 0.5f));
        }
        if (random(5) < 0.5f)
            put(1, {-side * 1.88f, 0, 0.35f + 0.4f * random(6)}, 6 * random(7));
        if (random(8) < 0.55f)
            put(2, {side * 1.86f, 0, 0.75f - 0.3f * random(9)}, 6 * random(10));
    }
    for (size_t kind = 0; kind < 3; ++kind)
        addCopies(document, "stores", meshes[kind], placements[kind]);
}

} // namespace

void addGoods(Document& document, const Plan& plan)
{
    const GoodsMaterials materials{addPlainMaterial(document, "matt_goods", {1, 1, 1}, 0.85f),
                                   addPlainMaterial(document, "waxed_goods", {1, 1, 1}, 0.35f),
                                   addPlainMaterial(document, "glazed_goods", {1, 1, 1}, 0.15f),
                                   addPlainMaterial(document, "metal_goods", {1, 1, 1}, 0.25f, 1)};
    const int meshes[kGoodsCount] = {addFruit(document, materials),   addJars(document, materials),
                                     addFabrics(document, materials), addPots(document, materials),
                                     addBread(document, materials),   addToys(document, materials)};
    std::vector<Placement> of_goods[kGoodsCount], all;
    for (const Stall& stall : plan.stalls)
    {
        of_goods[stall.goods].push_back(stall.placement);
        all.push_back(stall.placement);
    }
    for (size_t goods = 0; goods < kGoodsCount; ++goods)
        addCopies(document, "goods", meshes[goods], of_goods[goods]);
    addCopies(document, "shelf_goods", addShelfGoods(document, materials), all);
    addStores(document, plan, materials);
}

} // namespace hearth::samples::market
