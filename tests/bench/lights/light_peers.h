// Lists of lights as other engines make them, written anew from their published sources for comparison.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "runtime/frame/light_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::bench
{

/// Grid of Filament's size (filament/src/Froxelizer.cpp): at most 8192 cells in 16 slices, the first of which
/// reaches to 5 m and the last to 100 m. Lights beyond are lost.
class FroxelGrid
{
public:
    explicit FroxelGrid(const shared::LightGridView& view);

    /// Assign balls by Filament's loop: a ball is cut by the nearest plane of a slice, and the circle by the
    /// nearest plane of a row.
    void assign(std::span<const shared::Light> lights);

    /// Number of the cell of a point, or none beyond the last slice.
    size_t cellAt(float x, float y, float depth) const;
    size_t count(size_t cell) const { return lists_[cell].size(); }
    static constexpr size_t kNoCell = ~size_t{0};

private:
    float sliceEnd(int slice) const;
    int findSlice(float depth) const;
    void assignBall(Float3 center, float radius, uint32_t light);
    void assignRow(Float3 center, float radius2, int slice, int row, uint32_t light);

    shared::LightGridView view_;
    float cell_pixels_;
    int columns_, rows_;
    std::vector<std::vector<uint32_t>> lists_;
};

/// Test of Filament and Bevy whether a cone reaches a cell: the ball around the cell against the cone.
bool reachesBall(Float3 apex, Float3 axis, float cosine, float range, Float3 center, float radius);

} // namespace hearth::bench
