// Receivers of a scene: which of its lights and instances the atlas has, their weights, and the rows in which
// shading finds the rectangles of instances. The atlas itself is receiver_pass.h's.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"
#include "formats/gpu_shared/receivers/receiver_rows.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"
#include "formats/pack/pack_view.h"
#include "runtime/gpu/receivers/receiver_pass.h"
#include "runtime/pack/receivers/receiver_light.h"

#include <array>
#include <optional>
#include <vector>

namespace hearth::gpu
{

class SceneReceivers
{
public:
    /// pack    checked, with an atlas
    /// lights  of the pack as loaded, exposed
    SceneReceivers(const formats::PackView& pack, std::span<const shared::Light> lights);

    /// Rows of all instances as they are now.
    std::span<const shared::ReceiverRow> rows() const { return rows_; }

    /// Take the new state of a light: the atlas's lamp follows its intensity, of flicker and clips as well. A
    /// light that is not where it was baked has no light in the atlas until it is back.
    /// returns  true if surfaces with a rectangle leave the light out: a lamp whose light the atlas has.
    ///          Suns never are: their direct light is not baked
    bool takeLight(uint32_t slot, const shared::Light& light);

    /// Take the sky of a frame: steady light is that of the baked sky, and gets the ratio of what both
    /// give level ground. It is exact where the sky changes its brightness and colour alone.
    void takeSky(const shared::Sky& sky, const shared::Sky& baked);

    /// Set the weight of an instance's emission, in its row and of its lamp. Returns the row.
    const shared::ReceiverRow& weighEmission(uint32_t instance, Float3 weight);

    /// Take a move of an instance, which has its rectangle only where it was baked. Returns the row.
    const shared::ReceiverRow& takeMove(uint32_t instance, bool is_at_rest);

    /// Return the update groups that a frame is to update, by bits, as if it did; see ReceiverSchedule.
    uint32_t beginUpdate();
    /// Groups of the last frame.
    uint32_t updatedGroups() const { return updated_groups_; }
    /// Cost of an update of all groups.
    const pack::ReceiverCost& fullCost() const { return costs_.back(); }
    /// Cost of the last frame's update.
    const pack::ReceiverCost& updateCost() const { return costs_[updated_groups_]; }
    std::span<const Float3> weights() const { return schedule_.weights(); }

    std::optional<ReceiverAtlas> atlas; ///< set by the upload

private:
    uint32_t steady_lamp_ = kInvalidIndex;
    std::vector<uint32_t> lamps_of_lights_;    ///< [slot]: lamp, or kInvalidIndex
    std::vector<uint32_t> lamps_of_instances_; ///< [instance]: the same
    std::vector<shared::Light> loaded_;        ///< lights of the pack
    std::vector<shared::ReceiverRow> rows_;
    std::vector<uint32_t> sizes_; ///< [instance]: ReceiverRow::size at rest
    pack::ReceiverSchedule schedule_;
    std::array<pack::ReceiverCost, 1u << shared::kReceiverGroups> costs_; ///< by groups
    uint32_t updated_groups_ = 0;
};

} // namespace hearth::gpu
