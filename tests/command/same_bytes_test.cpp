// Tests that a pack has the same bytes for any order of work, number of threads and environment, with the
// real cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <sys/stat.h>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

// Script that first sleeps for a time that depends on its seed, its name and its files' names, then notes its
// start and runs the cooker.
constexpr const char* kDawdler = R"sh(#!/bin/sh
files=$(printf '%s ' "$@" | sed 's:[^ ]*/::g')
sleep 0.$(printf '%s' "$SEED COOKER $files" | cksum | cut -c1-2)
echo "COOKER $files" >> "$ORDER"
exec BIN/hearth-COOKER "$@"
)sh";

class SameBytes : public ::testing::Test
{
protected:
    SameBytes() { writeSources(folder); }

    static void writeSources(const Sandbox& place)
    {
        writeObj(place, "house");
        writeObj(place, "barn", 2, 60);
        writeGltf(place, "tree");
        writeGltf(place, "bush", 0.5F);
    }

    /// Return the pack of all sources.
    static std::string cook(Sandbox& place, const std::vector<std::string>& options,
                            const std::vector<std::string>& environment = {},
                            const std::string& programs = HEARTH_BIN)
    {
        std::vector<std::string> command{programs + "/hearth", "cook",      "-q", "house.obj", "tree.gltf",
                                         "barn.obj",           "bush.gltf", "-o", "a.hearth"};
        command.insert(command.end(), options.begin(), options.end());
        fs::remove(place / "a.hearth");
        const ProgramEnd end = place.run(command, environment);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return place.read("a.hearth");
    }

    Sandbox folder;
};

} // namespace

TEST_F(SameBytes, forAnySurroundings)
{
    const std::string pack = cook(folder, {"--no-cache", "-j1"});
    ASSERT_FALSE(pack.empty());
    Sandbox elsewhere;
    writeSources(elsewhere);
    const mode_t mask = ::umask(077);
    for (const auto& [options, environment] :
         std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>{
             {{"-j2"}, {}},
             {{"-j1"}, {"LC_ALL=de_DE.UTF-8", "TZ=Asia/Tokyo"}},
             {{"--force"}, {"TMPDIR=" + elsewhere.path()}},
             {{"--memory", "1M"}, {}}})
        for (Sandbox* place : {&folder, &elsewhere})
            EXPECT_TRUE(cook(*place, options, environment) == pack) << options[0];
    ::umask(mask);
}

TEST_F(SameBytes, forAnyOrder)
{
    Sandbox programs;
    fs::copy(HEARTH_BIN "/hearth", programs / "hearth");
    for (const char* cooker : {"bricks", "clusters", "import", "link", "neighbours", "receivers", "skinning",
                               "specular", "texels", "textures", "visibility"})
    {
        std::string script = kDawdler;
        replaceAll(script, "COOKER", cooker);
        replaceAll(script, "BIN", HEARTH_BIN);
        programs.write(std::string("hearth-") + cooker, script, true);
    }
    const std::vector<std::string> options{"--no-cache",           "--bricks", "--receivers", "--visibility",
                                           "--visibility-quality", "draft",    "-j",          "8"};
    const std::string pack = cook(folder, options);
    ASSERT_FALSE(pack.empty());
    std::set<std::string> orders;
    for (const char* seed : {"1", "2", "3"})
    {
        const std::string order = programs / std::string("order") + seed;
        const std::vector<std::string> environment{"SEED=" + std::string(seed), "ORDER=" + order};
        EXPECT_TRUE(cook(folder, options, environment, programs.path()) == pack) << "seed " << seed;
        orders.insert(programs.read(std::string("order") + seed));
    }
    EXPECT_EQ(orders.size(), 3u) << "none was like another";
    EXPECT_GE(countOccurrences(*orders.begin(), "\n"), 18u) << *orders.begin();
}

} // namespace hearth::test
