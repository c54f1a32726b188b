// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/textures.h"

#include "sample_assets/shapes/parallel.h"
#include "sample_assets/shapes/sample_math.h"

#include <algorithm>

namespace hearth::samples
{

namespace
{

uint8_t encodeUnit(float value)
{
    return static_cast<uint8_t>(clamp01(value) * 255.0f + 0.5f);
}

float decodeSrgb(float encoded)
{
    // pow() differs between machines; x^2.4 = x^2 * (x^2)^(1/5), the root by Newton's method
    if (encoded <= 0.04045f)
        return encoded / 12.92f;
    const double x = (static_cast<double>(encoded) + 0.055) / 1.055;
    double root = x;
    for (int step = 0; step < 60; ++step)
    {
        const double r4 = root * root * root * root;
        root -= (r4 * root - x * x) / (5.0 * r4);
    }
    return static_cast<float>(x * x * root);
}

/// threshold[i]: the smallest linear value whose nearest byte is i.
const std::array<float, 256>& srgbThresholds()
{
    static const std::array<float, 256> thresholds = []
    {
        std::array<float, 256> t{};
        for (size_t i = 1; i < t.size(); ++i)
            t[i] = decodeSrgb((static_cast<float>(i) - 0.5f) / 255.0f);
        return t;
    }();
    return thresholds;
}

Image paint(std::string name, uint32_t width, uint32_t height,
            const std::function<void(Float2 uv, uint8_t* texel)>& write)
{
    Image image{std::move(name), width, height, std::vector<uint8_t>(size_t{width} * height * 4)};
    parallelFor(height,
                [&](size_t y)
                {
                    for (size_t x = 0; x < width; ++x)
                        write({(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(height)},
                              &image.texels[(y * width + x) * 4]);
                });
    return image;
}

} // namespace

uint8_t encodeSrgb(float linear)
{
    const auto& thresholds = srgbThresholds();
    const auto above = std::upper_bound(thresholds.begin() + 1, thresholds.end(), linear);
    return static_cast<uint8_t>(above - thresholds.begin() - 1);
}

Image paintColor(std::string name, uint32_t width, uint32_t height, const ColorFunction& color_function)
{
    return paint(std::move(name), width, height,
                 [&](Float2 uv, uint8_t* texel)
                 {
                     const Float4 c = color_function(uv);
                     texel[0] = encodeSrgb(c.x);
                     texel[1] = encodeSrgb(c.y);
                     texel[2] = encodeSrgb(c.z);
                     texel[3] = encodeUnit(c.w);
                 });
}

Image paintData(std::string name, uint32_t width, uint32_t height, const ColorFunction& color_function)
{
    return paint(std::move(name), width, height,
                 [&](Float2 uv, uint8_t* texel)
                 {
                     const Float4 c = color_function(uv);
                     texel[0] = encodeUnit(c.x);
                     texel[1] = encodeUnit(c.y);
                     texel[2] = encodeUnit(c.z);
                     texel[3] = encodeUnit(c.w);
                 });
}

Image paintNormals(std::string name, uint32_t size, float depth, const HeightField& height)
{
    std::vector<float> heights(size_t{size} * size);
    const float step = 1.0f / static_cast<float>(size);
    parallelFor(size,
                [&](size_t y)
                {
                    for (size_t x = 0; x < size; ++x)
                        heights[y * size + x] = height(
                            {(static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step});
                });
    const auto at = [&](size_t x, size_t y) { return heights[(y % size) * size + x % size]; };
    return paint(std::move(name), size, size,
                 [&](Float2 uv, uint8_t* texel)
                 {
                     const auto x = static_cast<size_t>(uv.x * static_cast<float>(size));
                     const auto y = static_cast<size_t>(uv.y * static_cast<float>(size));
                     const float scale = depth / (2.0f * step);
                     const float dx = (at(x + 1, y) - at(x + size - 1, y)) * scale;
                     const float dy = (at(x, y + 1) - at(x, y + size - 1)) * scale;
                     // rows run downwards, the green channel points up
                     const Float3 n = normalize({-dx, dy, 1.0f});
                     texel[0] = encodeUnit(n.x * 0.5f + 0.5f);
                     texel[1] = encodeUnit(n.y * 0.5f + 0.5f);
                     texel[2] = encodeUnit(n.z * 0.5f + 0.5f);
                     texel[3] = 255;
                 });
}

} // namespace hearth::samples
