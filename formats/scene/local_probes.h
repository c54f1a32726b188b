// Local probes of a pack as shading reads them: their rows in the buffer of lights, and the atlas of
// their texels (C++ only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/probes/local_probes.h"
#include "formats/gpu_shared/sky.h"
#include "formats/records/probe.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::shared
{

/// Rows of a local probe in the buffer of lights.
struct LocalProbeTable
{
    LocalProbe probe;
    std::array<Float4, kSkyHarmonics>
        harmonics; ///< of radiance over the mean irradiance's luminance; w: its luminance with lamps
};
static_assert(sizeof(LocalProbeTable) == 16 * kLocalProbeRows);

struct LocalProbes
{
    uint32_t side = 0; ///< texels of an edge of a face at roughness 0
    uint32_t mip_count = 0;
    std::vector<LocalProbeTable> tables; ///< at most kMaxLocalProbes
};

/// Return the first local probes of a pack, as many as are drawn.
LocalProbes makeLocalProbes(std::span<const formats::ProbeRecord> probes);

/// Image of texels in RGB9E5, rows from top to bottom.
struct ProbeAtlas
{
    uint32_t width = 0;
    uint32_t height = 0; ///< 0: there are no local probes
    std::vector<uint32_t> texels;
};

/// Lay out the texels of the local probes that makeLocalProbes returns.
/// texels  of all probes
ProbeAtlas makeProbeAtlas(std::span<const formats::ProbeRecord> probes, std::span<const uint32_t> texels);

} // namespace hearth::shared
