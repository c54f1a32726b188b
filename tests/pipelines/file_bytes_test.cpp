// Tests the reading of imported files: small files are copied; only parts of large ones are in memory at a
// time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_reader.h"
#include "pipelines/import/source/file_bytes.h"
#include "tests/support/sandbox.h"

#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace hearth::import
{

namespace
{

constexpr size_t kLarge = (size_t{64} << 20) + 5;

/// Sparse file of zeros, which takes no disk space, with a non-zero end.
std::string largeFile(const test::Sandbox& folder)
{
    folder.write("large", "start");
    EXPECT_EQ(::truncate((folder / "large").c_str(), kLarge - 3), 0);
    std::ofstream(folder / "large", std::ios::app) << "end";
    return folder / "large";
}

uint64_t residentBytes()
{
    uint64_t size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

} // namespace

TEST(FileBytes, areThoseOfTheFile)
{
    const test::Sandbox folder;
    folder.write("small", "abc");
    const Result<FileBytes> small = FileBytes::read(folder / "small", 3);
    ASSERT_TRUE(small.ok());
    EXPECT_FALSE(small->isMapped());
    EXPECT_EQ(small->bytes().size(), 3u);
    EXPECT_EQ(small->hash(), formats::hashBytes(std::as_bytes(std::span("abc", 3))));
    EXPECT_EQ(FileBytes::read(folder / "small", 2).error().issue, Issue::input_too_large);
    EXPECT_EQ(FileBytes::read(folder / "none", 2).error().issue, Issue::input_missing);
    EXPECT_EQ(FileBytes::read(folder.path(), 2).error().issue, Issue::input_missing);

    const Result<FileBytes> large = FileBytes::read(largeFile(folder), kLarge);
    ASSERT_TRUE(large.ok());
    EXPECT_TRUE(large->isMapped());
    ASSERT_EQ(large->bytes().size(), kLarge);
    EXPECT_EQ(large->bytes()[0], std::byte{'s'});
    EXPECT_EQ(large->bytes()[kLarge - 1], std::byte{'d'});
    EXPECT_EQ(large->hash(), formats::hashBytes(large->bytes()));
}

TEST(FileBytes, leaveTheMemory)
{
    const test::Sandbox folder;
    FileBytes file = FileBytes::read(largeFile(folder), kLarge).value();
    const uint64_t before = residentBytes();
    formats::hashBytes(file.bytes());
    EXPECT_GT(residentBytes(), before + kLarge / 2);
    file.releasePages();
    EXPECT_LT(residentBytes(), before + kLarge / 4);
    file.hash();
    EXPECT_LT(residentBytes(), before + kLarge / 2) << "a piece is left";
    EXPECT_EQ(file.bytes()[kLarge - 1], std::byte{'d'});
    const FileBytes moved = std::move(file);
    EXPECT_EQ(moved.bytes()[kLarge - 1], std::byte{'d'});
}

TEST(FileBytes, sayWhenTheFileChanged)
{
    const test::Sandbox folder;
    const std::string path = largeFile(folder);
    const FileBytes file = FileBytes::read(path, kLarge).value();
    EXPECT_TRUE(file.checkUnchanged().ok());
    std::ofstream(path, std::ios::app) << "more";
    const Status changed = file.checkUnchanged();
    ASSERT_FALSE(changed.ok());
    EXPECT_EQ(changed.error().issue, Issue::read_failed);
    EXPECT_EQ(changed.error().file, path);
}

} // namespace hearth::import
