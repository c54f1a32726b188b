// How a pack is arranged for drawing: the work lists, the bins, addresses in the geometry pool. Plain data, no Vulkan.
// Computed once when a scene is loaded; see runtime/gpu/README.md, "Bins".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/gpu/scene/deformation_layout.h"
#include "runtime/gpu/scene/pool_layout.h"

#include <vector>

namespace hearth::gpu
{

enum class Facing : uint8_t
{
    culled,      ///< back faces are not drawn
    mirrored,    ///< the same for instances that turn the triangles round
    doubleSided, ///< both faces are drawn
};

/// What is drawn by one indirect draw: same pipeline, same descriptor sets.
struct SceneBin
{
    bool alpha_tested = false; ///< the material decides which pixels are there
    uint32_t material_row = 0; ///< of the alpha-tested material; 0 where it does not matter
    Facing facing = Facing::culled;
    bool unlit = false;    ///< casts no shadow: a dome with the sky on it would leave no sun
    bool deformed = false; ///< its clusters are those of deformed instances
    shared::Bin items{};
};

struct SceneLayout
{
    std::vector<shared::WorkItem> items; ///< sorted by bin, then instance, then cluster
    uint32_t rigid_items = 0;            ///< the first ones: the bins of deformed instances are the last
    std::vector<uint32_t> order;         ///< cluster numbers; of each mesh, those of one bin together
    std::vector<SceneBin> bins;
    std::vector<shared::ClusterDraw> draws;        ///< for each cluster
    std::vector<shared::MeshBounds> bounds;        ///< for each mesh, then for each deformed instance
    std::vector<shared::Instance> instances;       ///< those of the pack, deformed ones at rest
    std::vector<shared::InstanceInverse> inverses; ///< for each instance
    DeformationLayout deformation;
    PoolLayout pool;
    uint64_t instanced_clusters =
        0;                      ///< over all instances, all clusters of the mesh: what a frame draws at most
    uint32_t material_rows = 0; ///< materials of the pack, and the default material behind them
};

/// Row of the material table for a material index of the pack, which may be formats::kNone.
uint32_t materialRow(const formats::PackView& pack, uint32_t material);

/// What drawing needs of a cluster whose page lies at `page_address` of the geometry pool.
shared::ClusterDraw makeClusterDraw(const formats::PackView& pack, uint32_t cluster, uint32_t page_address);

/// The groups of every instance, mesh by mesh: what the page requests look at. Rigid instances first.
struct GroupItems
{
    std::vector<shared::GroupItem> items;
    uint32_t rigid_items = 0; ///< the first ones
};
GroupItems makeGroupItems(const formats::PackView& pack);

/// Clusters of pages without a place get an address that means nothing.
/// errors: device_limit, where the scene is larger than any device of Vulkan 1.1 must be able to take.
Result<SceneLayout> makeSceneLayout(const formats::PackView& pack, PoolLayout pool);

/// With a place for every page.
Result<SceneLayout> makeSceneLayout(const formats::PackView& pack);

} // namespace hearth::gpu
