// hearth extract --part specular: writes the table of specular occlusion as CSV.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// Write the table of a pack or specular part as CSV: aperture,roughness,cos_beta,value for each of its 4096
/// nodes, aperture fastest. aperture is half-angle / 90 degrees.
/// errors: chunk_missing if the file has no table; those of openContainer; cannot_write.
Status extractSpecular(const std::string& path, const std::string& output);

} // namespace hearth::command
