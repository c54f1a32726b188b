// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/sample_image.h"

#include <algorithm>
#include <cmath>

namespace hearth::bench
{

namespace
{

// A low sun, as in the field of `./dev bench runtime`, over a grey sky.
constexpr Float3 kToSun{-0.865f, 0.454f, 0.216f};
constexpr float kSunLight = 0.55f;
constexpr float kSkyLight = 0.15f;
constexpr float kBackground = 0.35f;

/// Corner on the screen, in samples.
struct Corner
{
    float x = 0, y = 0;
    float depth = 0; ///< z_near / distance: linear on the screen
};

float lightAt(Float3 normal)
{
    const Float3 unit = normalizeOr(normal, {0, 1, 0});
    return kSunLight * std::max(dot(unit, kToSun), 0.0f) + kSkyLight * (0.6f + 0.4f * unit.y);
}

float edge(const Corner& a, const Corner& b, float x, float y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

} // namespace

SampleImage::SampleImage(const shared::FrameView& view, uint32_t samples_across)
    : view_(view),
      samples_across_(samples_across),
      width_(static_cast<uint32_t>(view.width) * samples_across),
      height_(static_cast<uint32_t>(view.height) * samples_across),
      ids_(size_t{width_} * height_, kNothing),
      depths_(ids_.size(), 0.0f),
      light_(ids_.size(), kBackground)
{
}

bool SampleImage::draw(const ShadedTriangle& triangle, uint32_t id)
{
    std::array<Corner, 3> c;
    for (size_t i = 0; i < 3; ++i)
    {
        const Float4 clip = shared::clipPosition(view_, triangle.corners[i]);
        if (clip.w <= view_.z_near)
            return false;
        c[i] = {(clip.x / clip.w * 0.5f + 0.5f) * static_cast<float>(width_),
                (clip.y / clip.w * 0.5f + 0.5f) * static_cast<float>(height_), view_.z_near / clip.w};
    }
    // y points down: triangles that face the eye run clockwise, with a negative area here
    const float area = edge(c[0], c[1], c[2].x, c[2].y);
    if (!(area < 0))
        return false;
    const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
    const auto first = [](float from) { return static_cast<int>(std::ceil(std::max(from, 0.0f) - 0.5f)); };
    const auto last = [](float to, uint32_t size)
    { return static_cast<int>(std::floor(std::min(to, static_cast<float>(size)) - 0.5f)); };
    for (int y = std::max(first(top), 0); y <= last(bottom, height_); ++y)
        for (int x = std::max(first(left), 0); x <= last(right, width_); ++x)
        {
            const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
            const float a = edge(c[1], c[2], px, py) / area, b = edge(c[2], c[0], px, py) / area;
            const float rest = 1 - a - b;
            if (a < 0 || b < 0 || rest < 0)
                continue;
            const size_t sample = static_cast<size_t>(y) * width_ + static_cast<size_t>(x);
            const float depth = c[0].depth * a + c[1].depth * b + c[2].depth * rest;
            if (depth <= depths_[sample])
                continue;
            depths_[sample] = depth;
            ids_[sample] = id;
            light_[sample] =
                lightAt(triangle.normals[0] * a + triangle.normals[1] * b + triangle.normals[2] * rest);
        }
    return true;
}

viewer::Image SampleImage::resolve() const
{
    viewer::Image image(width_ / samples_across_, height_ / samples_across_);
    for (size_t y = 0; y < image.height; ++y)
        for (size_t x = 0; x < image.width; ++x)
        {
            double sum = 0;
            for (size_t j = 0; j < samples_across_; ++j)
                for (size_t i = 0; i < samples_across_; ++i)
                    sum += double{light_[(y * samples_across_ + j) * width_ + x * samples_across_ + i]};
            const double mean = sum / (samples_across_ * samples_across_);
            const auto grey =
                static_cast<uint8_t>(std::lround(255 * viewer::srgbFromLinear(std::clamp(mean, 0.0, 1.0))));
            std::fill_n(image.at(x, y), 3, grey);
        }
    return image;
}

} // namespace hearth::bench
