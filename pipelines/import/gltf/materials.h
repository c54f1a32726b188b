// Writes materials and the images that they use.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

namespace hearth::import
{

/// Write all materials to the part, and the images that they use: one record for each image and purpose
/// (colour, data, normals). Missing or broken images become a placeholder with a warning.
/// errors: cannot_write.
Status writeMaterials(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context);

} // namespace hearth::import
