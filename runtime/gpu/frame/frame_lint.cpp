// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_lint.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace hearth::gpu
{

namespace
{

using Resource = FrameResource;

constexpr const char* kRules[] = {
    "undefined-load", "useless-store", "not-transient", "unnamed-spill", "spill",         "tile-storage",
    "attachments",    "depth-changes", "not-by-region", "foreign-input", "clear-command", "bubble",
    "diagonal",       "host-race",     "stored-twice",  "late-depth",
};
static_assert(std::size(kRules) == static_cast<size_t>(LintRule::count));

double bytesPerPixel(const Pass& pass, Resource resource)
{
    if (resource == Resource::shadow_map && pass.map_format == VK_FORMAT_D16_UNORM)
        return 2;
    if (resource == Resource::color)
        return findColorFormat(pass.color_format)->bytes;
    const double bytes = double{resourceFacts(resource).bytes_per_pixel};
    return isLinear(resource) && pass.radiance_format != kPackedRadiance ? 2 * bytes : bytes;
}

bool isBuffer(Resource resource)
{
    return resourceFacts(resource).kind == ResourceKind::buffer;
}

const AttachmentUse* findAttachment(const Pass& pass, Resource resource)
{
    const auto found = std::find_if(pass.attachments.begin(), pass.attachments.end(),
                                    [&](const AttachmentUse& use) { return use.resource == resource; });
    return found == pass.attachments.end() ? nullptr : &*found;
}

/// True if a subpass needs what earlier ones left in the attachment.
bool readsContent(const ResourceUse& use)
{
    return use.content == Content::keep && use.access != Access::depth_keep;
}

/// Bytes that subpasses which do not merge store and load between them.
double subpassTraffic(const Pass& pass)
{
    double bytes = 0;
    std::set<Resource> on_tile, stored;
    for (const AttachmentUse& use : pass.attachments)
        if (use.load == LoadOperation::load)
            stored.insert(use.resource);
    for (const Subpass& subpass : pass.subpasses)
    {
        if (subpass.is_empty)
            continue;
        for (const ResourceUse& use : subpass.attachments)
            if (readsContent(use) && on_tile.contains(use.resource))
            {
                const AttachmentUse* attachment = findAttachment(pass, use.resource);
                // one store serves all that follows
                if (!stored.contains(use.resource) && !(attachment != nullptr && attachment->store))
                    bytes += bytesPerPixel(pass, use.resource);
                stored.insert(use.resource);
                bytes += bytesPerPixel(pass, use.resource);
            }
        for (const ResourceUse& use : subpass.attachments)
            if (isWrite(use.access) && use.access != Access::depth_keep)
            {
                on_tile.insert(use.resource);
                stored.erase(use.resource);
            }
    }
    return bytes;
}

class Linter
{
public:
    Linter(const FrameDescription& frame, const LintLimits& limits) : frame_(frame), limits_(limits) {}

    std::vector<LintFinding> run()
    {
        for (size_t i = 0; i < frame_.passes.size(); ++i)
        {
            pass_ = &frame_.passes[i];
            checkLoads();
            checkStores(i);
            checkSubpasses();
            checkDraws();
            checkWaiting();
        }
        checkFrame();
        return std::move(findings_);
    }

private:
    void report(LintRule rule, bool is_error, std::string text)
    {
        findings_.push_back({rule, is_error, pass_ == nullptr ? "" : passName(*pass_), std::move(text)});
    }
    void error(LintRule rule, std::string text) { report(rule, true, std::move(text)); }
    void warn(LintRule rule, std::string text) { report(rule, false, std::move(text)); }

    void checkLoads()
    {
        for (const AttachmentUse& use : pass_->attachments)
        {
            const std::string name = resourceFacts(use.resource).name;
            if (use.load == LoadOperation::load)
            {
                if (!stored_.contains(use.resource))
                    error(LintRule::undefined_load, "loads the " + name + ", which no pass has stored");
                else
                    warn(LintRule::spill, "loads the " + name + ", which left the tile");
            }
        }
        if (pass_->kind == PassKind::render)
            for (const ResourceUse& use : pass_->uses)
                if (resourceFacts(use.resource).kind == ResourceKind::attachment)
                    warn(LintRule::spill, std::string("samples the ") + resourceFacts(use.resource).name +
                                              ", which left the tile");
        for (const ResourceUse& use : pass_->uses)
            if (use.access == Access::copy_write)
                stored_.insert(use.resource);
        // content that a later pass reads is lost if this pass neither keeps nor stores it again
        for (const AttachmentUse& use : pass_->attachments)
        {
            if (use.store)
                stored_.insert(use.resource);
            else
                stored_.erase(use.resource);
        }
    }

    /// True if a pass needs the content of the resource that it finds.
    static bool needs(const Pass& pass, Resource resource)
    {
        const AttachmentUse* attachment = findAttachment(pass, resource);
        if (attachment != nullptr && attachment->load == LoadOperation::load)
            return true;
        return attachment == nullptr &&
               std::any_of(pass.uses.begin(), pass.uses.end(),
                           [&](const ResourceUse& use)
                           { return use.resource == resource && use.content == Content::keep; });
    }

    /// Name of the first step that needs what a pass stores; empty if nobody does.
    std::string nameReader(size_t number, Resource resource) const
    {
        for (size_t i = number + 1; i < frame_.passes.size(); ++i)
        {
            // shadow maps lie in layers of their own
            if (resource == Resource::shadow_map && frame_.passes[i].map &&
                frame_.passes[i].map != pass_->map)
                continue;
            if (needs(frame_.passes[i], resource))
                return userName(frame_.passes[i], resource);
            if (findAttachment(frame_.passes[i], resource) != nullptr)
                return "";
        }
        const bool handed_out = resource == Resource::color ||
                                (resource == Resource::visibility && frame_.configuration.keeps_visibility) ||
                                (resource == Resource::depth && frame_.configuration.keeps_depth);
        if (handed_out)
            return kCaller;
        // the next frame has the same passes
        for (size_t i = 0; i <= number && resource != Resource::shadow_map; ++i)
        {
            if (needs(frame_.passes[i], resource))
                return kNextFrame;
            if (findAttachment(frame_.passes[i], resource) != nullptr)
                break;
        }
        return "";
    }

    void checkStores(size_t number)
    {
        for (const AttachmentUse& use : pass_->attachments)
        {
            const std::string name = resourceFacts(use.resource).name;
            const std::string reader = nameReader(number, use.resource);
            if (use.store && reader.empty())
                error(LintRule::useless_store, "stores the " + name + ", which nobody reads");
            if (use.store && !reader.empty() && (use.reader == nullptr || reader != use.reader))
                error(LintRule::unnamed_spill,
                      "stores the " + name + " and does not name its reader, " + reader);
            if (use.resource == Resource::color && use.store && color_stores_++ > 0)
                error(LintRule::restored, "stores the finished image a second time");
        }
    }

    void checkSubpasses()
    {
        if (pass_->attachments.size() > limits_.attachments)
            warn(LintRule::attachment_count,
                 std::to_string(pass_->attachments.size()) + " attachments are not merged by some drivers");
        if (pass_->subpasses.size() > 1 && !pass_->by_region)
            error(LintRule::not_by_region, "its subpasses wait for the whole image of each other");
        std::set<Resource> has_content, depths;
        size_t with_depth = 0;
        for (const AttachmentUse& use : pass_->attachments)
            if (use.load != LoadOperation::none)
                has_content.insert(use.resource);
        for (const Subpass& subpass : pass_->subpasses)
        {
            uint32_t colors = 0, inputs = 0;
            for (const ResourceUse& use : subpass.attachments)
            {
                colors += use.access == Access::color_write ? 1 : 0;
                inputs += use.access == Access::input || use.access == Access::depth_input ? 1 : 0;
                if (use.access == Access::depth_write || use.access == Access::depth_keep ||
                    use.access == Access::depth_input)
                {
                    depths.insert(use.resource);
                    ++with_depth;
                }
                if (use.access == Access::input && !subpass.is_empty && !has_content.contains(use.resource))
                    error(LintRule::foreign_input, std::string("reads the ") +
                                                       resourceFacts(use.resource).name +
                                                       " as an input, which has no content there");
            }
            if (colors > limits_.colors || inputs > limits_.inputs)
                error(LintRule::attachment_count, std::to_string(colors) + " colours and " +
                                                      std::to_string(inputs) +
                                                      " inputs are more than every device has");
            for (const ResourceUse& use : subpass.attachments)
                if (isWrite(use.access) && !subpass.is_empty)
                    has_content.insert(use.resource);
        }
        if (depths.size() > 1 || (with_depth > 0 && with_depth < pass_->subpasses.size()))
            error(LintRule::depth_changes,
                  "its subpasses have not all the same depth attachment, so drivers do not merge them");
        checkTileBits();
    }

    /// Sum colours and inputs over the pass: what lives on the tile at once.
    void checkTileBits()
    {
        uint32_t bits = 0;
        for (const AttachmentUse& use : pass_->attachments)
            if (use.resource != Resource::depth && use.resource != Resource::shadow_map)
                bits += static_cast<uint32_t>(8 * bytesPerPixel(*pass_, use.resource));
        const std::string text = std::to_string(bits) + " bits a pixel of colours and inputs are more than ";
        if (bits > limits_.error_bits)
            error(LintRule::tile_storage, text + std::to_string(limits_.error_bits));
        else if (bits > limits_.warning_bits)
            warn(LintRule::tile_storage, text + std::to_string(limits_.warning_bits));
    }

    void checkDraws()
    {
        for (const Subpass& subpass : pass_->subpasses)
        {
            if (subpass.is_empty)
                continue;
            if (subpass.draws.clears_by_command)
                error(LintRule::clear_command, "clears by a command, where a load operation can");
            if (subpass.draws.cover == Cover::quad)
                error(LintRule::diagonal,
                      "covers the frame by two triangles, whose diagonal crosses every tile on its way");
            if (subpass.draws.discards)
                warn(LintRule::late_depth, "discards fragments");
            if (subpass.draws.writes_fragment_depth)
                warn(LintRule::late_depth, "writes the depth of fragments");
        }
    }

    /// Compute work between draws stalls until the last fragment; the next frame's waits for what it left.
    void checkWaiting()
    {
        if (pass_->host_write == HostWrite::in_place)
            error(LintRule::host_race, "the CPU writes what an earlier frame may still read");
        if (pass_->kind != PassKind::compute)
            return;
        std::set<Resource> waited;
        for (const ResourceUse& use : pass_->uses)
            if (resourceFacts(use.resource).kind == ResourceKind::attachment &&
                waited.insert(use.resource).second)
                warn(LintRule::bubble,
                     std::string("waits for all fragments of the ") + resourceFacts(use.resource).name);
    }

    void checkFrame()
    {
        pass_ = nullptr;
        for (const Resource resource : kTileAttachments)
        {
            bool leaves_tile = false;
            for (const Pass& pass : frame_.passes)
                if (const AttachmentUse* use = findAttachment(pass, resource))
                    leaves_tile = leaves_tile || use->store || use->load == LoadOperation::load;
            const bool is_transient = std::find(frame_.transient.begin(), frame_.transient.end(), resource) !=
                                      frame_.transient.end();
            if (!leaves_tile && !is_transient)
                error(LintRule::not_transient, std::string("the ") + resourceFacts(resource).name +
                                                   " never leaves the tile and has memory");
        }
    }

    const FrameDescription& frame_;
    const LintLimits& limits_;
    const Pass* pass_ = nullptr;
    std::set<Resource> stored_; ///< with content that a pass can load
    int color_stores_ = 0;
    std::vector<LintFinding> findings_;
};

} // namespace

const char* ruleName(LintRule rule)
{
    return kRules[static_cast<size_t>(rule)];
}

Traffic measureTraffic(const Pass& pass)
{
    Traffic traffic;
    for (const AttachmentUse& use : pass.attachments)
    {
        traffic.low += use.load == LoadOperation::load ? bytesPerPixel(pass, use.resource) : 0;
        traffic.low += use.store ? bytesPerPixel(pass, use.resource) : 0;
    }
    for (const ResourceUse& use : pass.uses)
    {
        // a pass that adds to a resource reads it first
        const bool twice = isWrite(use.access) && use.content == Content::keep;
        const double bytes = bytesPerPixel(pass, use.resource) * double{use.share} * (twice ? 2 : 1);
        (isBuffer(use.resource) ? traffic.buffers : traffic.low) += bytes;
    }
    traffic.high = traffic.low + subpassTraffic(pass);
    return traffic;
}

Traffic measureTraffic(const FrameDescription& frame)
{
    Traffic sum;
    for (const Pass& pass : frame.passes)
    {
        if (hasOwnSize(pass))
            continue;
        const Traffic traffic = measureTraffic(pass);
        sum.low += traffic.low;
        sum.high += traffic.high;
        sum.buffers += traffic.buffers;
    }
    return sum;
}

std::vector<LintFinding> lint(const FrameDescription& frame, const LintLimits& limits)
{
    return Linter(frame, limits).run();
}

} // namespace hearth::gpu
