// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/texture_upload.h"

#include "formats/pack/decode_image.h"
#include "runtime/gpu/textures/image_layout.h"
#include "runtime/gpu/textures/streamed_textures.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace hearth::gpu
{

namespace
{

using formats::DecodedTexel;
using formats::TexelFormat;
using formats::TexelFormatTraits;

constexpr VkImageUsageFlags kTextureUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

/// Return the format for the texels of one that the device lacks; all devices have it.
TexelFormat decodedFormat(const TexelFormatTraits& traits)
{
    if (traits.coding == formats::TexelCoding::float_value)
        return TexelFormat::rgba16_float;
    if (traits.coding == formats::TexelCoding::srgb)
        return TexelFormat::rgba8_srgb;
    return traits.channels == 1   ? TexelFormat::r8_unorm
           : traits.channels == 2 ? TexelFormat::rg8_unorm
                                  : TexelFormat::rgba8_unorm;
}

/// Append texels in a format of decodedFormat.
void appendTexels(const TexelFormatTraits& traits, std::span<const DecodedTexel> texels,
                  std::vector<std::byte>& bytes)
{
    for (const DecodedTexel& texel : texels)
        if (traits.format == TexelFormat::rgba16_float)
        {
            const std::span<const std::byte> words = std::as_bytes(std::span(texel));
            bytes.insert(bytes.end(), words.begin(), words.end());
        }
        else
            for (uint32_t c = 0; c < traits.channels; ++c)
                bytes.push_back(std::byte{formats::narrowUnorm(texel[c])});
}

std::vector<std::byte> decodeMips(const formats::ImageRecord& record, std::span<const std::byte> stored,
                                  const TexelFormatTraits& target)
{
    std::vector<std::byte> bytes;
    for (uint32_t mip = 0; mip < record.mip_count; ++mip)
        appendTexels(target, formats::decodeImageMip(record, stored, mip), bytes);
    return bytes;
}

/// Return the names of the compressed formats that the device has.
std::string familyNames(const Device& device)
{
    constexpr std::pair<TexelFormat, const char*> kFamilies[] = {{TexelFormat::astc_unorm, "ASTC"},
                                                                 {TexelFormat::astc_float, "ASTC HDR"},
                                                                 {TexelFormat::etc2_rgb8_unorm, "ETC2"},
                                                                 {TexelFormat::bc7_unorm, "BC"}};
    std::string names;
    for (const auto& [format, name] : kFamilies)
        if (device.texel_formats[static_cast<uint32_t>(format)])
            names += (names.empty() ? "" : ", ") + std::string(name);
    return names.empty() ? "no compressed format" : names;
}

Status uploadImage(const Device& device, const formats::PackView& pack, uint32_t index, Uploader& uploader,
                   Scene& scene)
{
    const formats::ImageRecord& record = pack.images()[index];
    const std::string where = "image " + std::to_string(index);
    if (std::max(record.width, record.height) > device.limits.maxImageDimension2D)
        return Error{Issue::device_limit, pack.name(), where,
                     std::to_string(record.width) + "x" + std::to_string(record.height) +
                         " texels, the device takes " + std::to_string(device.limits.maxImageDimension2D)};
    const TexelFormatTraits& traits = *formats::findTexelFormat(record.format);
    const bool is_sampled = device.texel_formats[record.format];
    const bool is_plain = traits.family == formats::TexelFamily::plain;
    if (!is_sampled && !is_plain && !scene.decodes_textures)
        return Error{
            Issue::texture_format, pack.name(), where + " \"" + std::string(pack.text(record.name)) + "\"",
            "has the format " + std::string(traits.name) + ", the device has " + familyNames(device)};
    const TexelFormatTraits& target = is_sampled ? traits : formats::texelTraits(decodedFormat(traits));
    HEARTH_ASSIGN_OR_RETURN(const formats::ChunkData data, pack.imageData(index));
    HEARTH_ASSIGN_OR_RETURN(scene.images[index],
                            scene.arena.createImage({.format = static_cast<VkFormat>(target.vulkan_format),
                                                     .extent = {record.width, record.height},
                                                     .mip_count = record.mip_count,
                                                     .usage = kTextureUsage,
                                                     .components = viewComponents(record)}));
    if (is_sampled)
        return uploader.upload(scene.images[index], data.bytes(), blockSize(target));
    if (is_plain)
        warn(device, pack.name(), where,
             "its 16 bits a channel are reduced to 8: the device cannot filter R16G16B16A16_UNORM");
    else if (scene.decoded_textures++ == 0)
        warn(device, pack.name(), where,
             "and others of compressed formats are decoded, which takes four times the memory or more: the "
             "device has " +
                 familyNames(device));
    return uploader.upload(scene.images[index], decodeMips(record, data.bytes(), target), blockSize(target));
}

Status uploadWhite(Uploader& uploader, Scene& scene)
{
    HEARTH_ASSIGN_OR_RETURN(
        Image white, scene.arena.createImage(
                         {.format = VK_FORMAT_R8G8B8A8_UNORM, .extent = {1, 1}, .usage = kTextureUsage}));
    const uint32_t texel = 0xFFFFFFFFu;
    HEARTH_TRY(uploader.upload(white, std::as_bytes(std::span(&texel, 1)), {.bytes = sizeof(texel)}));
    scene.images.push_back(std::move(white));
    return success();
}

} // namespace

std::vector<bool> findUsedImages(const formats::PackView& pack)
{
    std::vector<bool> used(pack.images().size(), false);
    for (const LayeredMaterial& material : readMaterials(pack))
        for (const formats::TextureRef& texture : materialTextures(material))
            if (texture.image != kInvalidIndex)
                used[texture.image] = true;
    return used;
}

Status uploadTextures(const Device& device, const formats::PackView& pack, Uploader& uploader, Scene& scene)
{
    scene.images.resize(pack.images().size());
    const std::vector<bool> used = findUsedImages(pack);
    for (uint32_t image = 0; image < used.size(); ++image)
        if (used[image] && (scene.textures == nullptr || !scene.textures->isStreamed(image)))
            HEARTH_TRY(uploadImage(device, pack, image, uploader, scene));
    if (scene.textures != nullptr)
        HEARTH_TRY(scene.textures->uploadTails(uploader));
    return uploadWhite(uploader, scene);
}

} // namespace hearth::gpu
