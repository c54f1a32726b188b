// Image of a sky, from the probe that a pack has of it (C++ only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/sky.h"
#include "formats/records/probe.h"

#include <memory>
#include <optional>
#include <span>

namespace hearth::shared
{

/// Return the index of the probe of the sky, if there is one.
std::optional<size_t> findSkyProbe(std::span<const formats::ProbeRecord> probes);

/// Make the image of a sky. Its texels are those of the probe's mip that has panels of kSkyImageSide, or the
/// nearest of the mip with the next size.
/// texels  of the probe
std::shared_ptr<const SkyImage> makeSkyImage(const formats::ProbeRecord& probe,
                                             std::span<const uint32_t> texels);

} // namespace hearth::shared
