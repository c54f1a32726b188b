// What a material's surface gives back, gives off and hides, at points of a triangle.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/texture.h"
#include "cook/bricks/voxels/voxel_clip.h"

#include <memory>
#include <span>

namespace hearth::bricks
{

/// A point of a surface.
struct Look
{
    Float3
        albedo; ///< base colour, linear Rec.709, 0 to 1; a metal's too: what it mirrors is light all the same
    Float3 emission;  ///< radiance, linear Rec.709
    float hidden = 1; ///< of what lies behind: 0 in the holes of a mask, alpha of what is blended
};

struct MaterialUse
{
    formats::MaterialRecord record;
    std::shared_ptr<const Texture> base_color; ///< may be null, here and below
    std::shared_ptr<const Texture> emissive;

    bool doubleSided() const { return (record.flags & formats::kMaterialDoubleSided) != 0; }
    bool unlit() const { return (record.flags & formats::kMaterialUnlit) != 0; }
    formats::AlphaMode alphaMode() const { return static_cast<formats::AlphaMode>(record.alpha_mode); }
    bool hasHoles() const { return alphaMode() != formats::AlphaMode::opaque; }
};

/// What a material without a number is: glTF's default.
MaterialUse defaultMaterial();

/// The materials of a source, with the images of its textures part.
/// errors: meaning_reference for an image that is not there
Result<std::vector<MaterialUse>> materialsOf(const formats::PackView& scene,
                                             const formats::PackView& textures);

/// The attributes of one triangle's corners.
struct TriangleLook
{
    std::array<Float2, 3> base_color_uv; ///< before the texture's transform, here and below
    std::array<Float2, 3> emissive_uv;
    std::array<Float4, 3> color{Float4{1, 1, 1, 1}, Float4{1, 1, 1, 1}, Float4{1, 1, 1, 1}};
};

/// A triangle in voxels and its material: looks at it wherever a voxel has a piece of it.
class TriangleSurface
{
public:
    /// material  outlives it
    /// corners   in voxels; the triangle has an area
    TriangleSurface(const MaterialUse& material, const Polygon& corners, const TriangleLook& look);

    /// Whether it looks the same everywhere.
    bool plain() const { return plain_; }

    /// p  a point of the triangle
    Look at(const Double3& p) const;
    /// Look::hidden alone, by a mip fine enough for the samples of a cross-section.
    float hiddenAt(const Double3& p) const;

private:
    std::array<float, 3> weightsAt(const Double3& p) const;
    float alpha(const std::array<float, 3>& weights, uint32_t mip) const;
    float hiddenBy(float alpha) const;

    const MaterialUse& material_;
    const Polygon& corners_;
    const TriangleLook& look_;
    bool plain_ = true;
    int axis_ = 0; ///< along which the triangle is seen largest
    double area_ = 0;
    uint32_t base_color_mip_ = 0;
    uint32_t alpha_mip_ = 0;
    uint32_t emissive_mip_ = 0;
};

} // namespace hearth::bricks
