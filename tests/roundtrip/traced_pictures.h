// Pictures of traced radiance and of drawn samples, in the same pixels and codes, to be compared.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/gltf_material.h"
#include "tests/reference/tracer/path_tracer.h"
#include "tests/support/gpu_fixture.h"

namespace hearth::test
{

/// Return a square image of radiance as the runtime shows it, by its filmic curve.
/// radiance  [side * side], row by row
template <typename Radiance>
reference::Image showRadiance(const Radiance& radiance, uint32_t side)
{
    reference::Image image(side, side);
    for (uint32_t i = 0; i < side * side; ++i)
    {
        const double rgb[] = {radiance[i].x, radiance[i].y, radiance[i].z};
        for (size_t c = 0; c < 3; ++c)
            image.at(i % side, i / side)[c] = static_cast<uint8_t>(
                std::clamp(reference::srgbFromLinear(reference::filmic(rgb[c])), 0.0, 1.0) * 255 + 0.5);
    }
    return image;
}

/// Return the radiance that a drawn colour shows, by the inverse of the filmic curve.
inline reference::Double3 readRadiance(uint32_t color)
{
    const auto radiance = [&](int index)
    {
        return reference::invertFilmic(
            reference::linearFromSrgb(std::min(channel(color, index) / 255.0, 254.5 / 255)));
    };
    return {radiance(0), radiance(1), radiance(2)};
}

/// Return a square image whose pixels show the mean radiance of a drawn one's samples, as pixels of paths do:
/// the mean of what samples show is another one, as the filmic curve bends.
/// samples  of a pixel, along each axis
inline reference::Image averageSamples(const Image& drawn, uint32_t side, uint32_t samples)
{
    std::vector<reference::Double3> means;
    for (uint32_t i = 0; i < side * side; ++i)
    {
        reference::Double3 sum;
        for (uint32_t sample = 0; sample < samples * samples; ++sample)
            sum += readRadiance(
                drawn.at(samples * (i % side) + sample % samples, samples * (i / side) + sample / samples));
        means.push_back(sum / (samples * samples));
    }
    return showRadiance(means, side);
}

} // namespace hearth::test
