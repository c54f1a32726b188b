// Runs hearth's command line as a user would: help, typing errors, results on stdout.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class CommandLine : public ::testing::Test
{
protected:
    ProgramEnd hearth(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth");
        return folder.run(arguments);
    }

    /// Check for exit code 2 and one line on stderr that contains `part`.
    void expectUsageError(const std::vector<std::string>& arguments, const std::string& part)
    {
        const ProgramEnd end = hearth(arguments);
        EXPECT_EQ(end.exit_code, 2) << part;
        EXPECT_EQ(end.out, "");
        EXPECT_EQ(countOccurrences(end.err, "\n"), 1u) << end.err;
        EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
    }

    Sandbox folder;
};

} // namespace

TEST_F(CommandLine, typosGetTheNearestMatch)
{
    expectUsageError({"cok"}, "did you mean 'cook'?");
    expectUsageError({"isnpect", "a"}, "did you mean 'inspect'?");
    expectUsageError({"cook", "a.glb", "--ouptut", "b"}, "did you mean '--output'?");
    expectUsageError({"inspect", "a", "--fromat=json"}, "did you mean '--format'?");
    expectUsageError({"paint"}, "unknown verb 'paint' [E1000]");
    expectUsageError({"farm", "slrum", "a"}, "did you mean 'slurm'?");
    expectUsageError({"farm", "slurm", "a", "--partitoin", "b"}, "did you mean '--partition'?");
}

TEST_F(CommandLine, nothingUnknownIsIgnored)
{
    expectUsageError({"cook", "a", "-o", "b", "--colour"}, "unknown option '--colour'");
    expectUsageError({"cook", "a", "-o", "b", "-x"}, "unknown option '-x'");
    expectUsageError({"--verbose", "cook"}, "unknown option '--verbose'");
    expectUsageError({"verify", "a", "b"}, "b");
}

TEST_F(CommandLine, saysWhatIsMissingOrOutOfRange)
{
    expectUsageError({}, "");
    expectUsageError({"cook", "a"}, "--output is required");
    expectUsageError({"cook", "-o", "b"}, "SOURCE is required");
    expectUsageError({"cook", "a", "-o", "b", "-j", "0"}, "--jobs");
    expectUsageError({"cook", "a", "-o", "b", "-q", "-v"}, "excludes");
    expectUsageError({"inspect", "a", "--format", "xml"}, "--format");
    expectUsageError({"extract", "a", "--mesh", "0", "--error", "-1", "-o", "b"}, "--error");
    expectUsageError({"extract", "a", "--mesh", "0", "--error", "nan", "-o", "b"}, "--error");
    expectUsageError({"extract", "a", "-o", "b"}, "--mesh");
    expectUsageError({"extract", "a", "--mesh", "0", "-o", "b"}, "--error");
    expectUsageError({"extract", "a", "--error", "0", "-o", "b"}, "--mesh");
    expectUsageError({"extract", "a", "--error", "-1", "-o", "b.glb"}, "--error");
    expectUsageError({"extract", "a", "--lods", "--mesh", "0", "--error", "0", "-o", "b.ply"}, ".glb");
    expectUsageError({"extract", "a", "--texture", "0", "-o", "b.glb"}, "a .glb holds meshes");
    expectUsageError({"extract", "a", "--mesh", "0", "--animation", "walk", "-o", "b.glb"}, "all clips");
    expectUsageError({"extract", "a", "--part", "cone", "-o", "b"}, "--part");
    expectUsageError({"extract", "a", "--part", "specular", "--mesh", "0", "--error", "0", "-o", "b"},
                     "excludes");
    expectUsageError({"explain", "E9999"}, "E9999");
    expectUsageError({"plan", "a", "-o", "b", "--shards", "0"}, "--shards");
    expectUsageError({"plan", "a", "-o", "b", "--emit", "makefile"}, "--emit");
    expectUsageError({"plan", "a", "-o", "b", "--visibility", "off", "--visibility-quality", "high"},
                     "--visibility");
    expectUsageError({"merge", "a"}, "--output is required");
    expectUsageError({"farm"}, "");
    expectUsageError({"farm", "ninja", "a"}, "--output is required");
}

TEST_F(CommandLine, helpEndsWithAnExampleAndTheExitCodes)
{
    for (const char* verb : {"", "cook", "inspect", "verify", "extract", "why", "cache", "plan", "run",
                             "merge", "farm", "explain"})
    {
        const ProgramEnd end = *verb == '\0' ? hearth({"--help"}) : hearth({std::string(verb), "-h"});
        EXPECT_EQ(end.exit_code, 0);
        EXPECT_EQ(end.err, "");
        EXPECT_NE(end.out.find("Example"), std::string::npos) << end.out;
        EXPECT_NE(end.out.find("  65  an input's content is wrong"), std::string::npos) << end.out;
    }
}

TEST_F(CommandLine, namesItsVersion)
{
    EXPECT_EQ(hearth({"version"}).out.substr(0, 7), "hearth ");
}

TEST_F(CommandLine, resultsGoToStdoutAndErrorsToStderr)
{
    writePackFile(smallPack(), folder / "a.hearth");
    EXPECT_EQ(hearth({"verify", "a.hearth"}).err, "");
    EXPECT_EQ(Json::parse(hearth({"inspect", "a.hearth", "--format", "json"}).out).value()["schema"],
              "hearth.inspect/1");
    EXPECT_NE(hearth({"inspect", "a.hearth"}).out.find("strip"), std::string::npos);
    EXPECT_EQ(hearth({"extract", "a.hearth", "--mesh", "0", "--error", "0", "-o", "a.ply"}).exit_code, 0);
    EXPECT_TRUE(folder.has("a.ply"));

    const ProgramEnd missing = hearth({"verify", "b.hearth"});
    EXPECT_EQ(missing.exit_code, 66);
    EXPECT_EQ(missing.out, "");
    EXPECT_EQ(countOccurrences(missing.err, "b.hearth: error: "), 1u);

    folder.write("c.hearth", "not a pack");
    for (const char* verb : {"verify", "inspect"})
        EXPECT_EQ(hearth({verb, "c.hearth"}).exit_code, 65);
    const ProgramEnd json = hearth({"verify", "c.hearth", "--format", "json"});
    EXPECT_EQ(json.exit_code, 65);
    EXPECT_FALSE(Json::parse(json.out).value()["ok"].get<bool>());
}

} // namespace hearth::test
