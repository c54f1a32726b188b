// Tests profiles: their contents, and the errors for invalid ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/profile.h"
#include "cook/tools/name_pattern.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace
{

using namespace hearth;
using clusters::Profile;
using clusters::readProfile;

class ProfileFile : public ::testing::Test
{
protected:
    Result<Profile> read(const std::string& text)
    {
        const std::string path = folder_.file("house.toml");
        std::ofstream(path, std::ios::binary) << text;
        return readProfile(path);
    }

    void expectRefused(const std::string& text, Issue issue, const std::string& where,
                       const std::string& detail)
    {
        const Result<Profile> profile = read(text);
        ASSERT_FALSE(profile.ok()) << text;
        EXPECT_EQ(profile.error().issue, issue) << text;
        EXPECT_EQ(profile.error().file, folder_.file("house.toml"));
        EXPECT_EQ(profile.error().where, where) << text;
        EXPECT_NE(profile.error().detail.find(detail), std::string::npos) << profile.error().detail;
    }

    test::TemporaryFolder folder_;
};

TEST_F(ProfileFile, saysHowFarEachMeshIsSimplified)
{
    const auto profile = read(R"(
[clusters]
levels = [{ keep = 0.6 }, { keep = 0.5, error_weight = 2 }]
[[clusters.mesh]]
name = "hero*"
levels = [{ error_weight = 4.5 }]
targets = [{ level = 1, triangles = 5000 }, { level = 4, triangles = 700 }]
[[clusters.mesh]]
name = "*"
targets = [{ level = 2, triangles = 90 }]
[[clusters.material]]
name = "face?"
levels = [{ keep = 0.9 }]
)");
    ASSERT_TRUE(profile.ok()) << formatMessage(profile.error());
    const std::vector<std::string> materials{"skin", "face2", "face"};

    const auto hero = clusters::resolveConfig(*profile, "hero_01", materials).reduction;
    ASSERT_EQ(hero.curve.size(), 1u);
    EXPECT_EQ(hero.curve[0].keep, 0.5f) << "what a step does not set is the default";
    EXPECT_EQ(hero.curve[0].error_weight, 4.5f);
    ASSERT_EQ(hero.targets.size(), 2u);
    EXPECT_EQ(hero.targets[1].level, 4u);
    EXPECT_EQ(hero.targets[1].triangles, 700u);
    ASSERT_EQ(hero.curve_of_material.size(), 1u);
    EXPECT_EQ(hero.curve_of_material.at(1)[0].keep, 0.9f);

    const auto other = clusters::resolveConfig(*profile, "crate", materials).reduction;
    ASSERT_EQ(other.curve.size(), 2u) << "a rule without levels leaves those of all meshes";
    EXPECT_EQ(other.curve[0].keep, 0.6f);
    EXPECT_EQ(other.curve[1].error_weight, 2.0f);
    ASSERT_EQ(other.targets.size(), 1u);
    EXPECT_EQ(other.targets[0].triangles, 90u);
}

TEST_F(ProfileFile, setsNormalBitsAndErrorWeightsForAllMeshesAndForSome)
{
    const auto profile = read(R"(
[clusters]
normal_bits = 16
uv_error_weight = 2
influences = 4
[[clusters.mesh]]
name = "crate"
normal_bits = 8
normal_error_weight = 0
)");
    ASSERT_TRUE(profile.ok()) << formatMessage(profile.error());
    const clusters::Config usual;
    const auto crate = clusters::resolveConfig(*profile, "crate", {});
    EXPECT_EQ(crate.normal_bits, 8u);
    EXPECT_EQ(crate.normal_error_weight, 0.0f);
    EXPECT_EQ(crate.uv_error_weight, 2.0f) << "what a rule does not set is as for all";
    const auto other = clusters::resolveConfig(*profile, "mirror", {});
    EXPECT_EQ(other.normal_bits, 16u);
    EXPECT_EQ(usual.influences, 8u);
    EXPECT_EQ(other.influences, 4u);
    EXPECT_EQ(other.normal_error_weight, usual.normal_error_weight);
    EXPECT_EQ(other.uv_error_weight, 2.0f);
}

TEST_F(ProfileFile, refusesSettingsOutOfRange)
{
    const auto setting = [&](const std::string& line, const std::string& key)
    {
        expectRefused("[clusters]\n" + line + "\n", Issue::profile_value, "line 2, clusters." + key,
                      "must be");
        expectRefused("[[clusters.mesh]]\nname = 'a'\n" + line + "\n", Issue::profile_value,
                      "line 3, clusters.mesh[0]." + key, "must be");
    };
    setting("normal_bits = 12", "normal_bits");
    setting("influences = 6", "influences");
    setting("normal_bits = 0", "normal_bits");
    setting("normal_bits = 8.0", "normal_bits");
    setting("normal_error_weight = -1", "normal_error_weight");
    setting("uv_error_weight = inf", "uv_error_weight");
    setting("uv_error_weight = '1'", "uv_error_weight");
    expectRefused("[clusters]\nnormal_bit = 8\n", Issue::profile_key, "line 2, clusters.normal_bit",
                  "'normal_bits'");
}

TEST_F(ProfileFile, mayBeEmpty)
{
    const auto profile = read("");
    ASSERT_TRUE(profile.ok());
    const auto reduction = clusters::resolveConfig(*profile, "any", {}).reduction;
    ASSERT_EQ(reduction.curve.size(), 1u);
    EXPECT_EQ(reduction.curve[0].keep, 0.5f);
    EXPECT_TRUE(reduction.targets.empty());
}

TEST_F(ProfileFile, namesAKeyThatIsNotKnownAndTheNearest)
{
    expectRefused("[cluster]\n", Issue::profile_key, "line 1, cluster", "'clusters'");
    expectRefused("[clusters]\nlevel = []\n", Issue::profile_key, "line 2, clusters.level", "'levels'");
    expectRefused("[clusters]\nlevels = [\n{ kep = 0.5 }]\n", Issue::profile_key,
                  "line 3, clusters.levels[0].kep", "'keep'");
    expectRefused("[[clusters.mesh]]\nname = 'a'\n[[clusters.mesh]]\nname = 'b'\ntarget = 3\n",
                  Issue::profile_key, "line 5, clusters.mesh[1].target", "'targets'");
    expectRefused("[clusters]\nzebra = 1\n", Issue::profile_key, "line 2, clusters.zebra", "not known");
}

TEST_F(ProfileFile, refusesValuesOutOfRange)
{
    const auto levels = [&](const std::string& step, const std::string& where)
    {
        expectRefused("[clusters]\nlevels = [{}, " + step + "]\n", Issue::profile_value,
                      "line 2, clusters.levels[1]" + where, "must be");
    };
    levels("{ keep = 0.95 }", ".keep");
    levels("{ keep = 0.0 }", ".keep");
    levels("{ keep = -1 }", ".keep");
    levels("{ keep = nan }", ".keep");
    levels("{ keep = '0.5' }", ".keep");
    levels("{ keep = true }", ".keep");
    levels("{ error_weight = 0.99 }", ".error_weight");
    levels("{ error_weight = inf }", ".error_weight");
    levels("3", "");
    expectRefused("[clusters]\nlevels = []\n", Issue::profile_value, "line 2, clusters.levels",
                  "at least one");
    expectRefused("clusters = 1\n", Issue::profile_value, "line 1, clusters", "must be a table");
    expectRefused("[clusters]\nmesh = 'hero'\n", Issue::profile_value, "line 2, clusters.mesh", "array");
}

TEST_F(ProfileFile, refusesRulesThatAreNotWhole)
{
    expectRefused("[[clusters.mesh]]\n", Issue::profile_value, "line 1, clusters.mesh[0].name", "must be");
    expectRefused("[[clusters.mesh]]\nname = ''\n", Issue::profile_value, "line 2, clusters.mesh[0].name",
                  "must be");
    expectRefused("[[clusters.material]]\nname = 'a'\n", Issue::profile_value,
                  "line 1, clusters.material[0].levels", "needs levels");
    const auto targets = [&](const std::string& list, const std::string& where, const std::string& detail)
    {
        expectRefused("[[clusters.mesh]]\nname = 'a'\ntargets = [" + list + "]\n", Issue::profile_value,
                      "line 3, clusters.mesh[0].targets" + where, detail);
    };
    targets("{ level = 1 }", "[0].triangles", "whole number");
    targets("{ level = 0, triangles = 5 }", "[0].level", "whole number");
    targets("{ level = 1.5, triangles = 5 }", "[0].level", "whole number");
    targets("{ level = 1, triangles = 3000000000 }", "[0].triangles", "whole number");
    targets("{ level = 2, triangles = 9 }, { level = 2, triangles = 8 }", "[1]", "higher level");
    targets("{ level = 2, triangles = 9 }, { level = 3, triangles = 9 }", "[1]", "fewer triangles");
}

TEST_F(ProfileFile, refusesWhatIsNotToml)
{
    const auto profile = read("[clusters]\nlevels = [{ keep = \n");
    ASSERT_FALSE(profile.ok());
    EXPECT_EQ(profile.error().issue, Issue::profile_syntax);
    EXPECT_EQ(profile.error().where.substr(0, 5), "line ");
    const auto missing = readProfile(folder_.file("no.toml"));
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().issue, Issue::input_missing);
    const auto directory = readProfile(folder_.file(""));
    ASSERT_FALSE(directory.ok());
    EXPECT_EQ(directory.error().issue, Issue::input_missing);
}

TEST(MatchesPattern, knowsItsWildcards)
{
    using tools::matchesPattern;
    EXPECT_TRUE(matchesPattern("rock", "rock"));
    EXPECT_FALSE(matchesPattern("rock", "Rock"));
    EXPECT_FALSE(matchesPattern("rock", "rocks"));
    EXPECT_TRUE(matchesPattern("rock*", "rock"));
    EXPECT_TRUE(matchesPattern("*_LOD?", "a_LODb_LOD2"));
    EXPECT_FALSE(matchesPattern("*_LOD?", "a_LOD12"));
    EXPECT_TRUE(matchesPattern("a*b*c", "a-bb-b-c"));
    EXPECT_FALSE(matchesPattern("a*b*c", "a-bb-b"));
    EXPECT_TRUE(matchesPattern("*", ""));
    EXPECT_FALSE(matchesPattern("", "a"));
    EXPECT_FALSE(matchesPattern(std::string(30, '*') + "x", std::string(100000, 'a')));
}

} // namespace
