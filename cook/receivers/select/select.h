// Choice of the lamps that a texel keeps of all that reach it, without seams where the choice changes, and
// without a loss where all are on.
// Source: X. Guo and T. Li, "Practical High-Performance Rendering on Mobile Platforms", GDC 2023, has the
// smooth clamp of the lamps; it keeps three.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/gpu_shared/receivers/receivers.h"

#include <span>
#include <vector>

namespace hearth::receivers
{

struct SelectOptions
{
    /// Colours of a texel, at most, steady light included: 2 to shared::kMaxReceiverColors. With 3 a texel
    /// is one record of 16 bytes, and jumps are seen where the fourth lamp would matter.
    uint32_t max_colors = shared::kMaxReceiverColors;
    /// Shares of a texel's light: lamps below `low` are dropped, those above `high` kept, between them
    /// smoothly dimmed. In ./dev bench receivers these are off by 1 % rms under any weights with 35 bytes
    /// a texel; the 0.02 and 0.04 of the talk by 2.3 % with 30 bytes.
    double low = 0.01;
    double high = 0.03;
};

/// Lamp that a texel keeps.
struct KeptLight
{
    uint32_t lamp;
    Double3 color; ///< irradiance with weight 1
};

/// Return the luminance of linear Rec. 709.
double luminance(Double3 color);

/// Return the largest channel of a color.
double largestChannel(Double3 color);

/// Choose the lamps of a texel.
///
/// A lamp has a share I, its largest channel over that of the sum of all: by luminance a blue lamp would
/// be dropped that is a tenth of all blue. It is dimmed to I (1 - ((b - I) / (b - a))^4) where I is in
/// [a, b], with a and b as shares of the sum; b is no more than the brightest lamp, so that one is kept.
/// If more than max_colors are left, they are dimmed by (Y - Y_n) / (Y / 4), with Y_n the luminance of
/// the brightest that is dropped: all vanish before another takes their place. What is dimmed or dropped
/// is given to the kept ones by their luminance, so the sum of all stays as it is, channel by channel.
///
/// light      [lamps] of irradiance with weight 1, finite and at least 0
/// is_steady  the first is steady light, which is never dimmed
/// kept       replaced by the lamps, rising; none where all are black
void selectLights(std::span<const Float3> light, bool is_steady, const SelectOptions& options,
                  std::vector<KeptLight>& kept);

} // namespace hearth::receivers
