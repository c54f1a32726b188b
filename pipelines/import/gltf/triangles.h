// Converts index lists of triangle strips and fans to triangle lists.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/model.h"

namespace hearth::import
{

/// Return the triangles of a list, strip or fan, all with the winding of the first. Indices at the end that
/// form no whole triangle are dropped.
std::vector<uint32_t> makeTriangleList(std::vector<uint32_t> indices, PrimitiveMode mode);

} // namespace hearth::import
