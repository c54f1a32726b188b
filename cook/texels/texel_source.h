// Reads the images of a source: the materials of its import part, and the plain mips of its textures part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"
#include "formats/base/result.h"
#include "formats/pack/image_uses.h"
#include "formats/pack/pack_view.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::texels
{

/// An image with the data that it refers to.
struct LoadedImage
{
    formats::ChunkData data;
    PlainImage image{};
    std::string name{};
    Error place{}; ///< file and place of the image, for messages
};

class TexelSource
{
public:
    /// errors: those of ContainerReader; meaning_reference where the parts are not of one source
    static Result<TexelSource> open(const std::string& import_path, const std::string& textures_path);

    std::span<const formats::ImageRecord> images() const { return textures_.images(); }
    /// Materials and layers that differ from those of the import part; empty: none do.
    std::span<const formats::MaterialRecord> changedMaterials() const { return textures_.materials(); }
    std::span<const formats::MaterialLayersRecord> changedLayers() const
    {
        return textures_.materialLayers();
    }

    /// Strings of the import part, followed by names of images that it does not have; empty: there are none.
    std::string_view changedStrings() const { return textures_.strings(); }

    /// Load an image. errors: those of PackView::imageData; meaning_value and chunk_size where its record
    /// does not describe plain mips
    Result<LoadedImage> load(uint32_t index) const;

private:
    TexelSource(formats::PackView import_part, formats::PackView textures)
        : import_part_(std::move(import_part)), textures_(std::move(textures))
    {
    }

    formats::PackView import_part_;
    formats::PackView textures_;
    std::vector<std::vector<formats::ImageUse>> uses_{};
};

} // namespace hearth::texels
