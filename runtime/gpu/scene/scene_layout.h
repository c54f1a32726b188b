// Draw layout of a pack: work lists, bins, addresses in the geometry pool. Plain data, no Vulkan. Computed
// once when a scene is loaded; see runtime/gpu/README.md, "Bins".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/proxy_casters.h"
#include "runtime/gpu/materials/material_shaders.h"
#include "runtime/gpu/scene/deformation_layout.h"
#include "runtime/gpu/scene/pool_layout.h"

#include <vector>

namespace hearth::gpu
{

enum class Facing : uint8_t
{
    culled,      ///< back faces are not drawn
    mirrored,    ///< the same for instances that flip the winding
    doubleSided, ///< both faces are drawn
};

/// Bin: everything that one indirect draw can draw. Same pipeline, same descriptor sets.
struct SceneBin
{
    bool alpha_tested = false; ///< the material's alpha texture discards pixels
    uint32_t motion = 0;       ///< MaterialBinding::motion
    uint32_t material_row = 0; ///< of an alpha-tested material, or one with a motion; 0 for other bins
    Facing facing = Facing::culled;
    bool unlit = false;    ///< casts no shadow: a sky dome would block the sun
    bool deformed = false; ///< clusters of deformed instances
    shared::Bin items{};
};

/// Reach of materials that move vertices. All empty if there are none.
struct VertexMotions
{
    std::vector<float> reaches;                   ///< per mesh: metres in object space, 0 if it does not move
    std::vector<formats::ClusterRecord> clusters; ///< of the pack, whose boxes hold what moves
    std::vector<uint32_t> instances;              ///< that move
};

struct SceneLayout
{
    std::vector<shared::WorkItem> items; ///< sorted by bin, then instance, then cluster
    uint32_t rigid_items = 0;            ///< come first: the bins of deformed instances are the last
    std::vector<uint32_t> order;         ///< cluster ids; per mesh, the clusters of one bin are adjacent
    std::vector<SceneBin> bins;
    std::vector<shared::ClusterDraw> draws;        ///< per cluster
    std::vector<shared::MeshBounds> bounds;        ///< per mesh, then per deformed instance
    std::vector<shared::ProxyCaster> proxies;      ///< as bounds; empty unless proxies cast shadows
    std::vector<shared::Instance> instances;       ///< instances of the pack, deformed ones at rest
    std::vector<shared::InstanceInverse> inverses; ///< per instance
    DeformationLayout deformation;
    PoolLayout pool;
    /// Sum over all instances of the clusters of their meshes: the most that a frame draws.
    uint64_t instanced_clusters = 0;
    uint64_t proxy_chunks = 0;  ///< of the proxies of all instances
    uint32_t material_rows = 0; ///< materials of the pack, then the default material
    VertexMotions motions;
};

/// Return the row of the material table for a material index of the pack, which may be kInvalidIndex.
uint32_t materialRow(const formats::PackView& pack, uint32_t material);

/// Draw record of a cluster whose page is at `page_address` of the geometry pool.
shared::ClusterDraw makeClusterDraw(const formats::PackView& pack, uint32_t cluster, uint32_t page_address);

/// Groups of every instance, mesh by mesh, for the page requests. Rigid instances first.
struct GroupItems
{
    std::vector<shared::GroupItem> items;
    uint32_t rigid_items = 0; ///< come first
};
GroupItems makeGroupItems(const formats::PackView& pack);

/// Compute the layout. Clusters of pages without a place get a meaningless address.
/// bindings  of the materials; or empty: none has a motion
/// errors: device_limit if the scene exceeds the limits that every Vulkan 1.1 device supports; usage if a
/// motion is to move vertices of a deformed mesh.
Result<SceneLayout> makeSceneLayout(const formats::PackView& pack, PoolLayout pool,
                                    std::span<const MaterialBinding> bindings = {});

/// Let the proxies of a pack cast the shadows of its meshes. Bounds of these meshes then contain the proxies.
void addProxyCasters(const formats::PackView& pack, SceneLayout& layout);

/// Compute the layout with a place for every page.
Result<SceneLayout> makeSceneLayout(const formats::PackView& pack);

} // namespace hearth::gpu
