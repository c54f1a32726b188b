// Measures how far decoded texels are from plain ones, as the role of an image asks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"
#include "formats/base/double3.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Return the direction that a shader makes of x and y of a normal map's texel.
Double3 directionFromXy(const formats::DecodedTexel& texel);

/// Sum of the errors of texels of one mip. Squares are those of
///   color, emissive, data  codes as shares of their range; a mean over the channels, of data the worst one
///   cutout                 the same of colour times alpha, and of alpha
///   normal                 angles in radians between unit vectors
///   light                  log2(1 + v): stops
/// Sums of codes are whole numbers: their order does not matter.
class ErrorSum
{
public:
    ErrorSum(formats::ImageRole role, Channels channels) : role_(role), channels_(channels) {}

    /// Add texels as shaders read them.
    /// plain, stored  of equal size
    void add(std::span<const formats::DecodedTexel> plain, std::span<const formats::DecodedTexel> stored);

    void add(const ErrorSum& other);

    uint64_t count() const { return count_; }

    /// Return the mean square of each channel that counts; of normals and cutouts in the first elements.
    std::array<double, 4> meanSquares() const;

private:
    /// codes  tells the four numbers of a texel whose differences count
    template <typename Codes>
    void addCodes(std::span<const formats::DecodedTexel> plain, std::span<const formats::DecodedTexel> stored,
                  const Codes& codes);

    formats::ImageRole role_;
    Channels channels_;
    uint64_t count_ = 0;
    std::array<uint64_t, 4> whole_{}; ///< squares of 16-bit codes, 2^32 texels of them without overflow
    std::array<double, 4> real_{};    ///< of normals and light
};

/// Return the error of an image: the root of the mean over its mips, of data of its worst channel. Mips
/// without texels do not count; 0 if none has any.
double combineMips(formats::ImageRole role, Channels channels, std::span<const ErrorSum> mips);

/// The same of mips with texels, by the mean squares of their channels, as ErrorSum::meanSquares.
double combineMips(formats::ImageRole role, Channels channels, std::span<const std::array<double, 4>> mips);

/// Return the error of one texel: its largest difference of a channel, or its angle, or stops.
double texelError(formats::ImageRole role, Channels channels, const formats::DecodedTexel& plain,
                  const formats::DecodedTexel& stored);

/// Find the largest difference of a channel of each texel, in 16-bit codes; of cutouts after weighting by
/// alpha.
/// role                        neither normal nor light
/// plain, stored, differences  of equal size
void findCodeDifferences(formats::ImageRole role, Channels channels,
                         std::span<const formats::DecodedTexel> plain,
                         std::span<const formats::DecodedTexel> stored, std::span<uint16_t> differences);

/// Return the number of mips that an error is measured on: the first four, of those with sides of 64 texels
/// or more; at least one. Each of them is what some distance shows at a texel a pixel.
uint32_t countMeasuredMips(const formats::ImageRecord& image);

} // namespace hearth::texels
