// Receivers of a scene: which of its lights and instances are lamps of them, their weights, and the rows in
// which shading finds the rectangles of instances. Texels and faces themselves are receiver_pass.h's.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"
#include "formats/gpu_shared/receivers/receiver_rows.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"
#include "formats/pack/pack_view.h"
#include "runtime/gpu/receivers/probe_weights.h"
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
    /// pack    checked, with receivers
    /// lights  of the pack as loaded, exposed
    /// probes  that are drawn
    SceneReceivers(const formats::PackView& pack, std::span<const shared::Light> lights,
                   const shared::LocalProbes& probes);

    /// Rows of all instances as they are now.
    std::span<const shared::ReceiverRow> rows() const { return rows_; }

    /// Take the new state of a light: its lamp follows its intensity, of flicker and clips as well. A light
    /// that is not where it was baked has no light in receivers until it is back.
    /// returns  bits of shared::Light::reflector_axis: kLightBaked if surfaces with a rectangle leave it out,
    ///          never for suns, whose direct light texels do not have; kLightOnFaces if passes over bricks do
    uint32_t takeLight(uint32_t slot, const shared::Light& light);

    /// True if a light shines that the faces of bricks do not have: passes over bricks have to bounce it.
    bool hasLiveLight() const { return live_count_ > 0; }

    /// Take the sky of a frame: steady light is that of the baked sky, and gets the ratio of what both
    /// give level ground. It is exact where the sky changes its brightness and colour alone.
    void takeSky(const shared::Sky& sky, const shared::Sky& baked);

    /// Set the weight of an instance's emission, in its row and of its lamp. Returns the row.
    const shared::ReceiverRow& weighEmission(uint32_t instance, Float3 weight);

    /// Take a move of an instance, which has its rectangle only where it was baked. Returns the row.
    const shared::ReceiverRow& takeMove(uint32_t instance, bool is_at_rest);

    /// Return the update groups that a frame is to update, by bits, as if it did; see ReceiverSchedule.
    /// shows_drops  the frame is a view of texels that do not keep all lamps: a change updates all
    uint32_t beginUpdate(bool shows_drops = false);
    /// Return the groups of faces that are behind, as if the frame updated them. Frames without GI leave
    /// them.
    uint32_t beginFaceUpdate();
    /// Groups of the last frame.
    uint32_t updatedGroups() const { return updated_groups_; }
    /// Groups of faces of the last frame.
    uint32_t updatedFaceGroups() const { return updated_face_groups_; }
    /// Costs of an update of texels, by its groups.
    const pack::ReceiverCost& cost(uint32_t groups) const { return costs_[groups]; }
    /// The same of faces.
    const pack::ReceiverCost& faceCost(uint32_t groups) const { return face_costs_[groups]; }
    std::span<const Float3> weights() const { return schedule_.weights(); }
    const ProbeWeights& probeWeights() const { return probe_weights_; }

    std::optional<ReceiverAtlas> atlas; ///< set by the upload; none without texels
    std::optional<ReceiverFaces> faces; ///< the same; none without faces

private:
    void setLive(uint32_t slot, bool is_live);

    bool has_faces_;
    ProbeWeights probe_weights_;
    uint32_t steady_lamp_ = kInvalidIndex;
    std::vector<uint32_t> lamps_of_lights_;    ///< [slot]: lamp, or kInvalidIndex
    std::vector<uint32_t> lamps_of_instances_; ///< [instance]: the same
    std::vector<shared::Light> loaded_;        ///< lights of the pack
    std::vector<shared::ReceiverRow> rows_;
    std::vector<uint32_t> sizes_; ///< [instance]: ReceiverRow::size at rest
    pack::ReceiverSchedule schedule_;
    using Costs = std::array<pack::ReceiverCost, 1u << shared::kReceiverGroups>;
    Costs costs_, face_costs_; ///< by groups
    uint32_t updated_groups_ = 0, updated_face_groups_ = 0;
    bool shows_drops_ = false;
    uint32_t late_face_groups_ = 0; ///< that show older weights than texels
    std::vector<bool> is_live_;     ///< [slot]
    size_t live_count_ = 0;
};

} // namespace hearth::gpu
