// Counts the errors of texels, of which nearly all stay below some error.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Histogram of the errors of texels, as texelError.
class ErrorHistogram
{
public:
    ErrorHistogram(formats::ImageRole role, Channels channels) : role_(role), channels_(channels) {}

    /// Add texels as shaders read them.
    /// plain, stored  of equal size
    void add(std::span<const formats::DecodedTexel> plain, std::span<const formats::DecodedTexel> stored);

    void add(const ErrorHistogram& other);

    /// Return the error that 99.9 % of the texels do not exceed: rounded up to a step, 1/4095 of the largest.
    double findPercentile() const;

private:
    formats::ImageRole role_;
    Channels channels_;
    std::vector<uint32_t> counts_{}; ///< [step]; empty until texels are added
};

} // namespace hearth::texels
