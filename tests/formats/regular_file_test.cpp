// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/regular_file.h"

#include "formats/container/container_reader.h"
#include "runtime/pack/pack.h"
#include "tests/support/limits/time_limit.h"
#include "tests/support/sandbox.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

namespace hearth::test
{

namespace
{

constexpr unsigned kLimit_s = 20;

/// Folder with one of each kind of thing that is not a regular file.
class RegularFiles : public ::testing::Test
{
protected:
    RegularFiles()
    {
        EXPECT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
        std::filesystem::create_symlink("pipe", folder_ / "link");
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        (folder_ / "socket").copy(address.sun_path, sizeof(address.sun_path) - 1);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    }
    ~RegularFiles() override { ::close(socket_); }

    std::vector<std::string> irregularPaths() const
    {
        return {folder_ / "pipe", folder_ / "link", folder_ / "socket", folder_.path(), "/dev/zero"};
    }

    const Sandbox folder_;
    const TimeLimit limit_{kLimit_s};
    const int socket_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
};

TEST_F(RegularFiles, areReadWhole)
{
    folder_.write("text", std::string("a\0b", 3));
    std::filesystem::create_symlink("text", folder_ / "link to text");
    for (const char* name : {"text", "link to text"})
    {
        const Result<std::string> text = readFile(folder_ / name, 3);
        ASSERT_TRUE(text.ok()) << formatMessage(text.error());
        EXPECT_EQ(*text, std::string("a\0b", 3));
        EXPECT_EQ(readFile(folder_ / name, 2).error().issue, Issue::input_too_large);
    }
    folder_.write("empty", "");
    EXPECT_EQ(*readFile(folder_ / "empty"), "");
}

TEST_F(RegularFiles, areOpenedWithTheirSize)
{
    folder_.write("text", "1234");
    Result<RegularFile> file = openRegular(folder_ / "text");
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->size(), 4u);
    std::array<std::byte, 3> piece{};
    EXPECT_EQ(file->read(piece), 3);
    EXPECT_EQ(file->read(piece), 1) << "at the end there is less";
    EXPECT_EQ(file->read(piece), 0);
}

TEST_F(RegularFiles, areNotPipesOrSocketsOrDevicesOrFolders)
{
    for (const std::string& path : irregularPaths())
    {
        const Result<std::string> text = readFile(path);
        ASSERT_FALSE(text.ok()) << path;
        EXPECT_EQ(text.error().issue, Issue::input_missing);
        EXPECT_EQ(text.error().file, path);
        EXPECT_EQ(text.error().detail, "is not a regular file") << path;
    }
    EXPECT_EQ(RegularFile(folder_ / "none").openError(), ENOENT);
    EXPECT_EQ(readFile(folder_ / "none").error().detail, "cannot open: No such file or directory");
}

TEST_F(RegularFiles, areTheOnlyContainers)
{
    for (const std::string& path : irregularPaths())
    {
        const auto reader = formats::ContainerReader::open(path);
        ASSERT_FALSE(reader.ok()) << path;
        EXPECT_EQ(reader.error().issue, Issue::input_missing) << path;
        const auto pack = pack::Pack::open(path);
        ASSERT_FALSE(pack.ok()) << path;
        EXPECT_EQ(pack.error().issue, Issue::input_missing) << path;
    }
}

} // namespace

} // namespace hearth::test
