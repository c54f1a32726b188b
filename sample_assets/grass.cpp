// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/grass.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples
{

namespace
{

constexpr uint32_t kBladeCount = 17;

/// Blade `index` on the card: its centre line is a parabola, its width tapers to the tip.
struct Blade
{
    float root, lean, height, width, shade;
};

Blade makeBlade(uint32_t index)
{
    const auto random = [&](uint32_t which) { return randomUnit(index * 8 + which, 301); };
    const float root = 0.12f + 0.76f * (static_cast<float>(index) + 0.8f * random(0)) / kBladeCount;
    return {root, (random(1) - 0.5f) * 0.36f, 0.5f + 0.48f * random(2), 0.020f + 0.018f * random(3),
            random(4)};
}

Float4 grassTexel(Float2 uv)
{
    const float up = 1 - uv.y;
    Float4 color{0.06f, 0.09f, 0.022f,
                 0}; // blade colour also between the blades, so that mips have no dark edges
    for (uint32_t index = 0; index < kBladeCount; ++index)
    {
        const Blade blade = makeBlade(index);
        const float t = up / blade.height;
        if (t > 1)
            continue;
        const float across = uv.x - (blade.root + blade.lean * t * t);
        const float half_width = blade.width * (1 - t) * (1 - 0.4f * t) + 0.002f;
        if (std::abs(across) > half_width)
            continue;
        const Float3 base = lerp(Float3{0.030f, 0.045f, 0.012f}, Float3{0.095f, 0.13f, 0.035f}, t);
        const Float3 dry =
            lerp(base, Float3{0.21f, 0.165f, 0.06f}, blade.shade * blade.shade * (0.35f + 0.65f * t));
        const float rib = 1 - 0.35f * smoothstep(half_width * 0.3f, 0, std::abs(across));
        color = {dry.x * rib, dry.y * rib, dry.z * rib, 1};
    }
    return color;
}

} // namespace

TriangleMesh makeGrassTuft(const TuftShape& shape)
{
    TriangleMesh tuft;
    const float turn = 2 * kPi / static_cast<float>(shape.cards);
    for (uint32_t card = 0; card < shape.cards; ++card)
    {
        TriangleMesh mesh = makeGrid(shape.columns, shape.rows,
                                     [&](Float2 uv, Float3& position, Float2& texture_uv)
                                     {
                                         const float bend = 0.12f * uv.y * uv.y;
                                         position = {(uv.x - 0.5f) * 0.5f, uv.y * 0.4f, 0.04f + bend};
                                         texture_uv = {uv.x, 1 - uv.y};
                                     });
        for (const Float3& p : mesh.positions)
            mesh.normals.push_back(normalize({p.x * 0.6f, 1.0f, 0.35f + p.y}));
        append(tuft,
               transformed(mesh, {.rotation = rotationAbout({0, 1, 0}, static_cast<float>(card) * turn)}));
    }
    return tuft;
}

int addGrassMaterial(Document& document)
{
    Material material;
    material.name = "grass";
    material.base_color_image = add(document.images, paintColor("grass_blades", 512, 512, grassTexel));
    material.alpha_cutoff = 0.5f;
    material.roughness = 0.85f;
    return add(document.materials, material);
}

std::vector<Placement> scatterGrass(const HeightGrid& grid, uint32_t candidates, float bare_radius,
                                    uint32_t seed)
{
    std::vector<Placement> tufts;
    for (uint32_t i = 0; i < candidates; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, seed); };
        const Float2 xz{(random(0) - 0.5f) * grid.shape.size * 0.98f,
                        (random(1) - 0.5f) * grid.shape.size * 0.98f};
        const float distance = std::sqrt(xz.x * xz.x + xz.y * xz.y);
        const float patches =
            fbm({xz.x * 0.35f, 3, xz.y * 0.35f}, 3, 71); // same noise as the ground's colour
        const float wanted =
            smoothstep(0.25f, -0.2f, patches) * smoothstep(bare_radius, bare_radius + 2, distance);
        const Float3 normal = grid.normalAt(xz);
        if (random(2) >= wanted || normal.y < 0.88f)
            continue;
        const float scale = 0.55f + 0.75f * random(3);
        const Float4 turn = rotationAbout({0, 1, 0}, random(4) * 2 * kPi);
        tufts.push_back({{xz.x, grid.at(xz) - 0.02f, xz.y},
                         multiply(rotationBetween({0, 1, 0}, normal), turn),
                         {scale, scale * (0.8f + 0.5f * random(5)), scale}});
    }
    return tufts;
}

} // namespace hearth::samples
