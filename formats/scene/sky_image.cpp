// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/sky_image.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::shared
{

using namespace formats;

static_assert(kSkyImageRows * 4 == kSkyImageTexels + 4 * kSkyHarmonics);
static_assert(kProbeHarmonicValues == 3 * kSkyHarmonics);

std::optional<size_t> findSkyProbe(std::span<const ProbeRecord> probes)
{
    const auto found = std::ranges::find_if(probes, [](const ProbeRecord& probe)
                                            { return (probe.flags & kProbeIsSky) != 0; });
    if (found == probes.end())
        return {};
    return static_cast<size_t>(found - probes.begin());
}

std::shared_ptr<const SkyImage> makeSkyImage(const ProbeRecord& probe, std::span<const uint32_t> texels)
{
    HEARTH_ASSERT(texels.size() == probe.texels.count);
    uint32_t mip = 0;
    while (mip + 1 < probe.mip_count && probe.face_size >> (mip + 1) >= kSkyImageSide)
        ++mip;
    const uint32_t side = probe.face_size >> mip;
    const auto all =
        texels.subspan(static_cast<size_t>(cubeTexelCount(finestProbeSide(probe), probe.sharp_mips + mip)));
    const auto image = std::make_shared<SkyImage>();
    for (uint32_t panel = 0; panel < 6; ++panel)
        for (uint32_t y = 0; y < kSkyImageSide; ++y)
            for (uint32_t x = 0; x < kSkyImageSide; ++x)
            {
                const uint32_t row = (2 * y + 1) * side / (2 * kSkyImageSide);
                const uint32_t column = (2 * x + 1) * side / (2 * kSkyImageSide);
                image->texels[(panel * kSkyImageSide + y) * kSkyImageSide + x] =
                    all[(size_t{panel} * side + row) * side + column];
            }
    for (uint32_t i = 0; i < kSkyHarmonics; ++i)
        image->harmonics[i] =
            Float3{probe.harmonics[3 * i], probe.harmonics[3 * i + 1], probe.harmonics[3 * i + 2]} *
            probe.irradiance_luminance;
    image->factor = probe.irradiance_luminance;
    image->sharp_mips = probe.sharp_mips;
    return image;
}

} // namespace hearth::shared
