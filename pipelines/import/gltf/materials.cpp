// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/materials.h"

#include "pipelines/import/gltf/images.h"
#include "pipelines/import/gltf/specular_glossiness.h"
#include "pipelines/import/images/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace hearth::import
{

using namespace formats;

namespace
{

constexpr TextureRef kNoTexture{kInvalidIndex, 0, 0, 0, 0, {1, 0, 0, 0, 1, 0}};

/// Two textures of a glTF material that become the channels of one.
struct TexturePair
{
    const GltfTextureUse& first;
    const GltfTextureUse& second;
    std::string_view first_name;
    std::string_view second_name;
    ImagePurpose purpose;
    uint32_t first_channels; ///< bits, as for mergeChannels; `second` has the others
    bool uses_second;        ///< false: a factor of 0 hides the values of `second`
};

/// Return whether two uses of textures read the same texel of their images.
bool isAlike(const GltfTextureUse& a, const GltfTextureUse& b, const GltfModel& model)
{
    const GltfTexture &first = model.textures[a.texture], &second = model.textures[b.texture];
    return a.uv_set == b.uv_set && a.uv_transform == b.uv_transform && first.wrap_u == second.wrap_u &&
           first.wrap_v == second.wrap_v && first.nearest == second.nearest;
}

class MaterialWriter
{
public:
    MaterialWriter(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context)
        : model_(model), context_(context), images_(model, buffers, context)
    {
    }

    Status writeAll();

private:
    void registerAlphaCutoffs();
    Result<MaterialRecord> convert(const GltfMaterial& material);
    Status convertSpecularGlossinessMaterial(const GltfMaterial& material, MaterialRecord& record);
    Status convertTextures(const GltfMaterial& material, MaterialRecord& record);
    Status writeLayers(const GltfMaterial& material, uint32_t index);
    std::optional<DecodedImage> decodeBytes(const GltfTextureUse& use, std::string_view name);
    Result<TextureRef> referencePair(TexturePair pair);
    Result<TextureRef> reference(const GltfTextureUse& use, ImagePurpose purpose, std::string_view name);
    TextureRef referenceTo(uint32_t part_image, const GltfTextureUse& use) const;
    uint32_t sourceImage(const GltfTextureUse& use) const
    {
        return use.texture == kInvalidIndex ? kInvalidIndex : model_.textures[use.texture].image;
    }

    const GltfModel& model_;
    const GltfContext& context_;
    GltfImages images_;
    // the material that is being written
    std::string where_;
    std::string display_name_; ///< for messages: "material \"oak\""
};

/// Return the threshold for the texture's own alpha, which the shader multiplies with the factor's.
float textureCutoff(float cutoff, float alpha_factor)
{
    return cutoff / std::max(alpha_factor, 1e-3f);
}

/// Register the alpha cutoffs before any image is written: a later material may test an image that an earlier
/// one uses.
void MaterialWriter::registerAlphaCutoffs()
{
    for (const GltfMaterial& material : model_.materials)
    {
        const auto& converted = material.specular_glossiness;
        const uint32_t image =
            sourceImage(converted ? converted->diffuse_texture : material.base_color_texture);
        const float alpha_factor = converted ? converted->diffuse[3] : material.base_color[3];
        if (material.alpha_mode == AlphaMode::mask && image != kInvalidIndex)
            images_.setAlphaCutoff(image, textureCutoff(material.alpha_cutoff, alpha_factor));
    }
}

TextureRef MaterialWriter::referenceTo(uint32_t part_image, const GltfTextureUse& use) const
{
    const GltfTexture& texture = model_.textures[use.texture];
    TextureRef reference = kNoTexture;
    reference.image = part_image;
    reference.uv_set = static_cast<uint8_t>(use.uv_set);
    reference.wrap_u = static_cast<uint8_t>(texture.wrap_u);
    reference.wrap_v = static_cast<uint8_t>(texture.wrap_v);
    reference.nearest = texture.nearest ? 1 : 0;
    std::copy(use.uv_transform.begin(), use.uv_transform.end(), reference.uv_transform);
    return reference;
}

Result<TextureRef> MaterialWriter::reference(const GltfTextureUse& use, ImagePurpose purpose,
                                             std::string_view name)
{
    if (use.texture == kInvalidIndex)
        return kNoTexture;
    if (use.uv_set >= mesh::kUvSetCount)
    {
        context_.part.warn(Issue::dropped, where_,
                           fmt::format("{} is not kept: there is no UV set {}", name, use.uv_set));
        return kNoTexture;
    }
    HEARTH_ASSIGN_OR_RETURN(
        const uint32_t image,
        images_.write(sourceImage(use), purpose, fmt::format("/textures/{}", use.texture), display_name_));
    return referenceTo(image, use);
}

/// Convert a material. Only the factors are converted without textures, or if the two textures have different
/// UV mappings.
Status MaterialWriter::convertSpecularGlossinessMaterial(const GltfMaterial& material, MaterialRecord& record)
{
    const GltfSpecularGlossiness& source = *material.specular_glossiness;
    const GltfTextureUse& diffuse = source.diffuse_texture;
    const GltfTextureUse& specular = source.specular_glossiness_texture;
    context_.part.warn(Issue::degraded, where_, "specular-glossiness was converted to metallic-roughness");

    const bool same_place =
        diffuse.texture == kInvalidIndex ||
        (diffuse.uv_set == specular.uv_set && diffuse.uv_transform == specular.uv_transform);
    if (specular.texture != kInvalidIndex && specular.uv_set < mesh::kUvSetCount && same_place)
    {
        const auto decoded = [&](const GltfTextureUse& use)
        {
            if (use.texture == kInvalidIndex)
                return DecodedImage{};
            const std::string where = fmt::format("/textures/{}", use.texture);
            auto texels = images_.decode(sourceImage(use), where, display_name_);
            if (!texels || texels->isFloat())
                return DecodedImage{};
            if (texels->type == ChannelType::unorm16)
                context_.part.warn(Issue::image_depth, where,
                                   fmt::format("specular-glossiness of {} was converted in 8 bits a channel, "
                                               "the source has 16",
                                               display_name_));
            return narrow(std::move(*texels));
        };
        const DecodedImage specular_image = decoded(specular);
        const MetallicRoughnessImages images =
            convertSpecularGlossiness(source, decoded(diffuse), specular_image);
        if (!images.base_color.texels.empty())
        {
            const auto cutoff =
                material.alpha_mode == AlphaMode::mask ? std::optional(material.alpha_cutoff) : std::nullopt;
            HEARTH_ASSIGN_OR_RETURN(const uint32_t base,
                                    images_.writeComputed(images.base_color, ImagePurpose::color,
                                                          material.name + " base colour", cutoff));
            HEARTH_ASSIGN_OR_RETURN(const uint32_t surface,
                                    images_.writeComputed(images.metallic_roughness, ImagePurpose::data,
                                                          material.name + " metallic-roughness",
                                                          std::nullopt));
            record.base_color = {1, 1, 1, 1};
            record.metallic = 1;
            record.roughness = 1;
            record.base_color_texture =
                referenceTo(base, diffuse.texture != kInvalidIndex ? diffuse : specular);
            record.metallic_roughness_texture = referenceTo(surface, specular);
            return success();
        }
    }
    const MetallicRoughness factors =
        convertSpecularGlossiness({{source.diffuse[0], source.diffuse[1], source.diffuse[2]},
                                   {source.specular[0], source.specular[1], source.specular[2]},
                                   source.glossiness});
    record.base_color = {factors.base_color.x, factors.base_color.y, factors.base_color.z, source.diffuse[3]};
    record.metallic = factors.metallic;
    record.roughness = factors.roughness;
    HEARTH_ASSIGN_OR_RETURN(record.base_color_texture,
                            reference(diffuse, ImagePurpose::color, "diffuseTexture"));
    return success();
}

Status MaterialWriter::convertTextures(const GltfMaterial& material, MaterialRecord& record)
{
    if (material.specular_glossiness)
        HEARTH_TRY(convertSpecularGlossinessMaterial(material, record));
    else
    {
        HEARTH_ASSIGN_OR_RETURN(
            record.base_color_texture,
            reference(material.base_color_texture, ImagePurpose::color, "baseColorTexture"));
        HEARTH_ASSIGN_OR_RETURN(
            record.metallic_roughness_texture,
            reference(material.metallic_roughness_texture, ImagePurpose::data, "metallicRoughnessTexture"));
    }
    HEARTH_ASSIGN_OR_RETURN(record.normal_texture,
                            reference(material.normal_texture, ImagePurpose::normal, "normalTexture"));
    HEARTH_ASSIGN_OR_RETURN(record.occlusion_texture,
                            reference(material.occlusion_texture, ImagePurpose::data, "occlusionTexture"));
    HEARTH_ASSIGN_OR_RETURN(record.emissive_texture,
                            reference(material.emissive_texture, ImagePurpose::color, "emissiveTexture"));
    return success();
}

/// Decode an image whose channels are copied: 8 bits each. Returns nullopt and a warning if that is not
/// possible.
std::optional<DecodedImage> MaterialWriter::decodeBytes(const GltfTextureUse& use, std::string_view name)
{
    const uint32_t source = sourceImage(use);
    const std::string where = source == kInvalidIndex ? fmt::format("/textures/{}", use.texture)
                                                      : fmt::format("/images/{}", source);
    std::optional<DecodedImage> image = images_.decode(source, where, display_name_);
    if (!image)
        return std::nullopt;
    if (image->isFloat())
    {
        context_.part.warn(Issue::dropped, where,
                           fmt::format("{} of {} is not kept: it has floats", name, display_name_));
        return std::nullopt;
    }
    if (image->type == ChannelType::unorm16)
        context_.part.warn(Issue::image_depth, where,
                           fmt::format("{} of {} was converted to 8 bits a channel, the source has 16", name,
                                       display_name_));
    return narrow(std::move(*image));
}

/// Return the texture of a pair. The source's image serves where its channels are those that are wanted, else
/// an image is written that has them.
Result<TextureRef> MaterialWriter::referencePair(TexturePair pair)
{
    GltfTextureUse first = pair.first, second = pair.uses_second ? pair.second : GltfTextureUse{};
    const auto drop = [&](GltfTextureUse& use, std::string_view name, const std::string& why)
    {
        context_.part.warn(Issue::dropped, where_, fmt::format("{} is not kept: {}", name, why));
        use = {};
    };
    for (const auto& [use, name] : {std::pair(&first, pair.first_name), std::pair(&second, pair.second_name)})
        if (use->texture != kInvalidIndex && use->uv_set >= mesh::kUvSetCount)
            drop(*use, name, fmt::format("there is no UV set {}", use->uv_set));
    const bool has_first = first.texture != kInvalidIndex, has_second = second.texture != kInvalidIndex;
    if (has_first && has_second && !isAlike(first, second, model_))
        drop(second, pair.second_name,
             fmt::format("it has another UV mapping or sampler than {}", pair.first_name));
    const bool is_both = second.texture != kInvalidIndex && has_first;
    if ((is_both && sourceImage(first) == sourceImage(second)) || (has_first && !pair.uses_second))
        return reference(first, pair.purpose, pair.first_name);
    if (!has_first && second.texture == kInvalidIndex)
        return kNoTexture;

    const auto texels = [&](const GltfTextureUse& use, std::string_view name)
    { return use.texture == kInvalidIndex ? std::nullopt : decodeBytes(use, name); };
    const std::optional<DecodedImage> a = texels(first, pair.first_name),
                                      b = texels(second, pair.second_name);
    if (!a && !b)
        return kNoTexture;
    const GltfTextureUse& use = a ? first : second;
    HEARTH_ASSIGN_OR_RETURN(
        const uint32_t image,
        images_.writeComputed(
            mergeChannels(a.value_or(DecodedImage{}), b.value_or(DecodedImage{}), pair.first_channels),
            pair.purpose, fmt::format("{} of {}", a ? pair.first_name : pair.second_name, display_name_),
            std::nullopt));
    return referenceTo(image, use);
}

/// Write the layers that change what a material looks like.
Status MaterialWriter::writeLayers(const GltfMaterial& material, uint32_t index)
{
    constexpr uint32_t kRgb = 7, kRed = 1;
    const GltfLayers& source = material.layers;
    MaterialLayersRecord record = neutralLayers(index);
    record.ior = source.ior;
    record.specular = source.specular;
    record.specular_color = {source.specular_color[0], source.specular_color[1], source.specular_color[2]};
    if (material.unlit || material.specular_glossiness)
    {
        record.sheen_color.x =
            std::max({source.sheen_color[0], source.sheen_color[1], source.sheen_color[2]});
        if (source.clearcoat > 0 || hasSpecular(record) || hasSheen(record))
            context_.part.warn(Issue::dropped, where_,
                               fmt::format("specular reflectance, clear coat and sheen of {} are not kept: "
                                           "the extensions exclude {} materials",
                                           display_name_, material.unlit ? "unlit" : "specular-glossiness"));
        return success();
    }
    if (source.specular > 0)
    {
        HEARTH_ASSIGN_OR_RETURN(
            record.specular_texture,
            referencePair({source.specular_color_texture, source.specular_texture, "specularColorTexture",
                           "specularTexture", ImagePurpose::color, kRgb, true}));
    }
    if (source.clearcoat > 0)
    {
        record.clearcoat = source.clearcoat;
        record.clearcoat_roughness = source.clearcoat_roughness;
        record.clearcoat_normal_scale = source.clearcoat_normal_scale;
        HEARTH_ASSIGN_OR_RETURN(record.clearcoat_texture,
                                referencePair({source.clearcoat_texture, source.clearcoat_roughness_texture,
                                               "clearcoatTexture", "clearcoatRoughnessTexture",
                                               ImagePurpose::data, kRed, source.clearcoat_roughness > 0}));
        HEARTH_ASSIGN_OR_RETURN(
            record.clearcoat_normal_texture,
            reference(source.clearcoat_normal_texture, ImagePurpose::normal, "clearcoatNormalTexture"));
    }
    record.sheen_color = {source.sheen_color[0], source.sheen_color[1], source.sheen_color[2]};
    if (hasSheen(record))
    {
        record.sheen_roughness = source.sheen_roughness;
        HEARTH_ASSIGN_OR_RETURN(
            record.sheen_texture,
            referencePair({source.sheen_color_texture, source.sheen_roughness_texture, "sheenColorTexture",
                           "sheenRoughnessTexture", ImagePurpose::color, kRgb, source.sheen_roughness > 0}));
    }
    if (hasSpecular(record) || hasClearcoat(record) || hasSheen(record))
        context_.part.material_layers.push_back(record);
    return success();
}

Result<MaterialRecord> MaterialWriter::convert(const GltfMaterial& material)
{
    MaterialRecord record{};
    record.name = context_.part.intern(material.name);
    record.flags =
        (material.double_sided ? kMaterialDoubleSided : 0u) | (material.unlit ? kMaterialUnlit : 0u);
    record.alpha_mode = static_cast<uint32_t>(material.alpha_mode);
    record.alpha_cutoff = material.alpha_cutoff;
    record.base_color = {material.base_color[0], material.base_color[1], material.base_color[2],
                         material.base_color[3]};
    // a product of finite numbers can be infinite, which would spoil the frame
    const auto emitted = [&](size_t i)
    {
        return std::clamp(material.emissive[i] * material.emissive_strength, 0.0f,
                          std::numeric_limits<float>::max());
    };
    record.emissive = {emitted(0), emitted(1), emitted(2)};
    record.metallic = material.metallic;
    record.roughness = material.roughness;
    record.normal_scale = material.normal_scale;
    record.occlusion_strength = material.occlusion_strength;
    record.base_color_texture = kNoTexture;
    record.metallic_roughness_texture = kNoTexture;
    HEARTH_TRY(convertTextures(material, record));
    return record;
}

Status MaterialWriter::writeAll()
{
    registerAlphaCutoffs();
    for (size_t i = 0; i < model_.materials.size(); ++i)
    {
        where_ = fmt::format("/materials/{}", i);
        display_name_ = model_.materials[i].name.empty()
                            ? fmt::format("material {}", i)
                            : fmt::format("material \"{}\"", model_.materials[i].name);
        HEARTH_ASSIGN_OR_RETURN(const MaterialRecord record, convert(model_.materials[i]));
        context_.part.materials.push_back(record);
        HEARTH_TRY(writeLayers(model_.materials[i], static_cast<uint32_t>(i)));
    }
    images_.reportUnused();
    context_.part.counts.materials = model_.materials.size();
    return success();
}

} // namespace

Status writeMaterials(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context)
{
    return MaterialWriter(model, buffers, context).writeAll();
}

} // namespace hearth::import
