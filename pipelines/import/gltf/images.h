// Writes the images of a glTF file to the part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

#include <map>

namespace hearth::import
{

/// Meaning of a texture's texels, which decides their filtering and compression.
enum class ImagePurpose : uint32_t
{
    color,  ///< sRGB
    data,   ///< occlusion, roughness, metalness
    normal, ///< directions
};

class GltfImages
{
public:
    GltfImages(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context)
        : model_(model), buffers_(buffers), context_(context)
    {
    }

    /// Require that mips of the image keep the area that passes an alpha test; call before the image is
    /// written.
    void setAlphaCutoff(uint32_t image, float cutoff) { alpha_cutoff_of_image_.emplace(image, cutoff); }

    /// Return the part's image for a source image (kInvalidIndex: a texture without an image) and a purpose.
    /// The image is decoded and written on first use; a missing or broken one becomes a placeholder, with a
    /// warning.
    /// user  the image's user, for the warning: "material \"oak\""
    Result<uint32_t> write(uint32_t image, ImagePurpose purpose, const std::string& where,
                           const std::string& user);

    /// Return the texels, or nullopt and a warning.
    std::optional<DecodedImage> decode(uint32_t image, const std::string& where, const std::string& user);

    /// Write an image that the importer has computed.
    Result<uint32_t> writeComputed(const DecodedImage& image, ImagePurpose purpose, const std::string& name,
                                   std::optional<float> alpha_cutoff);

    /// Return the texels. errors: input_missing, those of readUri and decodeImage.
    Result<DecodedImage> read(uint32_t image, const std::string& where) const;

    /// Return the name of an image in messages.
    std::string imageName(uint32_t image) const;

    /// Report the images that no material and no image-based light uses.
    void reportUnused() const;

private:
    /// Warn of what the use does not keep, or reads in another way than the file says.
    void warnOfUse(const DecodedImage& image, ImagePurpose purpose, const std::string& where,
                   const std::string& name);

    const GltfModel& model_;
    const GltfBuffers& buffers_;
    const GltfContext& context_;
    std::map<uint32_t, float> alpha_cutoff_of_image_;
    std::map<std::pair<uint32_t, ImagePurpose>, uint32_t> written_;
    std::map<uint32_t, bool> requested_;
};

} // namespace hearth::import
