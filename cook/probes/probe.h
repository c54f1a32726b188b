// Probe of an environment, as parts and packs store it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"
#include "formats/base/result.h"
#include "formats/records/probe.h"

#include <string>
#include <vector>

namespace hearth::probes
{

/// Side of mip 0 of a probe: 524,160 bytes in all.
inline constexpr uint32_t kProbeSide = 128;
/// Mips of a probe: the last of kProbeSide has 4 x 4 texels a face.
inline constexpr uint32_t kProbeMips = 6;

/// Largest side of the sky that the camera sees, where nothing else is set.
inline constexpr uint32_t kMaxSkySide = 512;

struct Probe
{
    formats::ProbeRecord record{}; ///< its texels are those below
    std::vector<uint32_t> texels;  ///< RGB9E5, in the order of the record
};

/// Cook the probe of an environment. It is divided by the luminance of the mean irradiance, so an
/// environment that is twice as bright has the same texels and harmonics. The same for any number of
/// threads.
/// name  of the environment's file, in messages
/// side      of the mip of roughness 0: a power of two from 32 to 1024 (asserted)
/// max_side  of the sharp mips above it, which go no finer than the environment; `side` or less: none
/// errors: image_unsupported for an environment without light, or brighter than floats are
Result<Probe> cookProbe(const environment::Environment& environment, const std::string& name,
                        uint32_t side = kProbeSide, uint32_t max_side = 0);

} // namespace hearth::probes
