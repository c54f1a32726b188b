// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/rock.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

#include <algorithm>
#include <cmath>

namespace hearth::samples
{

namespace
{

struct CutPlane
{
    Float3 normal;
    float distance;
};

struct Boulder
{
    std::array<CutPlane, 13> planes;
    Float3 strata_axis;
    Float3 offset; ///< offset into the noise, so that each seed is another rock
    int fine_octaves;
};

/// Return point `index` of `count` spread over the sphere, perturbed by the seed.
Float3 spreadDirection(size_t index, size_t count, uint32_t seed)
{
    const auto i = static_cast<uint32_t>(index);
    const float height = 1.0f - 2.0f * (static_cast<float>(index) + 0.5f) / static_cast<float>(count);
    const float ring = std::sqrt(std::max(0.0f, 1.0f - height * height));
    const float angle = 2.3999632f * static_cast<float>(index) + 0.9f * randomUnit(i * 2, seed);
    const Float3 d{ring * cosine(angle), height + 0.35f * (randomUnit(i * 2 + 1, seed) - 0.5f),
                   ring * sine(angle)};
    return normalize(d);
}

Boulder makeBoulder(uint32_t seed, uint32_t grid)
{
    Boulder boulder;
    for (size_t i = 0; i < boulder.planes.size(); ++i)
        boulder.planes[i] = {spreadDirection(i, boulder.planes.size(), seed),
                             0.68f + 0.3f * randomUnit(static_cast<uint32_t>(i) + 100, seed)};
    boulder.strata_axis = normalize({randomUnit(200, seed) - 0.5f, 1.4f, randomUnit(201, seed) - 0.5f});
    boulder.offset = Float3{randomUnit(202, seed), randomUnit(203, seed), randomUnit(204, seed)} * 64.0f;
    // the finest octave must not be finer than the triangles: each octave halves a wavelength of 1/14
    boulder.fine_octaves = 2;
    for (uint32_t resolved = 32; resolved * 2 <= grid; resolved *= 2)
        ++boulder.fine_octaves;
    return boulder;
}

/// Return the distance from the centre to the cut sphere, with rounded edges.
float cutRadius(const Boulder& boulder, Float3 direction)
{
    float radius = 1.08f;
    for (const CutPlane& plane : boulder.planes)
    {
        const float facing = dot(direction, plane.normal);
        if (facing > 0.2f)
            radius = smoothMin(radius, plane.distance / facing, 0.08f);
    }
    return radius;
}

Float3 boulderPoint(const Boulder& boulder, Float3 direction)
{
    const float radius = cutRadius(boulder, direction);
    const Float3 p = direction * radius + boulder.offset;

    // Warp the domain first, so that neither ridges nor layers run straight.
    const Float3 bend{fbm(p * 1.7f, 3, 11), fbm(p * 1.7f, 3, 12), fbm(p * 1.7f, 3, 13)};
    const Float3 q = p + bend * 0.35f;
    const float cracks = ridged(q * 2.3f, 4, 21);
    const float layer = dot(q, boulder.strata_axis) * 9.0f;
    const float strata = smoothstep(0.1f, 0.9f, layer - std::floor(layer)) - 0.5f;
    const float strata_mask = smoothstep(-0.15f, 0.3f, fbm(p * 1.1f, 2, 31));
    const float rough = fbm(q * 7.0f, 4, 41);
    const float fine = ridged(q * 14.0f, boulder.fine_octaves, 51) - 0.4f;

    const float displacement = 0.06f * bend.x - 0.10f * cracks * cracks + 0.022f * strata * strata_mask +
                               0.05f * rough + 0.018f * fine;
    return direction * (radius + displacement);
}

/// Warp a cube coordinate for even spacing over the sphere. Exact even spacing is tan(c pi/4); this
/// polynomial is within 2 % of it and exact at 0 and +-1, so that the six sides meet in the same bits.
float warpCube(float c)
{
    return c * (0.75f + 0.25f * c * c);
}

} // namespace

TriangleMesh makeRock(uint64_t triangle_count, uint32_t seed, float uv_repeat)
{
    const auto grid = static_cast<uint32_t>(
        std::max(1.0, std::ceil(std::sqrt(static_cast<double>(triangle_count) / 12.0) - 0.5)));
    const Boulder boulder = makeBoulder(seed, grid);
    const auto onCube = [&](float unit)
    {
        const float step = std::floor(unit * static_cast<float>(grid) + 0.5f);
        return warpCube((2 * step - static_cast<float>(grid)) / static_cast<float>(grid));
    };
    TriangleMesh rock;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f})
            append(rock, makeGrid(grid, grid,
                                  [&](Float2 uv, Float3& position, Float2& texture_uv)
                                  {
                                      Float3 cube;
                                      cube[axis] = side;
                                      cube[(axis + 1) % 3] = onCube(uv.x) * side;
                                      cube[(axis + 2) % 3] = onCube(uv.y);
                                      position = boulderPoint(boulder, cube / length(cube));
                                      const float chart =
                                          static_cast<float>(axis * 2) + (side > 0 ? 1.0f : 0.0f);
                                      texture_uv = {uv.x * uv_repeat + chart * 0.37f, uv.y * uv_repeat};
                                  }));
    setSmoothNormals(rock);
    return rock;
}

namespace
{

struct RockSurface
{
    float height;  ///< 0..1
    float crevice; ///< 0..1
    float lichen;  ///< 0..1
    float tint;    ///< about -0.5..0.5
};

RockSurface rockSurface(Float2 uv)
{
    const float grain = TileNoise{32, 5}.fbm(uv, 4);
    const float lumps = TileNoise{6, 9}.fbm(uv, 4);
    const float veins = TileNoise{5, 14}.ridged({uv.x + 0.03f * lumps, uv.y + 0.03f * grain}, 5);
    const float crevice = smoothstep(0.66f, 0.92f, veins);
    const float patches = TileNoise{4, 23}.fbm(uv, 6);
    const float lichen = smoothstep(0.12f, 0.34f, patches + 0.3f * grain) * (1 - crevice);
    const float height = clamp01(0.55f + 0.35f * lumps + 0.28f * grain - 0.35f * crevice + 0.05f * lichen);
    return {height, crevice, lichen, lumps};
}

Float4 rockColor(Float2 uv)
{
    const RockSurface s = rockSurface(uv);
    Float3 color = lerp(Float3{0.125f, 0.118f, 0.112f}, Float3{0.30f, 0.275f, 0.245f}, clamp01(s.height));
    color = lerp(color, Float3{0.24f, 0.185f, 0.135f}, clamp01(s.tint * 1.6f));
    color = lerp(color, Float3{0.225f, 0.235f, 0.12f}, s.lichen * 0.5f);
    color = lerp(color, Float3{0.075f, 0.068f, 0.06f}, s.crevice * 0.4f);
    return {color.x, color.y, color.z, 1};
}

Float4 rockRoughness(Float2 uv)
{
    const RockSurface s = rockSurface(uv);
    return {1 - 0.7f * s.crevice, clamp01(0.74f + 0.2f * s.lichen + 0.15f * (0.5f - s.height)), 0, 1};
}

} // namespace

int addRockMaterial(Document& document, uint32_t size)
{
    Material material;
    material.name = "rock";
    material.base_color_image = add(document.images, paintColor("rock_color", size, size, rockColor));
    material.metallic_roughness_image =
        add(document.images, paintData("rock_occlusion_roughness", size, size, rockRoughness));
    material.has_occlusion = true;
    material.metallic = 1; // times the blue channel, which is 0
    material.normal_image =
        add(document.images,
            paintNormals("rock_normal", size, 0.012f, [](Float2 uv) { return rockSurface(uv).height; }));
    return add(document.materials, material);
}

} // namespace hearth::samples
