// Shadows as the command line asks for them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/pack/pack_view.h"
#include "runtime/gpu/scene/shadow_plan.h"

#include <string_view>

namespace hearth::viewer
{

struct ShadowSettings
{
    gpu::ShadowOptions options;
    bool fit_near = true; ///< the splits begin and end where the scene does
    bool fit_far = true;
    std::vector<gpu::ShadowSphere> spheres;
};

/// "off", "on", or settings of shadows that are on: "texels=2048,bias=4". errors: usage.
Status parseShadows(std::string_view text, ShadowSettings& settings);

/// One more sphere beside those of the pack: "X,Y,Z,RADIUS", and where it is not for all lights, ",LIGHT". errors: usage.
Status parseShadowSphere(std::string_view text, ShadowSettings& settings);

/// The options for these cameras, at least one, where the scene does not move. Of a camera in the scene the splits begin at a
/// thousandth of where they end.
gpu::ShadowOptions fitShadows(const ShadowSettings& settings, const formats::PackView& pack,
                              std::span<const shared::Camera> cameras);

} // namespace hearth::viewer
