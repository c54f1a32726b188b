// Makes the table of reflection that shading reads (formats/scene/reflectance_table.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::specular
{

/// Compute the nodes of the table, cosines first: scale, bias, turn and cosine of half-angle
/// (formats/gpu_shared/reflectance.h) as half floats, the first in the lowest bits.
std::vector<uint64_t> cookReflectance();

/// Write a table as a C++ header of formats/scene.
/// name     of its constant
/// comment  the header's first lines
std::string formatTable(const std::vector<uint64_t>& table, std::string_view name, std::string_view comment);

} // namespace hearth::specular
