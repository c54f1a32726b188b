// Tests `hearth cook --probe` with the real cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// Box of 4 x 3 x 5 m with the faces of a room: its floor is at y = 0.
constexpr const char* kRoom = "v -2 0 -2.5\nv 2 0 -2.5\nv 2 3 -2.5\nv -2 3 -2.5\n"
                              "v -2 0 2.5\nv 2 0 2.5\nv 2 3 2.5\nv -2 3 2.5\n"
                              "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 5 6 2 1\nf 4 3 7 8\n";

class CookReflections : public ::testing::Test
{
protected:
    CookReflections() { folder.write("room.obj", kRoom); }

    ProgramEnd cook(const std::vector<std::string>& options)
    {
        std::vector<std::string> words{std::string(HEARTH_BIN) + "/hearth",
                                       "cook",
                                       "room.obj",
                                       "-o",
                                       "room.hearth",
                                       "--visibility=off",
                                       "--bricks=off",
                                       "--cache",
                                       folder.cacheSpec()};
        words.insert(words.end(), options.begin(), options.end());
        return folder.run(words);
    }

    Json probes()
    {
        const ProgramEnd end =
            folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "room.hearth", "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return Json::parse(end.out).value()["scene"]["probes"];
    }

    Sandbox folder;
};

} // namespace

TEST_F(CookReflections, givesThePackAProbeForEachPlace)
{
    // a hole in the roof, for light: rooms of OBJ have no lamps
    std::string open = kRoom;
    open.resize(open.rfind("f 4 3 7 8"));
    folder.write("room.obj", open);
    const ProgramEnd end = cook({"--probe", "0.5,1.5,0", "--probe", "-1,1,1:-2,0,-2.5:2,3,2.5:0.5"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json found = probes();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_FALSE(found[0]["sky"].get<bool>());
    EXPECT_EQ(found[0]["face_size"], 64);
    EXPECT_NEAR(found[0]["place"]["box_min"][0].get<double>(), -2, 1e-3);
    EXPECT_GT(found[0]["place"]["box_max"][1].get<double>(), 5) << "no surface above";
    EXPECT_EQ(found[1]["place"]["position"][2], 1);
    EXPECT_EQ(found[1]["place"]["fade"], 0.5);
    EXPECT_EQ(found[1]["place"]["influence_max"][1], 3.5);
    EXPECT_GT(found[0]["place"]["sky_share"].get<double>(), 0.02);
    EXPECT_LT(found[0]["place"]["sky_share"].get<double>(), 0.5);
    EXPECT_EQ(folder.run({std::string(HEARTH_BIN) + "/hearth", "verify", "room.hearth"}).exit_code, 0);
    const ProgramEnd list = folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "room.hearth"});
    EXPECT_NE(list.out.find("at (-1, 1, 1), box (-2, 0, -2.5) to (2, 3, 2.5)"), std::string::npos)
        << list.out;
}

TEST_F(CookReflections, E1407_probeInsideOfASolid)
{
    // the same faces turned outwards
    folder.write("room.obj", "v -2 0 -2.5\nv 2 0 -2.5\nv 2 3 -2.5\nv -2 3 -2.5\n"
                             "v -2 0 2.5\nv 2 0 2.5\nv 2 3 2.5\nv -2 3 2.5\n"
                             "f 4 3 2 1\nf 7 8 5 6\nf 8 4 1 5\nf 3 7 6 2\nf 1 2 6 5\nf 8 7 3 4\n");
    const ProgramEnd end = cook({"--probe", "5,1,0", "--probe", "0,1,0"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_NE(end.err.find("probe 1 at 0,1,0"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("E1407"), std::string::npos) << end.err;
    EXPECT_FALSE(folder.has("room.hearth"));
}

TEST_F(CookReflections, namesAPlaceThatIsNone)
{
    const ProgramEnd end = cook({"--probe", "1,2"});
    EXPECT_NE(end.exit_code, 0);
    EXPECT_NE(end.err.find("\"1,2\": the place of a probe is X,Y,Z"), std::string::npos) << end.err;
}

} // namespace hearth::test
