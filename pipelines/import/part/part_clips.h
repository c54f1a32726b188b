// The last step of an import: the clips of the part become as small as their error allows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/compress.h"
#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Compress the clips of a part whose scene and meshes are complete (cook/animation_compression), and note in its report what became of them.
void compressClips(PartBuilder& part, const clips::StatedError& stated);

} // namespace hearth::import
