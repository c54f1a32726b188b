// Widens the roughness of mips by the normals that the mips of a normal map lose: a bumpy surface that
// is far away looks rough. The length of a mean of unit normals tells how much they spread. Sources: M.
// Toksvig, "Mipmapping Normal Maps", 2005; A. Banerjee and others, "Clustering on the Unit Hypersphere
// using von Mises-Fisher Distributions", 2005 (spread from length); C. Han and others, "Frequency
// Domain Normal Map Filtering", 2007.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/halve.h"
#include "formats/records/scene.h"

#include <cstddef>
#include <span>

namespace hearth::textures
{

/// Normal map of a material, and the factors that a shader applies to it and to the roughness.
struct NormalSource
{
    formats::ImageRecord image{};        ///< width, height and format are read; a normal map
    std::span<const std::byte> texels{}; ///< of the finest mip; must outlive the filter
    float normal_scale = 1;
    float roughness_factor = 1; ///< above 0
};

/// Compute the variance of normals from the length of their mean: of their slopes about the mean, in each of
/// two directions.
///
/// mean_length  0 to 1: length of the mean of unit normals
/// step_error   variance that the steps of stored normals have by themselves, which is no roughness
float lostVariance(float mean_length, float step_error);

/// Filter of the mips of a roughness image, for one normal map. Same result for any number of threads.
class RoughnessFilter
{
public:
    explicit RoughnessFilter(const NormalSource& source) : source_(source) {}

    /// Widen the roughness (y) of working texels of a mip. Mips come from fine to coarse. Texels whose
    /// normals are alike stay as they are, and so does a mip that is no smaller than the normal map.
    void apply(FloatImage& mip);

private:
    FloatImage averageNormals(uint32_t width, uint32_t height);
    void readRow(uint32_t y, std::span<Float4> out) const;

    NormalSource source_;
    FloatImage means_{}; ///< of unit normals, a mip of the normal map; empty: the finest
};

} // namespace hearth::textures
