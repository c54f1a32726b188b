// Cooks the receivers of a scene: bakes the light of each lamp, and packs it in an atlas.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "cook/receivers/bake/bake.h"
#include "cook/receivers/select/atlas.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/scene_lighting.h"

#include <string>
#include <vector>

namespace hearth::receivers
{

struct CookSettings
{
    BakeSettings bake;
    AtlasOptions atlas;
};

/// Mesh whose UVs cannot address texels.
struct UnusableMesh
{
    std::string source; ///< name of its file
    std::string name;
    std::string reason; ///< "its UVs overlap" as a clause
};

/// Instances without receivers, by reason. Those that move or are unlit are in bricks::ExcludedInstances.
struct InstancesWithoutUvs
{
    uint32_t none = 0; ///< mesh without UVs
    uint32_t flat = 0;
    uint32_t outside = 0;
    uint32_t overlapping = 0;
    uint32_t transparent = 0; ///< all surfaces have holes
};

struct CookedReceivers
{
    Atlas atlas; ///< of width 0 if no instance has receivers
    Atlas faces; ///< of the grid of bricks, with the same lamps; of width 0 without a grid
    bricks::ExcludedInstances left_out;
    InstancesWithoutUvs without_uvs;
    std::vector<UnusableMesh> unusable_meshes; ///< by source and mesh
    uint64_t shadow_rays = 0, gather_rays = 0;
};

/// Cook the receivers of all static instances, and of the faces of bricks. The result does not depend on
/// the number of threads.
///
/// Each light of the sources is a lamp, and so is each instance that emits. Steady light is that of the sky,
/// and what surfaces give back of the default sun.
/// bricks  checked part with a grid that was cooked from the scene, or null
/// errors: errors of decoding pages and textures; input_too_large where the atlas or the lamps are too many
Result<CookedReceivers> cookReceivers(const bricks::StaticScene& scene, const shared::SceneProbes& probes,
                                      const formats::PackView* bricks, const CookSettings& settings);

} // namespace hearth::receivers
