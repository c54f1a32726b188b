// hearth extract --probe: writes a light probe of a pack as a table or a picture.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// Write a probe of a pack or a probe part; the output's extension says how:
/// .csv  mip,side,roughness,mean_r,mean_g,mean_b,least,greatest of each mip: means by solid angle, and the
///       least and greatest channel
/// .exr  texels as they are: the six faces of a mip side by side, the mips below each other, the rest 0
/// .png  the same for the eye: pi times the mean radiance of the environment is half of white in linear light
/// errors: usage for another extension, or for an index behind the last probe; chunk_missing if the file
/// has no probe; those of openContainer and
/// checkProbes; cannot_write.
Status extractProbe(const std::string& path, uint32_t index, const std::string& output);

} // namespace hearth::command
