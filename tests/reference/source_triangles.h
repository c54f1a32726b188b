// Lists the triangles of a source as import read them, before any cooking.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

/// Return every triangle with nonzero area of every instance of an import part. Corners are snapped to the
/// mesh's grid if three distinct ones remain; id = running number.
Result<std::vector<SceneTriangle>> trianglesOfImportPart(const formats::PackView& part);

} // namespace hearth::reference
