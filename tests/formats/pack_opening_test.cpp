// Tests which parts of a pack are read when it is opened, and the access to the rest afterwards.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_reader.h"
#include "runtime/pack/pack.h"
#include "tests/support/small_pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <sys/mman.h>
#include <unistd.h>

namespace hearth::test
{

using namespace formats;

namespace
{

/// A pack with a page and an image that are larger than memory pages.
PackModel widePack()
{
    PackModel model = smallPack();
    model.decoded_pages[1].resize(kMaxPageBytes); // zeros at its end are legal
    model.sealPages();
    model.images[0].width = model.images[0].height = 64;
    model.images[0].mip_count = 1;
    model.image_data[0].assign(64 * 64 * 4, std::byte{9});
    return model;
}

/// Copy of bytes at the start of a memory page; access to some memory pages can be forbidden.
class GuardedBytes
{
public:
    explicit GuardedBytes(std::span<const std::byte> bytes) : size_(bytes.size())
    {
        memory_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        HEARTH_ASSERT(memory_ != MAP_FAILED);
        std::memcpy(memory_, bytes.data(), size_);
    }
    GuardedBytes(const GuardedBytes&) = delete;
    GuardedBytes& operator=(const GuardedBytes&) = delete;
    ~GuardedBytes() { ::munmap(memory_, size_); }

    std::span<const std::byte> span() const { return {static_cast<const std::byte*>(memory_), size_}; }

    /// Forbid access to whole memory pages of a part; returns how many. Touching one ends the process.
    size_t forbid(size_t offset, size_t size)
    {
        const auto page = static_cast<size_t>(::sysconf(_SC_PAGESIZE));
        const size_t first = (offset + page - 1) / page, end = (offset + size) / page;
        if (first >= end)
            return 0;
        HEARTH_ASSERT(::mprotect(static_cast<std::byte*>(memory_) + first * page, (end - first) * page,
                                 PROT_NONE) == 0);
        return end - first;
    }

private:
    void* memory_;
    size_t size_;
};

/// Message of reading a page; "" if the page equals the model's.
std::string describeReading(const pack::Pack& pack, const PackModel& model, uint32_t page)
{
    std::vector<std::byte> buffer(kMaxPageBytes);
    const auto read = pack.readPage(page, buffer);
    if (!read.ok())
        return formatMessage(read.error());
    return std::ranges::equal(*read, model.decoded_pages[page]) ? "" : "it is another page";
}

} // namespace

TEST(PackOpen, touchesNeitherPagesNorTexels)
{
    const AlignedBytes bytes = widePack().bytes();
    const auto reader = ContainerReader::fromBytes(bytes.span(), "wide");
    ASSERT_TRUE(reader.ok());
    GuardedBytes guarded(bytes.span());
    size_t pages = 0, texels = 0;
    for (const ChunkEntry& entry : reader->chunks())
        if (entry.type == kChunkPages)
            pages += guarded.forbid(entry.offset, entry.stored_size);
        else if (entry.type == kChunkImageData)
            texels += guarded.forbid(entry.offset, entry.stored_size);
    ASSERT_GE(pages, 10u);
    ASSERT_GE(texels, 2u);
    const auto pack = pack::Pack::fromBytes(guarded.span(), "wide");
    EXPECT_TRUE(pack.ok()) << formatMessage(pack.error());
}

TEST(PackOpen, leavesADamagedPageToItsReading)
{
    const PackModel model = widePack();
    AlignedBytes bytes = model.bytes();
    const auto reader = ContainerReader::fromBytes(bytes.span(), "wide");
    ASSERT_TRUE(reader.ok());
    bytes.span()[reader->find(kChunkPages)->offset + model.pages[2].offset] ^= std::byte{1};
    const auto pack = pack::Pack::fromBytes(bytes.span(), "wide");
    ASSERT_TRUE(pack.ok()) << formatMessage(pack.error());
    for (uint32_t page = 0; page < model.pages.size(); ++page)
        if (page != 2)
        {
            EXPECT_EQ(describeReading(*pack, model, page), "");
        }
    EXPECT_THAT(describeReading(*pack, model, 2), testing::StartsWith("wide|page 2: error: "));
    EXPECT_EQ(pack->view().decodePage(2).error().issue, Issue::page_hash);
    EXPECT_EQ(pack->checkAll().error().issue, Issue::chunk_hash);
}

TEST(PackOpen, leavesDamagedTexelsToTheirReading)
{
    const PackModel model = widePack();
    AlignedBytes bytes = model.bytes();
    const auto reader = ContainerReader::fromBytes(bytes.span(), "wide");
    ASSERT_TRUE(reader.ok());
    bytes.span()[reader->find(kChunkImageData, 0)->offset] ^= std::byte{1};
    const auto pack = pack::Pack::fromBytes(bytes.span(), "wide");
    ASSERT_TRUE(pack.ok()) << formatMessage(pack.error());
    EXPECT_EQ(pack->view().imageData(0).error().issue, Issue::chunk_hash);
    EXPECT_TRUE(pack->view().imageData(1).ok());
    EXPECT_EQ(pack->checkAll().error().issue, Issue::chunk_hash);
}

TEST(PackOpen, checksWhateverWayAPageIsRead)
{
    // A vertex outside of its cluster's box, in a page whose hash is right.
    PackModel model = smallPack();
    model.clusters[2].extent[0] -= 1;
    const AlignedBytes bytes = model.bytes();
    const auto pack = pack::Pack::fromBytes(bytes.span(), "small");
    ASSERT_TRUE(pack.ok()) << formatMessage(pack.error());
    const uint32_t page = model.clusters[2].page;
    const formats::PackView copy = pack->view();
    std::vector<std::byte> out(model.pages[page].size);
    EXPECT_EQ(copy.decodePage(page, out).error().issue, Issue::meaning_bounds);
    EXPECT_EQ(copy.decodePage(page).error().where, "cluster 2");
    EXPECT_EQ(copy.checkPage(page).error().issue, Issue::meaning_bounds);
    EXPECT_TRUE(copy.checkPage(0).ok());
    EXPECT_EQ((*pack)->decodePage(page).error().issue, Issue::meaning_bounds);
    // a size that is not the page's is rejected as before
    EXPECT_EQ(copy.decodePage(0, std::span(out).first(4)).error().issue, Issue::meaning_value);
    std::vector<std::byte> large(kMaxPageBytes + 1);
    EXPECT_EQ(copy.decodePage(0, large).error().issue, Issue::meaning_value);
    EXPECT_EQ(copy.decodePage(99, out).error().issue, Issue::meaning_reference);
}

} // namespace hearth::test
