// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/lights/light_peers.h"

#include <algorithm>
#include <cmath>

namespace hearth::bench
{

namespace
{

constexpr int kSlices = 16;
constexpr float kMaxFroxels = 8192;
constexpr float kLightNear = 5;
constexpr float kLightFar = 100;

/// Return the signed distance from a plane through the eye, x = u z.
float distanceFrom(float coordinate, float depth, float edge)
{
    return (coordinate - edge * depth) / std::sqrt(1 + edge * edge);
}

} // namespace

FroxelGrid::FroxelGrid(const shared::LightGridView& view) : view_(view)
{
    const float side = std::sqrt(view.width * view.height * kSlices / kMaxFroxels);
    cell_pixels_ = std::ceil(side / 8) * 8;
    columns_ = static_cast<int>(std::ceil(view.width / cell_pixels_));
    rows_ = static_cast<int>(std::ceil(view.height / cell_pixels_));
}

float FroxelGrid::sliceEnd(int slice) const
{
    const float share = static_cast<float>(slice) / (kSlices - 1);
    return kLightNear * std::pow(kLightFar / kLightNear, share);
}

int FroxelGrid::findSlice(float depth) const
{
    int slice = 0;
    while (slice < kSlices && depth >= sliceEnd(slice))
        ++slice;
    return slice;
}

size_t FroxelGrid::cellAt(float x, float y, float depth) const
{
    const int slice = findSlice(depth);
    if (slice >= kSlices)
        return kNoCell;
    const int column = std::min(static_cast<int>(x / cell_pixels_), columns_ - 1);
    const int row = std::min(static_cast<int>(y / cell_pixels_), rows_ - 1);
    return static_cast<size_t>((slice * rows_ + row) * columns_ + column);
}

void FroxelGrid::assign(std::span<const shared::Light> lights)
{
    lists_.assign(static_cast<size_t>(kSlices * rows_ * columns_), {});
    for (uint32_t i = 0; i < lights.size(); ++i)
    {
        const Float3 offset = lights[i].position - view_.eye;
        assignBall({dot(view_.right, offset), dot(view_.down, offset), dot(view_.forward, offset)},
                   lights[i].range, i);
    }
}

void FroxelGrid::assignBall(Float3 center, float radius, uint32_t light)
{
    if (center.z + radius < view_.z_near)
        return;
    const int first = findSlice(std::max(center.z - radius, 0.0f));
    const int last = std::min(findSlice(center.z + radius), kSlices - 1);
    const int own = findSlice(std::max(center.z, 0.0f));
    for (int slice = first; slice <= last; ++slice)
    {
        Float3 cut = center;
        if (slice != own)
            cut.z = slice < own ? sliceEnd(slice) : sliceEnd(slice - 1);
        const float radius2 = radius * radius - (cut.z - center.z) * (cut.z - center.z);
        if (radius2 > 0)
            for (int row = 0; row < rows_; ++row)
                assignRow(cut, radius2, slice, row, light);
    }
}

void FroxelGrid::assignRow(Float3 center, float radius2, int slice, int row, uint32_t light)
{
    const auto edge = [&](int number)
    { return (static_cast<float>(number) * cell_pixels_ - view_.center_y) / view_.pixels_per_v; };
    const float below = distanceFrom(center.y, center.z, edge(row));
    const float above = distanceFrom(center.y, center.z, edge(row + 1));
    const float off = below < 0 ? below : above > 0 ? above : 0;
    const float left2 = radius2 - off * off;
    if (left2 <= 0)
        return;
    const float reach = std::sqrt(left2);
    for (int column = 0; column < columns_; ++column)
    {
        const auto side = [&](int number)
        {
            const float u = (static_cast<float>(number) * cell_pixels_ - view_.center_x) / view_.pixels_per_u;
            return distanceFrom(center.x, center.z, u);
        };
        if (side(column) > -reach && side(column + 1) < reach)
            lists_[static_cast<size_t>((slice * rows_ + row) * columns_ + column)].push_back(light);
    }
}

bool reachesBall(Float3 apex, Float3 axis, float cosine, float range, Float3 center, float radius)
{
    const Float3 offset = center - apex;
    if (dot(offset, offset) > (range + radius) * (range + radius))
        return false;
    const float sine = std::sqrt(std::max(1 - cosine * cosine, 1e-12f));
    const Float3 from_tip = center - (apex - axis * (radius / sine));
    const float along = dot(axis, from_tip);
    return along > 0 && along * along >= dot(from_tip, from_tip) * cosine * cosine;
}

} // namespace hearth::bench
