// Tests the limit of what tables decode to: tables of equal records are read whatever their ratio is, and
// decompression bombs are refused without their memory.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/table_sizes.h"

#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/pack/pack_view.h"
#include "tests/support/container_image.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr uint64_t kGibibyte = uint64_t{1} << 30;
constexpr uint64_t kRunBytes = 128 * 1024; // largest block of a zstd frame

ChunkEntry compressedEntry(uint32_t type, uint64_t size, uint64_t stored_size)
{
    ChunkEntry entry{};
    entry.type = type;
    entry.codec = static_cast<uint32_t>(Codec::zstd);
    entry.size = size;
    entry.stored_size = stored_size;
    return entry;
}

Status check(const std::vector<ChunkEntry>& entries)
{
    return checkTableSizes(entries, Issue::chunk_size, "a.part");
}

/// Return a zstd frame of `runs` blocks that are 128 KiB of zeros each, and that claims `claimed` bytes.
std::vector<std::byte> frameOfZeros(uint64_t claimed, uint64_t runs)
{
    // magic number; one segment with a content size of 8 bytes
    std::vector<std::byte> frame{std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD},
                                 std::byte{0xE0}};
    const auto append = [&](uint64_t value, int bytes)
    {
        for (int i = 0; i < bytes; ++i)
            frame.push_back(static_cast<std::byte>(value >> (8 * i)));
    };
    append(claimed, 8);
    for (uint64_t run = 0; run < runs; ++run)
    {
        append((run + 1 == runs ? 1u : 0u) | 1u << 1 | kRunBytes << 3, 3); // last block, run, its length
        append(0, 1);
    }
    return frame;
}

ChunkImage chunkOfZeros(uint32_t type, uint32_t element_size, uint64_t claimed, uint64_t runs)
{
    ChunkImage chunk{compressedEntry(type, claimed, 0), frameOfZeros(claimed, runs)};
    chunk.entry.version = chunkVersion(type);
    chunk.entry.element_size = element_size;
    return chunk;
}

/// Peak of the resident memory of this process since the last reset, in bytes; 0 if the system does not say.
class PeakMemory
{
public:
    PeakMemory() { std::ofstream("/proc/self/clear_refs") << "5"; }
    uint64_t bytes() const
    {
        std::ifstream status("/proc/self/status");
        for (std::string word; status >> word;)
            if (uint64_t kibibytes = 0; word == "VmHWM:" && status >> kibibytes)
                return kibibytes * 1024;
        return 0;
    }
};

/// Return the error of opening a part of these chunks, and expect that it takes less than 64 MiB.
Error refusePart(const std::vector<ChunkImage>& chunks)
{
    const AlignedBytes bytes = assemble(ContainerKind::part, chunks);
    EXPECT_LT(bytes.size(), 1u << 20) << "the file is small";
    const PeakMemory peak;
    const uint64_t before = peak.bytes();
    const auto reader = ContainerReader::fromBytes(bytes.span(), "bomb.part");
    Error error{Issue::usage, "", "", "nothing is wrong"};
    if (!reader.ok())
        error = reader.error();
    else if (const auto view = PackView::read(*reader); !view.ok())
        error = view.error();
    EXPECT_LT(peak.bytes(), before + (uint64_t{64} << 20)) << formatMessage(error);
    return error;
}

} // namespace

TEST(TableSizes, letEqualRecordsHaveAnyRatio)
{
    EXPECT_TRUE(check({compressedEntry(kChunkNodes, 900 << 20, 30'000)}).ok());
    const ChunkImage nodes =
        zstdChunk(kChunkNodes, 0, sizeof(NodeRecord), std::vector<std::byte>(100'000 * sizeof(NodeRecord)));
    EXPECT_GT(nodes.entry.size, 1000 * nodes.stored.size());
    const AlignedBytes bytes = assemble(ContainerKind::part, std::vector{nodes});
    const auto view = PackView::read(ContainerReader::fromBytes(bytes.span(), "nodes.part").value());
    ASSERT_TRUE(view.ok()) << formatMessage(view.error());
    EXPECT_EQ(view->nodes().size(), 100'000u);
}

TEST(TableSizes, boundTheSumOfAllCompressedTables)
{
    const ChunkEntry nodes = compressedEntry(kChunkNodes, 900 << 20, 30'000);
    const Status status = check({compressedEntry(kChunkMaterials, 300 << 20, 10'000), nodes});
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(formatMessage(status.error()),
              "a.part|chunk NODE 0: error: the tables decode to 1258291200 bytes from 40000 in the file, at "
              "most 1073741824 and 256 for each of these are possible [E2012] hint: cook the asset again");
    // tables that are stored as they are, texels and meshes are not decoded with the tables
    ChunkEntry plain = compressedEntry(kChunkMaterials, 3 * kGibibyte, 3 * kGibibyte);
    plain.codec = static_cast<uint32_t>(Codec::none);
    EXPECT_TRUE(check({nodes, plain, compressedEntry(kChunkImageData, 3 * kGibibyte, 10),
                       compressedEntry(kChunkSourceMesh, 3 * kGibibyte, 10),
                       compressedEntry(fourCC("NEW!"), 3 * kGibibyte, 10)})
                    .ok());
}

TEST(TableSizes, growWithTheBytesInTheFile)
{
    const uint64_t needed = 2 * kGibibyte / kMaxBytesPerStoredByte;
    EXPECT_TRUE(check({compressedEntry(kChunkClusters, 3 * kGibibyte, needed)}).ok());
    EXPECT_FALSE(check({compressedEntry(kChunkClusters, 3 * kGibibyte, needed - 1)}).ok());
}

TEST(TableSizes, boundEachTable)
{
    EXPECT_TRUE(check({compressedEntry(kChunkClusters, 4 * kGibibyte, kGibibyte)}).ok());
    for (const Codec codec : {Codec::none, Codec::zstd})
    {
        ChunkEntry entry = compressedEntry(kChunkClusters, 4 * kGibibyte + 48, 4 * kGibibyte + 48);
        entry.codec = static_cast<uint32_t>(codec);
        const Status status = check({entry});
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(status.error().detail, "a table of 4294967344 bytes, at most 4294967296 are possible");
    }
}

TEST(TableSizes, refuseABombOfManyGibibytes)
{
    // each of these frames is sound, and decodes to what it claims
    constexpr uint64_t kRuns = 3 * 64 * 128; // 3 GiB, a multiple of all sizes of records
    const auto bomb = [](uint32_t type, uint32_t element_size)
    { return chunkOfZeros(type, element_size, kRuns * kRunBytes, kRuns); };
    const Error error =
        refusePart({bomb(kChunkStrings, 1), bomb(kChunkKeys, 4), bomb(kChunkBrickOpacity, 1)});
    EXPECT_EQ(error.issue, Issue::chunk_size);
    EXPECT_THAT(error.detail, testing::HasSubstr("9663676416 bytes"));
}

TEST(TableSizes, costOnlyWhatAFrameHolds)
{
    const Error error = refusePart({chunkOfZeros(kChunkStrings, 1, kGibibyte, 1)});
    EXPECT_EQ(error.issue, Issue::chunk_codec);
}

TEST(TableSizes, areCheckedByTheWriter)
{
    const TemporaryFolder folder;
    auto writer = ContainerWriter::create(folder.file("a.part"), ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    const ChunkImage bomb = chunkOfZeros(kChunkNodes, sizeof(NodeRecord), 3 * 5 * kGibibyte / 8, 1);
    ChunkEntry entry = bomb.entry;
    entry.stored_size = bomb.stored.size();
    entry.hash = hashBytes(bomb.stored);
    ASSERT_TRUE(writer->addStored({.type = kChunkNodes}, entry, bomb.stored).ok());
    const Status status = writer->finish();
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::input_too_large);
    EXPECT_EQ(status.error().where, "chunk NODE 0");
    EXPECT_FALSE(folder.files().contains("a.part"));
}

} // namespace hearth::test
