// Finds the materials of a source and the names of its images: hearth-textures may give materials other
// images than the importer did, and makes some itself.
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

/// Return the string table of a source: that of the textures (or texels) part if it has one, which begins
/// with the import part's and goes on with names of images that hearth-textures has made.
inline std::string_view findStrings(const PackView& import_part, const PackView& textures_part)
{
    return textures_part.strings().empty() ? import_part.strings() : textures_part.strings();
}

/// Return the name of an image of the textures (or texels) part.
inline std::string_view findImageName(const PackView& import_part, const PackView& textures_part,
                                      const ImageRecord& image)
{
    return (textures_part.strings().empty() ? import_part : textures_part).text(image.name);
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
