// Rigid instances that move: new transforms for the tables on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <span>

namespace hearth::gpu
{

/// What a new transform changes in the tables; holds until the next one.
struct InstanceMove
{
    uint32_t instance = 0;
    shared::Instance record{};
    shared::InstanceInverse inverse{};
};

/// `world_from_object` is finite; it may mirror what was loaded unmirrored, and the other way round. errors: usage.
Result<InstanceMove> moveInstance(const Scene& scene, uint32_t instance, const Affine3& world_from_object);

/// Two small copies for each. Between barriers of the caller: after all that reads the tables, before what shall see
/// the new ones.
void recordMoves(const Device& device, VkCommandBuffer commands, const Scene& scene,
                 std::span<const InstanceMove> moves);

} // namespace hearth::gpu
