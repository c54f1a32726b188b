// Marks which material each pixel has, so that a fixed-function test limits the draw of a material to its
// pixels: in the depth, or in a stencil where the depth has to stay. Begins FrameStep::shading and normals.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Bits of a material's number that the stencil has. The shader tells apart numbers that differ in higher
/// bits only.
inline constexpr uint32_t kStencilBits = 8;

class MaterialMarksPass
{
public:
    /// step  that the marks are for
    static Result<MaterialMarksPass> create(const Device& device, const DrawLayouts& layouts,
                                            const FramePasses& passes, ShadedOutput output, FrameStep step);

    /// Record in that step, with viewport and scissor set and the stencil, if there is one, 0. Clobbers the
    /// graphics state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets) const;

private:
    MaterialTest materials_ = MaterialTest::depth;
    LightPath path_ = LightPath::materials;
    UniquePipeline pipeline_;
};

} // namespace hearth::gpu
