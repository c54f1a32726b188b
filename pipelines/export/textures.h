// Exports textures: the finest mip of an image as PNG, with the wraps and filters of its use.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"
#include "pipelines/export/omissions.h"

#include <map>

namespace hearth::gltf_export
{

/// Adds images and textures to a document when materials use them, each once.
class TextureSet
{
public:
    TextureSet(GltfDocument& document, const formats::PackView& pack, Omissions& omissions)
        : document_(document), pack_(pack), omissions_(omissions)
    {
    }

    /// Return the use of a texture, which has none if the reference has no image.
    /// errors: those of PackView::imageData
    Result<TextureUse> use(const formats::TextureRef& reference);

private:
    Result<uint32_t> addImage(uint32_t image);

    GltfDocument& document_;
    const formats::PackView& pack_;
    Omissions& omissions_;
    std::map<uint32_t, uint32_t> images_; ///< of the document, by image of the pack
};

} // namespace hearth::gltf_export
