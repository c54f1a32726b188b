// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/unused_files.h"

#include "tests/support/sandbox.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::command
{

TEST(LeftOutText, namesWhatNobodyHasReadByKind)
{
    EXPECT_EQ(
        unusedFilesText({"a/sky.HDR", "a/notes.txt", "a/old.bin", "a/oak.glb"}, {"./a/oak.glb"}),
        "left out  1 texture that no source uses (a/sky.HDR), 1 file that no source uses (a/old.bin), 1 file "
        "of a kind that is not read (a/notes.txt)");
    EXPECT_EQ(unusedFilesText({"1.png", "2.png", "3.png", "4.png", "5.png"}, {}),
              "left out  5 textures that no source uses (1.png, 2.png, 3.png and 2 more)");
    EXPECT_EQ(unusedFilesText({"hearth.toml", "old.hearth", "oak.glb"}, {"oak.glb"}), "");
}

TEST(LeftOutText, knowsAFileByAnyPath)
{
    const test::Sandbox folder;
    std::filesystem::create_directories(folder / "art/textures");
    std::filesystem::create_directory_symlink("art", folder / "link");
    folder.write("art/textures/wood.png", "");
    EXPECT_EQ(unusedFilesText({folder / "art/textures/wood.png"}, {folder / "link/textures/wood.png"}), "");
    EXPECT_EQ(
        unusedFilesText({folder / "art/textures/wood.png"}, {folder / "art/./textures/../textures/wood.png"}),
        "");
}

} // namespace hearth::command
