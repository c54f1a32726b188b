// Streamed textures: images on the device whose finer mips come and go. See runtime/gpu/README.md,
// "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/uploader.h"
#include "runtime/pack/texture_stream.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hearth::gpu
{

/// Bytes on the device of the images that can be streamed: [image][mip] of an image that begins with this
/// mip, as TextureGraph takes them. Images that no material uses, or that have no pieces or only a tail, are
/// not streamed: they have none.
using TextureSizes = std::vector<std::vector<uint64_t>>;

/// Ask the device for the sizes. errors: device_failed.
/// decodes  compressed formats that the device lacks are decoded; else such images are not streamed
Result<TextureSizes> measureTextures(const Device& device, const formats::PackView& pack,
                                     const std::vector<bool>& used, bool decodes);

struct StreamedTextureOptions
{
    TextureSizes sizes;                              ///< from measureTextures
    std::vector<std::vector<pack::TextureUse>> uses; ///< [material row] of images that are streamed
    uint32_t frame_count = 1;                        ///< in flight
    uint64_t budget_bytes = 0;
    uint64_t max_budget_bytes{}; ///< as pack::TextureStreamOptions
    uint32_t max_loads = 32;
    pack::PageReader read; ///< as pack::TextureStreamOptions
};

struct TextureStatistics
{
    uint64_t budget_bytes = 0;    ///< the share now; after it has shrunk, at least bytes_in_use
    uint64_t bytes_in_use = 0;    ///< of the budget
    uint64_t bytes_on_device = 0; ///< of all images, also of those that replace others or are still read
    uint64_t bytes_streamed = 0;  ///< of texels, so far
    uint32_t failures = 0;        ///< mips that could not be read, so far
    float error_scale = 1;        ///< texels a pixel, where the budget is too small
};

/// Streamed textures of one scene. Each image is on the device with the mips that are resident, in memory of
/// its own: a finer mip is brought by a new image, into which the coarser ones are copied, and which replaces
/// the old one in the frame that records the copies.
class StreamedTextures
{
public:
    /// pack  outlives the textures
    /// errors: streaming_budget, device_failed.
    static Result<std::unique_ptr<StreamedTextures>>
    create(const Device& device, const formats::PackView& pack, StreamedTextureOptions options);

    /// Upload the tails. errors: device_failed, and those of PackView::decodePiece.
    Status uploadTails(Uploader& uploader);

    bool isStreamed(uint32_t image) const { return stream_.graph().mipCount(image) > 0; }
    const Image& image(uint32_t image) const { return images_[image].current->image; }

    void beginFrame(uint64_t serial, uint64_t completed_serial);
    /// Request the mips for the feedback of materials: shared::texelRequest, 0 if a material is not seen.
    void request(std::span<const uint32_t> materials);
    /// Return how many mips that such feedback wants are not resident, counted for each use of an image.
    uint32_t countMissing(std::span<const uint32_t> materials) const;
    void schedule(uint64_t feedback_serial) { stream_.schedule(feedback_serial); }

    /// Record the changes of the frame that was begun, outside of render passes.
    /// frame    number among the frames in flight
    /// returns  the materials whose images have changed since this frame in flight was recorded last: their
    ///          sets must be written before they are bound; valid until the next call
    std::span<const uint32_t> record(VkCommandBuffer commands, uint32_t frame);

    TextureStatistics statistics() const;
    VkDeviceSize stagingBytes() const { return staging_.size; }
    const pack::TextureStream& stream() const { return stream_; }
    void retryFailed() { stream_.retryFailed(); }
    void setBudget(uint64_t bytes) { stream_.setBudget(bytes); } ///< as TextureStream::setBudget

private:
    /// Image in memory of its own.
    struct Held
    {
        MemoryArena arena; ///< before the image, which must be destroyed first
        Image image;
        uint32_t first_mip; ///< of the pack's image, which is mip 0 here
    };
    struct StreamedImage
    {
        std::optional<Held> current;
        std::optional<Held> incoming; ///< with the next finer mip
    };
    struct Retired
    {
        Held held;       ///< in layout TRANSFER_SRC_OPTIMAL
        uint64_t serial; ///< last frame that reads it
        uint32_t image;
    };

    StreamedTextures(const Device& device, const formats::PackView& pack, StreamedTextureOptions options,
                     MemoryArena arena, Buffer staging, pack::TextureStream stream, uint32_t slot_bytes);
    Result<Held> makeImage(uint32_t image, uint32_t first_mip) const;
    bool beginImage(VkCommandBuffer commands, std::optional<Held>& place, uint32_t image, uint32_t first_mip);
    void recordEvictions(VkCommandBuffer commands);
    void recordUploads(VkCommandBuffer commands);
    void recordPublished(VkCommandBuffer commands);
    void replace(VkCommandBuffer commands, uint32_t image, Held held);
    bool bringBack(VkCommandBuffer commands, uint32_t image, uint32_t first_mip);
    void exchange(uint32_t image, Held held);
    void copyMips(VkCommandBuffer commands, const Held& from, const Held& to, uint32_t first_mip) const;

    const Device& device_;
    const formats::PackView& pack_;
    MemoryArena arena_; ///< of the staging memory
    Buffer staging_;
    pack::TextureStream stream_;
    uint32_t slot_bytes_;
    std::vector<StreamedImage> images_;
    std::vector<Retired> retired_;
    std::vector<std::vector<formats::TexturePiece>> pieces_; ///< [image]
    std::vector<std::vector<pack::TextureUse>> uses_;        ///< [material row]
    std::vector<std::vector<uint32_t>> rows_of_image_;
    std::vector<std::vector<bool>> outdated_; ///< [frame in flight][material row]: its set names old images
    std::vector<uint32_t> outdated_rows_;
    pack::TextureChanges changes_{};
    uint64_t serial_ = 0;
    uint64_t bytes_streamed_ = 0;
    uint32_t failures_ = 0;
};

} // namespace hearth::gpu
