// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/select/atlas.h"

#include <random>
#include <vector>

namespace hearth::test
{

/// Atlas whose texels are one rectangle of instance 0, lit by steady light and lamps of random colours, of
/// which each patch of 8 x 8 texels sees a random half. A tenth of the texels is not valid.
struct RandomReceivers
{
    RandomReceivers(uint32_t width_in, uint32_t height_in, uint32_t lamp_count, uint32_t seed)
        : width(width_in), height(height_in), lamps(lamp_count), rects{{0, 0, 0, width_in, height_in, 0}}
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0, 1);
        lamps[0] = {static_cast<uint32_t>(formats::ReceiverLampKind::steady), 0};
        for (uint32_t i = 1; i < lamp_count; ++i)
            lamps[i] = {static_cast<uint32_t>(formats::ReceiverLampKind::light), i - 1};
        std::vector<uint32_t> seen((width / 8 + 1) * (height / 8 + 1));
        for (uint32_t& bits : seen)
            bits = static_cast<uint32_t>(random()) & static_cast<uint32_t>(random() | 1u);
        for (uint32_t y = 0; y < height; ++y)
            for (uint32_t x = 0; x < width; ++x)
            {
                valid.push_back(unit(random) < 0.9f);
                const uint32_t bits = seen[y / 8 * (width / 8 + 1) + x / 8] | 1u;
                for (uint32_t lamp = 0; lamp < lamp_count; ++lamp)
                {
                    const float far = unit(random) * unit(random) * 0.5f;
                    const Float3 color{unit(random), unit(random), unit(random)};
                    light.push_back(bits >> lamp % 32 & 1 ? color * far : Float3{});
                }
            }
    }

    bool isValid(uint32_t x, uint32_t y) const { return valid[y * width + x] != 0; }
    std::span<const Float3> lightAt(uint32_t x, uint32_t y) const
    {
        return std::span(light).subspan((y * width + x) * lamps.size(), lamps.size());
    }
    receivers::BakedLight baked() const { return {width, height, lamps, rects, valid, light}; }

    uint32_t width, height;
    std::vector<formats::ReceiverLampRecord> lamps;
    std::vector<formats::ReceiverRectRecord> rects;
    std::vector<uint8_t> valid;
    std::vector<Float3> light; ///< [height][width][lamps]
};

} // namespace hearth::test
