// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/prefilter.h"

#include "cook/probes/direction_grid.h"
#include "formats/base/assert.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace hearth::probes
{

namespace
{

using environment::Layout;

// Parts of a node of the finest level, along each axis. Each is spread over the texels of mip 0 that it
// overlaps, as if it were a square along their rows: 3 parts or more cross a texel of 128 on a side.
constexpr uint32_t kPartsOfNode = 2;

/// Adds light to the texels of a face of mip 0.
class FaceSum
{
public:
    FaceSum(uint32_t face, uint32_t side, std::span<Double3> lights, std::span<double> solid_angles)
        : side_(static_cast<int>(side)), lights_(lights), solid_angles_(solid_angles)
    {
        axis_ = panelDirection(Layout::cube, face, {0.5, 0.5});
        right_ = panelDirection(Layout::cube, face, {1, 0.5}) * std::numbers::sqrt2 - axis_;
        down_ = panelDirection(Layout::cube, face, {0.5, 1}) * std::numbers::sqrt2 - axis_;
    }

    /// Add what falls on the face of a panel's finest level.
    void addPanel(const RadianceLevel& level, const DirectionGrid& parts)
    {
        // no direction of the face is farther from its axis than 54.8 degrees; nodes have less than 0.2
        constexpr double kMinCosine = 0.57;
        for (uint32_t y = 0; y < level.height; ++y)
            for (uint32_t x = 0; x < level.width; ++x)
                if (const RadianceNode& node = level.at(x, y); dot(widen(node.direction), axis_) > kMinCosine)
                {
                    const Double3 radiance = widen(node.light) * (1 / double{node.solid_angle});
                    for (uint32_t row = y * kPartsOfNode; row < (y + 1) * kPartsOfNode; ++row)
                        for (uint32_t column = x * kPartsOfNode; column < (x + 1) * kPartsOfNode; ++column)
                            addPart(parts.direction(column, row), parts.solidAngle(column, row), radiance);
                }
    }

private:
    /// Add the share of a part that lies on the face.
    void addPart(Double3 direction, double solid_angle, Double3 radiance)
    {
        const double depth = dot(direction, axis_), to_texels = side_ / (2 * depth);
        const double column = (dot(direction, right_) + depth) * to_texels;
        const double row = (dot(direction, down_) + depth) * to_texels;
        // area on the face, which is seen at an angle from a distance
        const double distance2 = dot(direction, direction) / (depth * depth);
        const double half = std::sqrt(solid_angle * distance2 * std::sqrt(distance2)) * side_ / 4;
        const auto last = [&](double at)
        { return std::min(static_cast<int>(std::floor(at + half)), side_ - 1); };
        const auto first = [&](double at) { return std::max(static_cast<int>(std::floor(at - half)), 0); };
        const auto share = [&](double at, int texel)
        { return (std::min(at + half, texel + 1.0) - std::max(at - half, double(texel))) / (2 * half); };
        for (int y = first(row); y <= last(row); ++y)
            for (int x = first(column); x <= last(column); ++x)
            {
                const double part = solid_angle * share(row, y) * share(column, x);
                const auto texel = static_cast<size_t>(y * side_ + x);
                lights_[texel] = lights_[texel] + radiance * part;
                solid_angles_[texel] += part;
            }
    }

    int side_;
    std::span<Double3> lights_;
    std::span<double> solid_angles_;
    Double3 axis_, right_, down_; ///< unit
};

ProbeMip averageAreas(const RadianceTree& tree, uint32_t side)
{
    const size_t face_texels = size_t{side} * side;
    ProbeMip mip{side, std::vector<Double3>(6 * face_texels)};
    std::vector<double> solid_angles(mip.texels.size());
    std::vector<DirectionGrid> parts;
    for (uint32_t panel = 0; panel < tree.panels.size(); ++panel)
    {
        const RadianceLevel& level = tree.panels[panel].levels[0];
        parts.emplace_back(tree.layout, panel, kPartsOfNode * level.width, kPartsOfNode * level.height);
    }
    const auto sumFace = [&](uint32_t face)
    {
        FaceSum sum(face, side, std::span(mip.texels).subspan(face * face_texels, face_texels),
                    std::span(solid_angles).subspan(face * face_texels, face_texels));
        for (size_t panel = 0; panel < parts.size(); ++panel)
            sum.addPanel(tree.panels[panel].levels[0], parts[panel]);
    };
    tbb::parallel_for(uint32_t{0}, uint32_t{6}, sumFace);
    for (size_t i = 0; i < mip.texels.size(); ++i)
    {
        HEARTH_ASSERT(solid_angles[i] > 0);
        mip.texels[i] = mip.texels[i] * (1 / solid_angles[i]);
    }
    return mip;
}

// Edge of a node that may be summed as one point, beside the width of the lobe there: near its middle .35
// alpha. Beside the sun of a clear day the error is 0.1 to 0.4 % rms, and grows with the square.
constexpr float kNodeOfLobe = 0.35f;
// Longest edges of nodes in radians: 11 degrees, and 2.8 for lobes that reach the horizon, where they are
// cut.
constexpr float kMaxNode = 0.2f, kMaxNodeOfWideLobe = 0.05f;
constexpr float kMinWideAlpha = 0.25f;

/// Sums of a lobe over the tree.
class LobeSum
{
public:
    LobeSum(Float3 axis, float alpha)
        : axis_(axis),
          alpha2_(alpha * alpha),
          max_size_(alpha < kMinWideAlpha ? kMaxNode : kMaxNodeOfWideLobe)
    {
    }

    Double3 filter(const RadianceTree& tree)
    {
        for (const RadiancePanel& panel : tree.panels)
            add(panel, panel.levels.size() - 1, 0, 0);
        return light_ * (1 / weight_);
    }

private:
    void add(const RadiancePanel& panel, size_t level, uint32_t x, uint32_t y)
    {
        const RadianceNode& node = panel.levels[level].at(x, y);
        const float square = squareTo(node.direction);
        if (1 - square / 2 < -node.size)
            return; // below the horizon, with all of it
        const float width2 = alpha2_ + square / 4;
        if (level == 0 ||
            (node.size <= max_size_ && node.size * node.size <= kNodeOfLobe * kNodeOfLobe * width2))
        {
            light_ = light_ + widen(node.light) * double{evaluate(squareTo(node.light_direction))};
            weight_ += double{node.solid_angle} * double{evaluate(square)};
            return;
        }
        const RadianceLevel& finer = panel.levels[level - 1];
        for (uint32_t row = 2 * y; row < std::min(2 * y + 2, finer.height); ++row)
            for (uint32_t column = 2 * x; column < std::min(2 * x + 2, finer.width); ++column)
                add(panel, level - 1, column, row);
    }

    /// Return 2 - 2 cos t = 4 sin^2(t / 2) of a direction; it is exact for small angles t, too.
    float squareTo(Float3 direction) const
    {
        const Float3 offset = direction - axis_;
        return dot(offset, offset);
    }

    /// Return k, but 1 where t is 0.
    float evaluate(float square) const
    {
        const float cosine = std::max(1 - square / 2, 0.0f);
        // 1 + cos^2(t / 2) (alpha^2 - 1), with cos^2(t / 2) = 1 - square / 4
        const float ratio = alpha2_ / (alpha2_ + (1 - alpha2_) * square / 4);
        return cosine * ratio * ratio;
    }

    Float3 axis_;
    float alpha2_, max_size_;
    Double3 light_;
    double weight_ = 0;
};

ProbeMip filterLobes(const RadianceTree& tree, uint32_t side, double roughness)
{
    ProbeMip mip{side, std::vector<Double3>(size_t{6} * side * side)};
    const auto alpha = static_cast<float>(roughness * roughness);
    tbb::parallel_for(uint32_t{0}, 6 * side,
                      [&](uint32_t row)
                      {
                          for (uint32_t x = 0; x < side; ++x)
                          {
                              const Double3 axis = panelDirection(
                                  Layout::cube, row / side, {(x + 0.5) / side, (row % side + 0.5) / side});
                              mip.texels[size_t{row} * side + x] = LobeSum(narrow(axis), alpha).filter(tree);
                          }
                      });
    return mip;
}

} // namespace

std::vector<ProbeMip> prefilter(const RadianceTree& tree, uint32_t side, uint32_t mip_count)
{
    HEARTH_ASSERT(mip_count >= 2 && side >> (mip_count - 1) > 0);
    std::vector<ProbeMip> mips{averageAreas(tree, side)};
    for (uint32_t mip = 1; mip < mip_count; ++mip)
        mips.push_back(filterLobes(tree, side >> mip, formats::probeMipRoughness(mip, mip_count)));
    return mips;
}

} // namespace hearth::probes
