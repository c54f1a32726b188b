// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/noise.h"

#include "sample_assets/shapes/sample_math.h"

#include <array>

namespace hearth::samples
{

namespace
{

float fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// The middles of a cube's edges: far apart, and the dot product needs no multiplication.
float gradientDot(uint32_t hash, Float3 d)
{
    const float u = (hash & 8u) ? d.y : d.x;
    const float v = (hash & 4u) ? d.z : ((hash & 8u) ? d.x : d.y);
    return ((hash & 1u) ? -u : u) + ((hash & 2u) ? -v : v);
}

int wrapCell(int cell, int cells)
{
    return ((cell % cells) + cells) % cells;
}

float gradient2(uint32_t hash, float x, float y)
{
    // eight directions; the factor brings the range to about [-1, 1]
    constexpr float kDiagonal = 0.70710678f;
    const float a = (hash & 1u) ? -1.0f : 1.0f;
    const float b = (hash & 2u) ? -1.0f : 1.0f;
    if (hash & 4u)
        return 1.5f * kDiagonal * (a * x + b * y);
    return 1.5f * ((hash & 8u) ? a * x : a * y);
}

float ridgeFromNoise(float noise)
{
    const float r = 1.0f - std::min(std::abs(noise), 1.0f);
    return r * r;
}

} // namespace

uint32_t hashLattice(int x, int y, int z, uint32_t seed)
{
    uint32_t h = seed * 0x9E3779B1u + 0x85EBCA77u;
    for (const int value : {x, y, z})
    {
        h ^= static_cast<uint32_t>(value) * 0xC2B2AE3Du;
        h = (h << 15 | h >> 17) * 0x27D4EB2Fu;
    }
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    return h ^ (h >> 15);
}

float randomUnit(uint32_t index, uint32_t seed)
{
    return static_cast<float>(hashLattice(static_cast<int>(index), 0, 0, seed) >> 8) * 0x1p-24f;
}

float gradientNoise(Float3 p, uint32_t seed)
{
    const Float3 base{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    const int ix = static_cast<int>(base.x), iy = static_cast<int>(base.y), iz = static_cast<int>(base.z);
    const Float3 f = p - base;
    const auto corner = [&](int dx, int dy, int dz)
    {
        const Float3 d{f.x - static_cast<float>(dx), f.y - static_cast<float>(dy),
                       f.z - static_cast<float>(dz)};
        return gradientDot(hashLattice(ix + dx, iy + dy, iz + dz, seed) >> 20, d);
    };
    const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
    const float x00 = lerp(corner(0, 0, 0), corner(1, 0, 0), u);
    const float x10 = lerp(corner(0, 1, 0), corner(1, 1, 0), u);
    const float x01 = lerp(corner(0, 0, 1), corner(1, 0, 1), u);
    const float x11 = lerp(corner(0, 1, 1), corner(1, 1, 1), u);
    return lerp(lerp(x00, x10, v), lerp(x01, x11, v), w);
}

float fbm(Float3 p, int octaves, uint32_t seed)
{
    float sum = 0, amplitude = 0.5f;
    for (int octave = 0; octave < octaves; ++octave)
    {
        sum += amplitude * gradientNoise(p, seed + static_cast<uint32_t>(octave));
        p = p * 2.0f + Float3{17.3f, 5.7f, 11.1f};
        amplitude *= 0.5f;
    }
    return sum;
}

float ridged(Float3 p, int octaves, uint32_t seed)
{
    float sum = 0, amplitude = 0.5f, weight = 1;
    for (int octave = 0; octave < octaves; ++octave)
    {
        const float ridge = ridgeFromNoise(gradientNoise(p, seed + static_cast<uint32_t>(octave))) * weight;
        sum += amplitude * ridge;
        weight = clamp01(ridge * 1.6f);
        p = p * 2.0f + Float3{3.1f, 13.7f, 7.9f};
        amplitude *= 0.5f;
    }
    return sum;
}

float TileNoise::gradient(Float2 uv) const
{
    const float x = uv.x * static_cast<float>(cells), y = uv.y * static_cast<float>(cells);
    const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const auto corner = [&](int dx, int dy)
    {
        const uint32_t hash = hashLattice(wrapCell(ix + dx, cells), wrapCell(iy + dy, cells), cells, seed);
        return gradient2(hash >> 20, fx - static_cast<float>(dx), fy - static_cast<float>(dy));
    };
    const float u = fade(fx);
    return lerp(lerp(corner(0, 0), corner(1, 0), u), lerp(corner(0, 1), corner(1, 1), u), fade(fy));
}

float TileNoise::fbm(Float2 uv, int octaves) const
{
    float sum = 0, amplitude = 0.5f;
    for (int octave = 0; octave < octaves; ++octave)
    {
        sum += amplitude * TileNoise{cells << octave, seed + static_cast<uint32_t>(octave)}.gradient(uv);
        amplitude *= 0.5f;
    }
    return sum;
}

float TileNoise::ridged(Float2 uv, int octaves) const
{
    float sum = 0, amplitude = 0.5f, weight = 1;
    for (int octave = 0; octave < octaves; ++octave)
    {
        const TileNoise noise{cells << octave, seed + static_cast<uint32_t>(octave)};
        const float ridge = ridgeFromNoise(noise.gradient(uv)) * weight;
        sum += amplitude * ridge;
        weight = clamp01(ridge * 1.6f);
        amplitude *= 0.5f;
    }
    return sum;
}

TileNoise::Cell TileNoise::cellular(Float2 uv) const
{
    const float x = uv.x * static_cast<float>(cells), y = uv.y * static_cast<float>(cells);
    const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
    Cell cell{8.0f, 8.0f, 0};
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
        {
            const uint32_t hash =
                hashLattice(wrapCell(ix + dx, cells), wrapCell(iy + dy, cells), cells, seed);
            const float px = static_cast<float>(ix + dx) + static_cast<float>(hash & 0xFFFFu) * 0x1p-16f;
            const float py = static_cast<float>(iy + dy) + static_cast<float>(hash >> 16) * 0x1p-16f;
            const float distance = std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
            if (distance < cell.nearest)
                cell = {distance, cell.nearest, hash};
            else
                cell.second = std::min(cell.second, distance);
        }
    return cell;
}

} // namespace hearth::samples
