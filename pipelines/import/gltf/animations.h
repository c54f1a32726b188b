// Writes animations as keys, in the units and the order of the source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"
#include "pipelines/import/gltf/vertices.h"

namespace hearth::import
{

/// Write all animations to the part, whose lights are complete. A light's channel becomes one for each node
/// that has the light. Keys whose time does not increase are dropped, rotations are normalised, and values of
/// lights are clamped to their range, all with a warning. errors: gltf_value, gltf_data, input_too_large.
Status writeAnimations(const GltfModel& model, GltfAccessors& accessors, const GltfContext& context,
                       GltfTally& tally);

/// Return the number of morph targets of a mesh: the maximum over its primitives.
size_t morphTargetCount(const GltfMesh& mesh);

} // namespace hearth::import
