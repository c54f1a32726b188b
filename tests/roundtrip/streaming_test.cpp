// Tests hearth-render with a geometry budget: the same image if the budget suffices, else a coarser image
// without holes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/cooked_sample.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace hearth::roundtrip
{
namespace
{

std::string readContent(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Value of the first member of that name in the statistics.
std::string member(const std::string& json, const std::string& name)
{
    const size_t at = json.find("\"" + name + "\":");
    if (at == std::string::npos)
        return "";
    const size_t first = at + name.size() + 3;
    return json.substr(first, json.find_first_of(",}", first) - first);
}

class StreamedRender : public testing::Test
{
protected:
    ProgramEnd render(const std::string& name, std::vector<std::string> options)
    {
        options.insert(options.begin(),
                       {sample_.packPath(), "-o", file(name + ".png"), "--stats", file(name + ".json"),
                        "--size", "320x240", "--samples", "1", "--validate"});
        return runProgram(Program::render, options);
    }

    std::string file(const std::string& name) const { return folder_.path(name); }

    const CookedSample& sample_ = cookedSample({"rock", 150000});
    ScratchFolder folder_;
};

TEST_F(StreamedRender, drawsTheSameImageWhereTheBudgetSuffices)
{
    const ProgramEnd whole = render("whole", {});
    ASSERT_EQ(whole.exit_code, 0) << whole.errors;
    const ProgramEnd streamed = render("streamed", {"--budget", "1G"});
    ASSERT_EQ(streamed.exit_code, 0) << streamed.errors;
    EXPECT_EQ(readContent(file("streamed.png")), readContent(file("whole.png")));
    EXPECT_EQ(member(readContent(file("whole.json")), "converged"), "") << "nothing is streamed";
    const std::string statistics = readContent(file("streamed.json"));
    EXPECT_EQ(member(statistics, "converged"), "true");
    EXPECT_EQ(member(statistics, "error_scale"), "1.000");
    EXPECT_EQ(member(statistics, "failures"), "0");
    EXPECT_EQ(member(statistics, "drawn_triangles"),
              member(readContent(file("whole.json")), "drawn_triangles"));
    EXPECT_GT(std::stoull(member(statistics, "bytes_streamed")), 100000u);
}

TEST_F(StreamedRender, drawsCoarserWhereItDoesNot)
{
    const ProgramEnd end = render("small", {"--budget", "512K", "--error-pixels", "0.1"});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    const std::string statistics = readContent(file("small.json"));
    EXPECT_GT(std::stod(member(statistics, "error_scale")), 1);
    EXPECT_LE(std::stoull(member(statistics, "bytes_in_use")), 512u * 1024);
    EXPECT_GT(std::stoull(member(statistics, "drawn_triangles")), 100u);
}

TEST_F(StreamedRender, namesTheBudgetThatIsNeeded)
{
    const ProgramEnd end = render("none", {"--budget", "16"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.errors.find("E4006"), std::string::npos) << end.errors;
}

TEST_F(StreamedRender, aCameraPathTakesOneRoundOfLoadsAFrame)
{
    std::ofstream(file("path.txt")) << "3,1,3,0,0,0,45\n3,1,3,0,0,0,45\n3,1,3,0,0,0,45\n";
    const ProgramEnd end =
        render("path", {"--budget", "1G", "--shadows", "off", "--camera-path", file("path.txt")});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    const std::string statistics = readContent(file("path.json"));
    const size_t frames = statistics.rfind("\"frames\":[");
    ASSERT_NE(frames, std::string::npos);
    EXPECT_EQ(member(statistics.substr(frames), "converged"), "false")
        << "the first has nothing but the roots";
    EXPECT_EQ(member(statistics.substr(frames), "bytes_streamed"), "0");
    EXPECT_NE(member(statistics, "bytes_streamed"), "0");
}

} // namespace
} // namespace hearth::roundtrip
