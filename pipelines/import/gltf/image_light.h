// Reads the image-based light of the scene that is drawn: the sky of the part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

namespace hearth::import
{

/// Set PartBuilder::sky to the light of the scene (EXT_lights_image_based), if it has one. Its radiance
/// is that of the faces of mip 0; coarser mips and coefficients follow from these. A light of another
/// scene, or without radiance, is dropped with a warning.
/// errors: those of reading the images; gltf_extension_value where they are no faces of a cube;
/// image_unsupported where they are no RGBD; number_too_large.
Status readSky(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context);

} // namespace hearth::import
