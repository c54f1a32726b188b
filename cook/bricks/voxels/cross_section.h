// How much of a voxel's cross-section the surfaces in it hide, seen along each axis: 8 x 8 samples, each hidden or not.
// Samples know what lies behind what: two sheets one behind the other hide no more than one, as areas would have it; and
// pieces that meet leave no sample between them uncovered, so that a wall hides exactly all.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/voxel_clip.h"

namespace hearth::bricks
{

inline constexpr uint32_t kSampleRow = 8; ///< samples along an edge of a voxel

/// For each axis, sample (u, v) is bit u + 8 v, where u and v are the two axes after it, and lies in the middle of its cell.
using CrossSections = std::array<uint64_t, 3>;

constexpr int uAxis(int axis)
{
    return axis == 2 ? 0 : axis + 1;
}
constexpr int vAxis(int axis)
{
    return axis == 0 ? 2 : axis - 1;
}

/// The samples of a voxel that a piece inside of it hides along an axis. Of pieces with a common edge each sample on it
/// belongs to one.
uint64_t hiddenSamples(const Polygon& piece, const Cell& cell, int axis);

/// Whether the voxel and its two neighbours along an axis hide everything together: then what goes through it along the
/// axis meets a surface somewhere there, however the surface is slanted between the three.
inline bool hidesAll(uint64_t before, uint64_t own, uint64_t after)
{
    return (before | own | after) == ~uint64_t{0};
}

} // namespace hearth::bricks
