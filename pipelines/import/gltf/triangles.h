// Index lists of triangles, strips and fans.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/model.h"

namespace hearth::import
{

/// Triangles of a list, strip or fan, all with the winding of the first. Indices that make no whole triangle at the
/// end are left out.
std::vector<uint32_t> triangulated(std::vector<uint32_t> indices, PrimitiveMode mode);

} // namespace hearth::import
