// Chunks of the brick grid: the solid voxels of a scene, and the light that their faces reflect and emit. See
// FORMAT.md, "Bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/bricks.h"
#include "formats/gpu_shared/reflector.h"
#include "formats/records/container.h"

#include <algorithm>
#include <array>

namespace hearth::formats
{

inline constexpr uint32_t kChunkBrickGrid = fourCC("BRKS"); ///< BrickGridRecord[], one at most
/// BrickGroupRecord[], all of the grid, x fastest, then y, z
inline constexpr uint32_t kChunkBrickGroups = fourCC("BRKG");
inline constexpr uint32_t kChunkBricks = fourCC("BRKB");        ///< BrickRecord[]
inline constexpr uint32_t kChunkBrickOpacity = fourCC("BRKO");  ///< u8[], one for each solid voxel
inline constexpr uint32_t kChunkBrickAlbedo = fourCC("BRKA");   ///< u32[], one for each face
inline constexpr uint32_t kChunkBrickNormals = fourCC("BRKN");  ///< u16[], one for each face
inline constexpr uint32_t kChunkBrickEmission = fourCC("BRKE"); ///< u32[], one for each face, R11G11B10F
inline constexpr uint32_t kChunkBrickLighting = fourCC("BRKL"); ///< u32[], one for each face, R11G11B10F
/// ReflectorRecord[], one for each light of the pack, up to shared::kMaxLights; or none
inline constexpr uint32_t kChunkReflectors = fourCC("BRKR");

/// All chunk types of the brick grid, in file order.
inline constexpr std::array kBrickChunks{kChunkBrickGrid,     kChunkBrickGroups,   kChunkBricks,
                                         kChunkBrickOpacity,  kChunkBrickAlbedo,   kChunkBrickNormals,
                                         kChunkBrickEmission, kChunkBrickLighting, kChunkReflectors};
constexpr bool isBrickChunk(uint32_t type)
{
    return std::find(kBrickChunks.begin(), kBrickChunks.end(), type) != kBrickChunks.end();
}

/// Maximum number of voxels along each axis: positions stay exact in floats, and numbers of groups fit 32
/// bits.
inline constexpr uint32_t kMaxGridVoxels = 1u << 14;
/// Maximum number of groups, solid voxels and faces: each table is at most 64 MiB.
inline constexpr uint32_t kMaxBrickGroups = 1u << 22;
inline constexpr uint32_t kMaxBrickVoxels = 1u << 26;
inline constexpr uint32_t kMaxBrickFaces = 1u << 24;

/// Voxel (x, y, z) is the box from origin + voxel_size * (x, y, z) to origin + voxel_size * (x + 1, y + 1, z
/// + 1).
struct BrickGridRecord
{
    Float3 origin;
    float voxel_size;
    uint32_t voxels[3];
    uint32_t group_count;
    uint32_t brick_count;
    uint32_t solid_count;
    uint32_t face_count;
    uint32_t reserved;
};

/// Surfaces right around a lamp, as its shade: shared::reflectorShare, shared::reflectorPassed. All 0: none.
struct ReflectorRecord
{
    uint32_t gain;                                     ///< R11G11B10F
    uint32_t axis;                                     ///< world space
    uint32_t reflected[shared::kReflectorSamples / 4]; ///< 4 of 8 bits, the first in the low byte
    uint32_t passed[shared::kReflectorSamples / 4];    ///< of the lamp's own light
};

using BrickGroupRecord = shared::BrickGroup;
using BrickRecord = shared::Brick;

/// Return the name of a face of shared::kVoxelFaces; "none" for kNoFace.
constexpr std::string_view voxelFaceName(uint32_t face)
{
    constexpr std::string_view kNames[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    return face < shared::kVoxelFaces ? kNames[face] : "none";
}

/// Return the grid as the march functions take it.
constexpr shared::BrickGrid toBrickGrid(const BrickGridRecord& record)
{
    return {record.origin, record.voxel_size, record.voxels[0], record.voxels[1], record.voxels[2], 0};
}

/// Return the number of groups of a grid with this many voxels along its axes, each at most kMaxGridVoxels.
constexpr uint32_t brickGroupCount(const uint32_t (&voxels)[3])
{
    uint32_t count = 1;
    for (const uint32_t along : voxels)
        count *= (along + shared::kGroupVoxels - 1) / shared::kGroupVoxels;
    return count;
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::BrickGridRecord, 48,
              HEARTH_FIELD(hearth::formats::BrickGridRecord, origin,
                           "least corner of voxel (0, 0, 0), world space, metres"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, voxel_size, "edge of a voxel, metres, > 0"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, voxels,
                           "along each axis, 1 to 16384; groups along it are a sixteenth, rounded up"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, group_count, "of chunk BRKG"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, brick_count, "of chunk BRKB"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, solid_count, "of chunk BRKO"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, face_count,
                           "of chunks BRKA, BRKN, BRKE and BRKL"),
              HEARTH_FIELD(hearth::formats::BrickGridRecord, reserved, "0"));

HEARTH_RECORD(hearth::formats::BrickGroupRecord, 12,
              HEARTH_FIELD(hearth::formats::BrickGroupRecord, brick_mask_low,
                           "which of its 4 x 4 x 4 bricks exist: bits 0 to 31"),
              HEARTH_FIELD(hearth::formats::BrickGroupRecord, brick_mask_high, "bits 32 to 63"),
              HEARTH_FIELD(hearth::formats::BrickGroupRecord, first_brick,
                           "of its bricks; where it has none, that of the next group"));

HEARTH_RECORD(hearth::formats::BrickRecord, 64,
              HEARTH_FIELD(hearth::formats::BrickRecord, voxel_mask_low,
                           "which of its 4 x 4 x 4 voxels are solid: bits 0 to 31; one at least"),
              HEARTH_FIELD(hearth::formats::BrickRecord, voxel_mask_high, "bits 32 to 63"),
              HEARTH_FIELD(hearth::formats::BrickRecord, face_masks,
                           "the voxels that have face x-, x+, y-, y+, z-, z+: two words for each"),
              HEARTH_FIELD(hearth::formats::BrickRecord, first_voxel, "of its solid voxels"),
              HEARTH_FIELD(hearth::formats::BrickRecord, first_face,
                           "of its faces: those of x- in the order of their bits, then those of x+, ..."));

HEARTH_RECORD(hearth::formats::ReflectorRecord, 40,
              HEARTH_FIELD(hearth::formats::ReflectorRecord, gain,
                           "brightest intensity over the lamp's without its cone, R11G11B10F; 0: none"),
              HEARTH_FIELD(hearth::formats::ReflectorRecord, axis,
                           "in world space, 2 x 8 bits, coded as normals of faces"),
              HEARTH_FIELD(hearth::formats::ReflectorRecord, reflected,
                           "16 of 8 bits, 255: the gain; number i at the angle t to the axis where "
                           "sin(t / 2) = i / 15"),
              HEARTH_FIELD(hearth::formats::ReflectorRecord, passed,
                           "16 of 8 bits at the same angles: share of the lamp's own light that passes"));
