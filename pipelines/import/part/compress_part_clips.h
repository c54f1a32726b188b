// Compresses the animation clips of a part, the last step of an import, as far as their stated error allows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/compress.h"
#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Compress the clips of a part whose scene and meshes are complete (cook/animation_compression), and note
/// the results in its report.
void compressClips(PartBuilder& part, const animation_compression::StatedError& stated);

} // namespace hearth::import
