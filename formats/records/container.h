// The container: one format for parts (what cookers exchange) and packs (what games ship). See FORMAT.md.
//
//   | FileHeader | chunk | 0.. | chunk | 0.. | ... | ChunkEntry[chunk_count] |
//     128 bytes    each chunk starts on a 64-byte boundary, zeros between      at table_offset, ends the file
//
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"
#include "formats/records/fields.h"

namespace hearth::formats
{

/// Pack four characters into a number that reads in order in a hex dump.
constexpr uint32_t fourCC(const char (&text)[5])
{
    return static_cast<uint32_t>(static_cast<unsigned char>(text[0])) |
           static_cast<uint32_t>(static_cast<unsigned char>(text[1])) << 8 |
           static_cast<uint32_t>(static_cast<unsigned char>(text[2])) << 16 |
           static_cast<uint32_t>(static_cast<unsigned char>(text[3])) << 24;
}

/// Magic bytes of a file. The control characters detect a transfer in text mode, as in PNG and KTX2.
inline constexpr uint8_t kMagic[16] = {'H', 'R',  'T',  'H',  0xAB, 'P',  'A', 'C',
                                       'K', 0xBB, '\r', '\n', 0x1A, '\n', 0,   0};
inline constexpr uint32_t kVersionMajor = 2;
inline constexpr uint32_t kVersionMinor = 0;
inline constexpr uint32_t kEndianMark = 0x01020304;
inline constexpr uint64_t kChunkAlignment = 64;

/// Return the first position at or behind `position` where a chunk or a page can begin.
constexpr uint64_t alignChunk(uint64_t position)
{
    return (position + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment;
}

/// Maximum size of a table in decoded bytes: indices and sums of ranges fit 32 bits.
inline constexpr uint64_t kMaxTableBytes = uint64_t{1} << 32;
/// Decoded bytes that the compressed tables of a file may have together, whatever they hold: equal records
/// compress several thousand to one. Holds 5 million nodes that draw a mesh; the tables of bricks need half.
inline constexpr uint64_t kMaxUniformTableBytes = uint64_t{1} << 30;
/// Decoded bytes of compressed tables beyond kMaxUniformTableBytes, for each of their bytes in the file.
/// Tables of real packs have 2 to 5.
inline constexpr uint64_t kMaxBytesPerStoredByte = 256;

enum class ContainerKind : uint32_t
{
    part = fourCC("PART"), ///< result of one cooker, input of the next
    pack = fourCC("PACK"), ///< asset that the runtime loads
};

enum class Codec : uint32_t
{
    none = 0,
    zstd = 1,
    zstd_frames = 2, ///< one after another, each with the size of its content
};

struct FileHeader
{
    uint8_t magic[16];
    uint32_t version_major;
    uint32_t version_minor;
    uint32_t endian_mark;
    uint32_t header_size;
    uint32_t kind;
    uint32_t chunk_count;
    uint64_t file_size;
    uint64_t table_offset;
    uint64_t table_hash;
    uint32_t required_features;
    uint32_t optional_features;
    uint32_t reserved[12];
    uint64_t header_hash;
};

struct ChunkEntry
{
    uint32_t type;
    uint32_t version;
    uint32_t index;
    uint32_t codec;
    uint64_t offset;
    uint64_t stored_size;
    uint64_t size;
    uint64_t hash;
    uint32_t element_size;
    uint32_t reserved[3];
};

/// Part of the string table: bytes [offset, offset + length) of chunk STRS, UTF-8, no terminator.
struct StringRef
{
    static constexpr std::string_view kTypeName = "StringRef";
    uint32_t offset;
    uint32_t length;
};

/// Half-open range [first, first + count) of the records of another chunk.
struct Range
{
    static constexpr std::string_view kTypeName = "Range";
    uint32_t first;
    uint32_t count;
};

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::StringRef, 8,
              HEARTH_FIELD(hearth::formats::StringRef, offset, "first byte in chunk STRS"),
              HEARTH_FIELD(hearth::formats::StringRef, length, "bytes of UTF-8 text, no terminator"));

HEARTH_RECORD(hearth::formats::Range, 8, HEARTH_FIELD(hearth::formats::Range, first, "first record"),
              HEARTH_FIELD(hearth::formats::Range, count, "number of records"));

HEARTH_RECORD(hearth::formats::FileHeader, 128,
              HEARTH_FIELD(hearth::formats::FileHeader, magic, "\"HRTH\" AB \"PACK\" BB 0D 0A 1A 0A 00 00"),
              HEARTH_FIELD(hearth::formats::FileHeader, version_major, "readers refuse another one"),
              HEARTH_FIELD(hearth::formats::FileHeader, version_minor,
                           "greater ones only add chunks and fields"),
              HEARTH_FIELD(hearth::formats::FileHeader, endian_mark, "0x01020304, little-endian"),
              HEARTH_FIELD(hearth::formats::FileHeader, header_size, "size of this header: 128"),
              HEARTH_FIELD(hearth::formats::FileHeader, kind, "FourCC PART or PACK"),
              HEARTH_FIELD(hearth::formats::FileHeader, chunk_count, "entries of the chunk table"),
              HEARTH_FIELD(hearth::formats::FileHeader, file_size, "bytes of the whole file"),
              HEARTH_FIELD(hearth::formats::FileHeader, table_offset,
                           "first byte of the chunk table, which ends the file"),
              HEARTH_FIELD(hearth::formats::FileHeader, table_hash, "XXH3-64 of the chunk table"),
              HEARTH_FIELD(hearth::formats::FileHeader, required_features,
                           "bits; readers refuse a file with one they lack"),
              HEARTH_FIELD(hearth::formats::FileHeader, optional_features, "bits; readers may ignore them"),
              HEARTH_FIELD(hearth::formats::FileHeader, reserved, "0"),
              HEARTH_FIELD(hearth::formats::FileHeader, header_hash,
                           "XXH3-64 of the header's bytes before this field"));

HEARTH_RECORD(
    hearth::formats::ChunkEntry, 64, HEARTH_FIELD(hearth::formats::ChunkEntry, type, "FourCC"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, version, "of this type of chunk"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, index, "which of several chunks of the type; with type unique"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, codec, "0 none, 1 zstd"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, offset, "from the start of the file; a multiple of 64"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, stored_size, "bytes in the file"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, size, "bytes after decompression"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, hash, "XXH3-64 of the stored bytes"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, element_size, "bytes of one record, 1 for plain bytes"),
    HEARTH_FIELD(hearth::formats::ChunkEntry, reserved, "0"));
