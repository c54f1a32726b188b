// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <limits>

namespace hearth::test
{

namespace
{

/// Make a probe a valid one within the scene.
void makeLocal(formats::ProbeRecord& probe)
{
    probe.flags = formats::kProbeIsLocal;
    probe.position = {1, 1, 1};
    probe.box_max = {3, 3, 3};
    probe.influence_min = {-1, -1, -1};
    probe.influence_max = {4, 4, 4};
    probe.fade = 1;
}

} // namespace

const std::vector<MalformedPack>& malformedProbes()
{
    static const std::vector<MalformedPack> list = {
        {"probeFaceSize", Issue::meaning_value, "probe 0", [](PackModel& p) { p.probes[0].face_size = 3; }},
        {"probeWithoutFaces", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].face_size = 0; }},
        {"probeLargeFaces", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].face_size = 1u << 31; }},
        {"probeOneMip", Issue::meaning_value, "probe 0", [](PackModel& p) { p.probes[0].mip_count = 1; }},
        {"probeManyMips", Issue::meaning_value, "probe 0", [](PackModel& p) { p.probes[0].mip_count = 3; }},
        {"probeSharpMips", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].sharp_mips = 40; }},
        {"probeFinerThanItsTexels", Issue::meaning_range, "probe 0",
         [](PackModel& p) { p.probes[0].sharp_mips = 1; }},
        {"probeTwoSkies", Issue::meaning_value, "probe 1",
         [](PackModel& p)
         {
             p.probes[0].flags = formats::kProbeIsSky;
             p.probes.push_back(p.probes[0]);
             p.probes[1].texels.first = p.probes[0].texels.count;
             p.probe_texels.insert(p.probe_texels.end(), p.probe_texels.begin(), p.probe_texels.end());
         }},
        {"probeFormat", Issue::meaning_value, "probe 0", [](PackModel& p) { p.probes[0].format = 0; }},
        {"probeFlags", Issue::meaning_padding, "probe 0", [](PackModel& p) { p.probes[0].flags = 4; }},
        {"probeReserved", Issue::meaning_padding, "probe 0",
         [](PackModel& p) { p.probes[0].reserved[1] = 1; }},
        {"probePlaceOfNone", Issue::meaning_padding, "probe 0",
         [](PackModel& p) { p.probes[0].box_max.y = 1; }},
        {"probeSkyWithin", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].flags |= formats::kProbeIsSky;
         }},
        {"probeLocalTooLarge", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].face_size = 128;
         }},
        {"probeLocalSharp", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].sharp_mips = 1;
         }},
        {"probeOutsideOfItsBox", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].box_min.x = 2;
         }},
        {"probeOutsideOfItsInfluence", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].influence_max.z = 0;
         }},
        {"probeWithoutFade", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].fade = 0;
         }},
        {"probeSkyShare", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].sky_share[3] = std::numeric_limits<float>::infinity();
         }},
        {"probeLampHarmonic", Issue::meaning_value, "probe 0",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             p.probes[0].lamp_harmonics[8] = std::numeric_limits<float>::quiet_NaN();
         }},
        {"probeLampHarmonicOfASky", Issue::meaning_padding, "probe 0",
         [](PackModel& p) { p.probes[0].lamp_harmonics[0] = 1; }},
        {"probeLocalOfAnotherSize", Issue::meaning_value, "probe 1",
         [](PackModel& p)
         {
             makeLocal(p.probes[0]);
             formats::ProbeRecord other = p.probes[0];
             other.face_size = 4;
             other.texels = {p.probes[0].texels.count, 120};
             p.probes.push_back(other);
             p.probe_texels.resize(150);
         }},
        {"probeIrradiance", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].irradiance.z = -1; }},
        {"probeDark", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].irradiance_luminance = 0; }},
        {"probeHarmonic", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].harmonics[26] = std::numeric_limits<float>::quiet_NaN(); }},
        {"probeWindow", Issue::meaning_value, "probe 0", [](PackModel& p) { p.probes[0].window = -0.1f; }},
        {"probeLargest", Issue::meaning_value, "probe 0",
         [](PackModel& p) { p.probes[0].largest = std::numeric_limits<float>::infinity(); }},
        {"probeError", Issue::meaning_value, "probe 0", [](PackModel& p) { p.probes[0].error = -1; }},
        {"probeFewTexels", Issue::meaning_range, "probe 0",
         [](PackModel& p) { p.probes[0].texels.count = 29; }},
        {"probeTexelsBehindTheEnd", Issue::meaning_range, "probe 0",
         [](PackModel& p) { p.probe_texels.pop_back(); }},
        {"probeTexelsOfNone", Issue::meaning_range, "probe texels 30",
         [](PackModel& p) { p.probe_texels.push_back(0); }},
        {"probeTexelsTwice", Issue::meaning_order, "probe 1",
         [](PackModel& p) { p.probes.push_back(p.probes[0]); }},
    };
    return list;
}

} // namespace hearth::test
