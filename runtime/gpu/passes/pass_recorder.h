// Records the passes of a planned frame in order: begins and ends render passes, moves on between subpasses,
// and waits before each pass as the table says. What is recorded is what is described, or an assertion fails.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_passes.h"

namespace hearth::gpu
{

class FrameTargets;

class PassRecorder
{
public:
    PassRecorder(const Device& device, VkCommandBuffer commands, const FramePlan& plan,
                 const FrameTargets& targets)
        : device_(device), commands_(commands), plan_(plan), targets_(targets)
    {
    }
    ~PassRecorder() { end(); }
    PassRecorder(const PassRecorder&) = delete;
    PassRecorder& operator=(const PassRecorder&) = delete;

    /// End the pass before, if the step is not its next subpass, and begin the one that has the step, with
    /// viewport and scissor set. Steps come in the table's order; those of shadow maps as often as there are
    /// maps.
    void begin(FrameStep step);
    /// The same for a pass that has a size of its own.
    void begin(FrameStep step, VkFramebuffer framebuffer, VkExtent2D extent);

    /// End the pass that was begun last, if there is one.
    void end();

    /// True if the frame has the step.
    bool has(FrameStep step) const;
    /// Output of the frame's shading.
    ShadedOutput shadedOutput() const;
    /// True if the frame has both steps in one render pass.
    bool sharesPass(FrameStep first, FrameStep second) const;

private:
    size_t findNext(FrameStep step) const;
    void beginPass(size_t number);
    void beginRenderPass(VkRenderPass render_pass, VkFramebuffer framebuffer, VkExtent2D extent);
    void wait(const PassBarrier& described) const;
    void nextSubpass();
    void handOut(const LayoutChange& change);
    void handOutColor() const;

    const Device& device_;
    VkCommandBuffer commands_;
    const FramePlan& plan_;
    const FrameTargets& targets_;
    size_t passes_begun_ = 0; ///< position after the pass begun last
    const Pass* open_ = nullptr;
    uint32_t subpass_ = 0; ///< of an open render pass
};

} // namespace hearth::gpu
