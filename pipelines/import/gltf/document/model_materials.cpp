// Reads images, textures, samplers and materials.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/model_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::import
{

namespace
{

constexpr Choice kAlphaModes[] = {
    {"OPAQUE", static_cast<uint32_t>(formats::AlphaMode::opaque)},
    {"MASK", static_cast<uint32_t>(formats::AlphaMode::mask)},
    {"BLEND", static_cast<uint32_t>(formats::AlphaMode::blend)},
};

struct Sampler
{
    formats::Wrap wrap_u = formats::Wrap::repeat;
    formats::Wrap wrap_v = formats::Wrap::repeat;
    bool nearest = false;
};

formats::Wrap readWrap(const GltfObject& object, std::string_view name)
{
    // OpenGL's numbers
    switch (const uint64_t value = object.integer(name, {}, 10497))
    {
    case 10497:
        return formats::Wrap::repeat;
    case 33648:
        return formats::Wrap::mirrored_repeat;
    case 33071:
        return formats::Wrap::clamp_to_edge;
    default:
        object.problems().fail(Issue::gltf_value, object.json(),
                               fmt::format("{} {} is not known", name, value));
        return formats::Wrap::repeat;
    }
}

Sampler readSampler(const GltfObject& object)
{
    constexpr uint64_t kNearest = 9728;
    constexpr uint64_t kLinear = 9729;
    Sampler sampler;
    sampler.wrap_u = readWrap(object, "wrapS");
    sampler.wrap_v = readWrap(object, "wrapT");
    sampler.nearest = object.integer("magFilter", {kNearest, kLinear}, kLinear) == kNearest;
    // only checked: the runtime chooses the filter of minified textures
    (void)object.integer("minFilter", {kNearest, 9987}, kLinear);
    return sampler;
}

/// Return the image of a texture: its own, or an extension's if it has no image that every reader supports.
uint32_t readTextureImage(const GltfObject& object, const GltfModel& model)
{
    const uint32_t plain = object.index("source", model.images.size());
    uint32_t extended = kInvalidIndex;
    for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds"})
        if (const auto extension = object.extension(name))
        {
            const uint32_t source = extension->index("source", model.images.size());
            extended = extended == kInvalidIndex ? source : extended;
        }
    return plain != kInvalidIndex ? plain : extended;
}

/// Return KHR_texture_transform: translation * rotation * scale, applied to (u, v, 1).
std::array<float, 6> readUvTransform(const GltfObject& object)
{
    const auto offset = object.numbers<2>("offset", {0, 0});
    const auto scale = object.numbers<2>("scale", {1, 1});
    const float rotation = object.number("rotation", 0.0f);
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    // the extension turns clockwise in UV space: its matrix is [[c s] [-s c]]
    return {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
}

GltfTextureUse readTextureUse(const GltfObject& object, const GltfModel& model)
{
    GltfTextureUse use;
    use.texture = object.index("index", model.textures.size(), Need::required);
    // a set that no mesh can have reads as the first unsupported one, and is dropped with a warning
    use.uv_set = static_cast<uint32_t>(std::min<uint64_t>(object.integer("texCoord", {}, 0), UINT32_MAX));
    if (const auto transform = object.extension("KHR_texture_transform"))
    {
        use.uv_transform = readUvTransform(*transform);
        if (transform->has("texCoord"))
            use.uv_set =
                static_cast<uint32_t>(std::min<uint64_t>(transform->integer("texCoord", {}, 0), UINT32_MAX));
    }
    return use;
}

GltfTextureUse readOptionalTexture(const GltfObject& parent, std::string_view name, const GltfModel& model)
{
    const std::optional<GltfObject> object = parent.object(name);
    return object ? readTextureUse(*object, model) : GltfTextureUse{};
}

template <size_t N>
std::array<float, N> readColor(const GltfObject& object, std::string_view name,
                               const std::array<float, N>& fallback)
{
    std::array<float, N> color = object.numbers<N>(name, fallback);
    bool inside = true;
    for (float& value : color)
    {
        inside = inside && value >= 0.0f && value <= 1.0f;
        value = std::clamp(value, 0.0f, 1.0f);
    }
    if (!inside)
        object.problems().warn(Issue::repaired, object.json(),
                               fmt::format("{} is not in 0 to 1: it was clamped", name));
    return color;
}

void readMetallicRoughness(const GltfObject& object, const GltfModel& model, GltfMaterial& material)
{
    material.base_color = readColor<4>(object, "baseColorFactor", {1, 1, 1, 1});
    material.metallic = object.factor("metallicFactor", 1, 0, 1);
    material.roughness = object.factor("roughnessFactor", 1, 0, 1);
    material.base_color_texture = readOptionalTexture(object, "baseColorTexture", model);
    material.metallic_roughness_texture = readOptionalTexture(object, "metallicRoughnessTexture", model);
}

GltfSpecularGlossiness readSpecularGlossiness(const GltfObject& object, const GltfModel& model)
{
    GltfSpecularGlossiness result;
    result.diffuse = readColor<4>(object, "diffuseFactor", {1, 1, 1, 1});
    result.specular = readColor<3>(object, "specularFactor", {1, 1, 1});
    result.glossiness = object.factor("glossinessFactor", 1, 0, 1);
    result.diffuse_texture = readOptionalTexture(object, "diffuseTexture", model);
    result.specular_glossiness_texture = readOptionalTexture(object, "specularGlossinessTexture", model);
    return result;
}

void readSurfaceTextures(const GltfObject& object, const GltfModel& model, GltfMaterial& material)
{
    if (const auto normal = object.object("normalTexture"))
    {
        material.normal_texture = readTextureUse(*normal, model);
        material.normal_scale = normal->number("scale", 1.0f);
    }
    if (const auto occlusion = object.object("occlusionTexture"))
    {
        material.occlusion_texture = readTextureUse(*occlusion, model);
        material.occlusion_strength = occlusion->factor("strength", 1, 0, 1);
    }
    material.emissive_texture = readOptionalTexture(object, "emissiveTexture", model);
}

float readIor(const GltfObject& object)
{
    // 0 is the extension's value for a surface that reflects all light
    if (object.number("ior", formats::kDefaultIor) == 0.0f)
        return 0;
    return object.factor("ior", formats::kDefaultIor, 1, kUnbounded);
}

/// Read factors that may exceed 1.
std::array<float, 3> readUnboundedColor(const GltfObject& object, std::string_view name)
{
    std::array<float, 3> color = object.numbers<3>(name, {1, 1, 1});
    if (std::all_of(color.begin(), color.end(), [](float value) { return value >= 0; }))
        return color;
    object.problems().warn(Issue::repaired, object.json(),
                           fmt::format("{} is negative: it was clamped to 0", name));
    for (float& value : color)
        value = std::max(value, 0.0f);
    return color;
}

GltfLayers readLayers(const GltfObject& object, const GltfModel& model)
{
    GltfLayers layers;
    if (const auto ior = object.extension("KHR_materials_ior"))
        layers.ior = readIor(*ior);
    if (const auto specular = object.extension("KHR_materials_specular"))
    {
        layers.specular = specular->factor("specularFactor", 1, 0, 1);
        layers.specular_color = readUnboundedColor(*specular, "specularColorFactor");
        layers.specular_texture = readOptionalTexture(*specular, "specularTexture", model);
        layers.specular_color_texture = readOptionalTexture(*specular, "specularColorTexture", model);
    }
    if (const auto clearcoat = object.extension("KHR_materials_clearcoat"))
    {
        layers.clearcoat = clearcoat->factor("clearcoatFactor", 0, 0, 1);
        layers.clearcoat_roughness = clearcoat->factor("clearcoatRoughnessFactor", 0, 0, 1);
        layers.clearcoat_texture = readOptionalTexture(*clearcoat, "clearcoatTexture", model);
        layers.clearcoat_roughness_texture =
            readOptionalTexture(*clearcoat, "clearcoatRoughnessTexture", model);
        if (const auto normal = clearcoat->object("clearcoatNormalTexture"))
        {
            layers.clearcoat_normal_texture = readTextureUse(*normal, model);
            layers.clearcoat_normal_scale = normal->number("scale", 1.0f);
        }
    }
    if (const auto sheen = object.extension("KHR_materials_sheen"))
    {
        layers.sheen_color = readColor<3>(*sheen, "sheenColorFactor", {0, 0, 0});
        layers.sheen_roughness = sheen->factor("sheenRoughnessFactor", 0, 0, 1);
        layers.sheen_color_texture = readOptionalTexture(*sheen, "sheenColorTexture", model);
        layers.sheen_roughness_texture = readOptionalTexture(*sheen, "sheenRoughnessTexture", model);
    }
    return layers;
}

GltfMaterial readMaterial(const GltfObject& object, const GltfModel& model)
{
    GltfMaterial material;
    material.name = object.text("name");
    if (const auto pbr = object.object("pbrMetallicRoughness"))
        readMetallicRoughness(*pbr, model, material);
    readSurfaceTextures(object, model, material);
    material.emissive = object.numbers<3>("emissiveFactor", {0, 0, 0});
    material.alpha_mode = static_cast<formats::AlphaMode>(
        object.choice("alphaMode", kAlphaModes, static_cast<uint32_t>(formats::AlphaMode::opaque)));
    material.alpha_cutoff = object.factor("alphaCutoff", 0.5f, 0, kUnbounded);
    material.double_sided = object.boolean("doubleSided", false);
    material.unlit = object.extension("KHR_materials_unlit").has_value();
    if (const auto strength = object.extension("KHR_materials_emissive_strength"))
        material.emissive_strength = strength->factor("emissiveStrength", 1, 0, kUnbounded);
    material.layers = readLayers(object, model);
    if (const auto specular_glossiness = object.extension("KHR_materials_pbrSpecularGlossiness"))
        material.specular_glossiness = readSpecularGlossiness(*specular_glossiness, model);
    return material;
}

} // namespace

void readImages(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("images"))
    {
        GltfImage image;
        image.name = object.text("name");
        if (object.has("uri"))
            image.uri = object.text("uri");
        image.buffer_view = object.index("bufferView", model.buffer_views.size());
        model.images.push_back(std::move(image));
    }
}

void readTextures(const GltfObject& root, GltfModel& model)
{
    std::vector<Sampler> samplers;
    for (const GltfObject& object : root.objects("samplers"))
        samplers.push_back(readSampler(object));
    for (const GltfObject& object : root.objects("textures"))
    {
        GltfTexture texture;
        texture.image = readTextureImage(object, model);
        const uint32_t sampler = object.index("sampler", samplers.size());
        if (sampler != kInvalidIndex)
        {
            texture.wrap_u = samplers[sampler].wrap_u;
            texture.wrap_v = samplers[sampler].wrap_v;
            texture.nearest = samplers[sampler].nearest;
        }
        model.textures.push_back(texture);
    }
}

void readMaterials(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("materials"))
    {
        model.materials.push_back(readMaterial(object, model));
        if (object.extension("MSFT_lod"))
            object.problems().warn(Issue::dropped, object.json(),
                                   "levels of detail of materials (MSFT_lod) are not kept");
    }
}

} // namespace hearth::import
