// Adds meshes of a scene to the occluders: a level, with the holes that alpha masks cut, and its colours.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/alpha_mask.h"
#include "cook/visibility/rays/occluders.h"
#include "cook/visibility/scene/level_meshes.h"
#include "cook/visibility/scene/surface_colors.h"

#include <memory>
#include <vector>

namespace hearth::visibility
{

/// Alpha masks of a scene's materials.
class SceneMasks
{
public:
    /// scene  the import part: materials and images; must outlive this
    explicit SceneMasks(const formats::PackView& scene) : scene_(&scene), images_(scene.images().size()) {}

    /// Return the mask of a material, nullptr if it has none; images are read once.
    /// errors: those of readAlpha; meaning_reference for a missing image
    Result<std::shared_ptr<const AlphaMask>> find(uint32_t material);

    /// Return whether a material blocks rays, outside of its mask. Blended surfaces dim light, but let it
    /// through; unlit ones are skies (formats/scene/lit_material.h).
    bool occludes(uint32_t material) const;

private:
    const formats::MaterialRecord* record(uint32_t material) const;

    const formats::PackView* scene_;
    std::vector<std::shared_ptr<const AlphaImage>> images_;
};

/// True if joints or morph targets move the mesh's vertices. Such a mesh occludes only itself.
bool isDeformed(const formats::MeshRecord& mesh);

/// True if rays can be transformed into an instance's space; false for one that is flat in the world.
bool isInvertible(const Affine3& world_from_object);

/// Properties of a scene's materials that rays ask for.
struct SceneSurfaces
{
    /// scene  the import part; must outlive this
    explicit SceneSurfaces(const formats::PackView& scene) : masks(scene), colors(scene) {}

    SceneMasks masks;
    SurfaceColors colors;
};

/// Add a level of a mesh once for each of the transforms.
/// errors: those of SceneMasks::find and SurfaceColors::find
Status addMesh(Occluders& occluders, SceneSurfaces& surfaces, const MeshPages& pages,
               const LevelArrays& level, std::span<const Affine3> world_from_mesh);

} // namespace hearth::visibility
