// The unit and the up axis that a source is written in, and its way into a pack's: metres, +Y up.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Limits of SourceSpace::metres_per_unit: beyond what anybody measures in, and far inside of 32-bit numbers.
inline constexpr double kLeastScale = 1e-9;
inline constexpr double kLargestScale = 1e9;

enum class UpAxis : uint8_t
{
    y,
    z, ///< x stays, y points away: (x, y, z) becomes (x, z, -y)
};

struct SourceSpace
{
    double metres_per_unit = 1; ///< kLeastScale to kLargestScale
    UpAxis up = UpAxis::y;
};

/// Bring a part that has been read, but not finished, into metres with +Y up. A node without a name, behind all others, becomes
/// the parent of all roots, whatever scene they are of, so that joints and clips need no change; meshes keep their coordinates.
/// Places, ranges of lights, planes and widths of cameras and radii of shadow spheres follow. Candela and lux do not: they are
/// units of light, whatever lengths are written in. What is in metres with +Y up already stays as it is.
/// errors  input_too_large, where a place or a length does not fit 32-bit numbers
Status bringIntoMetres(const SourceSpace& space, PartBuilder& part);

} // namespace hearth::import
