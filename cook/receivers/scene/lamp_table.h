// Lamps of receivers: what a game may weigh, and the lights of the scene that each of them stands for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/scene/receiver_scene.h"
#include "formats/records/receivers.h"

#include <vector>

namespace hearth::receivers
{

/// Return the instance of the pack for each of the static scene: records of all sources follow each other.
std::vector<uint32_t> findPackInstances(const bricks::StaticScene& scene);

/// Lamps, and the lights that each of them sums, numbered as those of BakeScene.
struct LampTable
{
    std::vector<formats::ReceiverLampRecord> records; ///< steady light is the first
    std::vector<std::vector<size_t>> lights;          ///< [records]
};

/// Make a lamp of each light of the sources, and of each instance that emits. Steady light is that of the sky
/// and of the default sun.
/// pack_instances  of findPackInstances
LampTable makeLampTable(const ReceiverScene& receivers, std::span<const uint32_t> pack_instances);

} // namespace hearth::receivers
