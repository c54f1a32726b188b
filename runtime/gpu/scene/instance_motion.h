// Moving rigid instances: new transforms for the tables on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <span>

namespace hearth::gpu
{

/// Table rows for a new transform of an instance; valid until the next one.
struct InstanceMove
{
    uint32_t instance = 0;
    shared::Instance record{};
    shared::InstanceInverse inverse{};
};

/// Compute the table rows. `world_from_object` is finite; it may flip the handedness of the loaded transform.
/// An instance that moves loses its rectangle of receivers, whose light is that of its place at loading: it
/// is lit like one without, until it is moved back to exactly where it was. errors: usage.
Result<InstanceMove> moveInstance(const Scene& scene, uint32_t instance, const Affine3& world_from_object);

/// Write moves to the tables, and to those of receivers.
void takeMoves(const Scene& scene, std::span<const InstanceMove> moves);

} // namespace hearth::gpu
