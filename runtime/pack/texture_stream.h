// Streaming of mips without a graphics device: connects the policy (residency.h) with reads of pieces and the
// staging memory between them. See runtime/pack/README.md, "Textures".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/texture_pieces.h"
#include "runtime/pack/completion_queue.h"
#include "runtime/pack/page_stream.h"
#include "runtime/pack/piece_decoder.h"
#include "runtime/pack/residency.h"
#include "runtime/pack/staging_slots.h"
#include "runtime/pack/texture_graph.h"
#include "runtime/pack/texture_requests.h"

#include <memory>
#include <span>
#include <vector>

namespace hearth::pack
{

struct TextureStreamOptions
{
    uint64_t budget_bytes = 0;   ///< of all images that are streamed, and of those that replace them
    uint64_t max_budget_bytes{}; ///< to which setBudget may raise it; >= budget_bytes, 0: not at all
    uint32_t max_loads = 32;     ///< mips in flight
    uint32_t slot_bytes = 0;     ///< of staging memory; holds every piece, decoded if need be
    std::vector<bool> decoded{}; ///< [image] pieces arrive in staging memory as decodeTexels; empty: none
    PageReader read;             ///< numbers of pieces follow those of the pages: PackView::decodePiece
};

/// Copy of a decoded piece from its staging slot into the new image of its mip.
struct PieceUpload
{
    TextureMip mip;
    uint32_t piece = 0; ///< of listTexturePieces
    uint32_t staging_slot = 0;
};

/// Changes to record at the start of a frame, in this order; valid until the next beginFrame. The image of a
/// mip holds this mip and all coarser ones.
struct TextureChanges
{
    /// No longer resident, finer mips of an image first: an image of the coarser mips replaces the current.
    std::span<const TextureMip> evicted;
    std::span<const PieceUpload> uploads;
    /// All pieces are there, coarser mips of an image first: their image takes the coarser mips from the
    /// current one and replaces it.
    std::span<const TextureMip> published;
    /// Cannot be read, once for each attempt; no frame in flight copies into their images any more.
    std::span<const TextureMip> failed;
};

/// Stream of the mips of a pack's images, called frame by frame from one thread; reads may end on others. The
/// bytes of all images, also of those that replace others and of those that frames in flight read, never
/// exceed the budget, unless it was just made smaller, as long as an image that was replaced in frame n lives
/// until frame n has completed, and an eviction takes it again while it lives. Deterministic, as PageStream.
class TextureStream
{
public:
    /// Create a stream whose tails are resident.
    /// view     of a checked pack that outlives the stream
    /// graph    of its images; only images with pieces are streamed
    /// staging  a multiple of slot_bytes, at least one slot
    /// errors: streaming_budget, if the tails exceed the budget.
    static Result<TextureStream> create(const formats::PackView& view, TextureGraph graph,
                                        const TextureStreamOptions& options, std::span<std::byte> staging);

    /// Begin a frame, as PageStream::beginFrame does.
    TextureChanges beginFrame(uint64_t serial, uint64_t completed_serial);

    /// Request the mips that a view wants of an image, but for those that the greatest budget could not hold
    /// beside the tails of all images.
    /// pixels_log2  as mipPriority
    void request(const TextureUse& use, float pixels_log2);

    /// Return how many mips that a view wants of an image are not resident, though errorScale() asks for
    /// them; pixels_log2 as above.
    uint32_t countMissing(const TextureUse& use, float pixels_log2) const;

    /// Return the pixels that a texel of the last round's requests covers at most, >= 1: above 1 if the
    /// budget does not hold them all.
    float errorScale() const { return error_scale_; }

    /// End a round of requests, as PageStream::schedule does.
    void schedule(uint64_t feedback_serial);

    uint64_t settledSerial() const { return settled_serial_; } ///< as PageStream::settledSerial
    uint32_t readsInFlight() const { return reads_in_flight_; }
    void retryFailed() { residency_.retryFailed(); }

    /// Change the budget, which the tails fit (asserted); bytes beyond it are evicted, as
    /// Residency::setBudget.
    void setBudget(uint64_t bytes);
    uint64_t budgetBytes() const { return options_.budget_bytes; }
    const TextureGraph& graph() const { return graph_; }
    const Residency& residency() const { return residency_; }
    /// Return the finest resident mip of an image that is streamed, as of the last beginFrame.
    uint32_t residentMip(uint32_t image) const;

private:
    /// Mip on its way.
    struct Load
    {
        uint32_t node = 0;
        std::vector<uint32_t> pieces; ///< of listTexturePieces, to be read; the next is the last
        uint32_t reads = 0;           ///< in flight
        bool is_failed = false;
        uint64_t copy_serial = 0; ///< last frame that copies a piece
    };
    /// Requested mip.
    struct Choice
    {
        uint32_t node;
        float priority;
        float weight; ///< by which it is chosen
    };
    /// Reason for which no finer mip of an image is chosen.
    enum class Cut : uint8_t
    {
        none,
        no_room,
        failed,
    };
    TextureStream(const formats::PackView& view, TextureGraph graph, Residency residency,
                  const TextureStreamOptions& options, std::span<std::byte> staging);
    void findFinestMips();
    void takeCompletions();
    /// Call function(node, priority) for the mips that a view wants of an image.
    template <typename Function>
    void forEachWanted(const TextureUse& use, float pixels_log2, const Function& function) const;
    void listChoices();
    void chooseMips();
    bool isChoiceResident() const;
    std::vector<Load>::iterator findLoad(uint32_t node);
    void endLoads(uint64_t completed_serial);
    uint64_t lag(uint64_t completed_serial);
    void startReads();
    void startRead(Load& load);

    const formats::PackView* view_;
    TextureStreamOptions options_;
    std::span<std::byte> staging_;
    TextureGraph graph_;
    Residency residency_;
    std::vector<float> requests_;     ///< [node] greatest priority of this round; 0: none
    std::vector<uint32_t> requested_; ///< nodes with a request
    std::vector<Choice> choices_;     ///< of the round: those that the budget holds
    std::vector<Cut> cuts_;           ///< [image] in this round
    float error_scale_ = 1;
    std::vector<uint32_t> finest_mips_;     ///< [image] that the budget can hold; of images that are streamed
    std::unique_ptr<PieceDecoder> decoder_; // the queue keeps its address
    std::unique_ptr<CompletionQueue> queue_; // readers keep its address

    std::vector<std::vector<formats::TexturePiece>> pieces_; ///< [image]; empty: it is not streamed
    std::vector<Load> loads_;                                ///< in the order in which they were started
    StagingSlots staging_slots_;
    std::vector<uint32_t> staging_of_piece_; ///< by number in the pack
    std::vector<PieceUpload> uploads_;
    std::vector<TextureMip> evicted_, published_, failed_;
    std::vector<uint64_t> frames_; ///< serials, from the last that has completed, or the first
    uint64_t lagging_serial_ = 0;
    uint32_t reads_in_flight_ = 0;
    uint64_t serial_ = 0;
    uint64_t changed_serial_ = 0;
    uint64_t settled_serial_ = 0;
};

} // namespace hearth::pack
