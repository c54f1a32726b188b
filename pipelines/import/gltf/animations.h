// Animations: kept as keys, in the units and the order of the source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"
#include "pipelines/import/gltf/vertices.h"

namespace hearth::import
{

/// Write all animations to the part. Keys whose time does not grow are left out and rotations get length 1, both
/// with a warning. errors: gltf_value, gltf_data, input_too_large.
Status writeAnimations(const GltfModel& model, GltfAccessors& accessors, const GltfContext& context,
                       GltfTally& tally);

/// Morph targets of a mesh: the most that one of its primitives has.
size_t morphTargetCount(const GltfMesh& mesh);

} // namespace hearth::import
