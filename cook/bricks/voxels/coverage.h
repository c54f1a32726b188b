// Computes the coverage of a voxel along each axis with 8 x 8 samples, each covered or not. Samples handle
// overlap, which areas do not: two sheets behind each other cover no more than one. Pieces with a common edge
// leave no sample between them uncovered, so a wall has full coverage.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/polygon_clip.h"

namespace hearth::bricks
{

inline constexpr uint32_t kSamplesPerEdge = 8; ///< coverage samples along an edge of a voxel

/// Coverage mask for each axis. Sample (u, v) is bit u + 8 v, where u and v are the two axes after the axis
/// in cyclic order. Samples lie in the middle of their cells.
using CoverageMasks = std::array<uint64_t, 3>;

constexpr int uAxis(int axis)
{
    return axis == 2 ? 0 : axis + 1;
}
constexpr int vAxis(int axis)
{
    return axis == 0 ? 2 : axis - 1;
}

/// Return the samples of voxel `cell` that a piece inside it covers along an axis. A sample on a common edge
/// of two pieces belongs to exactly one of them.
uint64_t coveredSamples(const Polygon& piece, const Cell& cell, int axis);

/// True if the voxel and its two neighbours along an axis have full coverage together. Every line along the
/// axis then meets a surface in one of the three, however the surface slants between them.
inline bool coversAll(uint64_t before, uint64_t own, uint64_t after)
{
    return (before | own | after) == ~uint64_t{0};
}

} // namespace hearth::bricks
