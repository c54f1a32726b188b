// Tests `hearth cook --proxy-from` with the real cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// Two materials: a box without its top, and a wall inside of it that its floor is joined to.
constexpr const char* kCrate = "mtllib crate.mtl\n"
                               "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 2\nv 2 0 2\nv 2 1 2\nv 0 1 2\n"
                               "v 1 0 0\nv 1 0 2\nv 1 .5 0\nv 1 .5 2\n"
                               "usemtl wood\nf 4 3 2 9 1\nf 5 10 6 7 8\nf 1 5 8 4\nf 6 2 3 7\n"
                               "f 1 9 10 5\nf 9 2 6 10\n"
                               "usemtl tin plate\nf 9 11 12 10\n";

class CookProxies : public ::testing::Test
{
protected:
    CookProxies()
    {
        folder.write("crate.obj", kCrate);
        folder.write("crate.mtl", "newmtl wood\nKd 1 .5 0\nnewmtl tin plate\nKd 1 1 1\n");
        folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                "f 4 3 2 1\nf 5 6 7 8\nf 1 5 8 4\nf 6 2 3 7\nf 1 2 6 5\nf 8 7 3 4\n");
    }

    ProgramEnd hearth(const std::vector<std::string>& arguments)
    {
        std::vector<std::string> words{std::string(HEARTH_BIN) + "/hearth"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return folder.run(words);
    }

    ProgramEnd cook(const std::vector<std::string>& sources, const std::vector<std::string>& options)
    {
        std::vector<std::string> words{"cook"};
        words.insert(words.end(), sources.begin(), sources.end());
        words.insert(words.end(),
                     {"-o", "a.hearth", "--visibility=off", "--bricks=off", "--cache", folder.cacheSpec()});
        words.insert(words.end(), options.begin(), options.end());
        return hearth(words);
    }

    Json inspect()
    {
        const ProgramEnd end = hearth({"inspect", "a.hearth", "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return Json::parse(end.out).value();
    }

    Sandbox folder;
};

} // namespace

TEST_F(CookProxies, areMadeOnRequestAlone)
{
    ASSERT_EQ(cook({"box.obj"}, {}).exit_code, 0);
    EXPECT_FALSE(inspect().contains("proxies"));
    const ProgramEnd end = hearth({"extract", "a.hearth", "--proxy", "0", "-o", "a.ply"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_NE(end.err.find("the file has no proxies: cook with --proxy-from clean"), std::string::npos)
        << end.err;
}

TEST_F(CookProxies, ofABoxIsTheBox)
{
    const ProgramEnd end = cook({"box.obj"}, {"--proxy-from", "clean", "--proxy-bindings"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_EQ(proxies[0]["origin"], "cleaned");
    EXPECT_EQ(proxies[0]["triangles"], 12);
    EXPECT_EQ(proxies[0]["vertices"], 8);
    EXPECT_TRUE(proxies[0]["closed"].get<bool>());
    EXPECT_LT(proxies[0]["distance"].get<double>(), 1e-3);
    EXPECT_LT(proxies[0]["mesh_distance"].get<double>(), 1e-3);
    EXPECT_GE(proxies[0]["bindings"].get<int>(), 8);
    EXPECT_EQ(hearth({"verify", "a.hearth"}).exit_code, 0);
    const ProgramEnd text = hearth({"inspect", "a.hearth"});
    EXPECT_NE(text.out.find("cleaned, 12 triangles in 1 sections, closed, within "), std::string::npos)
        << text.out;
}

TEST_F(CookProxies, areCookedAgainAsTheyWere)
{
    // the proxy of a proxy is the proxy
    ASSERT_EQ(cook({"crate.obj"}, {"--proxy-from", "clean"}).exit_code, 0);
    ASSERT_EQ(hearth({"extract", "a.hearth", "--proxy", "0", "-o", "proxy.ply"}).exit_code, 0);
    const Json first = inspect()["proxies"][0];
    ASSERT_EQ(cook({"proxy.ply"}, {"--proxy-from", "clean"}).exit_code, 0);
    const Json second = inspect()["proxies"][0];
    EXPECT_EQ(first["triangles"], second["triangles"]);
    EXPECT_EQ(first["vertices"], second["vertices"]);
}

TEST_F(CookProxies, haveASectionForEachMaterial)
{
    ASSERT_EQ(cook({"crate.obj"}, {"--proxy-from", "clean", "--report", "report.json"}).exit_code, 0);
    const Json proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_FALSE(proxies[0]["closed"].get<bool>());
    ASSERT_EQ(proxies[0]["sections"].size(), 2u);
    EXPECT_EQ(proxies[0]["sections"][1]["triangles"], 2) << "the wall, taken off the floor";
    ASSERT_EQ(hearth({"extract", "a.hearth", "--proxy", "0", "-o", "crate_proxy.obj"}).exit_code, 0);
    const std::string obj = folder.read("crate_proxy.obj");
    EXPECT_NE(obj.find("\ng wood\n"), std::string::npos) << obj;
    EXPECT_NE(obj.find("\ng tin_plate\n"), std::string::npos) << obj;
    const ProgramEnd glb = hearth({"extract", "a.hearth", "-o", "crate.glb"});
    EXPECT_NE((glb.out + glb.err).find("proxies: 1"), std::string::npos) << glb.out << glb.err;
}

TEST_F(CookProxies, belongToTheMeshesOfTheirSource)
{
    folder.write("hearth.toml", "[[rule]]\nmatch = \"crate.obj\"\nproxy.from = \"clean\"\n");
    const ProgramEnd end = cook({"box.obj", "crate.obj"}, {"--config", "hearth.toml"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json pack = inspect();
    ASSERT_EQ(pack["proxies"].size(), 1u);
    EXPECT_EQ(pack["proxies"][0]["mesh"], 1) << "the box has none";
    ASSERT_EQ(pack["proxies"][0]["sections"].size(), 2u);
    EXPECT_EQ(hearth({"verify", "a.hearth"}).exit_code, 0);
}

TEST_F(CookProxies, haveAtMostTheTrianglesThatAreAsked)
{
    const ProgramEnd made =
        folder.run({std::string(HEARTH_BIN) + "/hearth-samples", "rock", "-o", "rock.glb"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    ASSERT_EQ(cook({"rock.glb"}, {"--proxy-from", "clean", "--proxy-triangles", "500"}).exit_code, 0);
    const Json pack = inspect();
    ASSERT_EQ(pack["proxies"].size(), 1u);
    EXPECT_LE(pack["proxies"][0]["triangles"].get<int>(), 550) << "a few for holes";
    EXPECT_GE(pack["proxies"][0]["triangles"].get<int>(), 60);
    EXPECT_TRUE(pack["proxies"][0]["closed"].get<bool>());
}

TEST_F(CookProxies, wrapOfACrateIsClosed)
{
    if (!std::filesystem::exists(std::string(HEARTH_BIN) + "/hearth-wrap"))
        GTEST_SKIP() << "hearth-wrap is not built: CGAL is missing";
    const ProgramEnd end = cook({"crate.obj"}, {"--proxy-from", "wrap", "--proxy-alpha", "0.1"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_EQ(proxies[0]["origin"], "wrapped");
    EXPECT_TRUE(proxies[0]["closed"].get<bool>());
    EXPECT_LT(proxies[0]["distance"].get<double>(), 0.35) << "alpha and offset of a diagonal of 3 m";
    EXPECT_EQ(hearth({"verify", "a.hearth"}).exit_code, 0);
}

TEST_F(CookProxies, haveConvexPartsForPhysics)
{
    // an L of two boxes, closed
    folder.write("l.obj", "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
                          "v 0 0 1\nv 3 0 1\nv 3 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\n"
                          "f 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\n"
                          "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n");
    const ProgramEnd end = cook({"l.obj"}, {"--proxy-from", "clean", "--proxy-convex-parts", "8"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_TRUE(proxies[0]["closed"].get<bool>());
    EXPECT_LT(proxies[0]["distance"].get<double>(), 0.1);
    EXPECT_LT(proxies[0]["mesh_distance"].get<double>(), 1e-3);
    ASSERT_EQ(proxies[0]["sections"].size(), 2u);
    EXPECT_TRUE(proxies[0]["sections"][0]["convex"].get<bool>());
    EXPECT_TRUE(proxies[0]["sections"][1]["convex"].get<bool>());
    EXPECT_EQ(proxies[0]["sections"][1]["triangles"], 12);
    EXPECT_EQ(hearth({"verify", "a.hearth"}).exit_code, 0);
}

TEST_F(CookProxies, E1000_noProxyOfThatNumber)
{
    ASSERT_EQ(cook({"box.obj"}, {"--proxy-from", "clean"}).exit_code, 0);
    ProgramEnd end = hearth({"extract", "a.hearth", "--proxy", "1", "-o", "a.ply"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.err.find("there is no proxy 1: the file has 1"), std::string::npos) << end.err;
    end = hearth({"extract", "a.hearth", "--proxy", "0", "-o", "a.stl"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.err.find("a proxy is written as .ply or .obj"), std::string::npos) << end.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.stl"));
}

} // namespace hearth::test
