// Runs the ray marching command of hearth-bricks as a user would.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

const std::string kHeader = "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z\n";

class BricksProgram : public ::testing::Test
{
protected:
    void SetUp() override { writeBricksPart(smallPack(), folder / "a.part"); }

    ProgramEnd march(const std::string& file, const std::string& rays)
    {
        folder.write("rays.csv", rays);
        return folder.run({HEARTH_BIN "/hearth-bricks", file, "--march", "rays.csv", "-o", "hits.csv"});
    }

    /// Check that rays of this text end with the expected result and leave no files behind.
    void expectRefused(const std::string& rays, const std::string& part)
    {
        const ProgramEnd end = march("a.part", rays);
        EXPECT_EQ(end.exit_code, 65) << part;
        EXPECT_EQ(countOccurrences(end.err, "\n"), 1u) << end.err;
        EXPECT_NE(end.err.find("rays.csv|" + part), std::string::npos) << end.err;
        EXPECT_NE(end.err.find("[E1601] hint: "), std::string::npos) << end.err;
        EXPECT_FALSE(folder.has("hits.csv"));
    }

    Sandbox folder;
};

} // namespace

TEST_F(BricksProgram, marchesRowsInTheirOrder)
{
    // solid voxels of half a metre, from (-4, 0, -1): 2, 3, 7 and 18 along x at y 4, z 2
    const std::string rays = kHeader + "-10,2.25,0.25,1,0,0\r\n"
                                       "\n"
                                       "-2.75,2.25,0.25,0,0,1\n"
                                       " -2.125, 5, 0.25, 0, -3, 0\n"
                                       "-1,2.25,0.25,-1,0,0\n"
                                       "0,5,0,0,1,0\n";
    ASSERT_EQ(march("a.part", rays).exit_code, 0);
    const std::string hits = "hit,x,y,z,face,t\n"
                             "1,2,4,2,x-,7\n"
                             "1,2,4,2,none,0\n"
                             "1,3,4,2,y+,2.5\n"
                             "1,3,4,2,x+,1\n"
                             "0,,,,,\n";
    EXPECT_EQ(folder.read("hits.csv"), hits);

    writePackFile(smallPack(), folder / "a.hearth");
    ASSERT_EQ(march("a.hearth", rays).exit_code, 0);
    EXPECT_EQ(folder.read("hits.csv"), hits);
}

TEST_F(BricksProgram, refusesRaysThatAreNone)
{
    expectRefused("", "line 1: ");
    expectRefused("x,y,z\n", "line 1: ");
    expectRefused(kHeader + "1,2,3,0,0\n", "line 2: error: has 5 columns");
    expectRefused(kHeader + "1,2,3,0,0,1,0\n", "line 2: error: has 7 columns");
    expectRefused(kHeader + "1,2,3,0,0,1\n1,nan,3,0,0,1\n", "line 3: error: 'nan' is not a number");
    expectRefused(kHeader + "1,2,3,0,up,1\n", "line 2: error: 'up' is not a number");
    expectRefused(kHeader + "1,2,3,0,0,0\n", "line 2: error: its direction is 0");
    expectRefused(kHeader + "1,2,1e300,0,0,1\n",
                  "line 2: error: its direction is 0, or a number is too large");
}

TEST_F(BricksProgram, endsWithTheHousesExitCodes)
{
    const std::string rays = kHeader + "0,0,0,1,0,0\n";
    EXPECT_EQ(march("missing.part", rays).exit_code, 66);
    PackModel model = smallPack();
    writeSpecularPart(model, folder / "other.part");
    EXPECT_EQ(march("other.part", rays).exit_code, 65);
    model.bricks.opacity[0] = 0;
    writeBricksPart(model, folder / "wrong.part");
    EXPECT_EQ(march("wrong.part", rays).exit_code, 65);
    EXPECT_FALSE(folder.has("hits.csv"));
    const auto bricks = [&](std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth-bricks");
        return folder.run(arguments).exit_code;
    };
    EXPECT_EQ(bricks({"a.part", "--march", "missing.csv", "-o", "hits.csv"}), 66);
    EXPECT_EQ(bricks({"a.part", "--march", "rays.csv", "-o", "nowhere/hits.csv"}), 73);
    EXPECT_EQ(bricks({"a.part", "--march", "rays.csv"}), 2);
    EXPECT_EQ(bricks({"--help"}), 0);
}

} // namespace hearth::test
