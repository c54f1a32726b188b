// Decides which texels of a receiver atlas are updated in a frame, by how far their light is from the weights
// that the lamps have now. Independent of Vulkan.
// Source: X. Guo and T. Li, "Practical High-Performance Rendering on Mobile Platforms", GDC 2023.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/receivers/receivers.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::pack
{

/// Differences of a lamp's weight that a group of texels may show for longer: above the first, half of the
/// texels are updated in a frame, above the second all. The talk's.
inline constexpr float kHalfUpdateChange = 0.04f;
inline constexpr float kFullUpdateChange = 0.08f;

/// Schedule of the updates of one atlas. The texels are in four groups, texel (x, y) in group
/// (x & 1) + 2 (y & 1). A frame updates all groups that are behind where the lamps differ by more than
/// kFullUpdateChange from what one of them shows, a checkerboard of two above kHalfUpdateChange, else one.
/// So no texel shows a weight that is further off, and all texels have the last weights after four frames
/// at most.
class ReceiverSchedule
{
public:
    /// All lamps begin with weight 1, and all texels without light.
    explicit ReceiverSchedule(size_t lamp_count);

    /// Set the weight of a lamp, red, green and blue: finite and at least 0 (asserted).
    void setWeight(size_t lamp, Float3 weight);
    std::span<const Float3> weights() const { return weights_; }

    /// Return the groups that this frame updates, by bits; 0 if all show the weights. They count as updated.
    uint32_t nextGroups();

private:
    /// Return the largest difference of a weight from what a group shows.
    float measureChange(uint32_t group) const;

    std::vector<Float3> weights_;
    std::array<std::vector<Float3>, shared::kReceiverGroups> shown_; ///< empty before the first update
    uint32_t next_turn_ = 0;                                         ///< of the groups in their order
};

} // namespace hearth::pack
