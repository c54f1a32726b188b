// Draws shaded triangles in software, with a grid of samples a pixel. Needs no graphics device, and draws
// cuts that no renderer makes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/decisions.h"
#include "runtime/viewer/compare/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hearth::bench
{

/// Corners relative to the eye in world axes, with unit normals.
struct ShadedTriangle
{
    std::array<Float3, 3> corners;
    std::array<Float3, 3> normals;
};

class SampleImage
{
public:
    static constexpr uint32_t kNothing = 0xffffffff;

    /// samples_across  samples along each side of a pixel
    SampleImage(const shared::FrameView& view, uint32_t samples_across);

    /// Draw a triangle, unless it faces away or reaches the near plane. Returns true if it faces the eye.
    bool draw(const ShadedTriangle& triangle, uint32_t id);

    /// Nearest triangle at each sample, or kNothing; rows top to bottom.
    const std::vector<uint32_t>& ids() const { return ids_; }

    /// z_near / distance of each sample; 0: nothing is there.
    const std::vector<float>& depths() const { return depths_; }

    /// Return the mean light of each pixel's samples, as grey.
    viewer::Image resolve() const;

private:
    shared::FrameView view_;
    uint32_t samples_across_;
    uint32_t width_;  ///< samples
    uint32_t height_; ///< samples
    std::vector<uint32_t> ids_;
    std::vector<float> depths_;
    std::vector<float> light_; ///< linear
};

} // namespace hearth::bench
