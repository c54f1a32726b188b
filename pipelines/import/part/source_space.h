// Converts a part from the unit and up axis of its source to metres with +Y up, as in a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Limits of SourceSpace::metres_per_unit: beyond any unit in use, and far inside the range of 32-bit floats.
inline constexpr double kMinScale = 1e-9;
inline constexpr double kMaxScale = 1e9;

enum class UpAxis : uint8_t
{
    y,
    z, ///< x stays, y points away: (x, y, z) becomes (x, z, -y)
};

struct SourceSpace
{
    double metres_per_unit = 1; ///< kMinScale to kMaxScale
    UpAxis up = UpAxis::y;
};

/// Convert a part that has been read, but not finished, to metres with +Y up. A node without a name, appended
/// after all others, becomes the parent of the roots of all scenes, so joints and clips need no change;
/// meshes keep their coordinates. World transforms, ranges of lights, near and far planes and widths of
/// cameras, and radii of shadow spheres are converted. Candela and lux are not: they do not depend on the
/// unit of length. A part in metres with +Y up stays unchanged.
/// errors  input_too_large, where a position or a length does not fit 32-bit floats
Status convertToMetres(const SourceSpace& space, PartBuilder& part);

} // namespace hearth::import
