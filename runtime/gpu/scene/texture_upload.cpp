// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/texture_upload.h"

#include "runtime/gpu/textures/image_layout.h"
#include "runtime/gpu/textures/streamed_textures.h"
#include "runtime/pack/decoded_texels.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace hearth::gpu
{

namespace
{

using formats::TexelFormat;
using formats::TexelFormatTraits;

constexpr VkImageUsageFlags kTextureUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

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

/// Tell that an image is decoded; of compressed ones once.
void warnOfDecoding(const Device& device, const formats::PackView& pack, uint32_t index, Scene& scene)
{
    const std::string where = "image " + std::to_string(index);
    if (formats::findTexelFormat(pack.images()[index].format)->family == formats::TexelFamily::plain)
        warn(device, pack.name(), where,
             "its 16 bits a channel are reduced to 8: the device cannot filter R16G16B16A16_UNORM");
    else if (scene.decoded_textures++ == 0)
        warn(device, pack.name(), where,
             "and others of compressed formats are decoded, which takes four times the memory or more: the "
             "device has " +
                 familyNames(device));
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
    const TexelFormatTraits& target = is_sampled ? traits : formats::texelTraits(pack::decodedFormat(traits));
    HEARTH_ASSIGN_OR_RETURN(const formats::ChunkData data, pack.imageData(index));
    HEARTH_ASSIGN_OR_RETURN(scene.images[index],
                            scene.arena.createImage({.format = static_cast<VkFormat>(target.vulkan_format),
                                                     .extent = {record.width, record.height},
                                                     .mip_count = record.mip_count,
                                                     .usage = kTextureUsage,
                                                     .components = viewComponents(record)}));
    if (is_sampled)
        return uploader.upload(scene.images[index], data.bytes(), blockSize(target));
    warnOfDecoding(device, pack, index, scene);
    return uploader.upload(scene.images[index], pack::decodeTexels(record, data.bytes()), blockSize(target));
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
    {
        if (scene.textures == nullptr || !scene.textures->isStreamed(image))
        {
            if (used[image])
                HEARTH_TRY(uploadImage(device, pack, image, uploader, scene));
        }
        else if (!device.texel_formats[pack.images()[image].format])
            warnOfDecoding(device, pack, image, scene);
    }
    if (scene.textures != nullptr)
        HEARTH_TRY(scene.textures->uploadTails(uploader));
    return uploadWhite(uploader, scene);
}

} // namespace hearth::gpu
