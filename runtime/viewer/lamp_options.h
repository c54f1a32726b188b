// Option --light: weights of the lamps of a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/gpu/scene/light_change.h"

#include <string>
#include <vector>

namespace hearth::viewer
{

/// Weight of all lamps with a name.
struct LampSetting
{
    std::string name;
    Float3 weight{1, 1, 1};
};

/// Parse "NAME=SCALE" or "NAME=R,G,B", and add it. errors: usage.
Status parseLamp(std::string_view text, std::vector<LampSetting>& lamps);

/// Return the weights of the settings, for a frame. Lights that the scene does not draw are left out.
/// errors: usage if the pack has no lamp of a name.
Result<std::vector<gpu::LampWeight>> findLampWeights(std::span<const LampSetting> lamps,
                                                     const formats::PackView& pack, const gpu::Scene& scene);

} // namespace hearth::viewer
