// The images of a glTF file, as the part keeps them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

#include <map>

namespace hearth::import
{

/// What a texture's texels mean, which decides how they are filtered and compressed.
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

    /// Say that mips of the image must keep the area that passes an alpha test; before it is written.
    void setAlphaCutoff(uint32_t image, float cutoff) { alpha_cutoff_of_image_.emplace(image, cutoff); }

    /// The part's image for this one (or for kNone, a texture without an image) and purpose; decoded and written when it
    /// is first asked for. One that is missing or broken becomes a placeholder, with a warning.
    /// user  what asks for it, for the warning: "material \"oak\""
    Result<uint32_t> write(uint32_t image, ImagePurpose purpose, const std::string& where,
                           const std::string& user);

    /// The texels, or nothing and a warning.
    std::optional<DecodedImage> decode(uint32_t image, const std::string& where, const std::string& user);

    /// Write an image that was made here.
    Result<uint32_t> writeMade(const DecodedImage& image, ImagePurpose purpose, const std::string& name,
                               std::optional<float> alpha_cutoff);

    /// Name the images that nothing asked for.
    void reportUnused() const;

private:
    Result<DecodedImage> read(uint32_t image, const std::string& where);
    std::string nameOf(uint32_t image) const;

    const GltfModel& model_;
    const GltfBuffers& buffers_;
    const GltfContext& context_;
    std::map<uint32_t, float> alpha_cutoff_of_image_;
    std::map<std::pair<uint32_t, ImagePurpose>, uint32_t> written_;
    std::map<uint32_t, bool> asked_for_;
};

} // namespace hearth::import
