// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/material.h"

#include "cook/bricks/voxels/coverage.h"
#include "formats/pack/part_materials.h"
#include "formats/scene/reflectance.h"

#include <map>

namespace hearth::bricks
{

using namespace formats;

namespace
{

// Texels per voxel for colours. With two, features between samples are no wider than a texel of the voxel's
// size.
constexpr double kColorTexelsPerVoxel = 2;
constexpr double kCoverageTexelsPerVoxel = kSamplesPerEdge;

Float3 rgb(Float4 color)
{
    return {color.x, color.y, color.z};
}

Float3 clampToUnit(Float3 c)
{
    return min(max(c, {0, 0, 0}), {1, 1, 1});
}

/// Return the albedo of a material. base, metallic_roughness: textures included.
Float3 reflectedShare(const SurfaceMaterial& material, Float3 base, Float4 metallic_roughness)
{
    return clampToUnit(shared::bihemisphericalReflectance(
        clampToUnit(base), std::clamp(metallic_roughness.z * material.record.metallic, 0.0f, 1.0f),
        material.dielectric, std::clamp(metallic_roughness.y * material.record.roughness, 0.0f, 1.0f)));
}

Float2 mixed(const std::array<Float2, 3>& values, const std::array<float, 3>& weights)
{
    return values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2];
}

/// Return the number of texels of the finest mip along a voxel's edge, averaged over the directions of the
/// triangle.
double texelsPerVoxel(const Texture& texture, const TextureRef& reference, const std::array<Float2, 3>& uvs,
                      double voxel_area)
{
    std::array<Float2, 3> at;
    for (size_t i = 0; i < 3; ++i)
        at[i] = transformed(reference, uvs[i]);
    const Float2 a = at[1] - at[0], b = at[2] - at[0];
    const double area = std::abs(double{a.x} * b.y - double{a.y} * b.x) * texture.width() * texture.height();
    return std::sqrt(area / voxel_area);
}

} // namespace

SurfaceMaterial defaultMaterial()
{
    SurfaceMaterial use{};
    use.record.base_color = {1, 1, 1, 1};
    use.record.base_color_texture.image = kInvalidIndex;
    use.record.metallic_roughness_texture.image = kInvalidIndex;
    use.record.emissive_texture.image = kInvalidIndex;
    use.record.metallic = 1;
    use.record.roughness = 1;
    use.dielectric = shared::defaultDielectric();
    return use;
}

Float3 meanAlbedo(const SurfaceMaterial& material)
{
    const auto mean = [](const std::shared_ptr<const Texture>& texture, const TextureRef& reference)
    {
        if (!texture)
            return Float4{1, 1, 1, 1};
        const uint32_t whole = texture->mipFor(std::max(texture->width(), texture->height()), 1);
        return texture->at(reference, {0.5f, 0.5f}, whole);
    };
    const MaterialRecord& record = material.record;
    return reflectedShare(material,
                          rgb(record.base_color) * rgb(mean(material.base_color, record.base_color_texture)),
                          mean(material.metallic_roughness, record.metallic_roughness_texture));
}

Result<std::vector<SurfaceMaterial>> readMaterials(const PackView& scene, const PackView& textures)
{
    std::map<uint32_t, std::shared_ptr<const Texture>> images;
    const auto findTexture = [&](uint32_t material,
                                 const TextureRef& reference) -> Result<std::shared_ptr<const Texture>>
    {
        if (reference.image == kInvalidIndex)
            return std::shared_ptr<const Texture>();
        if (reference.image >= textures.images().size())
            return Error{Issue::meaning_reference, textures.name(), "material " + std::to_string(material),
                         "image " + std::to_string(reference.image)};
        std::shared_ptr<const Texture>& image = images[reference.image];
        if (!image)
            image = std::make_shared<const Texture>(textures, reference.image);
        return image;
    };
    const std::span<const MaterialRecord> materials = findMaterials(scene, textures);
    std::vector<SurfaceMaterial> uses;
    for (uint32_t i = 0; i < materials.size(); ++i)
    {
        SurfaceMaterial use{.record = materials[i], .dielectric = shared::defaultDielectric()};
        if (const MaterialLayersRecord* layers = findLayers(findMaterialLayers(scene, textures), i))
            use.dielectric = shared::specularDielectric(shared::dielectricF0(*layers), layers->specular);
        HEARTH_ASSIGN_OR_RETURN(use.base_color, findTexture(i, use.record.base_color_texture));
        HEARTH_ASSIGN_OR_RETURN(use.metallic_roughness,
                                findTexture(i, use.record.metallic_roughness_texture));
        const Float3 emissive = use.record.emissive;
        if (emissive.x > 0 || emissive.y > 0 || emissive.z > 0)
        {
            HEARTH_ASSIGN_OR_RETURN(use.emissive, findTexture(i, use.record.emissive_texture));
        }
        uses.push_back(std::move(use));
    }
    return uses;
}

TriangleAttributes readTriangleAttributes(const ClusterGeometry& geometry,
                                          const std::array<uint32_t, 3>& corners,
                                          const SurfaceMaterial& material)
{
    TriangleAttributes look;
    const auto uvs = [&](const TextureRef& reference, std::array<Float2, 3>& out)
    {
        if (reference.uv_set < 4 && geometry.has(kVertexUv0 << reference.uv_set))
            for (size_t i = 0; i < 3; ++i)
                out[i] = geometry.uv(corners[i], reference.uv_set);
    };
    if (material.base_color)
        uvs(material.record.base_color_texture, look.base_color_uv);
    if (material.metallic_roughness)
        uvs(material.record.metallic_roughness_texture, look.metallic_roughness_uv);
    if (material.emissive)
        uvs(material.record.emissive_texture, look.emissive_uv);
    if (geometry.has(kVertexColor))
        for (size_t i = 0; i < 3; ++i)
            look.color[i] = geometry.color(corners[i]);
    return look;
}

TriangleSurface::TriangleSurface(const SurfaceMaterial& material, const Polygon& corners,
                                 const TriangleAttributes& look)
    : material_(material), corners_(corners), attributes_(look)
{
    const Double3 area = doubleArea(corners);
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(coordinate(area, axis)) > std::abs(coordinate(area, axis_)))
            axis_ = axis;
    area_ = coordinate(area, axis_);
    const double size = length(area);
    const auto findMip = [&](const std::shared_ptr<const Texture>& texture, const TextureRef& reference,
                             const std::array<Float2, 3>& uvs, double texels)
    { return texture ? texture->mipFor(texelsPerVoxel(*texture, reference, uvs, size), texels) : 0; };
    const MaterialRecord& record = material.record;
    base_color_mip_ =
        findMip(material.base_color, record.base_color_texture, look.base_color_uv, kColorTexelsPerVoxel);
    alpha_mip_ =
        findMip(material.base_color, record.base_color_texture, look.base_color_uv, kCoverageTexelsPerVoxel);
    metallic_roughness_mip_ = findMip(material.metallic_roughness, record.metallic_roughness_texture,
                                      look.metallic_roughness_uv, kColorTexelsPerVoxel);
    emissive_mip_ =
        findMip(material.emissive, record.emissive_texture, look.emissive_uv, kColorTexelsPerVoxel);
    plain_ = !material.base_color && !material.metallic_roughness && !material.emissive &&
             look.color[0] == look.color[1] && look.color[0] == look.color[2];
}

std::array<float, 3> TriangleSurface::weightsAt(const Double3& p) const
{
    const int u = uAxis(axis_), v = vAxis(axis_);
    const auto signedDoubleArea = [&](const Double3& a, const Double3& b)
    {
        return (coordinate(a, u) - coordinate(p, u)) * (coordinate(b, v) - coordinate(p, v)) -
               (coordinate(a, v) - coordinate(p, v)) * (coordinate(b, u) - coordinate(p, u));
    };
    const auto& corner = corners_.points;
    const auto first =
        static_cast<float>(std::clamp(signedDoubleArea(corner[1], corner[2]) / area_, 0.0, 1.0));
    const auto second =
        static_cast<float>(std::clamp(signedDoubleArea(corner[2], corner[0]) / area_, 0.0, 1.0));
    return {first, second, 1 - first - second};
}

float TriangleSurface::alpha(const std::array<float, 3>& weights, uint32_t mip) const
{
    float alpha = material_.record.base_color.w;
    alpha *= attributes_.color[0].w * weights[0] + attributes_.color[1].w * weights[1] +
             attributes_.color[2].w * weights[2];
    if (material_.base_color)
    {
        const TextureRef& reference = material_.record.base_color_texture;
        alpha *= material_.base_color
                     ->at(reference, transformed(reference, mixed(attributes_.base_color_uv, weights)), mip)
                     .w;
    }
    return alpha;
}

float TriangleSurface::coverageFromAlpha(float alpha) const
{
    switch (material_.alphaMode())
    {
    case AlphaMode::opaque:
        return 1;
    case AlphaMode::mask:
        return alpha >= material_.record.alpha_cutoff ? 1.0f : 0.0f;
    case AlphaMode::blend:
        break;
    }
    return std::clamp(alpha, 0.0f, 1.0f);
}

Float3 TriangleSurface::albedo(const std::array<float, 3>& weights) const
{
    const MaterialRecord& record = material_.record;
    Float3 base = rgb(record.base_color) *
                  (rgb(attributes_.color[0]) * weights[0] + rgb(attributes_.color[1]) * weights[1] +
                   rgb(attributes_.color[2]) * weights[2]);
    if (material_.base_color)
    {
        const TextureRef& reference = record.base_color_texture;
        const Float2 uv = transformed(reference, mixed(attributes_.base_color_uv, weights));
        base = base * rgb(material_.base_color->at(reference, uv, base_color_mip_));
    }
    Float4 metallic_roughness{1, 1, 1, 1};
    if (material_.metallic_roughness)
    {
        const TextureRef& reference = record.metallic_roughness_texture;
        const Float2 uv = transformed(reference, mixed(attributes_.metallic_roughness_uv, weights));
        metallic_roughness = material_.metallic_roughness->at(reference, uv, metallic_roughness_mip_);
    }
    return reflectedShare(material_, base, metallic_roughness);
}

SurfaceSample TriangleSurface::at(const Double3& p) const
{
    const std::array<float, 3> weights = weightsAt(p);
    SurfaceSample look;
    look.albedo = albedo(weights);
    look.emission = material_.record.emissive;
    if (material_.emissive)
    {
        const TextureRef& reference = material_.record.emissive_texture;
        const Float2 uv = transformed(reference, mixed(attributes_.emissive_uv, weights));
        look.emission = look.emission * rgb(material_.emissive->at(reference, uv, emissive_mip_));
    }
    if (material_.hasHoles())
        look.coverage = coverageFromAlpha(alpha(weights, alpha_mip_));
    return look;
}

float TriangleSurface::coverageAt(const Double3& p) const
{
    return material_.hasHoles() ? coverageFromAlpha(alpha(weightsAt(p), alpha_mip_)) : 1.0f;
}

} // namespace hearth::bricks
