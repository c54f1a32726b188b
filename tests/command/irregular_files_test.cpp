// Gives each program a pipe, which nobody writes to, in the place of each file that it reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <cctype>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace hearth::test
{

namespace
{

/// Command line, with the program's name first and "pipe" in the place of one file or more.
using Words = std::vector<std::string>;

const std::vector<Words>& commandLines()
{
    static const std::vector<Words> lines = {
        {"hearth", "verify", "pipe"},
        {"hearth", "inspect", "pipe"},
        {"hearth", "diff", "pipe", "pipe"},
        {"hearth", "extract", "pipe", "--mesh", "0", "--error", "1", "-o", "out.ply"},
        {"hearth", "report", "pipe", "--html", "out.html"},
        {"hearth", "cook", "pipe", "-o", "out.hearth"},
        {"hearth", "cook", "a.obj", "-o", "out.hearth", "--profile", "./pipe"},
        {"hearth", "cook", "a.obj", "-o", "out.hearth", "--lod", "1=pipe"},
        {"hearth", "cook", "@pipe", "-o", "out.hearth"},
        {"hearth", "--config", "pipe", "cook", "a.obj", "-o", "out.hearth"},
        {"hearth", "plan", "a.obj", "-o", "out.plan", "--shards", "1", "--estimates", "pipe"},
        {"hearth", "run", "pipe", "--shard", "1/1"},
        {"hearth", "merge", "pipe", "-o", "out.hearth"},
        {"hearth-import", "pipe", "-o", "out.part"},
        {"hearth-import", "a.obj", "-o", "out.part", "--profile", "pipe"},
        {"hearth-import", "a.obj", "-o", "out.part", "--lod", "1=pipe"},
        {"hearth-clusters", "pipe", "-o", "out.part"},
        {"hearth-clusters", "a.obj", "-o", "out.part", "--profile", "pipe"},
        {"hearth-textures", "pipe", "-o", "out.part"},
        {"hearth-skinning", "pipe", "pipe", "-o", "out.part"},
        {"hearth-visibility", "pipe", "pipe", "-o", "out.part"},
        {"hearth-bricks", "pipe", "pipe", "pipe", "-o", "out.part"},
        {"hearth-receivers", "pipe", "pipe", "pipe", "-o", "out.part"},
        {"hearth-bricks", "--march", "rays.csv", "pipe", "-o", "out.csv"},
        {"hearth-specular", "--evaluate", "pipe", "-o", "out.csv"},
        {"hearth-link", "pipe", "pipe", "pipe", "pipe", "-o", "out.hearth"},
        {"hearth-render", "pipe", "-o", "out.png"},
        {"hearth-compare", "pipe", "--with", "pipe"},
    };
    return lines;
}

class IrregularFiles : public ::testing::TestWithParam<Words>
{
};

TEST_P(IrregularFiles, areRefusedAtOnce)
{
    Sandbox folder;
    writeObj(folder, "a");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    // KILL: cooks finish their work after other signals
    Words command{"/usr/bin/timeout", "--signal=KILL", "10"};
    command.insert(command.end(), GetParam().begin(), GetParam().end());
    command[3] = HEARTH_BIN "/" + command[3];
    const ProgramEnd end = folder.run(command);
    EXPECT_EQ(end.exit_code, 66) << end.err;
    EXPECT_EQ(countOccurrences(end.err, ": error: "), 1u) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "is not a regular file [E1001]"), 1u) << end.err;
    EXPECT_NE(end.err.find("pipe"), std::string::npos) << end.err;
}

std::string nameTest(const ::testing::TestParamInfo<Words>& info)
{
    std::string name;
    for (const std::string& word : info.param)
        for (const char letter : word + "_")
            name += std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Programs, IrregularFiles, ::testing::ValuesIn(commandLines()), nameTest);

} // namespace

} // namespace hearth::test
