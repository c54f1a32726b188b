// Makes the scene of a bake of receivers from the parts of its sources.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "cook/receivers/bake/bake_scene.h"
#include "formats/scene/scene_lighting.h"

#include <memory>

namespace hearth::receivers
{

/// Scene of a bake. Its instances are those of the static scene.
struct ReceiverScene
{
    BakeScene bake;
    /// UV set of each instance's receivers: the first that can be used, of the second to the last and then
    /// the first one, which mostly repeats textures. kInvalidIndex: it has no UVs.
    std::vector<uint32_t> uv_sets;
    std::vector<uint32_t> mesh_light_instances; ///< instance of each mesh light
    /// The only lamp is the sun of a scene without lights, which no light of a source stands for.
    bool has_default_sun = false;
    std::shared_ptr<const shared::SkyImage> sky_image; ///< of the sky, if it has one
};

/// Read the finest triangles, the lights and the sky as the runtime draws them (bricks::makeSceneLighting),
/// and the emissive triangles of each instance as a mesh light. Light is exposed. Albedo and emission of a
/// triangle are the means of four of its points. Surfaces with holes neither block nor reflect light.
/// probes  of the sky; none: the default sky
/// errors: errors of decoding pages and textures
Result<ReceiverScene> makeReceiverScene(const bricks::StaticScene& scene,
                                        const shared::SceneProbes& probes = {});

} // namespace hearth::receivers
