// The culling passes computed one element after the other, by the same shared lines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/cull_statistics.h"
#include "formats/gpu_shared/occlusion.h"
#include "formats/pack/pack_view.h"
#include "runtime/gpu/scene/scene_layout.h"

#include <vector>

namespace hearth::test
{

struct Pyramid
{
    shared::OcclusionView view{};
    std::vector<float> texels;
};

/// The pyramid of a depth buffer, as slow and obvious code.
std::vector<float> makePyramid(const std::vector<float>& depth, uint32_t width, uint32_t height);

/// What the passes leave in their buffers.
struct Twin
{
    std::vector<shared::InstanceState> states;
    std::vector<shared::WorkResult> results;
    std::vector<uint32_t> totals;
    std::vector<shared::VisibleCluster> visible;
    std::vector<shared::BinDraw> bin_draws; ///< of all bins, then those of the late phase
    std::vector<uint32_t> material_draws;
    uint32_t early_clusters = 0;
    shared::CullStatistics statistics{}; ///< as CullStatisticsPass leaves them
};

/// Without kCullOcclusion in the view's flags the pyramids are not looked at.
/// last: what the early phase finds;  current: what it leaves to the late one
/// resident_groups: for each group, not 0 if it is there; empty: all are
Twin makeTwin(const formats::PackView& pack, const gpu::SceneLayout& layout, const shared::FrameView& view,
              const Pyramid& last = {}, const Pyramid& current = {},
              std::span<const uint8_t> resident_groups = {});

/// For each page what shared::groupPriority says at most.
std::vector<uint32_t> makeRequestTwin(const formats::PackView& pack, const gpu::SceneLayout& layout,
                                      const shared::FrameView& view);

/// Set poses as frames do.
void applyPoses(std::span<const gpu::InstancePose> poses, gpu::SceneLayout& layout);

} // namespace hearth::test
