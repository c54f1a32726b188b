// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/scene_occluders.h"

#include "formats/base/affine3d.h"
#include "formats/scene/lit_material.h"

#include <map>

namespace hearth::visibility
{

using namespace formats;

namespace
{

/// Triangles that share a mask, or have none.
struct OccluderTriangles
{
    std::vector<uint32_t> corners;
    std::vector<uint32_t> colors;
};

/// Triangles of each material with a mask; key kInvalidIndex: all triangles without a mask.
using TrianglesByMaterial = std::map<uint32_t, OccluderTriangles>;

/// Collect the UVs of a set at all vertices of the level; vertices without the set get 0.
std::vector<Float2> collectUvs(const MeshPages& pages, const LevelArrays& level, uint32_t set)
{
    std::vector<Float2> uvs(level.positions.size());
    for (const LevelArrays::Part& part : level.parts)
    {
        const ClusterGeometry geometry = pages.cluster(part.cluster);
        if (geometry.has(kVertexUv0 << set))
            for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
                uvs[part.first_vertex + v] = geometry.uv(v, set);
    }
    return uvs;
}

/// Create the mask of triangles.
/// uvs  at the corners, three for each triangle
Mask createMask(std::shared_ptr<const AlphaMask> mask, std::vector<Float2> uvs)
{
    return [mask = std::move(mask), uvs = std::move(uvs)](uint32_t triangle, float u, float v)
    {
        const Float2* corner = &uvs[size_t{triangle} * 3];
        const float w = 1 - u - v;
        return mask->isOpaque({corner[0].x * w + corner[1].x * u + corner[2].x * v,
                               corner[0].y * w + corner[1].y * u + corner[2].y * v});
    };
}

} // namespace

const MaterialRecord* SceneMasks::record(uint32_t material) const
{
    return material < scene_->materials().size() ? &scene_->materials()[material] : nullptr;
}

bool SceneMasks::occludes(uint32_t material) const
{
    const MaterialRecord* found = record(material);
    return found == nullptr ||
           (isLit(*found) && found->alpha_mode != static_cast<uint32_t>(AlphaMode::blend));
}

Result<std::shared_ptr<const AlphaMask>> SceneMasks::find(uint32_t material)
{
    const MaterialRecord* found = record(material);
    if (found == nullptr || found->alpha_mode != static_cast<uint32_t>(AlphaMode::mask))
        return std::shared_ptr<const AlphaMask>();
    const uint32_t image = found->base_color_texture.image;
    if (image != kInvalidIndex && image >= images_.size())
        return Error{Issue::meaning_reference, scene_->name(), "material " + std::to_string(material),
                     "image " + std::to_string(image)};
    if (image != kInvalidIndex && !images_[image])
    {
        HEARTH_ASSIGN_OR_RETURN(AlphaImage alpha, readAlpha(*scene_, image));
        images_[image] = std::make_shared<const AlphaImage>(std::move(alpha));
    }
    return std::make_shared<const AlphaMask>(*found, image == kInvalidIndex ? nullptr : images_[image]);
}

bool isDeformed(const MeshRecord& mesh)
{
    return mesh.skinned != 0 || mesh.morph_target_count != 0;
}

bool isInvertible(const Affine3& world_from_object)
{
    return inverted(widened(world_from_object)).has_value();
}

Status addMesh(Occluders& occluders, SceneSurfaces& surfaces, const MeshPages& pages,
               const LevelArrays& level, std::span<const Affine3> world_from_mesh)
{
    SceneMasks& masks = surfaces.masks;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<uint32_t> colors, surfaces.colors.find(pages, level));
    std::map<uint32_t, std::shared_ptr<const AlphaMask>> mask_of_material;
    TrianglesByMaterial triangles;
    for (size_t t = 0; t < level.triangle_materials.size(); ++t)
    {
        const uint32_t material = level.triangle_materials[t];
        if (!masks.occludes(material))
            continue;
        if (!mask_of_material.contains(material))
        {
            HEARTH_ASSIGN_OR_RETURN(mask_of_material[material], masks.find(material));
        }
        OccluderTriangles& of_material = triangles[mask_of_material[material] ? material : kInvalidIndex];
        of_material.corners.insert(of_material.corners.end(), &level.indices[t * 3],
                                   &level.indices[t * 3] + 3);
        of_material.colors.push_back(colors[t]);
    }
    for (const auto& [material, of_material] : triangles)
    {
        OccluderMesh mesh{
            .positions = level.positions, .corners = of_material.corners, .colors = of_material.colors};
        if (material != kInvalidIndex)
        {
            const auto& mask = mask_of_material[material];
            const std::vector<Float2> uvs = collectUvs(pages, level, mask->uvSet());
            std::vector<Float2> at_corners;
            for (const uint32_t corner : of_material.corners)
                at_corners.push_back(uvs[corner]);
            mesh.mask = createMask(mask, std::move(at_corners));
        }
        const Occluders::Mesh added = occluders.add(mesh);
        for (const Affine3& transform : world_from_mesh)
            occluders.place(added, transform);
    }
    return success();
}

} // namespace hearth::visibility
