// Chunks of the surroundings of instances: how they change the visibility of a mesh, and how much light they
// give back. See FORMAT.md, "Surroundings".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/half.h"
#include "formats/records/container.h"

namespace hearth::formats
{

inline constexpr uint32_t kChunkSurroundings = fourCC("SURR");      ///< SurroundingsRecord[]
inline constexpr uint32_t kChunkRadianceTransfers = fourCC("XFER"); ///< RadianceTransferRecord[]

/// Spherical harmonics of the light that arrives, of degrees 0 to 2.
inline constexpr uint32_t kLightHarmonics = 9;

/// Terms of a linear function of a direction: x, y and z, and 1.
inline constexpr uint32_t kDirectionTerms = 4;

inline constexpr uint32_t kTransferValues = kLightHarmonics * kDirectionTerms * 3;

/// Surroundings of an instance.
struct SurroundingsRecord
{
    uint32_t transfer; ///< record of chunk XFER, or none: nothing occludes the instance
    /// Half floats, for the terms of a world direction: the instance's visibility over that of its mesh.
    uint16_t visibility[kDirectionTerms];
};

/// Surroundings as those of all instances of the mesh, and no occluders.
inline constexpr SurroundingsRecord kPlainSurroundings{kInvalidIndex, {0, 0, 0, kHalfOne}};

/// Radiance transfer: radiance from the occluded directions around an instance for each unit of a spherical
/// harmonic in the radiance of distant light. Linear in the direction, so that one record serves all sides.
struct RadianceTransferRecord
{
    uint16_t values[kTransferValues]; ///< half floats: red, green, blue, of each term, of each harmonic
};

/// Return the place of a value.
constexpr uint32_t transferValue(uint32_t harmonic, uint32_t term, uint32_t color)
{
    return (harmonic * kDirectionTerms + term) * 3 + color;
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::SurroundingsRecord, 12,
              HEARTH_FIELD(hearth::formats::SurroundingsRecord, transfer,
                           "chunk XFER, or none: nothing occludes the instance"),
              HEARTH_FIELD(hearth::formats::SurroundingsRecord, visibility,
                           "halves: factor of the mesh's visibility from a world direction, its terms x, y, "
                           "z and 1"));

HEARTH_RECORD(hearth::formats::RadianceTransferRecord, 216,
              HEARTH_FIELD(hearth::formats::RadianceTransferRecord, values,
                           "halves: 9 harmonics of light x 4 terms of the direction (x, y, z, 1) x RGB"));
