// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/specular_glossiness.h"

#include "pipelines/import/images/channels.h"

#include "pipelines/import/images/resized_image.h"

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

// reflectance of every dielectric at normal incidence in glTF's model
constexpr float kDielectricSpecular = 0.04f;
constexpr float kEpsilon = 1e-6f;

float perceivedBrightness(Float3 c)
{
    return std::sqrt(0.299f * c.x * c.x + 0.587f * c.y * c.y + 0.114f * c.z * c.z);
}

float solveMetallic(float diffuse, float specular, float one_minus_specular_strength)
{
    if (specular < kDielectricSpecular)
        return 0;
    const float a = kDielectricSpecular;
    const float b = diffuse * one_minus_specular_strength / (1 - kDielectricSpecular) + specular -
                    2 * kDielectricSpecular;
    const float c = kDielectricSpecular - specular;
    const float discriminant = std::max(b * b - 4 * a * c, 0.0f);
    return std::clamp((-b + std::sqrt(discriminant)) / (2 * a), 0.0f, 1.0f);
}

float srgbFromLinear(float linear)
{
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

std::array<float, 256> linearTable()
{
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i)
        table[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
    return table;
}

std::byte toByte(float value)
{
    return static_cast<std::byte>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

} // namespace

MetallicRoughness convertSpecularGlossiness(const SpecularGlossiness& source)
{
    const float strength = std::max({source.specular.x, source.specular.y, source.specular.z});
    const float one_minus_strength = 1 - strength;
    MetallicRoughness result;
    result.metallic = solveMetallic(perceivedBrightness(source.diffuse), perceivedBrightness(source.specular),
                                    one_minus_strength);
    result.roughness = 1 - source.glossiness;
    const float diffuse_scale =
        one_minus_strength / (1 - kDielectricSpecular) / std::max(1 - result.metallic, kEpsilon);
    const float dielectric = kDielectricSpecular * (1 - result.metallic);
    const float blend = result.metallic * result.metallic;
    for (int i = 0; i < 3; ++i)
    {
        const float from_diffuse = source.diffuse[i] * diffuse_scale;
        const float from_specular = (source.specular[i] - dielectric) / std::max(result.metallic, kEpsilon);
        result.base_color[i] = std::clamp(from_diffuse + (from_specular - from_diffuse) * blend, 0.0f, 1.0f);
    }
    return result;
}

MetallicRoughnessImages convertSpecularGlossiness(const GltfSpecularGlossiness& factors,
                                                  const DecodedImage& diffuse,
                                                  const DecodedImage& specular_glossiness)
{
    static const std::array<float, 256> kLinear = linearTable();
    const uint32_t width = std::max(diffuse.width, specular_glossiness.width);
    const uint32_t height = std::max(diffuse.height, specular_glossiness.height);
    const ResizedImage diffuse_texels(diffuse, width, height);
    const ResizedImage specular_texels(specular_glossiness, width, height);
    MetallicRoughnessImages images{blankImage(width, height), blankImage(width, height)};
    std::byte* base_color = images.base_color.texels.data();
    std::byte* metallic_roughness = images.metallic_roughness.texels.data();
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x, base_color += 4, metallic_roughness += 4)
        {
            const std::array<uint8_t, 4> d = diffuse_texels.texel(x, y);
            const std::array<uint8_t, 4> s = specular_texels.texel(x, y);
            SpecularGlossiness texel;
            for (size_t i = 0; i < 3; ++i)
            {
                texel.diffuse[static_cast<int>(i)] = kLinear[d[i]] * factors.diffuse[i];
                texel.specular[static_cast<int>(i)] = kLinear[s[i]] * factors.specular[i];
            }
            texel.glossiness = static_cast<float>(s[3]) / 255.0f * factors.glossiness;
            const MetallicRoughness converted = convertSpecularGlossiness(texel);
            for (int i = 0; i < 3; ++i)
                base_color[i] = toByte(srgbFromLinear(converted.base_color[i]));
            base_color[3] = toByte(static_cast<float>(d[3]) / 255.0f * factors.diffuse[3]);
            metallic_roughness[0] = std::byte{255};
            metallic_roughness[1] = toByte(converted.roughness);
            metallic_roughness[2] = toByte(converted.metallic);
            metallic_roughness[3] = std::byte{255};
        }
    return images;
}

} // namespace hearth::import
