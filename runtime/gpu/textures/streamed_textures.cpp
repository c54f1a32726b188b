// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/textures/streamed_textures.h"

#include "formats/gpu_shared/decisions.h"
#include "runtime/gpu/textures/image_layout.h"
#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/pack/decoded_texels.h"

#include <algorithm>
#include <string>
#include <utility>

namespace hearth::gpu
{

namespace
{

constexpr VkImageUsageFlags kStreamedUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

/// Slots of staging memory for each mip in flight: a mip of 1024 x 1024 texels of a byte has 16 pieces.
constexpr uint32_t kSlotsPerLoad = 2;

/// Bytes of staging memory beyond which there are fewer slots: decoded pieces take up to 2.4 MB.
constexpr VkDeviceSize kMaxStagingBytes = 16 << 20;

/// Return the format of an image on the device.
const formats::TexelFormatTraits& deviceFormat(const Device& device, const formats::ImageRecord& record)
{
    const formats::TexelFormatTraits& traits = *formats::findTexelFormat(record.format);
    return device.texel_formats[record.format] ? traits : formats::texelTraits(pack::decodedFormat(traits));
}

/// Describe an image that begins with a mip of the pack's.
ImageDescription describe(const Device& device, const formats::ImageRecord& record, uint32_t first_mip)
{
    const formats::MipExtent extent = formats::mipExtent(record, first_mip);
    return {.format = static_cast<VkFormat>(deviceFormat(device, record).vulkan_format),
            .extent = {extent.width, extent.height},
            .mip_count = record.mip_count - first_mip,
            .usage = kStreamedUsage,
            .components = viewComponents(record)};
}

bool isStreamed(const Device& device, const formats::ImageRecord& record, bool decodes)
{
    const bool is_readable = device.texel_formats[record.format] || decodes ||
                             formats::findTexelFormat(record.format)->family == formats::TexelFamily::plain;
    return is_readable && record.pieces.count > 0 && formats::firstTailMip(record) > 0 &&
           std::max(record.width, record.height) <= device.limits.maxImageDimension2D;
}

VkExtent3D levelExtent(const Image& image, uint32_t level)
{
    return {std::max(1u, image.extent.width >> level), std::max(1u, image.extent.height >> level), 1};
}

/// Convert a word of shared::texelRequest to log2 of the pixels of a UV unit, at least as many as there are.
float pixelsFromRequest(uint32_t request)
{
    constexpr auto kOctave = static_cast<float>(1 << shared::kTexelRequestBits);
    return static_cast<float>(request) / kOctave - static_cast<float>(shared::kTexelRequestOctaves) +
           shared::kTexelRequestError;
}

/// Return the bytes of a slot of staging memory: those of the largest piece on the device.
/// sizes  of images that are streamed
uint32_t findSlotBytes(const Device& device, const formats::PackView& pack, const TextureSizes& sizes)
{
    size_t bytes = formats::kMaxPieceBytes;
    for (uint32_t image = 0; image < sizes.size(); ++image)
    {
        const formats::ImageRecord& record = pack.images()[image];
        if (!sizes[image].empty())
            for (const formats::TexturePiece& piece : formats::listTexturePieces(record))
                bytes =
                    std::max(bytes, device.texel_formats[record.format] ? size_t{piece.size}
                                                                        : pack::decodedBytes(record, piece));
    }
    return static_cast<uint32_t>((bytes + 63) / 64 * 64);
}

} // namespace

Result<TextureSizes> measureTextures(const Device& device, const formats::PackView& pack,
                                     const std::vector<bool>& used, bool decodes)
{
    TextureSizes sizes(pack.images().size());
    for (uint32_t image = 0; image < sizes.size(); ++image)
    {
        const formats::ImageRecord& record = pack.images()[image];
        if (!used[image] || !isStreamed(device, record, decodes))
            continue;
        for (uint32_t mip = 0; mip <= formats::firstTailMip(record); ++mip)
        {
            HEARTH_ASSIGN_OR_RETURN(const VkDeviceSize bytes,
                                    measureImage(device, describe(device, record, mip)));
            sizes[image].push_back(bytes);
        }
    }
    return sizes;
}

Result<std::unique_ptr<StreamedTextures>>
StreamedTextures::create(const Device& device, const formats::PackView& pack, StreamedTextureOptions options)
{
    const uint32_t slot_bytes = findSlotBytes(device, pack, options.sizes);
    const VkDeviceSize slots = std::clamp<VkDeviceSize>(kMaxStagingBytes / slot_bytes, 1,
                                                        VkDeviceSize{kSlotsPerLoad} * options.max_loads);
    const VkDeviceSize staging_bytes = slots * slot_bytes;
    std::vector<bool> decoded;
    for (const formats::ImageRecord& record : pack.images())
        decoded.push_back(!device.texel_formats[record.format]);
    MemoryArena arena(device, 0);
    HEARTH_ASSIGN_OR_RETURN(
        Buffer staging,
        arena.createBuffer(staging_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::staging));
    HEARTH_ASSIGN_OR_RETURN(
        pack::TextureStream stream,
        pack::TextureStream::create(pack, pack::TextureGraph(options.sizes),
                                    {.budget_bytes = options.budget_bytes,
                                     .max_budget_bytes = options.max_budget_bytes,
                                     .max_loads = options.max_loads,
                                     .slot_bytes = slot_bytes,
                                     .decoded = std::move(decoded),
                                     .read = options.read},
                                    {staging.mapped, static_cast<size_t>(staging_bytes)}));
    return std::unique_ptr<StreamedTextures>(new StreamedTextures(device, pack, std::move(options),
                                                                  std::move(arena), std::move(staging),
                                                                  std::move(stream), slot_bytes));
}

StreamedTextures::StreamedTextures(const Device& device, const formats::PackView& pack,
                                   StreamedTextureOptions options, MemoryArena arena, Buffer staging,
                                   pack::TextureStream stream, uint32_t slot_bytes)
    : device_(device),
      pack_(pack),
      arena_(std::move(arena)),
      staging_(std::move(staging)),
      stream_(std::move(stream)),
      slot_bytes_(slot_bytes),
      images_(pack.images().size()),
      pieces_(pack.images().size()),
      uses_(std::move(options.uses)),
      rows_of_image_(pack.images().size()),
      outdated_(options.frame_count, std::vector<bool>(uses_.size(), false))
{
    for (uint32_t image = 0; image < images_.size(); ++image)
        if (stream_.graph().mipCount(image) > 0)
            pieces_[image] = formats::listTexturePieces(pack.images()[image]);
    for (uint32_t row = 0; row < uses_.size(); ++row)
        for (const pack::TextureUse& use : uses_[row])
            rows_of_image_[use.image].push_back(row);
}

Status StreamedTextures::uploadTails(Uploader& uploader)
{
    for (uint32_t image = 0; image < images_.size(); ++image)
    {
        if (stream_.graph().mipCount(image) == 0)
            continue;
        const formats::TexturePiece& tail = pieces_[image].back();
        std::vector<std::byte> texels(tail.size);
        const formats::ImageRecord& record = pack_.images()[image];
        const formats::Range& pieces = record.pieces;
        HEARTH_TRY(pack_.decodePiece(pieces.first + pieces.count - 1, texels));
        if (!device_.texel_formats[record.format])
        {
            const std::vector<std::byte> stored = std::exchange(texels, {});
            texels.resize(pack::decodedBytes(record, tail));
            pack::decodeTexels(record, tail, stored, texels);
        }
        HEARTH_ASSIGN_OR_RETURN(images_[image].current, makeImage(image, tail.mip));
        HEARTH_TRY(
            uploader.upload(images_[image].current->image, texels, blockSize(deviceFormat(device_, record))));
    }
    return success();
}

Result<StreamedTextures::Held> StreamedTextures::makeImage(uint32_t image, uint32_t first_mip) const
{
    Held held{MemoryArena(device_, 0), {}, first_mip};
    HEARTH_ASSIGN_OR_RETURN(held.image,
                            held.arena.createImage(describe(device_, pack_.images()[image], first_mip)));
    return held;
}

void StreamedTextures::beginFrame(uint64_t serial, uint64_t completed_serial)
{
    serial_ = serial;
    std::erase_if(retired_, [&](const Retired& retired) { return retired.serial <= completed_serial; });
    changes_ = stream_.beginFrame(serial, completed_serial);
    failures_ += static_cast<uint32_t>(changes_.failed.size());
    for (const pack::TextureMip& failed : changes_.failed)
    {
        images_[failed.image].incoming.reset();
        warn(device_, pack_.name(),
             "mip " + std::to_string(failed.mip) + " of image " + std::to_string(failed.image),
             "cannot be read: the texture stays blurred");
    }
}

void StreamedTextures::request(std::span<const uint32_t> materials)
{
    for (size_t row = 0; row < uses_.size(); ++row)
        if (materials[row] != 0)
            for (const pack::TextureUse& use : uses_[row])
                stream_.request(use, pixelsFromRequest(materials[row]));
}

uint32_t StreamedTextures::countMissing(std::span<const uint32_t> materials) const
{
    uint32_t missing = 0;
    for (size_t row = 0; row < uses_.size(); ++row)
        if (materials[row] != 0)
            for (const pack::TextureUse& use : uses_[row])
                missing += stream_.countMissing(use, pixelsFromRequest(materials[row]));
    return missing;
}

std::span<const uint32_t> StreamedTextures::record(VkCommandBuffer commands, uint32_t frame)
{
    recordEvictions(commands);
    recordUploads(commands);
    recordPublished(commands);
    outdated_rows_.clear();
    for (uint32_t row = 0; row < uses_.size(); ++row)
        if (outdated_[frame][row])
            outdated_rows_.push_back(row);
    outdated_[frame].assign(uses_.size(), false);
    return outdated_rows_;
}

void StreamedTextures::recordEvictions(VkCommandBuffer commands)
{
    for (size_t i = 0; i < changes_.evicted.size(); ++i)
    {
        const pack::TextureMip& evicted = changes_.evicted[i];
        // the next coarser mip goes as well: one image replaces both
        if (std::ranges::find(changes_.evicted, pack::TextureMip{evicted.image, evicted.mip + 1}) !=
            changes_.evicted.end())
            continue;
        if (bringBack(commands, evicted.image, evicted.mip + 1))
            continue;
        std::optional<Held> smaller;
        if (beginImage(commands, smaller, evicted.image, evicted.mip + 1))
            replace(commands, evicted.image, std::move(*smaller));
    }
}

/// Create an image that copies can fill. Warns and returns false if the device has no memory for it.
bool StreamedTextures::beginImage(VkCommandBuffer commands, std::optional<Held>& place, uint32_t image,
                                  uint32_t first_mip)
{
    Result<Held> made = makeImage(image, first_mip);
    if (!made.ok())
    {
        warn(device_, pack_.name(), "image " + std::to_string(image),
             "keeps the mips that it has: " + made.error().detail);
        return false;
    }
    place = std::move(*made);
    transition(device_, commands, place->image, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0, VK_ACCESS_TRANSFER_WRITE_BIT,
               VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
    return true;
}

void StreamedTextures::recordUploads(VkCommandBuffer commands)
{
    for (const pack::PieceUpload& upload : changes_.uploads)
    {
        std::optional<Held>& incoming = images_[upload.mip.image].incoming;
        if (!incoming && !beginImage(commands, incoming, upload.mip.image, upload.mip.mip))
            continue;
        const formats::TexturePiece& piece = pieces_[upload.mip.image][upload.piece];
        bytes_streamed_ += piece.size;
        const VkBufferImageCopy region{VkDeviceSize{upload.staging_slot} * slot_bytes_,
                                       0,
                                       0,
                                       {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       {0, static_cast<int32_t>(piece.first_row), 0},
                                       {incoming->image.extent.width, piece.rows, 1}};
        device_.vk.vkCmdCopyBufferToImage(commands, staging_.handle.get(), incoming->image.handle.get(),
                                          VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    }
}

void StreamedTextures::recordPublished(VkCommandBuffer commands)
{
    for (const pack::TextureMip& published : changes_.published)
        if (std::optional<Held>& incoming = images_[published.image].incoming)
        {
            Held held = std::move(*incoming);
            incoming.reset();
            replace(commands, published.image, std::move(held));
        }
}

/// Fill the mips of an image that the current one has, and put it in its place.
void StreamedTextures::replace(VkCommandBuffer commands, uint32_t image, Held held)
{
    std::optional<Held>& current = images_[image].current;
    copyMips(commands, *current, held, std::max(current->first_mip, held.first_mip));
    transition(device_, commands, held.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
               VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    exchange(image, std::move(held));
}

/// Put an image that was replaced, and that frames in flight still read, in its place again. A second one of
/// the same mips would count against no node of the budget. Returns false if there is none.
bool StreamedTextures::bringBack(VkCommandBuffer commands, uint32_t image, uint32_t first_mip)
{
    const auto retired = std::ranges::find_if(retired_, [&](const Retired& r)
                                              { return r.image == image && r.held.first_mip == first_mip; });
    if (retired == retired_.end())
        return false;
    Held held = std::move(retired->held);
    retired_.erase(retired);
    transition(device_, commands, images_[image].current->image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_SHADER_READ_BIT, VK_ACCESS_TRANSFER_READ_BIT,
               VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
    transition(device_, commands, held.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_READ_BIT,
               VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
               VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    exchange(image, std::move(held));
    return true;
}

/// Make an image the current one, and keep the one before for the frames that read it.
void StreamedTextures::exchange(uint32_t image, Held held)
{
    std::optional<Held>& current = images_[image].current;
    retired_.push_back({std::move(*current), serial_, image});
    current = std::move(held);
    for (std::vector<bool>& rows : outdated_)
        for (const uint32_t row : rows_of_image_[image])
            rows[row] = true;
}

/// Copy the mips from `first_mip` of the pack's image on, which both have. Frames before have read `from`;
/// none reads it after.
void StreamedTextures::copyMips(VkCommandBuffer commands, const Held& from, const Held& to,
                                uint32_t first_mip) const
{
    transition(device_, commands, from.image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_SHADER_READ_BIT, VK_ACCESS_TRANSFER_READ_BIT,
               VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
    std::vector<VkImageCopy> regions;
    for (uint32_t level = first_mip - from.first_mip; level < from.image.mip_count; ++level)
        regions.push_back({{VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1},
                           {},
                           {VK_IMAGE_ASPECT_COLOR_BIT, level + from.first_mip - to.first_mip, 0, 1},
                           {},
                           levelExtent(from.image, level)});
    device_.vk.vkCmdCopyImage(commands, from.image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                              to.image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                              static_cast<uint32_t>(regions.size()), regions.data());
}

TextureStatistics StreamedTextures::statistics() const
{
    const pack::Residency& residency = stream_.residency();
    uint64_t on_device = 0;
    for (const StreamedImage& image : images_)
        for (const std::optional<Held>* held : {&image.current, &image.incoming})
            on_device += held->has_value() ? (*held)->image.bytes : 0;
    for (const Retired& retired : retired_)
        on_device += retired.held.image.bytes;
    return {.budget_bytes = std::max(stream_.budgetBytes(), residency.bytesInUse()),
            .bytes_in_use = residency.bytesInUse(),
            .bytes_on_device = on_device,
            .bytes_streamed = bytes_streamed_,
            .failures = failures_,
            .error_scale = stream_.errorScale()};
}

} // namespace hearth::gpu
