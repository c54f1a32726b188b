// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/probe.h"

#include "cook/probes/harmonics.h"
#include "cook/probes/prefilter.h"
#include "cook/probes/sharp_mips.h"
#include "formats/records/texel_format.h"
#include "formats/scene/scene_lighting.h"
#include "formats/texels/shared_exponent.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;

void packHarmonics(const WindowedHarmonics& harmonics, double scale, formats::ProbeRecord& record)
{
    for (size_t i = 0; i < harmonics.radiance.size(); ++i)
    {
        const Float3 color = narrow(harmonics.radiance[i] * scale);
        for (int c = 0; c < 3; ++c)
            record.harmonics[3 * i + static_cast<size_t>(c)] = color[c];
    }
    record.window = static_cast<float>(harmonics.window);
}

/// Sums over stored texels, weighted by solid angle.
struct StorageError
{
    double square = 0; ///< of the texels
    double error = 0;  ///< square of what storing changed
};

/// Store the texels of a mip.
void packMip(const ProbeMip& mip, std::vector<uint32_t>& texels, StorageError& sums)
{
    const Environment faces{Layout::cube, mip.side, mip.side, {}};
    for (size_t i = 0; i < mip.texels.size(); ++i)
    {
        const Double3 color = mip.texels[i];
        const uint32_t word = formats::encodeSharedExponent({color.x, color.y, color.z});
        const std::array<float, 3> stored = formats::decodeSharedExponent(word);
        const Double3 change = Double3{double{stored[0]}, double{stored[1]}, double{stored[2]}} - color;
        const double solid_angle =
            panelSolidAngle(Layout::cube, faces.area(static_cast<uint32_t>(i % mip.side),
                                                     static_cast<uint32_t>(i / mip.side % mip.side)));
        sums.square += dot(color, color) * solid_angle;
        sums.error += dot(change, change) * solid_angle;
        texels.push_back(word);
    }
}

} // namespace

Result<Probe> cookProbe(const Environment& environment, const std::string& name, uint32_t side,
                        uint32_t max_side)
{
    HEARTH_ASSERT(std::has_single_bit(side) && side >= 32 && side <= 1024);
    const Harmonics harmonics = projectRadiance(environment);
    Probe probe;
    formats::ProbeRecord& record = probe.record;
    record.irradiance = narrow(meanIrradiance(harmonics));
    record.irradiance_luminance = shared::luminance(record.irradiance);
    if (!(record.irradiance_luminance >= std::numeric_limits<float>::min()))
        return Error{Issue::image_unsupported, name, "",
                     "the environment has no light: there is nothing to reflect"};
    if (!std::isfinite(record.irradiance_luminance))
        return Error{Issue::image_unsupported, name, "", "the environment is brighter than floats can be"};
    const double scale = 1 / double{record.irradiance_luminance};
    packHarmonics(windowHarmonics(harmonics), scale, record);

    const std::vector<ProbeMip> mips =
        prefilter(buildRadianceTree(environment, scale, kTreeRowsOfSide * side), side, kProbeMips);
    record.sharp_mips = countSharpMips(environment, side, max_side);
    StorageError sums;
    for (uint32_t mip = record.sharp_mips; mip > 0; --mip)
        packMip(averageSharply(environment, scale, side << mip), probe.texels, sums);
    sums = {};
    for (const ProbeMip& mip : mips)
        packMip(mip, probe.texels, sums);
    double largest = 0;
    for (const Double3& texel : mips[0].texels)
        largest = std::max({largest, texel.x, texel.y, texel.z});
    record.face_size = side;
    record.mip_count = kProbeMips;
    record.format = static_cast<uint32_t>(formats::TexelFormat::rgb9e5_float);
    record.largest = static_cast<float>(largest);
    record.error = static_cast<float>(std::sqrt(sums.error / sums.square));
    record.texels = {0, static_cast<uint32_t>(probe.texels.size())};
    return probe;
}

} // namespace hearth::probes
