// Formats that an image may get on a target, and how its channels are laid out in each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"
#include "cook/texels/rules/families.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Value of Candidate::stored for a channel that is 1 everywhere.
inline constexpr uint8_t kStoredOne = 4;

struct Candidate
{
    const formats::TexelFormatTraits* traits = nullptr;
    std::array<uint8_t, 4> stored{}; ///< image channel of each stored channel: 0 to 3, or kStoredOne
    std::array<formats::Swizzle, 4> swizzle{};
    bool has_two_parts = false; ///< the stored channels are red, three times, and alpha: independent numbers

    double bitsPerTexel() const
    {
        return 8.0 * traits->block_bytes / (1.0 * traits->block_width * traits->block_height);
    }
};

/// Return the compressed formats that an image may get, from the fewest bits a texel on; the last is the one
/// without compression, with 8 bits of each channel that is read, or RGB9E5 for light. Channels that are 0 or
/// 1 in all texels are not stored: the view's swizzle makes them.
std::vector<Candidate> listCandidates(const PlainImage& image, const Families& families);

} // namespace hearth::texels
