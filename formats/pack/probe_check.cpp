// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"
#include "formats/records/texel_format.h"

#include <algorithm>
#include <bit>

namespace hearth::formats::check
{

namespace
{

constexpr const char* kProbeKind = "probe";
// Largest side of a face: larger images are no use for reflections, and sums of texels fit 32 bits.
constexpr uint32_t kMaxProbeSide = 4096;
constexpr uint32_t kMaxSharpMips = 8;

/// Check that the position lies in both boxes, which have room for the fade.
Status checkLocalProbe(const PackView& view, size_t i, const ProbeRecord& probe)
{
    const auto wrong = [&](std::string detail)
    { return makeError(view, Issue::meaning_value, kProbeKind, i, std::move(detail)); };
    if (probe.face_size > kMaxLocalProbeSide || probe.sharp_mips != 0)
        return wrong("it is local, and has faces of " + std::to_string(finestProbeSide(probe)) + " texels");
    const auto holds = [&](Float3 low, Float3 high)
    { return isValidBox(low, probe.position) && isValidBox(probe.position, high); };
    if (!holds(probe.box_min, probe.box_max) || !holds(probe.influence_min, probe.influence_max))
        return wrong("it is outside of its boxes");
    if (!isNonNegative(probe.fade) || probe.fade == 0)
        return wrong("its fade distance is not possible");
    if (!finite(std::span<const float>(probe.sky_share)))
        return wrong("its share of the sky is not finite");
    if (!finite(std::span<const float>(probe.lamp_harmonics)))
        return wrong("a harmonic of lamps is not finite");
    return success();
}

bool hasNoPlace(const ProbeRecord& probe)
{
    const auto is_zero = [](float value) { return value == 0; };
    return probe.position == Float3{} && probe.box_min == Float3{} && probe.box_max == Float3{} &&
           probe.influence_min == Float3{} && probe.influence_max == Float3{} && probe.fade == 0 &&
           std::ranges::all_of(probe.sky_share, is_zero) &&
           std::ranges::all_of(probe.lamp_harmonics, is_zero);
}

Status checkProbe(const PackView& view, size_t i, const ProbeRecord& probe)
{
    const auto wrong = [&](std::string detail)
    { return makeError(view, Issue::meaning_value, kProbeKind, i, std::move(detail)); };
    if (!std::has_single_bit(probe.face_size) || probe.face_size > kMaxProbeSide)
        return wrong("faces of " + std::to_string(probe.face_size) + " texels");
    if (probe.mip_count < 2 || probe.mip_count > static_cast<uint32_t>(std::bit_width(probe.face_size)))
        return wrong(std::to_string(probe.mip_count) + " mips");
    if (probe.sharp_mips > kMaxSharpMips || finestProbeSide(probe) > kMaxProbeSide)
        return wrong(std::to_string(probe.sharp_mips) + " sharp mips");
    if (probe.format != static_cast<uint32_t>(TexelFormat::rgb9e5_float))
        return wrong("texel format " + std::to_string(probe.format));
    const Float3 irradiance = probe.irradiance;
    if (!isNonNegative(irradiance.x) || !isNonNegative(irradiance.y) || !isNonNegative(irradiance.z) ||
        !isNonNegative(probe.irradiance_luminance) || probe.irradiance_luminance == 0)
        return wrong("its irradiance is not possible");
    if (!finite(std::span<const float>(probe.harmonics)))
        return wrong("a harmonic is not finite");
    if (!isNonNegative(probe.window) || !isNonNegative(probe.largest) || !isNonNegative(probe.error))
        return wrong("its window, largest value or error is not possible");
    if ((probe.flags & kProbeIsSky) != 0 && isLocalProbe(probe))
        return wrong("it is the sky and local");
    if (isLocalProbe(probe))
        HEARTH_TRY(checkLocalProbe(view, i, probe));
    else if (!hasNoPlace(probe))
        return makeError(view, Issue::meaning_padding, kProbeKind, i, "it is not local, but has a place");
    if ((probe.flags & ~(kProbeIsSky | kProbeIsLocal)) != 0 || !reservedZero(probe.reserved))
        return makeError(view, Issue::meaning_padding, kProbeKind, i, "a reserved field is not 0");
    if (const uint64_t count = cubeTexelCount(finestProbeSide(probe), countProbeMips(probe));
        probe.texels.count != count)
        return makeError(view, Issue::meaning_range, kProbeKind, i,
                         std::to_string(probe.texels.count) + " texels, its mips have " +
                             std::to_string(count));
    return success();
}

} // namespace

Status checkProbeTables(const PackView& view)
{
    RangeCursor texels(view, kProbeKind, "probe texels", view.probeTexels().size());
    uint32_t skies = 0;
    for (size_t i = 0; i < view.probes().size(); ++i)
    {
        HEARTH_TRY(checkProbe(view, i, view.probes()[i]));
        skies += view.probes()[i].flags & kProbeIsSky;
        if (skies > 1)
            return makeError(view, Issue::meaning_value, kProbeKind, i, "it is a second sky");
        HEARTH_TRY(texels.take(i, view.probes()[i].texels));
    }
    const auto first = std::ranges::find_if(view.probes(), isLocalProbe);
    for (auto other = first; other != view.probes().end(); ++other)
        if (isLocalProbe(*other) &&
            (other->face_size != first->face_size || other->mip_count != first->mip_count))
            return makeError(view, Issue::meaning_value, kProbeKind,
                             static_cast<size_t>(other - view.probes().begin()),
                             "it has another size than the first local probe");
    return texels.finish();
}

} // namespace hearth::formats::check
