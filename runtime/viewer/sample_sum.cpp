// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/sample_sum.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace hearth::viewer
{

namespace
{

constexpr size_t kChannels = 3;

float linearFromSrgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear)
{
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

} // namespace

SampleGrid makeSampleGrid(uint32_t samples)
{
    return samples == 1 ? SampleGrid{1, 1} : SampleGrid{2, samples / 4};
}

shared::Camera shiftCamera(const shared::Camera& camera, uint32_t frame, uint32_t frames, uint32_t width,
                           uint32_t height)
{
    if (frames == 1)
        return camera;
    // places on a square grid, from the middle of a sample: -1/4 and 1/4 of four frames
    const auto side = static_cast<uint32_t>(std::lround(std::sqrt(frames)));
    const auto place = [&](uint32_t index)
    { return (static_cast<float>(index) + 0.5f) / static_cast<float>(side) - 0.5f; };
    shared::Camera shifted = camera;
    shifted.shift.x += 2 * place(frame % side) / static_cast<float>(width);
    shifted.shift.y += 2 * place(frame / side) / static_cast<float>(height);
    return shifted;
}

SampleSum::SampleSum(uint32_t width, uint32_t height, uint32_t scale)
    : width_(width), height_(height), scale_(scale), sums_(size_t{width} * height * kChannels)
{
}

template <typename Linear>
void SampleSum::addFrame(const Linear& linear)
{
    const size_t row = size_t{width_} * scale_;
    for (size_t y = 0; y < size_t{height_} * scale_; ++y)
        for (size_t x = 0; x < row; ++x)
        {
            float* sum = &sums_[(y / scale_ * width_ + x / scale_) * kChannels];
            for (size_t c = 0; c < kChannels; ++c)
                sum[c] += linear((y * row + x) * 4 + c);
        }
    ++frames_;
}

void SampleSum::add(std::span<const std::byte> rgba)
{
    HEARTH_ASSERT(rgba.size() == size_t{width_} * height_ * scale_ * scale_ * 4);
    std::array<float, 256> linear;
    for (size_t i = 0; i < linear.size(); ++i)
        linear[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
    addFrame([&](size_t i) { return linear[std::to_integer<size_t>(rgba[i])]; });
}

void SampleSum::addLinear(std::span<const std::byte> rgba)
{
    HEARTH_ASSERT(rgba.size() == size_t{width_} * height_ * scale_ * scale_ * 4 * sizeof(uint16_t));
    addFrame(
        [&](size_t i)
        {
            uint16_t half;
            std::memcpy(&half, &rgba[i * sizeof(half)], sizeof(half));
            return floatFromHalf(half);
        });
}

std::vector<float> SampleSum::averageLinear() const
{
    const float part = 1.0f / static_cast<float>(frames_ * scale_ * scale_);
    std::vector<float> rgb(sums_.size());
    std::transform(sums_.begin(), sums_.end(), rgb.begin(), [&](float sum) { return sum * part; });
    return rgb;
}

std::vector<std::byte> SampleSum::average() const
{
    const std::vector<float> linear = averageLinear();
    std::vector<std::byte> rgba(size_t{width_} * height_ * 4, std::byte{255});
    for (size_t pixel = 0; pixel < size_t{width_} * height_; ++pixel)
        for (size_t c = 0; c < kChannels; ++c)
            rgba[pixel * 4 + c] =
                static_cast<std::byte>(srgbFromLinear(linear[pixel * kChannels + c]) * 255.0f + 0.5f);
    return rgba;
}

} // namespace hearth::viewer
