// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/radiance_transfer.h"

#include "formats/base/half.h"
#include "formats/gpu_shared/record_values.h"

#include <numbers>

namespace hearth::shared
{

namespace
{

// Steps of height over which the sky is integrated: its gradients are smooth.
constexpr int kHeights = 256;

} // namespace

std::array<float, formats::kLightHarmonics> evaluateHarmonics(Float3 d)
{
    constexpr float kDegree0 = 0.28209479f; // sqrt(1 / (4 pi))
    constexpr float kDegree1 = 0.48860251f; // sqrt(3 / (4 pi))
    constexpr float kDegree2 = 1.09254843f; // sqrt(15 / (4 pi))
    return {kDegree0,
            kDegree1 * d.y,
            kDegree1 * d.x,
            kDegree1 * d.z,
            kDegree2 * (3 * d.y * d.y - 1) / (2 * std::numbers::sqrt3_v<float>),
            kDegree2 * d.x * d.y,
            kDegree2 * d.y * d.z,
            kDegree2 * d.x * d.z,
            kDegree2 * (d.x * d.x - d.z * d.z) / 2};
}

LightHarmonics projectDistantLight(const Sky& sky, std::span<const Light> lights)
{
    LightHarmonics sum{};
    const auto add = [&](Float3 direction, Float3 light, const auto& is_included)
    {
        const auto harmonics = evaluateHarmonics(direction);
        for (uint32_t i = 0; i < sum.size(); ++i)
            if (is_included(i))
                sum[i] += light * harmonics[i];
    };
    if (sky.image != nullptr)
        sum = sky.image->harmonics;
    // the gradient is the same all around: only the harmonics of the height, 0, 1 and 4, have coefficients
    for (int step = 0; step < kHeights && sky.image == nullptr; ++step)
    {
        const float height = (static_cast<float>(step) + 0.5f) * 2 / kHeights - 1;
        const Float3 direction{std::sqrt(1 - height * height), height, 0};
        add(direction, skyRadiance(sky, direction) * (4 * std::numbers::pi_v<float> / kHeights),
            [](uint32_t i) { return i == 0 || i == 1 || i == 4; });
    }
    for (const Light& light : lights)
        if (light.type == kLightDirectional)
            add(-light.direction, light.intensity, [](uint32_t) { return true; });
    return sum;
}

OccluderLight transferLight(const formats::RadianceTransferRecord& transfer, const LightHarmonics& light)
{
    std::array<Float3, formats::kDirectionTerms> terms{};
    for (uint32_t harmonic = 0; harmonic < formats::kLightHarmonics; ++harmonic)
        for (uint32_t term = 0; term < formats::kDirectionTerms; ++term)
        {
            const uint16_t* rgb = &transfer.values[formats::transferValue(harmonic, term, 0)];
            terms[term] +=
                light[harmonic] * Float3{floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
        }
    return {{terms[0].x, terms[1].x, terms[2].x, terms[3].x},
            {terms[0].y, terms[1].y, terms[2].y, terms[3].y},
            {terms[0].z, terms[1].z, terms[2].z, terms[3].z}};
}

} // namespace hearth::shared
