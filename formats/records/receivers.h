// Chunks of receivers: light that was baked lamp by lamp into the texels of an atlas, so that a game may dim
// and colour the lamps. See FORMAT.md, "Receivers".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/receivers/receivers.h"
#include "formats/records/container.h"

#include <array>

namespace hearth::formats
{

inline constexpr uint32_t kChunkReceivers = fourCC("RCVR");      ///< ReceiverAtlasRecord[], one at most
inline constexpr uint32_t kChunkReceiverLamps = fourCC("RCVL");  ///< ReceiverLampRecord[]
inline constexpr uint32_t kChunkReceiverRects = fourCC("RCVI");  ///< ReceiverRectRecord[]
inline constexpr uint32_t kChunkReceiverBlocks = fourCC("RCVB"); ///< ReceiverBlockRecord[]
inline constexpr uint32_t kChunkReceiverWords = fourCC("RCVW");  ///< u32[], of all blocks
inline constexpr uint32_t kChunkFaceReceivers = fourCC("RCFA");  ///< ReceiverAtlasRecord[], one at most
inline constexpr uint32_t kChunkFaceBlocks = fourCC("RCFB");     ///< ReceiverBlockRecord[], of faces
inline constexpr uint32_t kChunkFaceWords = fourCC("RCFW");      ///< u32[], of all blocks of faces

/// Chunks of texels, with the lamps of all receivers; and of faces.
inline constexpr std::array kReceiverChunks{kChunkReceivers, kChunkReceiverLamps, kChunkReceiverRects,
                                            kChunkReceiverBlocks, kChunkReceiverWords};
inline constexpr std::array kFaceReceiverChunks{kChunkFaceReceivers, kChunkFaceBlocks, kChunkFaceWords};

/// Lamps of an atlas, at most: blocks name them by 16 bits.
inline constexpr uint32_t kMaxReceiverLamps = 1u << 16;

/// Least scale of an atlas, far above the least floats; the largest is its reciprocal.
inline constexpr float kMinReceiverScale = 0x1p-100f;

enum class ReceiverCodec : uint32_t
{
    rgb9e5 = shared::kReceiverRgb9e5,
    rgbm = shared::kReceiverRgbm,
};

enum class ReceiverLampKind : uint32_t
{
    steady = 0,     ///< all light that no game changes: its weight is always 1
    light = 1,      ///< a light of the pack
    mesh_light = 2, ///< an instance whose material emits
};

/// Atlas of texels that receive irradiance; or the faces of the grid of bricks, in rows of
/// shared::kMaxReceiverSide.
struct ReceiverAtlasRecord
{
    uint32_t width;
    uint32_t height;
    uint32_t codec;
    float scale;
    uint32_t lamp_count;
    uint32_t rect_count;
    uint32_t block_count;
    uint32_t word_count;
    uint32_t texel_count;
    uint32_t group_blocks[shared::kReceiverGroups];
    uint32_t reserved[3];
};

/// Lamp with a weight of its own. Its name is that of the light, or of the instance's node.
struct ReceiverLampRecord
{
    uint32_t kind;
    uint32_t index;

    friend bool operator==(const ReceiverLampRecord&, const ReceiverLampRecord&) = default;
};

/// Rectangle of the atlas that an instance has to itself. Texture coordinates (u, v) of 0 to 1, of the UV set
/// that it names, lie at (x + u width, y + v height).
struct ReceiverRectRecord
{
    uint32_t instance;
    uint32_t x;
    uint32_t y;
    uint32_t width;
    uint32_t height;
    uint32_t uv_set;
};

using ReceiverBlockRecord = shared::ReceiverBlock;

/// All tables of an atlas.
struct ReceiverTables
{
    ReceiverAtlasRecord atlas{};
    std::span<const ReceiverLampRecord> lamps;
    std::span<const ReceiverRectRecord> rects;
    std::span<const ReceiverBlockRecord> blocks;
    std::span<const uint32_t> words;
};

/// Width and height of the atlas whose texels are faces.
struct FaceAtlasSize
{
    uint32_t width, height;
};

constexpr FaceAtlasSize faceAtlasSize(uint32_t face_count)
{
    constexpr uint32_t kRow = shared::kMaxReceiverSide;
    return {face_count < kRow ? face_count : kRow, face_count / kRow + (face_count % kRow != 0 ? 1u : 0u)};
}

/// Return a number that rises along the Z-order curve of texels; coordinates are below 2^16. Texels of a
/// block rise by it, so that a workgroup writes near each other.
constexpr uint32_t receiverOrder(uint32_t x, uint32_t y)
{
    const auto spread = [](uint32_t v)
    {
        v = (v | v << 8) & 0x00FF00FFu;
        v = (v | v << 4) & 0x0F0F0F0Fu;
        v = (v | v << 2) & 0x33333333u;
        return (v | v << 1) & 0x55555555u;
    };
    return spread(x) | spread(y) << 1;
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::ReceiverAtlasRecord, 64,
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, width, "texels, 1 to 16384"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, height, "texels, 1 to 16384"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, codec, "of the colours: 0 RGB9E5, 1 RGBM"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, scale,
                           "a power of two: irradiance is a decoded colour times it"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, lamp_count, "of chunk RCVL"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, rect_count, "of chunk RCVI"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, block_count, "of chunk RCVB"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, word_count, "of chunk RCVW"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, texel_count, "of all blocks"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, group_blocks, "blocks of each update group"),
              HEARTH_FIELD(hearth::formats::ReceiverAtlasRecord, reserved, "0"));

HEARTH_RECORD(hearth::formats::ReceiverLampRecord, 8,
              HEARTH_FIELD(hearth::formats::ReceiverLampRecord, kind,
                           "0 steady light, 1 light, 2 instance that emits"),
              HEARTH_FIELD(hearth::formats::ReceiverLampRecord, index,
                           "of chunk LGHT or INST; 0 for steady light"));

HEARTH_RECORD(hearth::formats::ReceiverRectRecord, 24,
              HEARTH_FIELD(hearth::formats::ReceiverRectRecord, instance, "one with a mesh"),
              HEARTH_FIELD(hearth::formats::ReceiverRectRecord, x, "first column"),
              HEARTH_FIELD(hearth::formats::ReceiverRectRecord, y, "first row"),
              HEARTH_FIELD(hearth::formats::ReceiverRectRecord, width, "columns, at least 1"),
              HEARTH_FIELD(hearth::formats::ReceiverRectRecord, height, "rows, at least 1"),
              HEARTH_FIELD(hearth::formats::ReceiverRectRecord, uv_set, "0 to 3: one that the mesh has"));

HEARTH_RECORD(hearth::formats::ReceiverBlockRecord, 40,
              HEARTH_FIELD(hearth::formats::ReceiverBlockRecord, first_word,
                           "of chunk RCVW, of faces RCFW; the block has texel_count (1 + color_count) words"),
              HEARTH_FIELD(hearth::formats::ReceiverBlockRecord, texel_count, "1 to 64"),
              HEARTH_FIELD(hearth::formats::ReceiverBlockRecord, color_count, "1 to 12"),
              HEARTH_FIELD(hearth::formats::ReceiverBlockRecord, group,
                           "of all its texels: (x & 1) + 2 (y & 1); blocks are sorted by it"),
              HEARTH_FIELD(hearth::formats::ReceiverBlockRecord, lamps,
                           "u16[12]: rising; 0 behind color_count"));
