// Settings of what follows the lighting of a frame: exposure, bloom, photo filter.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cmath>
#include <optional>

namespace hearth::gpu
{

/// Exposure that follows the light of the frames before, as eyes do.
struct AutomaticExposure
{
    float key = 0.18f;       ///< luminance that the mean of a frame gets (of logarithms): middle grey
    float time_constant = 1; ///< seconds in which the exposure goes 63 % of the way; 0: at once
    float time_step = 0;     ///< seconds since the last frame; an input, so that runs repeat
};

struct PhotoFilter
{
    Float3 color{1, 1, 1}; ///< linear; what the glass lets through
    float density = 0;     ///< 0: no filter, 1: all light passes it
};

enum class BloomMode : uint8_t
{
    mix, ///< replaces `strength` of the light, and keeps the mean
    add,
};

struct Bloom
{
    float strength = 0; ///< 0: none
    BloomMode mode = BloomMode::mix;
};

/// Neutral by default; other settings need PostSupport. Bloom and automatic exposure need a final pass
/// (TargetOptions::has_final_pass); all else takes place in the shaders of materials where a frame has none.
struct PostSettings
{
    float exposure_stops = 0; ///< factor 2^stops, behind the scene's own exposure and the automatic one
    std::optional<AutomaticExposure> automatic_exposure{};
    PhotoFilter photo_filter{};
    Bloom bloom{};
};

inline bool isNeutral(const PostSettings& settings)
{
    return settings.exposure_stops == 0 && !settings.automatic_exposure &&
           settings.photo_filter.density == 0 && settings.bloom.strength == 0;
}

/// Return the share of the way that automatic exposure goes in a frame: 1 - e^(-dt/tau).
inline float exposureShare(const AutomaticExposure& exposure)
{
    if (!(exposure.time_constant > 0))
        return 1;
    return static_cast<float>(-std::expm1(-double{exposure.time_step} / double{exposure.time_constant}));
}

} // namespace hearth::gpu
