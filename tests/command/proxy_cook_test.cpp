// Tests `hearth cook --proxy-from`, and proxies of artists on their way to glTF and back, with the real
// cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/json_schema.h"
#include "tests/support/sandbox.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <sys/resource.h>

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

/// Return the JSON text of a GLB file.
std::string readGlbJson(const std::string& glb)
{
    uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, sizeof(size));
    return glb.substr(20, size);
}

/// Append meshes that are the first one of a GLB file under other names, each with a node.
std::string copyFirstMesh(const std::string& glb, int copies)
{
    const std::string before = readGlbJson(glb);
    Json document = Json::parse(before).value();
    for (int copy = 0; copy < copies; ++copy)
    {
        Json mesh = document["meshes"][0];
        mesh["name"] = "copy " + std::to_string(document["meshes"].size());
        document["scenes"][0]["nodes"].push_back(document["nodes"].size());
        document["nodes"].push_back({{"mesh", document["meshes"].size()}});
        document["meshes"].push_back(std::move(mesh));
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string changed = glb;
    changed.replace(20, before.size(), text);
    const auto sizes = std::array{static_cast<uint32_t>(changed.size()), static_cast<uint32_t>(text.size())};
    std::memcpy(changed.data() + 8, sizes.data(), sizeof(sizes));
    return changed;
}

/// Processor time of the programs that have ended.
double childSeconds()
{
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

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

    /// Write rock.gltf: a rock, its proxy of two materials, two convex parts below it, and a log without any.
    void writeRock()
    {
        std::string bytes;
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                append(bytes, (corner >> axis & 1) != 0 ? 1.0f : -1.0f);
        for (const int index : {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5})
            append(bytes, static_cast<uint16_t>(index));
        folder.write("rock.bin", bytes);
        folder.write("rock.gltf",
                     R"({"asset":{"version":"2.0"},"buffers":[{"uri":"rock.bin","byteLength":168}],
            "bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72}],
            "accessors":[
                {"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},
                {"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"},
                {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"},
                {"bufferView":1,"byteOffset":24,"componentType":5123,"count":24,"type":"SCALAR"}],
            "materials":[{"name":"stone"},{"name":"moss"}],
            "meshes":[{"name":"box","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
                {"primitives":[{"attributes":{"POSITION":0},"indices":3,"material":1},
                               {"attributes":{"POSITION":0},"indices":2,"material":0}]},
                {"primitives":[{"attributes":{"POSITION":0},"indices":1}]},
                {"name":"log","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
            "nodes":[{"name":"Rock","mesh":0,"translation":[3,0,0],"scale":[2,2,2],"children":[2,3]},
                {"name":"rock_proxy","mesh":1,"translation":[3,0,1],"scale":[2,2,2]},
                {"name":"UCX_Rock_01","mesh":2,"scale":[0.5,1,1],"translation":[-0.5,0,0]},
                {"name":"UCX_Rock_02","mesh":2,"scale":[0.5,1,1],"translation":[0.5,0,0]},
                {"name":"Log","mesh":3,"translation":[0,0,8]}],
            "scenes":[{"nodes":[0,1,4]}],"scene":0})");
    }

    /// Return the proxies as OBJ files, one after another: positions, triangles, names of materials.
    std::string extractProxies(size_t count)
    {
        std::string text;
        for (size_t i = 0; i < count; ++i)
        {
            const ProgramEnd end =
                hearth({"extract", "a.hearth", "--proxy", std::to_string(i), "-o", "proxy.obj"});
            EXPECT_EQ(end.exit_code, 0) << end.err;
            text += folder.read("proxy.obj");
        }
        return text;
    }

    Sandbox folder;

private:
    template <typename T>
    static void append(std::string& bytes, T value)
    {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
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
    EXPECT_EQ((glb.out + glb.err).find("proxies"), std::string::npos) << "nothing is left out: " << glb.out;
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
    const ProgramEnd made = folder.run({std::string(HEARTH_BIN) + "/hearth-samples", "rock", "--triangles",
                                        "20000", "--texture-size", "1", "-o", "rock.glb"});
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

TEST_F(CookProxies, ofMeshesOfOneShapeAreMadeOnce)
{
    const auto run = [&](const std::string& program, const std::vector<std::string>& arguments)
    {
        std::vector<std::string> words{std::string(HEARTH_BIN) + "/hearth-" + program};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const ProgramEnd end = folder.run(words);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return end.out;
    };
    run("samples", {"rock", "--triangles", "3000", "--texture-size", "1", "-o", "rock.glb"});
    const std::string rock = folder.read("rock.glb");
    const auto makeProxies = [&](int copies)
    {
        folder.write("rocks.glb", copyFirstMesh(rock, copies));
        run("import", {"rocks.glb", "-o", "i.part"});
        run("clusters", {"i.part", "-o", "c.part"});
        const double start = childSeconds();
        const std::string statistics =
            run("proxy", {"i.part", "c.part", "-o", "p.part", "--convex-parts", "2", "--stats", "-"});
        return std::pair(Json::parse(statistics).value()["meshes"], childSeconds() - start);
    };
    const auto [one, seconds_of_one] = makeProxies(0);
    const auto [many, seconds_of_many] = makeProxies(20);
    EXPECT_LE(seconds_of_many, 5 * seconds_of_one) << seconds_of_one;
    ASSERT_EQ(many.size(), one.size() + 20);
    for (size_t i = one.size(); i < many.size(); ++i)
    {
        EXPECT_EQ(many[i]["mesh"], i);
        EXPECT_EQ(many[i]["name"], "copy " + std::to_string(i));
        for (const char* value : {"triangles", "mesh_triangles", "convex_parts", "distance", "bytes"})
            EXPECT_EQ(many[i][value], one[0][value]) << value;
    }
    EXPECT_GT(one[0]["convex_parts"].get<int>(), 1);

    // those of artists have their distances bounded once, too
    const auto import = [&](int copies)
    {
        folder.write("rocks.glb", copyFirstMesh(rock, copies));
        EXPECT_EQ(cook({"rocks.glb"}, {"--proxy-from", "clean"}).exit_code, 0);
        EXPECT_EQ(hearth({"extract", "a.hearth", "-o", "again.glb"}).exit_code, 0);
        const double start = childSeconds();
        run("import", {"again.glb", "-o", "again.part"});
        return childSeconds() - start;
    };
    const double import_of_one = import(0);
    EXPECT_LE(import(40), 10 * import_of_one) << import_of_one;
}

TEST_F(CookProxies, ofArtistsAreCarriedAndNotDrawn)
{
    writeRock();
    const ProgramEnd end = cook({"rock.gltf"}, {"--report", "report.json"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json pack = inspect();
    EXPECT_EQ(pack["scene"]["instances"], 2) << "the rock and the log";
    ASSERT_EQ(pack["proxies"].size(), 2u);
    for (const Json& proxy : pack["proxies"])
    {
        EXPECT_EQ(proxy["origin"], "authored");
        EXPECT_EQ(proxy["mesh"], 0);
        EXPECT_TRUE(proxy["closed"].get<bool>());
        EXPECT_EQ(proxy["sections"].size(), 2u);
        EXPECT_EQ(proxy["bindings"], 0);
    }
    EXPECT_EQ(pack["proxies"][0]["sections"][1]["material"], 1);
    EXPECT_FALSE(pack["proxies"][0]["sections"][1]["convex"].get<bool>());
    EXPECT_TRUE(pack["proxies"][1]["sections"][1]["convex"].get<bool>());
    EXPECT_EQ(hearth({"verify", "a.hearth"}).exit_code, 0);
    const ProgramEnd text = hearth({"inspect", "a.hearth"});
    EXPECT_NE(text.out.find("authored, 24 triangles in 2 sections (2 convex), closed"), std::string::npos)
        << text.out;

    const Json report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.report.1.json", report), "");
    const Json rows = report["assets"][0]["proxies"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["name"], "box");
    EXPECT_EQ(rows[0]["origin"], "authored");
    EXPECT_EQ(rows[0]["bytes"], 64 + 8 * 12 + 36 * 4 + 2 * 16);
    EXPECT_GE(rows[0]["mesh_distance"].get<double>(), 0.5) << "a metre along z, at twice the size";
    EXPECT_LE(rows[0]["mesh_distance"].get<double>(), 0.55);
}

TEST_F(CookProxies, ofArtistsGoBeforeThoseThatAreMade)
{
    writeRock();
    ASSERT_EQ(cook({"rock.gltf"}, {"--proxy-from", "clean", "--report", "report.json"}).exit_code, 0);
    Json proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 3u);
    EXPECT_EQ(proxies[1]["origin"], "authored");
    EXPECT_EQ(proxies[2]["origin"], "cleaned");
    EXPECT_EQ(proxies[2]["mesh"], 3) << "the log";
    EXPECT_EQ(Json::parse(folder.read("report.json")).value()["assets"][0]["proxies"].size(), 3u);

    ASSERT_EQ(cook({"rock.gltf"}, {"--proxy-bindings"}).exit_code, 0);
    proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 2u) << "none is made";
    EXPECT_GE(proxies[1]["bindings"].get<int>(), 8);

    ASSERT_EQ(cook({"rock.gltf"}, {"--proxy-from", "source"}).exit_code, 0);
    const Json pack = inspect();
    EXPECT_FALSE(pack.contains("proxies"));
    EXPECT_EQ(pack["scene"]["instances"], 2) << "they are not drawn either";
}

TEST_F(CookProxies, comeBackFromGltfAsTheyWere)
{
    writeRock();
    ASSERT_EQ(cook({"rock.gltf"}, {}).exit_code, 0);
    const Json first = inspect();
    const std::string surfaces = extractProxies(2);
    size_t nodes = 0;
    for (int turn = 0; turn < 2; ++turn)
    {
        const ProgramEnd end = hearth({"extract", "a.hearth", "-o", "rock.glb"});
        ASSERT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(end.out.find("prox"), std::string::npos) << end.out;
        ASSERT_EQ(cook({"rock.glb"}, {}).exit_code, 0);
        const Json again = inspect();
        EXPECT_EQ(again["scene"]["instances"], 2);
        EXPECT_EQ(again["proxies"].dump(), first["proxies"].dump());
        EXPECT_EQ(extractProxies(2), surfaces);
        EXPECT_TRUE(turn == 0 || again["scene"]["nodes"] == nodes) << "nodes do not pile up";
        nodes = again["scene"]["nodes"].get<size_t>();
    }
}

TEST_F(CookProxies, areInGltfOnceByTheirNamesBelowTheirMeshes)
{
    writeRock();
    ASSERT_EQ(cook({"rock.gltf"}, {}).exit_code, 0);
    ASSERT_EQ(hearth({"extract", "a.hearth", "-o", "rock.glb"}).exit_code, 0);
    const Json nodes = Json::parse(readGlbJson(folder.read("rock.glb"))).value()["nodes"];
    std::set<std::string> names;
    for (const Json& node : nodes)
        EXPECT_TRUE(names.insert(node["name"].get<std::string>()).second) << node.dump();
    std::vector<std::string> below_rock;
    for (const Json& child : nodes[0]["children"])
    {
        const Json& node = nodes[child.get<size_t>()];
        below_rock.push_back(node["name"].get<std::string>());
        EXPECT_TRUE(node.contains("mesh")) << node.dump();
        EXPECT_FALSE(node.contains("scale") || node.contains("translation")) << node.dump();
    }
    EXPECT_EQ(below_rock, (std::vector<std::string>{"Rock_PROXY", "UCX_Rock_01", "UCX_Rock_02"}));
}

TEST_F(CookProxies, thatWereMadeComeBackFromGltfAsThoseOfArtists)
{
    ASSERT_EQ(cook({"box.obj"}, {"--proxy-from", "clean"}).exit_code, 0);
    const std::string box = extractProxies(1);
    ASSERT_EQ(hearth({"extract", "a.hearth", "-o", "box.glb"}).exit_code, 0);
    ASSERT_EQ(cook({"box.glb"}, {}).exit_code, 0);
    EXPECT_EQ(inspect()["proxies"][0]["origin"], "authored");
    EXPECT_EQ(extractProxies(1), box);
    EXPECT_EQ(inspect()["scene"]["instances"], 1);

    // the wall of the crate is joined with its floor again: vertices at one place become one
    ASSERT_EQ(cook({"crate.obj"}, {"--proxy-from", "clean"}).exit_code, 0);
    const Json made = inspect()["proxies"];
    ASSERT_EQ(hearth({"extract", "a.hearth", "-o", "crate.glb"}).exit_code, 0);
    ASSERT_EQ(cook({"crate.glb"}, {}).exit_code, 0);
    const Json read = inspect()["proxies"];
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0]["sections"].dump(), made[0]["sections"].dump());
    EXPECT_EQ(read[0]["closed"], made[0]["closed"]);
    EXPECT_EQ(read[0]["vertices"].get<int>(), made[0]["vertices"].get<int>() - 2);
}

TEST_F(CookProxies, ofFilesAreOfTheOnlyMeshOrOfOneThatIsNamed)
{
    writeRock();
    folder.write("hull.obj", "v 2 0 0\nv 4 0 0\nv 3 2 0\nv 3 1 -2\nf 1 2 3\nf 2 1 4\nf 3 2 4\nf 1 3 4\n");
    // a scan has one mesh
    ProgramEnd end = cook({"box.obj"}, {"--proxy", "hull.obj"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    Json proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_EQ(proxies[0]["origin"], "authored");
    EXPECT_EQ(proxies[0]["triangles"], 4);
    EXPECT_NE(extractProxies(1).find("v 4 0 0\n"), std::string::npos);

    // all that a glTF file draws, whatever names say of other meshes
    end = cook({"box.obj"}, {"--proxy", "rock.gltf"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 2u);
    EXPECT_EQ(proxies[0]["triangles"], 36) << "the rock, its proxy, the log";
    EXPECT_EQ(proxies[1]["sections"].size(), 2u) << "UCX_Rock_01 and 02";
    EXPECT_TRUE(proxies[1]["sections"][0]["convex"].get<bool>());
    EXPECT_EQ(end.err.find("rock"), std::string::npos) << end.err;

    // in place of those of the source, by the name of its mesh; the rock stands at x = 3 at twice its size
    end = cook({"rock.gltf"}, {"--proxy", "BOX=hull.obj"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_EQ(proxies[0]["mesh"], 0);
    EXPECT_NE(extractProxies(1).find("v 0.5 0 0\n"), std::string::npos) << extractProxies(1);

    // a rule says it for one of several sources; the file is an input of its cook
    folder.write("hearth.toml", "[[rule]]\nmatch = \"box.obj\"\nimport.proxies = [\"UCX_hull.obj\"]\n");
    folder.write("UCX_hull.obj", folder.read("hull.obj"));
    end = cook({"box.obj", "crate.obj"}, {"--config", "hearth.toml"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    proxies = inspect()["proxies"];
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_TRUE(proxies[0]["sections"][0]["convex"].get<bool>());
    folder.write("UCX_hull.obj", folder.read("box.obj"));
    ASSERT_EQ(cook({"box.obj", "crate.obj"}, {"--config", "hearth.toml"}).exit_code, 0);
    EXPECT_EQ(inspect()["proxies"][0]["triangles"], 12);
}

TEST_F(CookProxies, ofFilesHaveTheMaterialsOfTheirSourceByName)
{
    writeRock();
    folder.write("hull.obj", "mtllib crate.mtl\nv 2 0 0\nv 4 0 0\nv 3 2 0\nv 3 1 -2\n"
                             "usemtl wood\nf 1 2 3\nusemtl tin plate\nf 2 1 4\n"
                             "usemtl moss\nf 3 2 4\nusemtl stone\nf 1 3 4\n");
    const auto cookWithHull = [&](const std::string& source, const std::string& word)
    {
        EXPECT_EQ(cook({source}, {"--proxy", word}).exit_code, 0);
        return extractProxies(1);
    };
    const std::string of_crate = cookWithHull("crate.obj", "hull.obj");
    for (const char* group : {"\ng wood\nf ", "\ng tin_plate\nf "})
        EXPECT_EQ(countOccurrences(of_crate, group), 1u) << of_crate;
    EXPECT_EQ(countOccurrences(of_crate, "\nf "), 4u) << of_crate;
    EXPECT_EQ(countOccurrences(of_crate, "moss") + countOccurrences(of_crate, "stone"), 0u)
        << "materials that the source lacks: " << of_crate;
    const std::string of_rock = cookWithHull("rock.gltf", "Rock=hull.obj");
    for (const char* group : {"\ng moss\nf ", "\ng stone\nf "})
        EXPECT_EQ(countOccurrences(of_rock, group), 1u) << of_rock;
    EXPECT_EQ(countOccurrences(of_rock, "wood"), 0u) << of_rock;
}

TEST_F(CookProxies, E1000_filesOfNoMesh)
{
    writeRock();
    const auto expectFault = [&](const std::vector<std::string>& sources,
                                 const std::vector<std::string>& options, const std::string& text,
                                 int exit_code = 2)
    {
        const ProgramEnd end = cook(sources, options);
        EXPECT_EQ(end.exit_code, exit_code) << end.err;
        EXPECT_NE(end.err.find(text), std::string::npos) << text << " is not in: " << end.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "a.hearth"));
    };
    expectFault({"rock.gltf"}, {"--proxy", "box.obj"}, "which mesh it is for is not said");
    expectFault({"rock.gltf"}, {"--proxy", "Rok=box.obj"}, "the source draws no mesh \"Rok\"");
    expectFault({"rock.gltf"}, {"--proxy", "Rok=box.obj"}, "box, log, rock");
    expectFault({"box.obj"}, {"--proxy", "crate=crate.obj"}, "the source draws no mesh \"crate\"");
    expectFault({"box.obj"}, {"--proxy", "=crate.obj"}, "must be a file, or the name");
    expectFault({"box.obj"}, {"--proxy", "lost.obj"}, "lost.obj: error: ", 66);
    expectFault({"box.obj"}, {"--proxy", "lost.obj"}, "is sought in the folder of box.obj", 66);
    expectFault({"box.obj"}, {"--proxy", "../box.obj"}, "is sought in the folder of box.obj", 65);
    expectFault({"box.obj"}, {"--proxy-error", "0.1"}, "has no effect: proxy.from of no source needs it");
    expectFault({"box.obj", "crate.obj"}, {"--proxy", "box.obj"}, "needs a cook of one source");
    expectFault({"box.obj"}, {"--proxy", "crate.obj", "--proxy-from", "source"}, "leaves proxies out");
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
