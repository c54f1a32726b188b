// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "runtime/pack/pack.h"
#include "tests/support/limits/peak_memory.h"
#include "tests/support/small_pack.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

namespace hearth::test
{

using namespace formats;

namespace
{

std::vector<std::byte> readBytes(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    const auto bytes = std::as_bytes(std::span(content));
    return {bytes.begin(), bytes.end()};
}

/// Write chunks like a cooker.
Status writeChunks(const std::string& path, std::span<const ChunkImage> chunks, Codec codec)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::pack));
    for (const ChunkImage& chunk : chunks)
    {
        const ChunkId id{chunk.entry.type, chunk.entry.index, chunk.entry.version};
        HEARTH_TRY(writer.addChunk(id, chunk.stored, chunk.entry.element_size, codec));
    }
    return writer.finish();
}

template <typename T>
T readAt(const AlignedBytes& bytes, size_t offset)
{
    T value;
    std::memcpy(&value, bytes.span().data() + offset, sizeof(T));
    return value;
}

/// Change the header and update its hash.
AlignedBytes withHeader(AlignedBytes bytes, void (*change)(FileHeader&))
{
    auto header = readAt<FileHeader>(bytes, 0);
    change(header);
    header.header_hash =
        hashBytes(std::as_bytes(std::span(&header, 1)).first(offsetof(FileHeader, header_hash)));
    std::memcpy(bytes.span().data(), &header, sizeof(header));
    return bytes;
}

/// Change entry `index` of the chunk table and update the hashes of table and header.
AlignedBytes withEntry(AlignedBytes bytes, size_t index, void (*change)(ChunkEntry&))
{
    auto header = readAt<FileHeader>(bytes, 0);
    const size_t at = header.table_offset + index * sizeof(ChunkEntry);
    auto entry = readAt<ChunkEntry>(bytes, at);
    change(entry);
    std::memcpy(bytes.span().data() + at, &entry, sizeof(entry));
    header.table_hash = hashBytes(bytes.span().subspan(header.table_offset));
    std::memcpy(bytes.span().data(), &header, sizeof(header));
    return withHeader(std::move(bytes), [](FileHeader&) {});
}

Issue refusal(const AlignedBytes& bytes)
{
    const auto pack = pack::Pack::fromBytes(bytes.span(), "small.hearth");
    if (!pack.ok())
        return pack.error().issue;
    const Status status = pack->checkAll();
    return status.ok() ? Issue::usage : status.error().issue;
}

/// Expect that each page and texel read is the model's, or an error.
void expectNothingElseIsHandedOut(const pack::Pack& pack, const PackModel& model)
{
    std::vector<std::byte> buffer(kMaxPageBytes);
    for (uint32_t i = 0; i < model.decoded_pages.size(); ++i)
        if (const auto page = pack.readPage(i, buffer); page.ok())
        {
            ASSERT_TRUE(std::ranges::equal(*page, model.decoded_pages[i])) << "page " << i;
        }
    for (uint32_t i = 0; i < model.image_data.size(); ++i)
        if (const auto texels = pack->imageData(i); texels.ok())
        {
            ASSERT_TRUE(std::ranges::equal(texels->bytes(), model.image_data[i])) << "image " << i;
        }
}

} // namespace

TEST(ContainerWriter, writesTheBytesThatTheSpecificationAsksFor)
{
    const TemporaryFolder folder;
    const std::vector<ChunkImage> chunks = smallPack().chunks();
    const Status written = writeChunks(folder.file("a.hearth"), chunks, Codec::none);
    ASSERT_TRUE(written.ok()) << formatMessage(written.error());
    const AlignedBytes expected = assemble(ContainerKind::pack, chunks);
    EXPECT_TRUE(std::ranges::equal(readBytes(folder.file("a.hearth")), expected.span()));
}

TEST(ContainerWriter, writesTheSameBytesTwice)
{
    const TemporaryFolder folder;
    const std::vector<ChunkImage> chunks = smallPack().chunks();
    ASSERT_TRUE(writeChunks(folder.file("a"), chunks, Codec::zstd).ok());
    ASSERT_TRUE(writeChunks(folder.file("b"), chunks, Codec::zstd).ok());
    EXPECT_EQ(readBytes(folder.file("a")), readBytes(folder.file("b")));
}

TEST(ContainerWriter, roundTripsRecordsTextAndStreamedChunks)
{
    const TemporaryFolder folder;
    const std::vector<uint64_t> numbers(1000, 42);
    auto writer = ContainerWriter::create(folder.file("a.part"), ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(writer->addRecords(fourCC("NUMB"), std::span(numbers), Codec::zstd, 7).ok());
    ASSERT_TRUE(writer->addText(fourCC("TEXT"), "Herd", Codec::zstd).ok());
    ASSERT_TRUE(writer->beginChunk({.type = fourCC("LONG")}, 2).ok());
    for (int i = 0; i < 100; ++i)
        ASSERT_TRUE(writer->append(std::as_bytes(std::span(numbers))).ok());
    EXPECT_EQ(writer->chunkSize(), 100 * numbers.size() * sizeof(uint64_t));
    ASSERT_TRUE(writer->endChunk().ok());
    ASSERT_TRUE(writer->finish().ok());

    const auto reader = ContainerReader::open(folder.file("a.part"));
    ASSERT_TRUE(reader.ok()) << formatMessage(reader.error());
    EXPECT_EQ(reader->kind(), ContainerKind::part);
    EXPECT_EQ(reader->chunks().size(), 3u);
    EXPECT_EQ(reader->find(fourCC("NUMB"), 7)->codec, static_cast<uint32_t>(Codec::zstd));
    EXPECT_EQ(reader->find(fourCC("TEXT"))->codec, static_cast<uint32_t>(Codec::none))
        << "zstd would make it larger";
    const auto read = reader->records<uint64_t>(fourCC("NUMB"), 7);
    ASSERT_TRUE(read.ok());
    EXPECT_TRUE(std::ranges::equal(*read, numbers));
    EXPECT_EQ(reader->read(fourCC("TEXT"))->bytes().size(), 4u);
    EXPECT_EQ(reader->read(fourCC("LONG"))->bytes().size(), 800000u);
    EXPECT_EQ(reader->read(fourCC("NONE"))->bytes().size(), 0u);
    EXPECT_EQ(reader->records<uint32_t>(fourCC("NUMB"), 7).error().issue, Issue::chunk_size);
}

TEST(ContainerWriter, leavesNothingWithoutFinish)
{
    const TemporaryFolder folder;
    {
        auto writer = ContainerWriter::create(folder.file("a.part"), ContainerKind::part);
        ASSERT_TRUE(writer.ok());
        ASSERT_TRUE(writer->addText(kChunkMeta, "{}").ok());
        EXPECT_EQ(folder.files().size(), 1u) << "the temporary file";
        EXPECT_FALSE(folder.files().contains("a.part"));
    }
    EXPECT_TRUE(folder.files().empty());
}

TEST(ContainerWriter, keepsTheOldFileUntilFinish)
{
    const TemporaryFolder folder;
    std::ofstream(folder.file("a.part")) << "old";
    {
        auto writer = ContainerWriter::create(folder.file("a.part"), ContainerKind::part);
        ASSERT_TRUE(writer->addText(kChunkMeta, "{}").ok());
    }
    EXPECT_EQ(readBytes(folder.file("a.part")).size(), 3u);
    auto writer = ContainerWriter::create(folder.file("a.part"), ContainerKind::part);
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_EQ(folder.files(), std::set<std::string>{"a.part"});
    EXPECT_TRUE(ContainerReader::open(folder.file("a.part")).ok());
}

TEST(ContainerWriter, namesAPathThatCannotBeWritten)
{
    const TemporaryFolder folder;
    const auto writer = ContainerWriter::create(folder.file("no/such/folder.part"), ContainerKind::part);
    ASSERT_FALSE(writer.ok());
    EXPECT_EQ(writer.error().issue, Issue::cannot_write);
    EXPECT_EQ(exitCode(writer.error()), 73);
    EXPECT_EQ(writer.error().file, folder.file("no/such/folder.part"));
}

TEST(ContainerReader, namesAFileThatIsMissing)
{
    const TemporaryFolder folder;
    const auto reader = ContainerReader::open(folder.file("none.hearth"));
    ASSERT_FALSE(reader.ok());
    EXPECT_EQ(reader.error().issue, Issue::input_missing);
    EXPECT_EQ(exitCode(reader.error()), 66);
    EXPECT_EQ(ContainerReader::open(folder.file("")).error().issue, Issue::input_missing)
        << "a folder is no file";
}

TEST(ContainerReader, allocatesNothingForAClaimThatItsFrameCannotHold)
{
    constexpr uint64_t kClaim = uint64_t{1} << 30;
    ChunkImage chunk = zstdChunk(fourCC("TEXT"), 0, 1, {});
    chunk.entry.size = kClaim;
    // a frame with a content size of 8 bytes, and one run of one byte
    chunk.stored = {std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD}, std::byte{0xE0}};
    const auto claim = std::as_bytes(std::span(&kClaim, 1));
    chunk.stored.insert(chunk.stored.end(), claim.begin(), claim.end());
    chunk.stored.insert(chunk.stored.end(), {std::byte{0x0B}, std::byte{0}, std::byte{0}, std::byte{0}});
    const AlignedBytes bytes = assemble(ContainerKind::part, std::span(&chunk, 1));
    const auto reader = ContainerReader::fromBytes(bytes.span(), "small.part");
    ASSERT_TRUE(reader.ok()) << formatMessage(reader.error());
    const std::optional<int> peak_mib = measurePeak_mib(
        [&]
        {
            const auto content = reader->read(fourCC("TEXT"), 0);
            return !content.ok() && content.error().issue == Issue::chunk_codec;
        });
    ASSERT_TRUE(peak_mib.has_value());
    EXPECT_LE(*peak_mib, 8);
}

TEST(Pack, opensAFile)
{
    const TemporaryFolder folder;
    const PackModel model = smallPack();
    const std::vector<ChunkImage> chunks = model.chunks();
    ASSERT_TRUE(writeChunks(folder.file("a.hearth"), chunks, Codec::zstd).ok());
    // every writer of packs stores chunk PAGE uncompressed
    EXPECT_EQ(pack::Pack::open(folder.file("a.hearth")).error().issue, Issue::chunk_codec);
    ASSERT_TRUE(writeChunks(folder.file("a.hearth"), chunks, Codec::none).ok());
    const auto pack = pack::Pack::open(folder.file("a.hearth"));
    ASSERT_TRUE(pack.ok()) << formatMessage(pack.error());
    EXPECT_EQ((*pack)->text(pack->view().meshes()[0].name), "strip");
}

TEST(Pack, refusesTruncationAtEveryLength)
{
    const AlignedBytes bytes = smallPack().bytes();
    for (size_t length = 0; length < bytes.size(); ++length)
    {
        // a buffer of exactly its size, so that the address sanitizer detects a read past its end
        const AlignedBytes cut(bytes.span().first(length));
        ASSERT_FALSE(pack::Pack::fromBytes(cut.span(), "cut").ok()) << length << " bytes of " << bytes.size();
    }
}

TEST(ContainerReader, refusesEveryFlippedByte)
{
    for (const bool compressed : {false, true})
    {
        AlignedBytes bytes = smallPack().bytes(compressed);
        for (size_t at = 0; at < bytes.size(); ++at)
            for (const int mask : {0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x40, 0x80, 0xFF})
            {
                bytes.span()[at] ^= static_cast<std::byte>(mask);
                ASSERT_FALSE(ContainerReader::fromBytes(bytes.span(), "flip").ok())
                    << "byte " << at << " ^ " << mask;
                bytes.span()[at] ^= static_cast<std::byte>(mask);
            }
        EXPECT_TRUE(ContainerReader::fromBytes(bytes.span(), "as it was").ok());
    }
}

TEST(Pack, handsOutNothingOfAFlippedByteAndFindsIt)
{
    const PackModel model = smallPack();
    for (const bool compressed : {false, true})
    {
        AlignedBytes bytes = model.bytes(compressed);
        for (size_t at = 0; at < bytes.size(); ++at)
        {
            const auto mask = static_cast<std::byte>(1 << at % 8);
            bytes.span()[at] ^= mask;
            if (const auto pack = pack::Pack::fromBytes(bytes.span(), "flip"); pack.ok())
            {
                ASSERT_FALSE(pack->checkAll().ok()) << "byte " << at;
                expectNothingElseIsHandedOut(*pack, model);
                ASSERT_FALSE(HasFatalFailure()) << "byte " << at;
            }
            bytes.span()[at] ^= mask;
        }
        EXPECT_TRUE(pack::Pack::fromBytes(bytes.span(), "as it was").ok());
    }
}

TEST(Pack, refusesBytesBehindItsEnd)
{
    const AlignedBytes bytes = smallPack().bytes();
    std::vector<std::byte> longer(bytes.span().begin(), bytes.span().end());
    longer.push_back(std::byte{0});
    EXPECT_EQ(refusal(AlignedBytes(longer)), Issue::container_size);
}

TEST(Pack, skipsUnknownChunks)
{
    std::vector<ChunkImage> chunks = smallPack().chunks();
    ChunkImage unknown = plainChunk(fourCC("NEW!"), 3, 5, std::vector<std::byte>(50));
    unknown.entry.version = 9;
    chunks.insert(chunks.begin() + 4, unknown);
    const AlignedBytes bytes = assemble(ContainerKind::pack, chunks);
    EXPECT_TRUE(pack::Pack::fromBytes(bytes.span(), "newer").ok());
}

TEST(Pack, readsANewerMinorVersion)
{
    const AlignedBytes bytes = withHeader(smallPack().bytes(), [](FileHeader& h) { ++h.version_minor; });
    EXPECT_TRUE(pack::Pack::fromBytes(bytes.span(), "newer").ok());
}

struct MalformedContainer
{
    const char* name;
    Issue issue;
    AlignedBytes (*make)();
};

const std::vector<MalformedContainer>& malformedContainers()
{
    static const std::vector<MalformedContainer> cases = {
        {"short", Issue::container_truncated,
         [] { return AlignedBytes(smallPack().bytes().span().first(127)); }},
        {"empty", Issue::container_truncated, [] { return AlignedBytes(); }},
        {"magic", Issue::container_magic,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.magic[10] = '\n'; }); }},
        {"newerMajor", Issue::container_version,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { ++h.version_major; }); }},
        {"olderMajor", Issue::container_version,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { --h.version_major; }); }},
        {"bigEndian", Issue::container_endian,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.endian_mark = 0x04030201; }); }},
        {"fileSize", Issue::container_size,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { ++h.file_size; }); }},
        {"headerSize", Issue::container_header,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.header_size = 64; }); }},
        {"headerReserved", Issue::container_header,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.reserved[11] = 1; }); }},
        {"feature", Issue::container_feature,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.required_features = 1; }); }},
        {"tableOffsetHuge", Issue::container_table,
         []
         { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.table_offset = ~uint64_t{63}; }); }},
        {"tableCountHuge", Issue::container_table,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.chunk_count = 0xFFFFFFFF; }); }},
        {"chunkOverlaps", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.offset -= 64; }); }},
        {"chunkLeavesFile", Issue::container_table,
         []
         { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.stored_size = ~uint64_t{0}; }); }},
        {"chunkElementZero", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.element_size = 0; }); }},
        {"chunkElementUneven", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.element_size = 60; }); }},
        {"chunkCodec", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.codec = 3; }); }},
        {"chunkSizeOfStored", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.size += e.element_size; }); }},
        {"chunkReserved", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.reserved[2] = 1; }); }},
        {"chunkTwice", Issue::container_table,
         [] { return withEntry(smallPack().bytes(), 1, [](ChunkEntry& e) { e.type = kChunkMeta; }); }},
        {"chunkBomb", Issue::container_table,
         []
         {
             return withEntry(smallPack().bytes(true), 3,
                              [](ChunkEntry& e) { e.size = e.element_size * (uint64_t{1} << 40); });
         }},
        {"padding", Issue::container_padding,
         []
         {
             AlignedBytes bytes = smallPack().bytes();
             const auto entry = readAt<ChunkEntry>(bytes, readAt<FileHeader>(bytes, 0).table_offset);
             bytes.span()[entry.offset + entry.size] = std::byte{1};
             return bytes;
         }},
        {"hash", Issue::chunk_hash,
         [] { return withEntry(smallPack().bytes(), 5, [](ChunkEntry& e) { ++e.hash; }); }},
        {"frameOfOtherSize", Issue::chunk_codec,
         []
         { return withEntry(smallPack().bytes(true), 3, [](ChunkEntry& e) { e.size += e.element_size; }); }},
        {"texelsOfOtherSize", Issue::chunk_codec,
         []
         {
             std::vector<ChunkImage> chunks = smallPack().chunks(true);
             const std::vector<std::byte> texels(31);
             chunks.back() = zstdChunk(kChunkImageData, 1, 1, texels);
             chunks.back().entry.size = 32;
             return assemble(ContainerKind::pack, chunks);
         }},
        {"texelsOfUnnamedSize", Issue::chunk_codec,
         []
         {
             std::vector<ChunkImage> chunks = smallPack().chunks(true);
             // a zstd frame without content size, with a window of 1 KiB and one raw block of 32 bytes
             std::vector<std::byte>& frame = chunks.back().stored;
             frame.clear();
             for (const int byte : {0x28, 0xB5, 0x2F, 0xFD, 0, 0, 0x01, 0x01, 0})
                 frame.push_back(static_cast<std::byte>(byte));
             frame.resize(frame.size() + 32);
             HEARTH_ASSERT(chunks.back().entry.size == 32);
             return assemble(ContainerKind::pack, chunks);
         }},
        {"texelsCutOff", Issue::chunk_codec,
         []
         {
             std::vector<ChunkImage> chunks = smallPack().chunks(true);
             chunks.back().stored.pop_back();
             return assemble(ContainerKind::pack, chunks);
         }},
        {"bytesBehindFrame", Issue::chunk_codec,
         []
         {
             std::vector<ChunkImage> chunks = smallPack().chunks(true);
             chunks[2].stored.push_back(std::byte{0});
             return assemble(ContainerKind::pack, chunks);
         }},
        {"recordSize", Issue::chunk_size,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { e.element_size = 32; }); }},
        {"tableBomb", Issue::chunk_size,
         []
         {
             std::vector<ChunkImage> chunks = smallPack().chunks(true);
             chunks[2].entry.size = 10'000'000 * sizeof(NodeRecord);
             return assemble(ContainerKind::pack, chunks);
         }},
        {"chunkVersion", Issue::chunk_version,
         [] { return withEntry(smallPack().bytes(), 3, [](ChunkEntry& e) { ++e.version; }); }},
        {"kind", Issue::container_kind,
         [] { return withHeader(smallPack().bytes(), [](FileHeader& h) { h.kind = fourCC("JUNK"); }); }},
    };
    return cases;
}

TEST(MalformedContainers, areEachRefusedAsTheirIssue)
{
    for (const MalformedContainer& container : malformedContainers())
        EXPECT_EQ(refusal(container.make()), container.issue) << container.name;
}

TEST(MalformedContainers, haveOneForEveryIssueOfContainers)
{
    // These two concern the content; their cases are among the malformed packs.
    const std::set<Issue> elsewhere = {Issue::chunk_missing, Issue::page_hash};
    for (const IssueInfo& info : allIssues())
    {
        if (static_cast<uint32_t>(info.issue) / 1000 != 2 || elsewhere.contains(info.issue))
            continue;
        EXPECT_TRUE(
            std::ranges::any_of(malformedContainers(), [&](const auto& c) { return c.issue == info.issue; }))
            << info.name;
    }
}

TEST(ContainerReader, checksAChunkWhenItIsReadIfOnlyTheStructureWasChecked)
{
    AlignedBytes bytes = smallPack().bytes();
    const auto entry = readAt<ChunkEntry>(bytes, readAt<FileHeader>(bytes, 0).table_offset);
    bytes.span()[entry.offset] ^= std::byte{1};
    EXPECT_FALSE(ContainerReader::fromBytes(bytes.span(), "a").ok());
    const auto reader = ContainerReader::fromBytes(bytes.span(), "a", Check::structure);
    ASSERT_TRUE(reader.ok());
    EXPECT_EQ(reader->read(entry.type).error().issue, Issue::chunk_hash);
    EXPECT_EQ(reader->checkDecodes(entry).error().issue, Issue::chunk_hash);
    EXPECT_TRUE(reader->read(kChunkStrings).ok());
}

} // namespace hearth::test
