// hearth extract --probe: writes light probes of a pack as a table, or one as a picture.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <optional>
#include <string>

namespace hearth::command
{

/// Write probes of a pack or a probe part; the output's extension says how:
/// .csv  probe,mip,side,roughness,mean_r,mean_g,mean_b,least,greatest of each mip: means by solid angle,
///       and the least and greatest channel
/// .exr  texels of one probe as they are: the six faces of a mip side by side, the mips below each
///       other, the rest 0
/// .png  the same for the eye: pi times the mean radiance of the environment is half of white in linear light
/// index  of the probe; nullopt: all probes, of which a picture holds one only
/// errors: usage for another extension, for an index behind the last probe, or for a picture of several
/// probes; chunk_missing if the file has no probe; those of openContainer and checkProbes;
/// cannot_write.
Status extractProbe(const std::string& path, std::optional<uint32_t> index, const std::string& output);

} // namespace hearth::command
