// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/room.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples
{

namespace
{

constexpr uint32_t kTextureSize = 512;
constexpr float kHalfWidth = 3.0f, kHalfDepth = 2.5f, kHeight = 2.8f;

/// Floor board: eight along v, each with its own shade and grain.
struct Board
{
    float gap;   ///< 1 in the joints
    float grain; ///< about -0.5..0.5
    float shade; ///< 0..1
};

Board boardAt(Float2 uv)
{
    const float across = uv.x * 8;
    const auto board = static_cast<uint32_t>(across) & 7u;
    const float inside = across - std::floor(across);
    const float gap = smoothstep(0.02f, 0.008f, std::min(inside, 1 - inside));
    const TileNoise rings{4, 500 + board};
    const float grain = rings.fbm({uv.x * 2, uv.y * 0.25f + 0.03f * rings.gradient(uv)}, 5);
    return {gap, grain + 0.25f * sine(60 * grain + 40 * inside), randomUnit(board, 510)};
}

Float4 boardColor(Float2 uv)
{
    const Board board = boardAt(uv);
    const Float3 wood = lerp(Float3{0.26f, 0.135f, 0.06f}, Float3{0.40f, 0.235f, 0.115f}, board.shade) *
                        (1 + 0.5f * board.grain);
    const Float3 c = lerp(wood, Float3{0.03f, 0.02f, 0.012f}, board.gap);
    return {c.x, c.y, c.z, 1};
}

Float4 boardRoughness(Float2 uv)
{
    const Board board = boardAt(uv);
    return {1 - 0.6f * board.gap, clamp01(0.42f + 0.25f * board.grain + 0.4f * board.gap), 0, 1};
}

Float4 carpetColor(Float2 uv)
{
    const Float2 c{std::abs(uv.x - 0.5f) * 2, std::abs(uv.y - 0.5f) * 2};
    const float frame = std::max(c.x, c.y);
    const float diamond = c.x + c.y;
    const float rings = sine(frame < 0.72f ? diamond * 22 : frame * 30);
    const Float3 red{0.24f, 0.025f, 0.022f}, blue{0.025f, 0.05f, 0.14f}, cream{0.55f, 0.46f, 0.32f};
    Float3 color = lerp(red, cream, smoothstep(0.55f, 0.75f, rings));
    color = lerp(color, blue, smoothstep(-0.5f, -0.7f, rings));
    const float thread = 0.8f + 0.2f * sine(uv.x * 900) * sine(uv.y * 900);
    color = color * (thread * (1 + 0.4f * TileNoise{16, 520}.fbm(uv, 4)));
    return {color.x, color.y, color.z, 1};
}

float plasterHeight(Float2 uv)
{
    return 0.5f + 0.5f * TileNoise{10, 530}.fbm(uv, 6);
}

int addFloorMaterial(Document& document)
{
    Material material;
    material.name = "floor_boards";
    material.base_color_image =
        add(document.images, paintColor("boards_color", kTextureSize, kTextureSize, boardColor));
    material.metallic_roughness_image =
        add(document.images, paintData("boards_roughness", kTextureSize, kTextureSize, boardRoughness));
    material.has_occlusion = true;
    material.metallic = 1; // times the blue channel, which is 0
    material.normal_image = add(document.images, paintNormals("boards_normal", kTextureSize, 0.004f,
                                                              [](Float2 uv)
                                                              {
                                                                  const Board board = boardAt(uv);
                                                                  return 0.3f * board.grain - board.gap;
                                                              }));
    return add(document.materials, material);
}

int addPlasterMaterial(Document& document)
{
    Material material;
    material.name = "plaster";
    material.base_color = {0.62f, 0.56f, 0.47f, 1};
    material.roughness = 0.9f;
    material.normal_image =
        add(document.images, paintNormals("plaster_normal", kTextureSize, 0.01f, plasterHeight));
    return add(document.materials, material);
}

int addCarpetMaterial(Document& document)
{
    Material material;
    material.name = "carpet";
    material.base_color_image =
        add(document.images, paintColor("carpet_color", kTextureSize, kTextureSize, carpetColor));
    material.roughness = 0.95f;
    return add(document.materials, material);
}

void addShell(Document& document, int floor, int plaster)
{
    constexpr float kThick = 0.1f;
    TriangleMesh walls;
    const float middle = kHeight / 2, out_x = kHalfWidth + kThick, out_z = kHalfDepth + kThick;
    append(walls, makeBox({-out_x, middle, 0}, {kThick, middle, out_z + kThick}, 0.5f));
    append(walls, makeBox({out_x, middle, 0}, {kThick, middle, out_z + kThick}, 0.5f));
    append(walls, makeBox({0, middle, -out_z}, {kHalfWidth, middle, kThick}, 0.5f));
    append(walls, makeBox({0, middle, out_z}, {kHalfWidth, middle, kThick}, 0.5f));
    append(walls, makeBox({0, kHeight + kThick, 0}, {out_x, kThick, out_z}, 0.5f));
    const TriangleMesh boards = makeBox({0, -kThick, 0}, {out_x, kThick, out_z}, 0.5f);
    addObject(document, "shell", {{walls, plaster}, {boards, floor}});
}

void addTable(Document& document, int wood, int ceramic, int brass)
{
    TriangleMesh table = makeBox({-0.4f, 0.74f, -0.3f}, {0.8f, 0.025f, 0.45f}, 0.7f);
    for (const float x : {-1.13f, 0.33f})
        for (const float z : {-0.68f, 0.08f})
            append(table, makeBox({x, 0.357f, z}, {0.035f, 0.357f, 0.035f}, 0.7f));
    TriangleMesh vase = makeLathe({{0.0f, 0.02f},
                                   {0.05f, 0.02f},
                                   {0.042f, 0.30f},
                                   {0.055f, 0.31f},
                                   {0.05f, 0.29f},
                                   {0.065f, 0.24f},
                                   {0.11f, 0.16f},
                                   {0.12f, 0.10f},
                                   {0.09f, 0.03f},
                                   {0.05f, 0.0f},
                                   {0.0f, 0.0f}},
                                  48);
    vase = transformed(vase, {.translation = {-0.75f, 0.765f, -0.35f}});
    std::vector<Float2> ball;
    for (int i = 0; i <= 24; ++i)
    {
        const float angle = kPi * static_cast<float>(i) / 24;
        ball.push_back({i % 24 == 0 ? 0.0f : 0.11f * sine(angle), 0.11f * cosine(angle)});
    }
    const TriangleMesh sphere = transformed(makeLathe(ball, 48), {.translation = {-0.1f, 0.875f, -0.2f}});
    addObject(document, "table", {{table, wood}, {vase, ceramic}, {sphere, brass}});
}

void addShelf(Document& document, int wood, int paper)
{
    TriangleMesh shelf, books;
    for (const float y : {0.5f, 1.0f, 1.5f, 2.0f})
    {
        append(shelf, makeBox({2.78f, y, -0.6f}, {0.2f, 0.015f, 0.9f}, 0.7f));
        float z = -1.45f;
        for (uint32_t book = 0; z < 0.2f; ++book)
        {
            const uint32_t id = book + static_cast<uint32_t>(y * 64);
            const float thick = 0.012f + 0.018f * randomUnit(id, 541),
                        tall = 0.10f + 0.07f * randomUnit(id, 542);
            const Float3 hue{randomUnit(id, 543), randomUnit(id, 544), randomUnit(id, 545)};
            const Float3 cover = hue * hue * 0.5f + Float3{0.02f, 0.02f, 0.02f};
            TriangleMesh volume =
                makeBox({2.8f, y + 0.015f + tall, z + thick}, {0.12f, tall, thick - 0.001f}, 1);
            volume.colors.assign(volume.positions.size(), {cover.x, cover.y, cover.z, 1});
            append(books, volume);
            z += 2 * thick + (randomUnit(id, 546) < 0.12f ? 0.12f : 0.0f);
        }
    }
    for (const float z : {-1.51f, 0.31f})
        append(shelf, makeBox({2.78f, 1.1f, z}, {0.2f, 1.1f, 0.012f}, 0.7f));
    addObject(document, "shelf", {{shelf, wood}, {books, paper}});
}

void addLamp(Document& document, const char* name, Float3 at, int metal, int glowing)
{
    TriangleMesh rod = makeBox({at.x, (at.y + kHeight) / 2 + 0.05f, at.z},
                               {0.006f, (kHeight - at.y) / 2 - 0.05f, 0.006f}, 1);
    append(rod, transformed(makeLathe({{0.0f, 0.16f},
                                       {0.05f, 0.15f},
                                       {0.16f, 0.0f},
                                       {0.155f, 0.0f},
                                       {0.045f, 0.14f},
                                       {0.0f, 0.145f}},
                                      40),
                            {.translation = at}));
    std::vector<Float2> bulb;
    for (int i = 0; i <= 16; ++i)
    {
        const float angle = kPi * static_cast<float>(i) / 16;
        bulb.push_back({i % 16 == 0 ? 0.0f : 0.045f * sine(angle), 0.045f * cosine(angle)});
    }
    const TriangleMesh globe = transformed(makeLathe(bulb, 24), {.translation = at + Float3{0, 0.03f, 0}});
    addObject(document, name, {{rod, metal}, {globe, glowing}});
}

} // namespace

Document makeRoom()
{
    Document document;
    const int floor = addFloorMaterial(document), plaster = addPlasterMaterial(document);
    const int carpet = addCarpetMaterial(document);
    const int wood = addPlainMaterial(document, "dark_wood", {0.11f, 0.055f, 0.028f}, 0.45f);
    const int ceramic = addPlainMaterial(document, "ceramic", {0.10f, 0.24f, 0.30f}, 0.15f);
    const int brass = addPlainMaterial(document, "brass", {0.78f, 0.57f, 0.25f}, 0.22f, 1);
    const int paper = addPlainMaterial(document, "books", {1, 1, 1}, 0.7f);
    const int warm = addEmissiveMaterial(document, "bulb", {1, 0.78f, 0.45f}, 12);
    const int neon = addEmissiveMaterial(document, "neon", {0.25f, 0.55f, 1.0f}, 4);

    addShell(document, floor, plaster);
    addTable(document, wood, ceramic, brass);
    addShelf(document, wood, paper);
    TriangleMesh rug = makeGrid(1, 1,
                                [](Float2 uv, Float3& position, Float2& texture_uv)
                                {
                                    position = {uv.x * 2.8f - 1.8f, 0.008f, 1.4f - uv.y * 2.6f};
                                    texture_uv = {uv.x, 1 - uv.y};
                                });
    setFlatNormals(rug);
    addObject(document, "rug", {{rug, carpet}});
    addObject(document, "neon_strip", {{makeBox({0, 2.45f, -2.47f}, {1.4f, 0.02f, 0.02f}, 1), neon}});

    const Float3 lamp_table{-0.4f, 1.75f, -0.3f}, lamp_corner{1.9f, 1.95f, 1.3f};
    addLamp(document, "lamp_table", lamp_table, brass, warm);
    addLamp(document, "lamp_corner", lamp_corner, brass, warm);
    const Float4 none{0, 0, 0, 1};
    addLight(document, {.name = "table_light", .color = {1, 0.75f, 0.45f}, .intensity = 3.5f, .range = 8},
             lamp_table - Float3{0, 0.03f, 0}, none);
    addLight(document, {.name = "corner_light", .color = {1, 0.70f, 0.40f}, .intensity = 2.0f, .range = 8},
             lamp_corner - Float3{0, 0.03f, 0}, none);
    const Float3 spot_at{1.2f, 2.7f, -0.6f};
    addLight(document,
             {.name = "shelf_spot",
              .kind = LightKind::spot,
              .color = {1, 0.9f, 0.75f},
              .intensity = 9,
              .range = 6,
              .inner_cone_rad = 0.35f,
              .outer_cone_rad = 0.6f},
             spot_at, rotationLookingAt(spot_at, {2.8f, 1.2f, -0.6f}));

    const Float3 eye{-2.3f, 1.65f, 2.1f};
    addCamera(document, {.name = "room", .y_fov_rad = 1.0f, .z_near = 0.05f, .z_far = 50}, eye,
              {0.5f, 0.9f, -0.6f});
    return document;
}

} // namespace hearth::samples
