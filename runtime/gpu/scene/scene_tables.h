// Tables of a scene as bindings: one list of tables makes the set layout of a compute pass and fills its
// sets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/bindings.h"
#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

/// Return the bindings of tables.
/// tables  shared::kTable*, each once
std::vector<SetBinding> tableBindings(std::span<const uint32_t> tables, VkShaderStageFlags stages);

/// Create a pipeline whose set shared::kSetTables has these tables; it owns the layout of that set.
/// other  layout of its only other set
Result<ComputePipeline> createTablePipeline(const Device& device, std::span<const uint32_t> spirv,
                                            std::span<const uint32_t> tables, uint32_t push_bytes,
                                            std::optional<NumberedSet> other = std::nullopt);

/// View of a frame in flight, whose tables a set has.
struct TableView
{
    const Scene& scene;
    uint32_t frame; ///< of Scene::frames
    const SceneView& view;
};
inline TableView mainView(const Scene& scene, uint32_t frame)
{
    return {scene, frame, scene.frames[frame].main};
}

/// Write the tables to a set. shared::kTableStatistics is no table of the scene and is left to its pass.
void writeTables(const Device& device, const TableView& from, VkDescriptorSet set,
                 std::span<const uint32_t> tables);

/// Allocate a set with the layout of a pipeline from the scene's pool, and write the tables to it.
Result<VkDescriptorSet> createTableSet(const Device& device, const TableView& from,
                                       const ComputePipeline& pipeline, std::span<const uint32_t> tables);

/// Write the bindings of the pool for a frame in flight into a set of the scene.
void writePool(const Scene& scene, uint32_t frame, DescriptorWriter& writer);

/// Write the pool into all sets of a frame in flight, which is not yet recorded; the one before it in its
/// place has completed.
void rebindPool(const Device& device, const Scene& scene, uint32_t frame);

} // namespace hearth::gpu
