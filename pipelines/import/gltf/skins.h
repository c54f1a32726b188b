// Writes skins: the joints that move each mesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"

namespace hearth::import
{

/// Inverse bind matrices of a skin, one for each joint.
using InverseBinds = std::vector<Transform>;

/// Write all skins to the part and return their matrices. errors: gltf_value, gltf_data.
Result<std::vector<InverseBinds>> writeSkins(const GltfModel& model, GltfAccessors& accessors,
                                             const GltfContext& context);

} // namespace hearth::import
