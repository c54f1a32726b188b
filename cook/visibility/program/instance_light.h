// Bakes the light that the occluders of instances give back, chunk XFER.
// See cook/visibility/README.md, "Light of occluders".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/light/radiance_transfer.h"
#include "cook/visibility/program/instance_samples.h"

#include <span>
#include <vector>

namespace hearth::visibility
{

/// Bakes the radiance transfers of the instances of a scene.
class InstanceLight
{
public:
    /// group_count  sum of countGroups over all meshes, which share the budget of rays
    InstanceLight(uint64_t group_count, const TransferSettings& settings);

    /// Return the number of records that the instances of a mesh share: neighbours share one where there are
    /// many.
    static size_t countGroups(size_t instance_count);

    /// Bake the instances of a mesh among occluders in the world.
    /// records  of the scene's instances; those of the mesh get their transfers
    void bakeInWorld(const Occluders& world, const SampledSurface& surface,
                     std::span<const MeshInstance> instances, std::span<formats::SurroundingsRecord> records);

    /// Bake the instances of a mesh that occludes only itself, in its own space.
    void bakeAlone(const Occluders& itself, const SampledSurface& surface,
                   std::span<const MeshInstance> instances, std::span<formats::SurroundingsRecord> records);

    std::span<const formats::RadianceTransferRecord> transfers() const { return transfers_; }

private:
    /// Bake groups of instances.
    /// make_points  returns the points of a group
    template <typename MakePoints>
    void bakeGroups(const Occluders& occluders, std::span<const MeshInstance> instances,
                    std::span<formats::SurroundingsRecord> records, const MakePoints& make_points);

    uint32_t points_per_group_;
    TransferSettings settings_;
    std::vector<formats::RadianceTransferRecord> transfers_;
};

} // namespace hearth::visibility
