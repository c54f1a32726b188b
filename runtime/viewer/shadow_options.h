// Shadow options of the command line.
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
    gpu::ShadowOptions options{.max_maps = shared::kMaxShadowMaps};
    bool fit_maps = true; ///< as many maps as the lights take, and no more than max_maps
    bool fit_near = true; ///< the splits begin and end where the scene does
    bool fit_far = true;
    std::vector<gpu::ShadowSphere> spheres;
};

/// Parse "off", "on" (the default), or settings of shadows that are on: "texels=2048,bias=4". errors: usage.
Status parseShadows(std::string_view text, ShadowSettings& settings);

/// Parse "clusters" (the default) or "proxies". errors: usage.
Status parseShadowCasters(std::string_view text, ShadowSettings& settings);

/// Parse one more sphere beside those of the pack: "X,Y,Z,RADIUS", and for a single light ",LIGHT". errors:
/// usage.
Status parseShadowSphere(std::string_view text, ShadowSettings& settings);

/// Fit the options to these cameras, at least one, in a static scene. For a camera inside the scene the
/// splits begin at a thousandth of their far end.
gpu::ShadowOptions fitShadows(const ShadowSettings& settings, const formats::PackView& pack,
                              std::span<const shared::Camera> cameras);

} // namespace hearth::viewer
