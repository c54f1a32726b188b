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

/// Return whether a textures part can be of the same source as an import part: it has an image for each one
/// of the import part, in their order. Further ones need materials, which use them.
inline bool matchesImages(const PackView& import_part, const PackView& textures_part)
{
    const size_t images = import_part.images().size(), materials = import_part.materials().size();
    return textures_part.materials().empty()
               ? textures_part.images().size() == images
               : textures_part.images().size() >= images && textures_part.materials().size() == materials;
}

} // namespace hearth::formats
