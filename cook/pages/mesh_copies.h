// Appends copies of meshes to a clusters part, so that instances of one mesh can have vertices of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <span>
#include <string>

namespace hearth::pages
{

/// Return the bytes that one more copy of a mesh takes in a file: its records and stored pages.
uint64_t countCopyBytes(const formats::PackView& part, uint32_t mesh);

/// Write a clusters part with copies of meshes behind its own: the same names, levels, triangles and pages.
/// part     whose hierarchy is checked
/// meshes   of the part, one for each copy, in the order of the copies
/// errors: input_too_large if a table would grow past 32-bit indices; cannot_write
Status copyMeshes(const formats::PackView& part, std::span<const uint32_t> meshes,
                  const std::string& output_path);

} // namespace hearth::pages
