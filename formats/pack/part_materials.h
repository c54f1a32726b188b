// Finds the materials of a source: hearth-textures may give them other images than the importer did.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::formats
{

/// Return the materials of the textures (or texels) part if it has any, else those of the import part. They
/// refer to images of the textures part, and to strings of the import part.
inline std::span<const MaterialRecord> findMaterials(const PackView& import_part,
                                                     const PackView& textures_part)
{
    return textures_part.materials().empty() ? import_part.materials() : textures_part.materials();
}

/// Return the layers of those materials.
inline std::span<const MaterialLayersRecord> findMaterialLayers(const PackView& import_part,
                                                                const PackView& textures_part)
{
    return textures_part.materials().empty() ? import_part.materialLayers() : textures_part.materialLayers();
}

/// Return whether a textures part can be of the same source as an import part: it has the same images in the
/// same order, or materials of its own, one for each of the import part, which know its images.
inline bool matchesImages(const PackView& import_part, const PackView& textures_part)
{
    return textures_part.materials().empty()
               ? textures_part.images().size() == import_part.images().size()
               : textures_part.materials().size() == import_part.materials().size();
}

} // namespace hearth::formats
