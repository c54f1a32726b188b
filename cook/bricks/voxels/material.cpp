// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/material.h"

#include "cook/bricks/voxels/coverage.h"

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
    use.record.emissive_texture.image = kInvalidIndex;
    return use;
}

Float3 meanAlbedo(const SurfaceMaterial& material)
{
    Float3 albedo = rgb(material.record.base_color);
    if (material.base_color)
    {
        const Texture& texture = *material.base_color;
        const uint32_t whole = texture.mipFor(std::max(texture.width(), texture.height()), 1);
        albedo = albedo * rgb(texture.at(material.record.base_color_texture, {0.5f, 0.5f}, whole));
    }
    return clampToUnit(albedo);
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
    std::vector<SurfaceMaterial> uses;
    for (uint32_t i = 0; i < scene.materials().size(); ++i)
    {
        SurfaceMaterial use{scene.materials()[i], nullptr, nullptr};
        HEARTH_ASSIGN_OR_RETURN(use.base_color, findTexture(i, use.record.base_color_texture));
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
    if (material.base_color)
    {
        const double texels = texelsPerVoxel(*material.base_color, material.record.base_color_texture,
                                             look.base_color_uv, size);
        base_color_mip_ = material.base_color->mipFor(texels, kColorTexelsPerVoxel);
        alpha_mip_ = material.base_color->mipFor(texels, kCoverageTexelsPerVoxel);
    }
    if (material.emissive)
        emissive_mip_ = material.emissive->mipFor(
            texelsPerVoxel(*material.emissive, material.record.emissive_texture, look.emissive_uv, size),
            kColorTexelsPerVoxel);
    plain_ = !material.base_color && !material.emissive && look.color[0] == look.color[1] &&
             look.color[0] == look.color[2];
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

SurfaceSample TriangleSurface::at(const Double3& p) const
{
    const std::array<float, 3> weights = weightsAt(p);
    SurfaceSample look;
    look.albedo = rgb(material_.record.base_color);
    look.albedo =
        look.albedo * (rgb(attributes_.color[0]) * weights[0] + rgb(attributes_.color[1]) * weights[1] +
                       rgb(attributes_.color[2]) * weights[2]);
    if (material_.base_color)
    {
        const TextureRef& reference = material_.record.base_color_texture;
        const Float2 uv = transformed(reference, mixed(attributes_.base_color_uv, weights));
        look.albedo = look.albedo * rgb(material_.base_color->at(reference, uv, base_color_mip_));
    }
    look.albedo = clampToUnit(look.albedo);
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
