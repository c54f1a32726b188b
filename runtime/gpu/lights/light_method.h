// Methods of lighting a frame by many lights: one table for the renderer, its programs and its tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/specialization.h"

#include <cstdint>
#include <iterator>

namespace hearth::gpu
{

enum class LightMethod : uint8_t
{
    practical, ///< the default
    all,
    count,
};
inline constexpr size_t kLightMethodCount = static_cast<size_t>(LightMethod::count);

struct LightMethodFacts
{
    const char* name; ///< of --lights
    const char* summary;
    uint32_t light_list; ///< shared::kLightList*: lights that a pixel evaluates
};

/// Facts by LightMethod. Methods that add lights in one order draw the same bytes.
inline constexpr LightMethodFacts kLightMethods[] = {
    {"practical", "each pixel evaluates the lights of its cell of a grid over the view",
     shared::kLightListCells},
    {"all", "each pixel evaluates all lights of the frame", shared::kLightListFrame},
};
static_assert(std::size(kLightMethods) == kLightMethodCount);

constexpr const LightMethodFacts& lightMethodFacts(LightMethod method)
{
    return kLightMethods[static_cast<size_t>(method)];
}

} // namespace hearth::gpu
