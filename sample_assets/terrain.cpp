// Generates terrain with an erosion look: octaves count less where the coarser ones are already steep, so
// slopes are smooth and crests sharp (after the idea in F. K. Musgrave et al., "The Synthesis and Rendering
// of Eroded Fractal Terrains", 1989).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/terrain.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/parallel.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/shapes.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples
{

namespace
{

/// Return a height in units of the coarsest octave; about [-0.6, 0.6].
float erodedNoise(Float2 p, int octaves, uint32_t seed)
{
    constexpr float kStep = 1e-2f; // for the slope of an octave, in its own cells
    float sum = 0, amplitude = 0.5f;
    Float2 slope;
    for (int octave = 0; octave < octaves; ++octave)
    {
        const uint32_t octave_seed = seed + static_cast<uint32_t>(octave);
        const float plane = 0.37f + static_cast<float>(octave);
        const float n = gradientNoise({p.x, plane, p.y}, octave_seed);
        slope.x += (gradientNoise({p.x + kStep, plane, p.y}, octave_seed) - n) / kStep;
        slope.y += (gradientNoise({p.x, plane, p.y + kStep}, octave_seed) - n) / kStep;
        sum += amplitude * n / (1 + slope.x * slope.x + slope.y * slope.y);
        amplitude *= 0.5f;
        // scales by 2 and rotates, so that no axis is visible
        p = {1.6f * p.x - 1.2f * p.y, 1.2f * p.x + 1.6f * p.y};
    }
    return sum;
}

float tileHeight(const TerrainShape& shape, Float2 xz)
{
    const float eroded = erodedNoise(xz * (3.2f / shape.size), 8, shape.seed);
    const float height = 0.11f * shape.size * eroded;
    if (shape.clearing_radius <= 0)
        return height;
    const float distance = std::sqrt(xz.x * xz.x + xz.y * xz.y);
    const float wildness = smoothstep(shape.clearing_radius, 0.5f * shape.size, distance);
    const float bumps = 0.03f * fbm({xz.x * 1.3f, 0, xz.y * 1.3f}, 3, shape.seed + 50);
    return height * wildness + bumps * smoothstep(0.9f, 2.0f, distance) +
           0.05f * shape.size * wildness * wildness;
}

struct GroundColors
{
    Float3 grass{0.060f, 0.085f, 0.024f};
    Float3 dry{0.17f, 0.135f, 0.055f};
    Float3 earth{0.105f, 0.072f, 0.045f};
    Float3 stone{0.19f, 0.175f, 0.16f};
    Float3 ash{0.045f, 0.042f, 0.04f};
};

Float3 groundColor(const HeightGrid& grid, Float2 uv)
{
    const GroundColors colors;
    const float size = grid.shape.size;
    const Float2 xz{(uv.x - 0.5f) * size, (uv.y - 0.5f) * size};
    const float patches = fbm({xz.x * 0.35f, 3, xz.y * 0.35f}, 3, 71);
    const float grain = fbm({xz.x * 9.0f, 5, xz.y * 9.0f}, 3, 73);
    const float slope = 1 - grid.normalAt(xz).y;
    Float3 color = lerp(colors.grass, colors.dry, smoothstep(-0.15f, 0.35f, patches + 0.5f * grain));
    color = lerp(color, colors.earth, smoothstep(0.06f, 0.16f, slope + 0.05f * grain));
    color = lerp(color, colors.stone, smoothstep(0.14f, 0.3f, slope + 0.08f * grain));
    const float distance = std::sqrt(xz.x * xz.x + xz.y * xz.y);
    if (grid.shape.clearing_radius > 0)
    {
        const float radius = grid.shape.clearing_radius * (0.75f + 0.6f * patches);
        color = lerp(color, colors.earth, smoothstep(radius + 0.8f, radius - 0.3f, distance + 1.2f * grain));
        color = lerp(color, colors.ash, smoothstep(1.15f, 0.6f, distance + 0.4f * grain));
    }
    return color * (1 + 0.9f * grain);
}

float pebbleHeight(Float2 uv)
{
    const TileNoise::Cell pebble = TileNoise{18, 91}.cellular(uv);
    const float round = std::sqrt(clamp01(1 - pebble.nearest * pebble.nearest * 3.2f));
    const float present = (pebble.hash & 3u) == 0 ? 1.0f : 0.0f;
    return 0.5f * round * present + 0.35f * TileNoise{12, 92}.fbm(uv, 5);
}

} // namespace

float HeightGrid::at(Float2 xz) const
{
    const auto cells = static_cast<float>(shape.cells);
    const auto column = [&](float v) { return std::clamp((v / shape.size + 0.5f) * cells, 0.0f, cells); };
    const float x = column(xz.x), z = column(xz.y);
    const auto ix = std::min(static_cast<size_t>(x), size_t{shape.cells} - 1);
    const auto iz = std::min(static_cast<size_t>(z), size_t{shape.cells} - 1);
    const size_t stride = shape.cells + size_t{1};
    const float fx = x - static_cast<float>(ix), fz = z - static_cast<float>(iz);
    const float* const row = &heights[iz * stride + ix];
    return lerp(lerp(row[0], row[1], fx), lerp(row[stride], row[stride + 1], fx), fz);
}

Float3 HeightGrid::normalAt(Float2 xz) const
{
    const float step = shape.size / static_cast<float>(shape.cells);
    const float dx = at({xz.x + step, xz.y}) - at({xz.x - step, xz.y});
    const float dz = at({xz.x, xz.y + step}) - at({xz.x, xz.y - step});
    return normalize({-dx, 2 * step, -dz});
}

HeightGrid makeHeights(const TerrainShape& shape)
{
    const size_t stride = shape.cells + size_t{1};
    HeightGrid grid{shape, std::vector<float>(stride * stride)};
    const float step = shape.size / static_cast<float>(shape.cells);
    parallelFor(stride,
                [&](size_t row)
                {
                    for (size_t column = 0; column < stride; ++column)
                        grid.heights[row * stride + column] =
                            tileHeight(shape, {static_cast<float>(column) * step - 0.5f * shape.size,
                                               static_cast<float>(row) * step - 0.5f * shape.size});
                });
    return grid;
}

TriangleMesh makeTerrain(const HeightGrid& grid)
{
    // the rows of the mesh run towards -Z, so that its triangles face up
    TriangleMesh mesh = makeGrid(grid.shape.cells, grid.shape.cells,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     const float x = (uv.x - 0.5f) * grid.shape.size;
                                     const float z = (0.5f - uv.y) * grid.shape.size;
                                     position = {x, grid.at({x, z}), z};
                                     texture_uv = {uv.x, 1 - uv.y};
                                 });
    setSmoothNormals(mesh);
    return mesh;
}

TriangleMesh makeHills(float inner, float outer, uint32_t segments, uint32_t seed)
{
    TriangleMesh mesh = makeGrid(segments, segments / 4,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     const float angle = uv.x == 1.0f ? 0.0f : uv.x * 2 * kPi;
                                     const float radius = inner + (outer - inner) * uv.y * uv.y;
                                     const Float2 xz{radius * cosine(angle), -radius * sine(angle)};
                                     const float ridge = ridged({xz.x * 0.02f, 0.5f, xz.y * 0.02f}, 6, seed);
                                     const float far = smoothstep(inner, outer, radius);
                                     const float height =
                                         -0.4f + 2.2f * smoothstep(inner, 2 * inner, radius) +
                                         0.11f * (outer - inner) * far * (0.25f + ridge) +
                                         1.5f * fbm({xz.x * 0.09f, 1, xz.y * 0.09f}, 4, seed + 9) * uv.y;
                                     position = {xz.x, height, xz.y};
                                     texture_uv = {uv.x * 8, far};
                                 });
    // u runs with the angle and v outwards: seen from above that is clockwise
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    setSmoothNormals(mesh);
    return mesh;
}

int addTerrainMaterial(Document& document, const HeightGrid& grid, uint32_t texture_size)
{
    Material material;
    material.name = "ground";
    material.base_color_image = add(document.images, paintColor("ground_color", texture_size, texture_size,
                                                                [&](Float2 uv)
                                                                {
                                                                    const Float3 c = groundColor(grid, uv);
                                                                    return Float4{c.x, c.y, c.z, 1};
                                                                }));
    material.normal_image = add(document.images, paintNormals("ground_normal", 512, 0.02f, pebbleHeight));
    material.detail_scale = std::floor(grid.shape.size / 1.5f + 0.5f);
    material.roughness = 0.95f;
    return add(document.materials, material);
}

} // namespace hearth::samples
