// Gradient noise over an integer lattice and the sums of octaves built from it; deterministic on every
// machine. K. Perlin, "Improving Noise", 2002 (fade and idea); lattice hash and gradients are our own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

namespace hearth::samples
{

/// Return a well mixed 32-bit hash of three integers and a seed.
uint32_t hashLattice(int x, int y, int z, uint32_t seed);

/// Return a number in [0, 1) for each index of a seed.
float randomUnit(uint32_t index, uint32_t seed);

/// Return gradient noise: about [-1, 1], 0 at lattice points, continuous second derivative.
float gradientNoise(Float3 p, uint32_t seed);

/// Return fractal noise, a sum of octaves, each twice as fine and half as strong; about [-1, 1].
float fbm(Float3 p, int octaves, uint32_t seed);

/// Return ridged noise: ridges where the noise crosses zero, finer ridges only on coarse ones; [0, 1].
float ridged(Float3 p, int octaves, uint32_t seed);

/// Noise over the unit square that tiles. `cells` lattice cells along a side.
struct TileNoise
{
    int cells = 8;
    uint32_t seed = 0;

    float gradient(Float2 uv) const;
    float fbm(Float2 uv, int octaves) const;
    float ridged(Float2 uv, int octaves) const;
    /// Distances to the nearest and the second nearest of one random point per cell, in cells; and the
    /// nearest point's hash.
    struct Cell
    {
        float nearest;
        float second;
        uint32_t hash;
    };
    Cell cellular(Float2 uv) const;
};

} // namespace hearth::samples
