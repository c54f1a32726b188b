// Tests that cooking is deterministic: the same source gives the same bytes, for any number of threads and
// repetitions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/cooked_sample.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace hearth::roundtrip
{
namespace
{

std::string readBytes(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void expectSuccess(Program program, const std::vector<std::string>& arguments)
{
    const ProgramEnd end = runProgram(program, arguments);
    EXPECT_EQ(end.exit_code, 0) << end.errors;
}

TEST(Samples, areTheSameBytesEveryTime)
{
    const ScratchFolder folder;
    for (const char* kind : {"rock", "terrain", "grass", "room", "attic", "gallery", "outdoor", "spheres",
                             "character", "transforms"})
    {
        for (const char* file : {"first.glb", "second.glb"})
            expectSuccess(Program::samples, {kind, "--texture-size", "64", "-o", folder.path(file)});
        EXPECT_EQ(readBytes(folder.path("first.glb")), readBytes(folder.path("second.glb"))) << kind;
        EXPECT_GT(readBytes(folder.path("first.glb")).size(), 10000u);
    }
}

TEST(Samples, haveTheTrianglesThatWereAskedFor)
{
    const ScratchFolder folder;
    for (const uint64_t wanted : {uint64_t{1000}, uint64_t{100000}})
    {
        const CookedSample sample({"rock", wanted});
        const uint32_t triangles = sample.pack().meshes()[0].source_triangles;
        EXPECT_NEAR(triangles, static_cast<double>(wanted), 0.1 * static_cast<double>(wanted));
    }
}

TEST(Samples, sayWhatIsWrongWithTheCommandLine)
{
    const ScratchFolder folder;
    EXPECT_EQ(runProgram(Program::samples, {"--list"}).exit_code, 0);
    const ProgramEnd unknown = runProgram(Program::samples, {"pebble", "-o", folder.path("x.glb")});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.errors.find("rock"), std::string::npos) << "names what there is: " << unknown.errors;
    EXPECT_EQ(runProgram(Program::samples, {"room"}).exit_code, 2);
    EXPECT_EQ(runProgram(Program::samples, {"room", "-o", folder.path("no/such/folder.glb")}).exit_code, 73);
}

TEST(Cook, givesTheSameBytesForAnyNumberOfThreads)
{
    const ScratchFolder folder;
    for (const char* kind : {"rock", "character"})
    {
        const std::string source = folder.path("sample.glb"), part = folder.path("import.part");
        expectSuccess(Program::samples, {kind, "--texture-size", "64", "-o", source});
        expectSuccess(Program::import, {source, "-o", part});
        for (const char* jobs : {"1", "2", "7"})
            expectSuccess(Program::clusters,
                          {part, "--jobs", jobs, "-o", folder.path(std::string("clusters") + jobs)});
        const std::string one = readBytes(folder.path("clusters1"));
        EXPECT_GT(one.size(), 100000u);
        EXPECT_TRUE(one == readBytes(folder.path("clusters2"))) << kind;
        EXPECT_TRUE(one == readBytes(folder.path("clusters7"))) << kind;
    }
}

TEST(Cook, givesTheSamePackTwice)
{
    const ScratchFolder folder;
    const std::string source = folder.path("room.glb");
    expectSuccess(Program::samples, {"room", "-o", source});
    for (const char* file : {"first.hearth", "second.hearth"})
    {
        expectSuccess(Program::hearth, {"cook", source, "-o", folder.path(file)});
        expectSuccess(Program::hearth, {"verify", folder.path(file)});
    }
    EXPECT_TRUE(readBytes(folder.path("first.hearth")) == readBytes(folder.path("second.hearth")));
    EXPECT_GT(readBytes(folder.path("first.hearth")).size(), 100000u);
}

} // namespace
} // namespace hearth::roundtrip
