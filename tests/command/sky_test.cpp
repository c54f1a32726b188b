// Tests `hearth cook --sky` with the real cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class CookSky : public ::testing::Test
{
protected:
    CookSky()
    {
        writeObj(folder, "crate");
        std::string file = "#?RADIANCE\n\n-Y 4 +X 8\n";
        for (int i = 0; i < 32; ++i)
            file += "\x50\x50\x40\x81";
        folder.write("sky.hdr", file);
    }

    ProgramEnd cook(const std::vector<std::string>& options)
    {
        std::vector<std::string> words{std::string(HEARTH_BIN) + "/hearth",
                                       "cook",
                                       "crate.obj",
                                       "-o",
                                       "crate.hearth",
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
            folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "crate.hearth", "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return Json::parse(end.out).value()["scene"]["probes"];
    }

    Sandbox folder;
};

} // namespace

TEST_F(CookSky, givesThePackTheProbeOfTheFile)
{
    ASSERT_EQ(cook({}).exit_code, 0);
    EXPECT_EQ(probes().size(), 0u);
    const ProgramEnd first = cook({"--sky", "sky.hdr"});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    ASSERT_EQ(probes().size(), 1u);
    EXPECT_NEAR(probes()[0]["irradiance"][0].get<double>(), 3.14159265 * 80 / 128, 1e-5);
    EXPECT_EQ(probes()[0]["bytes"], 524160);
}

TEST_F(CookSky, namesAFileThatIsNoEnvironment)
{
    const ProgramEnd missing = cook({"--sky", "none.hdr"});
    EXPECT_EQ(missing.exit_code, 66);
    EXPECT_NE(missing.err.find("none.hdr: error: "), std::string::npos) << missing.err;
    const ProgramEnd other = cook({"--sky", "crate.obj"});
    EXPECT_EQ(other.exit_code, 65);
    EXPECT_NE(other.err.find("crate.obj: error: an environment is an image"), std::string::npos) << other.err;
    EXPECT_FALSE(folder.has("crate.hearth"));
}

} // namespace hearth::test
