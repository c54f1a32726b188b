// The triangles of a source as import read them, before any cooking.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

/// Every triangle of every instance of an import part that has an area, in its mesh, with its corners on the mesh's grid
/// (where it still has three); id = running number.
Result<std::vector<SceneTriangle>> trianglesOfImportPart(const formats::PackView& part);

} // namespace hearth::reference
