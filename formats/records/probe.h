// Chunks of light probes: an environment's light as surfaces of each roughness reflect it, and its
// harmonics. See FORMAT.md, "Probes".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

#include <cmath>

namespace hearth::formats
{

inline constexpr uint32_t kChunkProbes = fourCC("PROB");      ///< ProbeRecord[]
inline constexpr uint32_t kChunkProbeTexels = fourCC("PRTX"); ///< u32[]: texels of all probes

/// Numbers of ProbeRecord::harmonics: three colours for each of nine harmonics.
inline constexpr uint32_t kProbeHarmonicValues = 27;

/// Bit of ProbeRecord::flags: the environment is the scene's sky, which the camera and all light cookers see.
/// At most one probe has it.
inline constexpr uint32_t kProbeIsSky = 1;

/// Bit of ProbeRecord::flags: the environment is what a point within the scene sees. All probes that
/// have it have faces of one size, and as many mips.
inline constexpr uint32_t kProbeIsLocal = 2;

/// Largest face_size of a local probe: on the GPU it takes 173 KB.
inline constexpr uint32_t kMaxLocalProbeSide = 64;

/// Light of surroundings, divided by the luminance of their mean irradiance.
struct ProbeRecord
{
    uint32_t face_size;
    uint32_t mip_count;
    uint32_t format;
    uint32_t flags;
    Float3 irradiance;
    float irradiance_luminance;
    float harmonics[kProbeHarmonicValues];
    float window;
    float largest;
    float error;
    Range texels;
    uint32_t sharp_mips;
    // of local probes, world space, metres; 0 of others
    Float3 position;
    Float3 box_min;
    Float3 box_max;
    Float3 influence_min;
    Float3 influence_max;
    float fade;
    float sky_share[4];
    float lamp_harmonics[9];
    uint32_t reserved[2];
};

/// Return whether a probe is one within the scene.
constexpr bool isLocalProbe(const ProbeRecord& probe)
{
    return (probe.flags & kProbeIsLocal) != 0;
}

/// Return the roughness of mip 0, 1, ... mip_count - 1 without the sharp ones, from 0 to 1; at least two
/// mips. A roughness r is found at lod (mip_count - 1) r (2 - r).
inline double probeMipRoughness(uint32_t mip, uint32_t mip_count)
{
    return 1 - std::sqrt(1 - static_cast<double>(mip) / (mip_count - 1));
}

/// Return the number of texels of all mips of a cube.
constexpr uint64_t cubeTexelCount(uint32_t face_size, uint32_t mip_count)
{
    uint64_t count = 0;
    for (uint32_t mip = 0; mip < mip_count; ++mip)
        count += uint64_t{6} * (face_size >> mip) * (face_size >> mip);
    return count;
}

/// Return the texels of an edge of the finest mip.
constexpr uint32_t finestProbeSide(const ProbeRecord& probe)
{
    return probe.face_size << probe.sharp_mips;
}

/// Return the number of all mips.
constexpr uint32_t countProbeMips(const ProbeRecord& probe)
{
    return probe.sharp_mips + probe.mip_count;
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::ProbeRecord, 288,
              HEARTH_FIELD(hearth::formats::ProbeRecord, face_size,
                           "texels of an edge of the mip of roughness 0, a power of two"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, mip_count, "from roughness 0 to 1; 2 or more"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, format, "a TexelFormat: rgb9e5"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, flags,
                           "bit 0: the sky of the scene; bit 1: local, within the scene"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, irradiance,
                           "mean irradiance E_probe of the environment: pi times its mean radiance"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, irradiance_luminance, "Y(E_probe), above 0"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, harmonics,
                           "nine colours: coefficients of radiance / Y(E_probe), windowed"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, window,
                           "degree l was attenuated by 1 / (1 + window (l (l + 1))^2)"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, largest,
                           "largest channel at roughness 0 before it was stored; above 65408 it was cut"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, error,
                           "rms error of the mips' stored texels by solid angle, as a share of their rms"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, texels,
                           "of chunk PRTX: mip, face, row, column; sharp mips first"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, sharp_mips,
                           "finer mips than that of roughness 0, for the camera's background"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, position,
                           "of a local probe, as the next fields; world space, metres; of others 0"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, box_min,
                           "box on which its light is taken to lie, for parallax"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, box_max, ""),
              HEARTH_FIELD(hearth::formats::ProbeRecord, influence_min,
                           "box of the surfaces that it lights: on its faces the weight is 0"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, influence_max, ""),
              HEARTH_FIELD(hearth::formats::ProbeRecord, fade,
                           "distance from those faces at which the weight is 1, above 0"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, sky_share,
                           "cosine-weighted share of the sky that it sees about a normal n: "
                           "dot(xyz, n) + w"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, lamp_harmonics,
                           "coefficients of the light that lamps but suns send to it without a bounce: "
                           "luminance over Y(E_probe), as radiance"),
              HEARTH_FIELD(hearth::formats::ProbeRecord, reserved, "0"));
