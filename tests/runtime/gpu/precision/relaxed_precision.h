// Checks and emulates RelaxedPrecision in SPIR-V modules.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::test
{

struct PrecisionCounts
{
    uint32_t arithmetic = 0; ///< instructions that compute floats from floats
    uint32_t relaxed = 0;    ///< of them with RelaxedPrecision
};

PrecisionCounts countPrecisions(std::span<const uint32_t> words);

/// True if anything in a module, a member of a struct as well, has RelaxedPrecision.
bool hasRelaxedPrecision(std::span<const uint32_t> words);

/// Describe each relaxed value from which a place in a texture is computed that has to be full: coordinates
/// and derivatives of samples with derivatives, which those of materials are; coordinates and depths of
/// comparisons with shadow maps. They come from positions, barycentrics and normals of triangles. Functions
/// must have been inlined. Conditions of branches are not followed.
std::vector<std::string> findRelaxedPlaces(std::span<const uint32_t> words);

/// Return the module with RelaxedPrecision on all arithmetic.
std::vector<uint32_t> relaxEverything(std::span<const uint32_t> words);

/// Return the module with halves in place of relaxed values, as a device with the least precision has them:
/// each relaxed instruction rounds its operands and its result to 16 bits, values below 6e-5 to 0. Sums of
/// products, powers and lengths round after each step. Samples of textures round their result.
std::vector<uint32_t> roundRelaxedToHalf(std::span<const uint32_t> words);

} // namespace hearth::test
