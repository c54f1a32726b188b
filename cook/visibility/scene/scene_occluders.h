// What of a mesh is in the way of rays: its finest level, with the holes that alpha masks cut.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/alpha_mask.h"
#include "cook/visibility/rays/occluders.h"
#include "cook/visibility/scene/level_meshes.h"

#include <memory>
#include <vector>

namespace hearth::visibility
{

/// The masks of a scene's materials.
class SceneMasks
{
public:
    /// scene  the import part: materials and images. The view must outlive it
    explicit SceneMasks(const formats::PackView& scene) : scene_(&scene), images_(scene.images().size()) {}

    /// The mask of a material, nullptr if it has none; images are read once.
    /// errors: those of alphaOf; meaning_reference for an image that is not there
    Result<std::shared_ptr<const AlphaMask>> of(uint32_t material);

    /// Whether a material lets all rays through: what is blended dims, but hides nothing.
    bool letsThrough(uint32_t material) const;

private:
    const formats::MaterialRecord* record(uint32_t material) const;

    const formats::PackView* scene_;
    std::vector<std::shared_ptr<const AlphaImage>> images_;
};

/// Add the finest level of a mesh once for each of the transforms.
/// errors: those of SceneMasks::of
Status addMesh(Occluders& occluders, SceneMasks& masks, const MeshPages& pages, const LevelArrays& finest,
               std::span<const Affine3> world_from_mesh);

} // namespace hearth::visibility
