// Replaces images of one value by factors of materials.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/container/container_reader.h"
#include "formats/records/material_layers.h"

#include <span>
#include <vector>

namespace hearth::textures
{

/// Take images away from the materials that see one value in them. An occlusion of 1 everywhere changes
/// nothing; one roughness and one metalness are multiplied into the factors. An image that is used for
/// something else too stays, since it has to be stored all the same, and so does a placeholder, which shall
/// be seen.
///
/// images     of the import part `part`
/// materials  changed; references beyond the images are skipped
/// errors: those of readTexels()
Status replaceConstantImages(const formats::ContainerReader& part,
                             std::span<const formats::ImageRecord> images,
                             std::span<const formats::MaterialLayersRecord> layers,
                             std::vector<formats::MaterialRecord>& materials);

} // namespace hearth::textures
