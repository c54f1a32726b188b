// Adds lights to stored surfaces, or to sums of light ahead of shading: by a list for each pixel, or light by
// light in the pixels within its volume. Volumes are marked in the stencil, wherever the eye is, as those of
// shadows: C. Everitt, M. Kilgard, "Practical and robust stenciled shadow volumes for hardware-accelerated
// rendering", 2002.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/passes/shading_pass.h"
#include "runtime/gpu/scene/scene.h"

#include <map>

namespace hearth::gpu
{

class AddLightsPass
{
public:
    /// output  one whose frames have FrameStep::add_lights
    static Result<AddLightsPass> create(const Device& device, const DrawLayouts& layouts,
                                        const FramePasses& passes, ShadedOutput output);

    /// Create the pipelines of a scene that has its LitSets. Call before frames are recorded. errors:
    /// device_failed.
    Status prepare(const Device& device, const DrawLayouts& layouts, LightMethod method, const Scene& scene);

    /// Record in FrameStep::add_lights, with viewport and scissor set. Clobbers the graphics state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const;

private:
    /// Facts that pipelines differ by.
    struct Variant
    {
        bool shadowed = false;
        bool filters_shadows = false;
        bool reflects = false; ///< shared::kConstantReflects
        uint32_t light_list = 0;

        auto operator<=>(const Variant&) const = default;
    };
    static Variant makeVariant(const Scene& scene, LightMethod method, bool reflects);
    GraphicsDescription describe(std::span<const uint32_t> vertex, std::span<const uint32_t> fragment,
                                 VkPipelineLayout layout) const;
    struct Shaders;
    Shaders chooseShaders(bool shadowed) const;
    void recordVolumes(const Device& device, VkCommandBuffer commands, const Scene& scene,
                       VkPipeline light) const;

    struct Pipelines
    {
        UniquePipeline lists;
        UniquePipeline volume; ///< of methods that draw volumes
    };
    LightPath path_ = LightPath::surfaces;
    DrawPlace place_{};
    FrameWay way_ = FrameWay::merged;
    UniquePipeline zero_;    ///< takes the numbers of materials out of the stencil
    UniquePipeline enclose_; ///< marks the pixels in a volume
    std::map<Variant, Pipelines> pipelines_;
};

} // namespace hearth::gpu
