// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/texture_stream.h"

#include <algorithm>
#include <utility>

namespace hearth::pack
{

namespace
{

/// Factor on the priorities of mips that are resident or on their way: without it two mips of which the
/// budget holds one could replace each other in turn as the eye moves.
constexpr float kHysteresis = 1.25f;

} // namespace

Result<TextureStream> TextureStream::create(const formats::PackView& view, TextureGraph graph,
                                            const TextureStreamOptions& options, std::span<std::byte> staging)
{
    HEARTH_ASSERT(options.slot_bytes > 0 && staging.size() >= options.slot_bytes);
    HEARTH_ASSIGN_OR_RETURN(Residency residency,
                            Residency::create(graph.nodes(), {.budget_bytes = options.budget_bytes,
                                                              .max_loads = options.max_loads}));
    return TextureStream(view, std::move(graph), std::move(residency), options, staging);
}

TextureStream::TextureStream(const formats::PackView& view, TextureGraph graph, Residency residency,
                             const TextureStreamOptions& options, std::span<std::byte> staging)
    : view_(&view),
      options_(options),
      staging_(staging),
      graph_(std::move(graph)),
      residency_(std::move(residency)),
      requests_(graph_.nodes().pageCount(), 0.0f),
      decoder_(std::make_unique<PieceDecoder>(view)),
      queue_(std::make_unique<CompletionQueue>(
          staging.size() / options.slot_bytes,
          [decoder = decoder_.get(), first = static_cast<uint32_t>(view.pages().size())](uint32_t number)
          { decoder->finish(number - first); })),
      staging_slots_(static_cast<uint32_t>(staging.size() / options.slot_bytes)),
      staging_of_piece_(view.texturePieces().size(), kInvalidIndex)
{
    for (uint32_t image = 0; image < view.images().size(); ++image)
    {
        const bool is_streamed = graph_.mipCount(image) > 0;
        pieces_.push_back(is_streamed ? formats::listTexturePieces(view.images()[image])
                                      : std::vector<formats::TexturePiece>());
    }
    findFinestMips();
}

void TextureStream::setBudget(uint64_t bytes)
{
    if (bytes == options_.budget_bytes)
        return;
    options_.budget_bytes = bytes;
    residency_.setBudget(bytes, bytes);
    changed_serial_ = serial_;
}

void TextureStream::findFinestMips()
{
    const PageGraph& nodes = graph_.nodes();
    const uint64_t budget_bytes = std::max(options_.max_budget_bytes, options_.budget_bytes);
    for (uint32_t image = 0; image < pieces_.size(); ++image)
    {
        uint32_t mip = std::max(graph_.mipCount(image), 1u) - 1;
        uint64_t bytes = nodes.pinnedBytes();
        while (mip > 0 && (bytes += nodes.sizeBytes(graph_.node({image, mip - 1}))) <= budget_bytes)
            --mip;
        finest_mips_.push_back(mip);
    }
}

TextureChanges TextureStream::beginFrame(uint64_t serial, uint64_t completed_serial)
{
    serial_ = serial;
    staging_slots_.complete(completed_serial);
    takeCompletions();
    endLoads(completed_serial);
    const FrameChanges changes = residency_.beginFrame(serial, lag(completed_serial));
    frames_.push_back(serial);
    const auto list = [&](std::vector<TextureMip>& mips, std::span<const uint32_t> nodes)
    {
        mips.clear();
        for (const uint32_t node : nodes)
            mips.push_back(graph_.mip(node));
    };
    list(evicted_, changes.evicted);
    list(published_, changes.published);
    list(failed_, changes.failed);
    if (!evicted_.empty() || !published_.empty())
        changed_serial_ = serial;
    startReads();
    return {evicted_, uploads_, published_, failed_};
}

/// Return the frame before the last one that has completed. An image that is replaced in a frame is read by
/// the copies of that frame: its memory is free one frame later than that of a page.
uint64_t TextureStream::lag(uint64_t completed_serial)
{
    while (frames_.size() > 1 && frames_[1] <= completed_serial)
    {
        lagging_serial_ = frames_.front();
        frames_.erase(frames_.begin());
    }
    return lagging_serial_;
}

void TextureStream::takeCompletions()
{
    uploads_.clear();
    const auto first_piece = static_cast<uint32_t>(view_->pages().size());
    for (const auto& [number, ok] : queue_->take())
    {
        --reads_in_flight_;
        const uint32_t piece = number - first_piece;
        const uint32_t staging_slot = std::exchange(staging_of_piece_[piece], kInvalidIndex);
        const uint32_t image = view_->findPieceImage(piece);
        const uint32_t own = piece - view_->images()[image].pieces.first;
        const TextureMip mip{image, pieces_[image][own].mip};
        Load& load = *findLoad(graph_.node(mip));
        --load.reads;
        load.is_failed = load.is_failed || !ok;
        if (load.is_failed)
        {
            staging_slots_.giveBack(staging_slot);
            continue;
        }
        uploads_.push_back({mip, own, staging_slot});
        staging_slots_.giveBackAfter(staging_slot, serial_);
        load.copy_serial = serial_;
    }
}

std::vector<TextureStream::Load>::iterator TextureStream::findLoad(uint32_t node)
{
    return std::find_if(loads_.begin(), loads_.end(), [&](const Load& load) { return load.node == node; });
}

/// Report the loads that have ended: those of which all pieces are there; those that failed, once no frame
/// copies into their images; and those that wait for a mip that failed, which the policy discards.
void TextureStream::endLoads(uint64_t completed_serial)
{
    std::vector<uint32_t> orphans;
    for (const Load& load : loads_)
    {
        const uint32_t needed = graph_.nodes().needs(load.node).front();
        if (!residency_.isResident(needed) && findLoad(needed) == loads_.end())
            orphans.push_back(load.node);
    }
    const auto isEnded = [&](const Load& load)
    {
        const bool is_orphan = std::ranges::find(orphans, load.node) != orphans.end();
        const bool is_read =
            load.reads == 0 && (load.is_failed ? load.copy_serial <= completed_serial : load.pieces.empty());
        if (is_orphan || is_read)
            residency_.completed(load.node, is_orphan || !load.is_failed);
        return is_orphan || is_read;
    };
    std::erase_if(loads_, isEnded);
}

template <typename Function>
void TextureStream::forEachWanted(const TextureUse& use, float pixels_log2, const Function& function) const
{
    const uint32_t count = graph_.mipCount(use.image);
    for (uint32_t mip = finest_mips_[use.image]; mip + 1 < count; ++mip)
        if (const float priority = mipPriority(use, pixels_log2, mip); priority > 1)
            function(graph_.node({use.image, mip}), priority);
}

void TextureStream::request(const TextureUse& use, float pixels_log2)
{
    forEachWanted(use, pixels_log2,
                  [&](uint32_t node, float priority)
                  {
                      if (requests_[node] == 0)
                          requested_.push_back(node);
                      requests_[node] = std::max(requests_[node], priority);
                  });
}

uint32_t TextureStream::countMissing(const TextureUse& use, float pixels_log2) const
{
    uint32_t missing = 0;
    forEachWanted(use, pixels_log2,
                  [&](uint32_t node, float priority)
                  { missing += priority > error_scale_ && !residency_.isResident(node) ? 1u : 0u; });
    return missing;
}

/// List the requests of the round, those to choose first in front. Coarser mips come before finer ones.
void TextureStream::listChoices()
{
    choices_.clear();
    for (const uint32_t node : requested_)
    {
        const float priority = std::exchange(requests_[node], 0.0f);
        const bool is_held = residency_.isResident(node) || findLoad(node) != loads_.end();
        choices_.push_back({node, priority, is_held ? priority * kHysteresis : priority});
    }
    requested_.clear();
    std::ranges::sort(choices_, [](const Choice& a, const Choice& b)
                      { return a.weight != b.weight ? a.weight > b.weight : a.node < b.node; });
}

/// Pass on the requests that the budget holds together, greatest priority first. A mip without room is left
/// out with the finer ones of its image; smaller mips of other images still come. Requests depend on the view
/// alone, so the choice is right at once: no controller needs to feel its way.
void TextureStream::chooseMips()
{
    listChoices();
    cuts_.assign(pieces_.size(), Cut::none);
    error_scale_ = 1;
    uint64_t bytes = graph_.nodes().pinnedBytes();
    size_t chosen = 0;
    for (const Choice& choice : choices_)
    {
        Cut& cut = cuts_[graph_.mip(choice.node).image];
        const uint64_t size = graph_.nodes().sizeBytes(choice.node);
        if (cut == Cut::none && residency_.isFailed(choice.node))
            cut = Cut::failed;
        else if (cut == Cut::none && bytes + size > options_.budget_bytes)
            cut = Cut::no_room;
        if (cut == Cut::no_room)
            error_scale_ = std::max(error_scale_, choice.priority);
        if (cut != Cut::none)
            continue;
        bytes += size;
        residency_.request(choice.node, choice.priority);
        choices_[chosen++] = choice;
    }
    choices_.erase(choices_.begin() + static_cast<ptrdiff_t>(chosen), choices_.end());
}

/// True if no chosen mip waits for a load, or until mips that no view wants any more have lost their worth.
bool TextureStream::isChoiceResident() const
{
    return std::ranges::all_of(choices_,
                               [&](const Choice& choice) { return residency_.isResident(choice.node); });
}

void TextureStream::schedule(uint64_t feedback_serial)
{
    const float scale_before = error_scale_;
    chooseMips();
    const auto started = residency_.schedule();
    if (!started.empty() || error_scale_ != scale_before)
        changed_serial_ = serial_;
    for (const uint32_t node : started)
    {
        const TextureMip& mip = graph_.mip(node);
        Load load;
        load.node = node;
        for (auto piece = static_cast<uint32_t>(pieces_[mip.image].size()); piece-- > 0;)
            if (pieces_[mip.image][piece].mip == mip.mip)
                load.pieces.push_back(piece);
        loads_.push_back(std::move(load));
    }
    if (residency_.atRest() && isChoiceResident() && feedback_serial >= changed_serial_)
        settled_serial_ = feedback_serial;
    startReads();
}

/// Read pieces in the order of the loads. A mip waits until the next coarser one is resident: so its image
/// exists only from then on, and none has to go because a coarser mip failed.
void TextureStream::startReads()
{
    for (Load& load : loads_)
        if (residency_.isResident(graph_.nodes().needs(load.node).front()))
            while (!load.is_failed && !load.pieces.empty() && !staging_slots_.isEmpty())
                startRead(load);
}

void TextureStream::startRead(Load& load)
{
    const TextureMip& mip = graph_.mip(load.node);
    const uint32_t own = load.pieces.back();
    load.pieces.pop_back();
    const uint32_t piece = view_->images()[mip.image].pieces.first + own;
    const uint32_t slot = staging_slots_.take();
    staging_of_piece_[piece] = slot;
    ++load.reads;
    ++reads_in_flight_;
    const auto number = static_cast<uint32_t>(view_->pages().size()) + piece;
    std::span<std::byte> destination =
        staging_.subspan(size_t{slot} * options_.slot_bytes, options_.slot_bytes);
    if (!options_.decoded.empty() && options_.decoded[mip.image])
        destination = decoder_->begin(mip.image, piece, pieces_[mip.image][own], destination);
    options_.read(number, destination.first(view_->texturePieces()[piece].size), ReadDone(*queue_, number));
}

uint32_t TextureStream::residentMip(uint32_t image) const
{
    uint32_t mip = graph_.mipCount(image) - 1;
    while (mip > 0 && residency_.isResident(graph_.node({image, mip - 1})))
        --mip;
    return mip;
}

} // namespace hearth::pack
