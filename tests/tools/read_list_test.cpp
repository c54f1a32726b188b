// Tests SHA-256 against published values, and the list of read files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/dependency_list.h"
#include "cook/tools/sha256.h"
#include "formats/base/atomic_file.h"
#include "formats/base/temp_directory.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::tools
{

namespace
{

// Examples of FIPS 180-4.
constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* kOfAMillionA = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TempDirectory temporaryFolder()
{
    return TempDirectory::create(std::filesystem::temp_directory_path().string(), "test").value();
}

} // namespace

TEST(Sha256, hasThePublishedValues)
{
    EXPECT_EQ(computeSha256("abc"), kOfAbc);
    EXPECT_EQ(computeSha256(""), kOfNothing);
    EXPECT_EQ(computeSha256(std::string(1000000, 'a')), kOfAMillionA);
    EXPECT_TRUE(isSha256(kOfAbc));
    EXPECT_FALSE(isSha256(std::string(63, 'a')));
    EXPECT_FALSE(isSha256(std::string(64, 'A')));
}

TEST(Sha256, readsFilesPieceByPiece)
{
    const TempDirectory folder = temporaryFolder();
    const std::string path = folder.path() + "/a";
    ASSERT_TRUE(writeText(path, std::string(1000000, 'a')).ok());
    EXPECT_EQ(computeFileSha256(path), kOfAMillionA);
    ASSERT_TRUE(writeText(path, "").ok());
    EXPECT_EQ(computeFileSha256(path), kOfNothing);
    EXPECT_EQ(computeFileSha256(folder.path()), std::nullopt);
    EXPECT_EQ(computeFileSha256(folder.path() + "/b"), std::nullopt);
}

TEST(DependencyList, comesBackFromItsText)
{
    DependencyList list;
    const std::string bytes = "abc";
    list.add("/a/b c.png", std::as_bytes(std::span(bytes)));
    list.addAbsent("/a/missing.png");
    list.addAbsent("/a/line\nbreak\\");
    const std::string text = list.text();
    EXPECT_NE(text.find(std::string(kOfAbc) + "  /a/b c.png\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n\\----"), std::string::npos) << text;
    const auto again = DependencyList::parse(text);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->files(), list.files());
    EXPECT_EQ(again->files().size(), 3u);
}

TEST(DependencyList, aFileThatChangedBetweenTwoReadsHasNoHash)
{
    DependencyList list;
    const std::string bytes = "abc";
    list.add("/a", std::as_bytes(std::span(bytes)));
    list.add("/a", std::as_bytes(std::span(bytes)));
    EXPECT_EQ(list.files().at("/a"), kOfAbc);
    list.add("/a", std::as_bytes(std::span(bytes).first(2)));
    EXPECT_EQ(list.files().at("/a"), std::nullopt);
}

TEST(DependencyList, refusesWhatIsNone)
{
    const std::string line = std::string(kOfAbc) + "  a\n";
    ASSERT_TRUE(DependencyList::parse(line).has_value());
    for (size_t size = 1; size < line.size(); ++size)
        EXPECT_FALSE(DependencyList::parse(line.substr(0, size)).has_value()) << size;
    EXPECT_FALSE(DependencyList::parse("g" + line.substr(1)).has_value());
    EXPECT_TRUE(DependencyList::parse("").has_value());
}

TEST(TempDirectory, removesWhatKilledProcessesHaveLeft)
{
    const TempDirectory parent = temporaryFolder();
    const TempDirectory alive = TempDirectory::create(parent.path(), "test").value();
    // a killed process leaves its lock file, unlocked; a process that has just started has none yet
    for (const char* name : {"/.hearth-killed", "/.hearth-begins", "/other"})
        ASSERT_TRUE(std::filesystem::create_directory(parent.path() + name));
    for (const char* name : {"/.hearth-killed/lock", "/.hearth-killed/half", "/other/lock"})
        ASSERT_TRUE(writeText(parent.path() + name, "x").ok());
    const TempDirectory next = TempDirectory::create(parent.path(), "test").value();
    EXPECT_FALSE(std::filesystem::exists(parent.path() + "/.hearth-killed"));
    EXPECT_TRUE(std::filesystem::exists(parent.path() + "/.hearth-begins"));
    EXPECT_TRUE(std::filesystem::exists(parent.path() + "/other"));
    EXPECT_TRUE(std::filesystem::exists(alive.path()));
    EXPECT_TRUE(std::filesystem::exists(next.path()));
}

} // namespace hearth::tools
