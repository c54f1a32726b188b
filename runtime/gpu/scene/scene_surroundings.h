// Surroundings of a scene's instances: rows behind the lights in their buffer, which follow the lights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/radiance_transfer.h"
#include "formats/scene/scene_lighting.h"
#include "runtime/gpu/vulkan/mirrored_table.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

class SceneSurroundings
{
public:
    using Row = std::array<uint32_t, 4>;

    /// pack      with surroundings
    /// lighting  of the scene, as loaded
    SceneSurroundings(const formats::PackView& pack, shared::SceneLighting lighting);

    /// Return the number of rows of a pack; 0 if it has no surroundings.
    static uint64_t countRows(const formats::PackView& pack);

    /// Return the number of the rows before those of instances.
    static uint64_t countTransferRows(const formats::PackView& pack);

    /// Return all rows under the present lights.
    std::vector<Row> makeRows() const;

    /// Take the new state of a light; the next update() has it.
    void change(uint32_t slot, const shared::Light& record);

    /// Take the new colours of the sky; the next update() has them.
    void changeSky(const shared::Sky& sky);

    /// Write the rows that depend on the lights, if the sky or a directional light has changed.
    /// offset  of the rows in the table
    void update(MirroredTable& lighting, VkDeviceSize offset);

private:
    std::vector<shared::OccluderLight> makeOccluderLights() const;

    std::vector<formats::RadianceTransferRecord> transfers_;
    std::vector<Row> instances_;
    shared::SceneLighting lighting_;
    bool changed_ = false;
};

} // namespace hearth::gpu
