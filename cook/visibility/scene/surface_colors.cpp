// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/surface_colors.h"

#include "cook/visibility/rays/occluders.h"
#include "formats/base/half.h"
#include "formats/records/texel_wrap.h"
#include "formats/scene/reflectance.h"
#include "formats/texels/decoded_texel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Texels read for each one of a thumbnail, in each direction.
constexpr uint32_t kReadsPerTexel = 8;

// Part of a texture, in each direction, above which a triangle has its mean.
constexpr float kMaxUvExtent = 0.25f;

float linearFromSrgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Read the colours of single texels.
class TexelReader
{
public:
    TexelReader(const ImageRecord& record, std::span<const std::byte> bytes) : record_(record), bytes_(bytes)
    {
        for (uint32_t i = 0; i < 256; ++i)
            linear_[i] = isSrgb() ? linearFromSrgb(static_cast<float>(i) / 255) : static_cast<float>(i) / 255;
    }

    Float3 read(uint32_t x, uint32_t y) const
    {
        const uint32_t size = texelBytes(record_.format);
        const std::byte* texel = bytes_.data() + (size_t{y} * record_.width + x) * size;
        Float3 color;
        for (int c = 0; c < 3; ++c)
        {
            if (size == 4)
            {
                color[c] = linear_[std::to_integer<uint8_t>(texel[c])];
                continue;
            }
            uint16_t word;
            std::memcpy(&word, texel + 2 * c, sizeof(word));
            color[c] = isUnorm16(record_.format) ? linear_[narrowUnorm(word)] : floatFromHalf(word);
        }
        return color;
    }

private:
    bool isSrgb() const
    {
        return record_.format == static_cast<uint32_t>(TexelFormat::rgba8_srgb) ||
               record_.format == static_cast<uint32_t>(TexelFormat::rgba16_srgb);
    }

    const ImageRecord& record_;
    std::span<const std::byte> bytes_;
    std::array<float, 256> linear_{};
};

ColorThumbnail makeThumbnail(const ImageRecord& record, std::span<const std::byte> bytes)
{
    const TexelReader reader(record, bytes);
    constexpr uint32_t kReads = ColorThumbnail::kSide * kReadsPerTexel;
    ColorThumbnail thumbnail;
    for (uint32_t y = 0; y < kReads; ++y)
        for (uint32_t x = 0; x < kReads; ++x)
        {
            const auto column = static_cast<uint32_t>(uint64_t{x} * record.width / kReads);
            const auto row = static_cast<uint32_t>(uint64_t{y} * record.height / kReads);
            thumbnail.texels[size_t{y / kReadsPerTexel} * ColorThumbnail::kSide + x / kReadsPerTexel] +=
                reader.read(column, row) / float{kReadsPerTexel * kReadsPerTexel};
        }
    for (const Float3& texel : thumbnail.texels)
        thumbnail.mean += texel / static_cast<float>(thumbnail.texels.size());
    return thumbnail;
}

Float2 transformed(const TextureRef& texture, Float2 uv)
{
    const float* m = texture.uv_transform;
    const auto row = [&](const float* r)
    { return std::clamp(r[0] * uv.x + r[1] * uv.y + r[2], -kMaxUvMagnitude, kMaxUvMagnitude); };
    return {row(m), row(m + 3)};
}

/// Return the colour of a texture on a triangle with these texture coordinates at its corners.
Float3 look(const ColorThumbnail& thumbnail, const TextureRef& texture, const std::array<Float2, 3>& uvs)
{
    std::array<Float2, 3> at;
    std::ranges::transform(uvs, at.begin(), [&](Float2 uv) { return transformed(texture, uv); });
    const auto [low_x, high_x] = std::minmax({at[0].x, at[1].x, at[2].x});
    const auto [low_y, high_y] = std::minmax({at[0].y, at[1].y, at[2].y});
    if (high_x - low_x > kMaxUvExtent || high_y - low_y > kMaxUvExtent)
        return thumbnail.mean;
    const Float2 middle = (at[0] + at[1] + at[2]) * (1.0f / 3);
    const auto texel = [](float place, uint8_t wrap)
    {
        constexpr uint32_t kSide = ColorThumbnail::kSide;
        return static_cast<size_t>(wrapTexel(static_cast<int64_t>(std::floor(place * kSide)), kSide, wrap));
    };
    return thumbnail
        .texels[texel(middle.y, texture.wrap_v) * ColorThumbnail::kSide + texel(middle.x, texture.wrap_u)];
}

/// Return the mean colour of a triangle's vertices.
Float3 vertexColor(const ClusterGeometry& geometry, const std::array<uint32_t, 3>& corners)
{
    if (!geometry.has(kVertexColor))
        return {1, 1, 1};
    Float3 sum;
    for (const uint32_t corner : corners)
    {
        const Float4 color = geometry.color(corner);
        sum += Float3{color.x, color.y, color.z} / 3;
    }
    return sum;
}

} // namespace

Result<const ColorThumbnail*> SurfaceColors::findThumbnail(uint32_t material, uint32_t image)
{
    if (image >= thumbnails_.size())
        return Error{Issue::meaning_reference, scene_->name(), "material " + std::to_string(material),
                     "image " + std::to_string(image)};
    if (thumbnails_[image] == nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, scene_->imageData(image));
        const ImageRecord& record = scene_->images()[image];
        if (data.bytes().size() < size_t{record.width} * record.height * texelBytes(record.format))
            return Error{Issue::chunk_size, scene_->name(), "image " + std::to_string(image),
                         "it has fewer texels than its size says"};
        thumbnails_[image] = std::make_unique<const ColorThumbnail>(makeThumbnail(record, data.bytes()));
    }
    return thumbnails_[image].get();
}

Result<std::vector<uint32_t>> SurfaceColors::find(const MeshPages& pages, const LevelArrays& level)
{
    std::vector<uint32_t> colors;
    colors.reserve(level.triangle_materials.size());
    for (const LevelArrays::Part& part : level.parts)
    {
        const ClusterGeometry geometry = pages.cluster(part.cluster);
        const uint32_t number = pages.part().clusters()[part.cluster].material;
        const bool has_record = number < scene_->materials().size();
        // glTF's default material is white
        const MaterialRecord material = has_record ? scene_->materials()[number] : MaterialRecord{};
        const Float3 factor =
            has_record ? Float3{material.base_color.x, material.base_color.y, material.base_color.z}
                       : Float3{1, 1, 1};
        const TextureRef& texture = material.base_color_texture;
        const ColorThumbnail* thumbnail = nullptr;
        if (has_record && texture.image != kInvalidIndex)
        {
            HEARTH_ASSIGN_OR_RETURN(thumbnail, findThumbnail(number, texture.image));
        }
        Float3 metallic_roughness{1, 1, 1};
        if (has_record && material.metallic_roughness_texture.image != kInvalidIndex)
        {
            HEARTH_ASSIGN_OR_RETURN(const ColorThumbnail* const values,
                                    findThumbnail(number, material.metallic_roughness_texture.image));
            metallic_roughness = values->mean;
        }
        const auto reflect = [&](Float3 base)
        {
            return has_record ? shared::bihemisphericalReflectance(min(max(base, {0, 0, 0}), {1, 1, 1}),
                                                                   material.metallic * metallic_roughness.z,
                                                                   shared::defaultDielectric(),
                                                                   material.roughness * metallic_roughness.y)
                              : base;
        };
        const bool has_uvs =
            thumbnail != nullptr && texture.uv_set < 4 && geometry.has(kVertexUv0 << texture.uv_set);
        const bool double_sided = (material.flags & kMaterialDoubleSided) != 0;
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        {
            const std::array<uint32_t, 3> corners = geometry.triangle(t);
            std::array<Float2, 3> uvs{};
            if (has_uvs)
                std::ranges::transform(corners, uvs.begin(),
                                       [&](uint32_t v) { return geometry.uv(v, texture.uv_set); });
            const Float3 texel = thumbnail == nullptr ? Float3{1, 1, 1} : look(*thumbnail, texture, uvs);
            colors.push_back(
                encodeSurfaceColor(reflect(factor * texel * vertexColor(geometry, corners)), double_sided));
        }
    }
    return colors;
}

} // namespace hearth::visibility
