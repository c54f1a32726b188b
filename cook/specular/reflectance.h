// Makes the table of reflection that shading reads (formats/scene/reflectance_table.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::specular
{

/// Compute the nodes of the table, cosines first: scale, bias, turn and cosine of half-angle
/// (formats/gpu_shared/reflectance.h) as half floats, the first in the lowest bits.
std::vector<uint64_t> cookReflectance();

/// Write the table as the C++ header of formats/scene.
std::string formatReflectance(const std::vector<uint64_t>& table);

} // namespace hearth::specular
