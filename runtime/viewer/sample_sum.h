// Averages the samples of pixels: several frames, each of the image's size or of twice that along both axes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::viewer
{

/// Samples of each pixel, and how many frames take them.
struct SampleGrid
{
    uint32_t scale = 1;  ///< samples of a frame along each side of a pixel
    uint32_t frames = 1; ///< with cameras of shiftCamera
};

/// samples  1, 4, 16 or 64
SampleGrid makeSampleGrid(uint32_t samples);

/// Return the camera of frame `frame` of `frames` for one image: shifted by a part of a sample, so that the
/// samples of all frames lie evenly in each pixel. One frame's camera stays as it is.
/// width, height  of a frame, in samples
shared::Camera shiftCamera(const shared::Camera& camera, uint32_t frame, uint32_t frames, uint32_t width,
                           uint32_t height);

class SampleSum
{
public:
    /// width, height  of the image, in pixels
    SampleSum(uint32_t width, uint32_t height, uint32_t scale);

    /// Add a frame.
    /// rgba  RGBA8 sRGB, scale * width x scale * height
    void add(std::span<const std::byte> rgba);

    /// Add a frame of linear colours.
    /// rgba  half floats, four of each sample
    void addLinear(std::span<const std::byte> rgba);

    /// Return the image of all frames added: RGBA8 sRGB, opaque, each pixel the mean of its samples in linear
    /// light.
    std::vector<std::byte> average() const;
    /// Return the same as linear colours, three floats of each pixel.
    std::vector<float> averageLinear() const;

private:
    /// Add a frame; linear(i) is the linear value i of RGBA.
    template <typename Linear>
    void addFrame(const Linear& linear);

    uint32_t width_, height_, scale_;
    uint32_t frames_ = 0;
    std::vector<float> sums_; ///< three of each pixel
};

} // namespace hearth::viewer
