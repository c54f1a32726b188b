// Compares factors, flags and texture transforms of materials and their layers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/compare_part.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

constexpr const char* kConverted = "KHR_materials_pbrSpecularGlossiness";
constexpr double kTransformSlack = 5e-7;

double numberOr(const tinygltf::Value& object, const char* key, double otherwise)
{
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

double elementOr(const tinygltf::Value& object, const char* key, int i, double otherwise)
{
    return object.Has(key) ? object.Get(key).Get(i).GetNumberAsDouble() : otherwise;
}

uint8_t wrapNumber(int mode)
{
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? 1
           : mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? 2
                                                         : 0;
}

/// Compares one material.
class MaterialComparison
{
public:
    MaterialComparison(const tinygltf::Model& model, size_t index, const formats::MaterialRecord& part,
                       const formats::MaterialLayersRecord& layers, Comparison& comparison)
        : model_(model),
          index_(index),
          source_(model.materials[index]),
          part_(part),
          layers_(layers),
          comparison_(comparison)
    {
    }

    void compare()
    {
        const tinygltf::PbrMetallicRoughness& pbr = source_.pbrMetallicRoughness;
        if (source_.extensions.contains(kConverted))
            comparison_.exclude(Exclusion::converted_material);
        else
        {
            const Float4 color = part_.base_color;
            const float base[4] = {color.x, color.y, color.z, color.w};
            for (size_t i = 0; i < 4; ++i)
                check(std::clamp(pbr.baseColorFactor.at(i), 0.0, 1.0), base[i], "base colour of material");
            check(std::clamp(pbr.metallicFactor, 0.0, 1.0), part_.metallic, "metallic of material");
            check(std::clamp(pbr.roughnessFactor, 0.0, 1.0), part_.roughness, "roughness of material");
            compareTexture(pbr.baseColorTexture, part_.base_color_texture);
            compareTexture(pbr.metallicRoughnessTexture, part_.metallic_roughness_texture);
        }
        compareEmission();
        compareFlags();
        check(source_.normalTexture.scale, part_.normal_scale, "normal scale of material");
        check(std::clamp(source_.occlusionTexture.strength, 0.0, 1.0), part_.occlusion_strength,
              "occlusion strength of material");
        compareTexture(source_.normalTexture, part_.normal_texture);
        compareTexture(source_.occlusionTexture, part_.occlusion_texture);
        compareTexture(source_.emissiveTexture, part_.emissive_texture);
        if (!source_.extensions.contains(kConverted) && !source_.extensions.contains("KHR_materials_unlit"))
        {
            compareSpecular();
            compareClearcoat();
            compareSheen();
        }
    }

private:
    void check(double source, float part, const char* what, double slack = 0)
    {
        comparison_.check(Value::factor, source, double{part}, slack, what, index_);
    }

    void compareEmission()
    {
        const auto found = source_.extensions.find("KHR_materials_emissive_strength");
        const double strength =
            found == source_.extensions.end() ? 1.0 : numberOr(found->second, "emissiveStrength", 1);
        const float part[3] = {part_.emissive.x, part_.emissive.y, part_.emissive.z};
        for (size_t i = 0; i < 3; ++i)
        {
            const double emitted =
                source_.emissiveFactor.empty() ? 0 : source_.emissiveFactor.at(i) * strength;
            check(emitted, part[i], "emission of material", 2.4e-7 * std::abs(emitted));
        }
    }

    const tinygltf::Value& extension(const char* name) const
    {
        static const tinygltf::Value kNone{tinygltf::Value::Object()};
        const auto found = source_.extensions.find(name);
        return found == source_.extensions.end() ? kNone : found->second;
    }

    /// Texture of an extension, with index -1 if there is none or `is_used` is false.
    static tinygltf::TextureInfo texture(const tinygltf::Value& object, const char* key, bool is_used = true)
    {
        tinygltf::TextureInfo info;
        if (!object.Has(key) || !is_used)
            return info;
        const tinygltf::Value& value = object.Get(key);
        info.index = value.Get("index").GetNumberAsInt();
        info.texCoord = value.Has("texCoord") ? value.Get("texCoord").GetNumberAsInt() : 0;
        if (value.Has("extensions"))
            for (const std::string& name : value.Get("extensions").Keys())
                info.extensions[name] = value.Get("extensions").Get(name);
        return info;
    }

    /// Two textures become one, at the place of the first.
    void compareMerged(const tinygltf::TextureInfo& first, const tinygltf::TextureInfo& second,
                       const formats::TextureRef& part)
    {
        compareTexture(first.index >= 0 ? first : second, part);
    }

    void compareColor(const tinygltf::Value& source, const char* key, double otherwise, double max,
                      Float3 part, const char* what)
    {
        const float values[3] = {part.x, part.y, part.z};
        for (int i = 0; i < 3; ++i)
            check(std::clamp(elementOr(source, key, i, otherwise), 0.0, max), values[i], what);
    }

    void compareSpecular()
    {
        const tinygltf::Value& source = extension("KHR_materials_specular");
        const double strength = std::clamp(numberOr(source, "specularFactor", 1), 0.0, 1.0);
        check(numberOr(extension("KHR_materials_ior"), "ior", 1.5), layers_.ior, "ior of material");
        check(strength, layers_.specular, "specular of material");
        compareColor(source, "specularColorFactor", 1, 1e30, layers_.specular_color,
                     "specular colour of material");
        compareMerged(texture(source, "specularColorTexture", strength > 0),
                      texture(source, "specularTexture", strength > 0), layers_.specular_texture);
    }

    void compareClearcoat()
    {
        const tinygltf::Value& source = extension("KHR_materials_clearcoat");
        const double strength = std::clamp(numberOr(source, "clearcoatFactor", 0), 0.0, 1.0);
        check(strength, layers_.clearcoat, "clear coat of material");
        const bool is_coated = strength > 0;
        const double roughness =
            is_coated ? std::clamp(numberOr(source, "clearcoatRoughnessFactor", 0), 0.0, 1.0) : 0;
        check(roughness, layers_.clearcoat_roughness, "roughness of the clear coat of material");
        compareMerged(texture(source, "clearcoatTexture", is_coated),
                      texture(source, "clearcoatRoughnessTexture", roughness > 0), layers_.clearcoat_texture);
        compareTexture(texture(source, "clearcoatNormalTexture", is_coated),
                       layers_.clearcoat_normal_texture);
        if (is_coated && source.Has("clearcoatNormalTexture"))
            check(numberOr(source.Get("clearcoatNormalTexture"), "scale", 1), layers_.clearcoat_normal_scale,
                  "normal scale of the clear coat of material");
    }

    void compareSheen()
    {
        const tinygltf::Value& source = extension("KHR_materials_sheen");
        compareColor(source, "sheenColorFactor", 0, 1, layers_.sheen_color, "sheen colour of material");
        const bool has_sheen = layers_.sheen_color != Float3{};
        const double roughness =
            has_sheen ? std::clamp(numberOr(source, "sheenRoughnessFactor", 0), 0.0, 1.0) : 0;
        check(roughness, layers_.sheen_roughness, "sheen roughness of material");
        compareMerged(texture(source, "sheenColorTexture", has_sheen),
                      texture(source, "sheenRoughnessTexture", roughness > 0), layers_.sheen_texture);
    }

    void compareFlags()
    {
        const std::string& mode = source_.alphaMode;
        comparison_.checkEqual(mode == "MASK"    ? 1
                               : mode == "BLEND" ? 2
                                                 : 0,
                               part_.alpha_mode, "alpha mode of material", index_);
        check(source_.alphaCutoff, part_.alpha_cutoff, "alpha cutoff of material");
        comparison_.checkEqual(source_.doubleSided ? 1 : 0,
                               (part_.flags & formats::kMaterialDoubleSided) != 0 ? 1 : 0,
                               "sides of material", index_);
        comparison_.checkEqual(source_.extensions.contains("KHR_materials_unlit") ? 1 : 0,
                               (part_.flags & formats::kMaterialUnlit) != 0 ? 1 : 0, "unlit of material",
                               index_);
    }

    template <typename Info>
    void compareTexture(const Info& source, const formats::TextureRef& part)
    {
        static const tinygltf::Value kNone{tinygltf::Value::Object()};
        const auto found = source.extensions.find("KHR_texture_transform");
        const tinygltf::Value& transform = found == source.extensions.end() ? kNone : found->second;
        const int uv_set =
            transform.Has("texCoord") ? transform.Get("texCoord").GetNumberAsInt() : source.texCoord;
        const bool is_kept = source.index >= 0 && uv_set < 4;
        comparison_.checkEqual(is_kept ? 1 : 0, part.image != kInvalidIndex ? 1 : 0, "texture of material",
                               index_);
        if (!is_kept)
            return;
        comparison_.checkEqual(uv_set, part.uv_set, "uv set of a texture of material", index_);
        compareSampler(model_.textures.at(static_cast<size_t>(source.index)).sampler, part);
        // The specification's example turns the lower left quadrant by offset (0, 1), rotation pi / 2, scale
        // (0.5, 0.5): (0, 0) becomes (0, 1), (1, 0) becomes (0, 0.5), (0, 1) becomes (0.5, 1).
        const double angle = numberOr(transform, "rotation", 0);
        const double c = std::cos(angle), s = std::sin(angle);
        const double x = elementOr(transform, "scale", 0, 1), y = elementOr(transform, "scale", 1, 1);
        const double matrix[6] = {c * x,  s * y, elementOr(transform, "offset", 0, 0),
                                  -s * x, c * y, elementOr(transform, "offset", 1, 0)};
        for (size_t i = 0; i < 6; ++i)
            comparison_.check(Value::texture_transform, matrix[i], double{part.uv_transform[i]},
                              kTransformSlack * std::max(1.0, std::abs(matrix[i])), "of material", index_);
    }

    void compareSampler(int index, const formats::TextureRef& part)
    {
        const tinygltf::Sampler sampler =
            index < 0 ? tinygltf::Sampler() : model_.samplers.at(static_cast<size_t>(index));
        comparison_.checkEqual(wrapNumber(index < 0 ? TINYGLTF_TEXTURE_WRAP_REPEAT : sampler.wrapS),
                               part.wrap_u, "wrapS of material", index_);
        comparison_.checkEqual(wrapNumber(index < 0 ? TINYGLTF_TEXTURE_WRAP_REPEAT : sampler.wrapT),
                               part.wrap_v, "wrapT of material", index_);
        comparison_.checkEqual(sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? 1 : 0, part.nearest,
                               "filter of material", index_);
    }

    const tinygltf::Model& model_;
    size_t index_;
    const tinygltf::Material& source_;
    const formats::MaterialRecord& part_;
    const formats::MaterialLayersRecord& layers_;
    Comparison& comparison_;
};

} // namespace

void compareMaterials(const SourceModel& source, const formats::PackView& part, Comparison& comparison)
{
    comparison.checkEqual(static_cast<long long>(source.model.materials.size()),
                          static_cast<long long>(part.materials().size()), "number of materials", 0);
    for (size_t i = 0; i < std::min(source.model.materials.size(), part.materials().size()); ++i)
    {
        const auto number = static_cast<uint32_t>(i);
        const formats::MaterialLayersRecord* const layers =
            formats::findLayers(part.materialLayers(), number);
        MaterialComparison(source.model, i, part.materials()[i],
                           layers != nullptr ? *layers : formats::neutralLayers(number), comparison)
            .compare();
    }
}

} // namespace hearth::test
