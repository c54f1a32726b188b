// Evaluates albedo, emission and opacity of a material at points of a triangle.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/polygon_clip.h"
#include "cook/bricks/voxels/texture.h"
#include "formats/gpu_shared/reflectance.h"

#include <memory>
#include <span>

namespace hearth::bricks
{

/// Material values at one point of a surface.
struct SurfaceSample
{
    /// Share of light that is reflected, linear Rec.709, 0 to 1: diffuse and specular reflection together, of
    /// dielectrics and metals, because all reflections count as diffuse light here.
    Float3 albedo;
    Float3 emission;    ///< radiance, linear Rec.709
    float coverage = 1; ///< opacity: 0 in the holes of a mask, alpha of blended materials
};

struct SurfaceMaterial
{
    formats::MaterialRecord record;
    shared::DielectricReflectance dielectric;
    std::shared_ptr<const Texture> base_color = nullptr; ///< may be null, like the others
    std::shared_ptr<const Texture> metallic_roughness = nullptr;
    std::shared_ptr<const Texture> emissive = nullptr;

    bool doubleSided() const { return (record.flags & formats::kMaterialDoubleSided) != 0; }
    formats::AlphaMode alphaMode() const { return static_cast<formats::AlphaMode>(record.alpha_mode); }
    bool hasHoles() const { return alphaMode() != formats::AlphaMode::opaque; }
};

/// Return glTF's default material, for triangles without a material index.
SurfaceMaterial defaultMaterial();

/// Return the albedo of the means of the textures, without vertex colours.
Float3 meanAlbedo(const SurfaceMaterial& material);

/// Read the materials of a source, with the images of its textures part.
/// errors: meaning_reference for a missing image
Result<std::vector<SurfaceMaterial>> readMaterials(const formats::PackView& scene,
                                                   const formats::PackView& textures);

/// Vertex attributes of one triangle's corners.
struct TriangleAttributes
{
    std::array<Float2, 3> base_color_uv; ///< before the texture's transform, like the others
    std::array<Float2, 3> metallic_roughness_uv;
    std::array<Float2, 3> emissive_uv;
    std::array<Float4, 3> color{Float4{1, 1, 1, 1}, Float4{1, 1, 1, 1}, Float4{1, 1, 1, 1}};
};

/// Read the attributes of a triangle that its material needs.
/// corners  vertices of the triangle
TriangleAttributes readTriangleAttributes(const formats::ClusterGeometry& geometry,
                                          const std::array<uint32_t, 3>& corners,
                                          const SurfaceMaterial& material);

/// Triangle in voxel coordinates with its material. Evaluates the material at any point of the triangle.
class TriangleSurface
{
public:
    /// Construct from a material and a triangle.
    /// material, corners, look  must outlive this
    /// corners                  in voxels, with an area above 0
    TriangleSurface(const SurfaceMaterial& material, const Polygon& corners, const TriangleAttributes& look);

    /// True if the material values are the same at all points.
    bool plain() const { return plain_; }

    /// Return the material values at point p of the triangle.
    SurfaceSample at(const Double3& p) const;
    /// Return the opacity alone, from a mip fine enough for coverage samples.
    float coverageAt(const Double3& p) const;

private:
    std::array<float, 3> weightsAt(const Double3& p) const;
    Float3 albedo(const std::array<float, 3>& weights) const;
    float alpha(const std::array<float, 3>& weights, uint32_t mip) const;
    float coverageFromAlpha(float alpha) const;

    const SurfaceMaterial& material_;
    const Polygon& corners_;
    const TriangleAttributes& attributes_;
    bool plain_ = true;
    int axis_ = 0; ///< axis along which the triangle's projection is largest
    double area_ = 0;
    uint32_t base_color_mip_ = 0;
    uint32_t alpha_mip_ = 0;
    uint32_t metallic_roughness_mip_ = 0;
    uint32_t emissive_mip_ = 0;
};

} // namespace hearth::bricks
