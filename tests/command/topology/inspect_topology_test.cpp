// Runs hearth inspect --topology on small sources, beside the real hearth-import and with a script in place
// of hearth-wrap.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/json_schema.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <thread>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;
using testing::Not;

/// Return an OBJ file of cubes of side 1 at places along x. A cube lacks its last `missing` triangles.
std::string makeCubes(const std::vector<int>& places, int missing)
{
    std::string text;
    int first = 1;
    for (const int x : places)
    {
        for (int i = 0; i < 8; ++i)
            text += "v " + std::to_string(x + (i & 1)) + " " + std::to_string(i >> 1 & 1) + " " +
                    std::to_string(i >> 2) + "\n";
        static constexpr int kFaces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                              {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                              {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
        for (int f = 0; f < 12 - missing; ++f)
        {
            text += "f";
            for (const int corner : kFaces[f])
                text += " " + std::to_string(first + corner);
            text += "\n";
        }
        first += 8;
    }
    return text;
}

class InspectTopology : public ::testing::Test
{
protected:
    InspectTopology()
    {
        for (const char* program : {"hearth", "hearth-import"})
            std::filesystem::copy(std::string(HEARTH_BIN "/") + program, programs / program);
        folder.write("cubes.obj", makeCubes({0, 2, 4}, 0));
        folder.write("open.obj", makeCubes({0}, 2));
    }

    ProgramEnd inspect(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {programs / "hearth", "inspect"});
        arguments.push_back("--topology");
        return folder.run(arguments);
    }

    Json inspectJson(const std::string& source)
    {
        const ProgramEnd end = inspect({source, "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        const Json json = Json::parse(end.out).value_or(Json());
        EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.topology.1.json", json), "");
        return json;
    }

    Sandbox programs;
    Sandbox folder;
};

/// Rows of a PLY file that the command wrote.
struct Ply
{
    std::string header;
    std::map<std::string, size_t> counts;
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<int, 2>> edges;
};

Ply parsePly(const std::string& bytes)
{
    Ply ply;
    const std::string end = "end_header\n";
    const size_t data = bytes.find(end) + end.size();
    ply.header = bytes.substr(0, data);
    for (const char* element : {"vertex", "face", "edge"})
    {
        const std::string words = std::string("element ") + element + " ";
        ply.counts[element] = std::stoul(ply.header.substr(ply.header.find(words) + words.size()));
    }
    constexpr size_t kVertex = 3 * 4 + 3, kFace = 1 + 3 * 4 + 3, kEdge = 2 * 4 + 3;
    EXPECT_EQ(bytes.size(), data + ply.counts["vertex"] * kVertex + ply.counts["face"] * kFace +
                                ply.counts["edge"] * kEdge);
    ply.positions.resize(ply.counts["vertex"]);
    for (size_t i = 0; i < ply.positions.size(); ++i)
        std::memcpy(&ply.positions[i], bytes.data() + data + i * kVertex, 12);
    ply.edges.resize(ply.counts["edge"]);
    const size_t edges = data + ply.counts["vertex"] * kVertex + ply.counts["face"] * kFace;
    for (size_t i = 0; i < ply.edges.size(); ++i)
        std::memcpy(&ply.edges[i], bytes.data() + edges + i * kEdge, 8);
    return ply;
}

} // namespace

TEST_F(InspectTopology, hasNoFindingsOfSolids)
{
    const ProgramEnd end = inspect({"cubes.obj"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("cubes.obj: 1 mesh, 0 with findings"));
    EXPECT_THAT(end.out, HasSubstr("3 components, 3 shells (3 outward of genus 0)"));
    EXPECT_THAT(end.out, Not(HasSubstr("advice")));
    const Json mesh = inspectJson("cubes.obj")["meshes"][0];
    EXPECT_EQ(mesh["shells"]["closed"], 3);
    EXPECT_EQ(mesh["boundary_loops"]["count"], 0);
    EXPECT_EQ(mesh["shells"]["list"][0]["volume"].get<double>(), 1.0);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"cubes.obj", "open.obj"}));
}

TEST_F(InspectTopology, reportsAHoleWithAdviceAndAsGeometry)
{
    const ProgramEnd end = inspect({"open.obj", "--ply", "holes.ply"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("boundary loops: 4 edges, 4 m; the longest of 4 m at (1, "));
    EXPECT_THAT(end.out, HasSubstr("boundary loops: the surface ends there."));
    const Json loops = inspectJson("open.obj")["meshes"][0]["boundary_loops"];
    EXPECT_EQ(loops["count"], 1);
    EXPECT_EQ(loops["length"].get<double>(), 4.0);
    EXPECT_EQ(loops["list"][0]["edges"], 4);

    const Ply ply = parsePly(folder.read("holes.ply"));
    EXPECT_THAT(ply.header, HasSubstr("comment 1 boundary loops: colour 60 180 75\n"));
    ASSERT_EQ(ply.edges.size(), 4u);
    for (const auto& edge : ply.edges)
        for (const int end_of_edge : edge)
            EXPECT_EQ(ply.positions.at(static_cast<size_t>(end_of_edge))[0], 1); // the side that is missing
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"cubes.obj", "holes.ply", "open.obj"}));
}

TEST_F(InspectTopology, writesAFileOfEachKindIntoAFolder)
{
    std::filesystem::create_directory(folder / "found");
    folder.write("twice.obj", makeCubes({0}, 2) + "f 1 3 4\n");
    ASSERT_EQ(inspect({"twice.obj", "--ply", "found"}).exit_code, 0);
    EXPECT_EQ(parsePly(folder.read("found/boundary_loops.ply")).counts,
              (std::map<std::string, size_t>{{"vertex", 4}, {"face", 0}, {"edge", 4}}));
    EXPECT_EQ(parsePly(folder.read("found/doubled_triangles.ply")).counts,
              (std::map<std::string, size_t>{{"vertex", 3}, {"face", 1}, {"edge", 0}}));
    folder.write("found/mine.ply", "of the artist");
    ASSERT_EQ(inspect({"open.obj", "--ply", "found"}).exit_code, 0); // without the copy
    EXPECT_TRUE(folder.has("found/boundary_loops.ply"));
    EXPECT_FALSE(folder.has("found/doubled_triangles.ply"));
    EXPECT_TRUE(folder.has("found/mine.ply"));
}

TEST_F(InspectTopology, placesFindingsWhereTheSceneHasTheMesh)
{
    // a triangle, drawn at x = 10
    folder.write("scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [10, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const ProgramEnd written = inspect({"scene.gltf", "--ply", "scene.ply"});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    const Ply ply = parsePly(folder.read("scene.ply"));
    ASSERT_EQ(ply.positions.size(), 3u);
    for (const auto& position : ply.positions)
        EXPECT_GE(position[0], 10);
}

TEST_F(InspectTopology, takesAnImportPartAndNoPack)
{
    ASSERT_EQ(folder.run({programs / "hearth-import", "open.obj", "-o", "open.part"}).exit_code, 0);
    Json of_part = inspectJson("open.part"), of_source = inspectJson("open.obj");
    of_part["source"] = of_source["source"] = "";
    EXPECT_EQ(of_part, of_source);
    writePackFile(smallPack(), folder / "small.hearth");
    const ProgramEnd pack = inspect({"small.hearth"});
    EXPECT_EQ(pack.exit_code, 65);
    EXPECT_THAT(pack.err, HasSubstr("this is a pack, not a part [E2014]"));
}

TEST_F(InspectTopology, passesOnTheErrorsOfTheImporter)
{
    folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    for (const char* source : {"bad.obj", "missing.obj", "."})
    {
        const ProgramEnd import = folder.run({programs / "hearth-import", source, "-o", "bad.part"});
        const ProgramEnd end = inspect({source});
        EXPECT_NE(end.exit_code, 0);
        EXPECT_EQ(end.exit_code, import.exit_code);
        EXPECT_EQ(end.err, import.err);
        EXPECT_EQ(end.out, "");
    }
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"bad.obj", "cubes.obj", "open.obj"}));
}

TEST_F(InspectTopology, saysThatSelfIntersectionsNeedHearthWrap)
{
    EXPECT_THAT(inspect({"open.obj"}).out,
                HasSubstr("self-intersections were not checked: hearth-wrap is not installed"));
    const Json json = inspectJson("open.obj");
    EXPECT_EQ(json["self_intersections_not_checked"], "hearth-wrap is not installed");
    EXPECT_FALSE(json["meshes"][0].contains("self_intersections"));
}

TEST_F(InspectTopology, reportsTheIntersectionsThatHearthWrapFinds)
{
    programs.write("hearth-wrap", R"(#!/bin/sh
[ "$2" = --self-intersections ] && [ -s "$1" ] || exit 2
echo '{"meshes": [{"mesh": 0, "name": "open", "intersecting_triangle_pairs": 7, "pairs": [[3, 5], [0, 3], [3, 10]]}]}' > "$3"
)",
                   true);
    const ProgramEnd end = inspect({"open.obj", "--ply", "found.ply"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("         7  intersecting triangles: pairs; the first at (0, 0, 1)\n"));
    EXPECT_THAT(end.out, Not(HasSubstr("not checked")));
    EXPECT_EQ(parsePly(folder.read("found.ply")).counts["face"], 3u);
    // triangle 10 is none of the mesh
    const Json found = inspectJson("open.obj")["meshes"][0]["self_intersections"];
    EXPECT_EQ(found["count"], 7);
    EXPECT_EQ(found["list"], (Json::array({Json::array({3, 5}), Json::array({0, 3})})));
}

TEST_F(InspectTopology, goesOnWhereHearthWrapFails)
{
    for (const auto& [script, reason] :
         {std::pair{"echo 'open.obj: error: too large [E1003] hint: split' >&2; exit 65", "too large"},
          std::pair{"exit 0", "hearth-wrap wrote no JSON"}, std::pair{"echo '{' > $3", "wrote no JSON"},
          std::pair{"echo '{\"meshes\": 3}' > $3", "wrote other JSON than expected"}})
    {
        programs.write("hearth-wrap", "#!/bin/sh\n" + std::string(script) + "\n", true);
        const ProgramEnd end = inspect({"open.obj"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_THAT(end.out, HasSubstr("1  boundary loops"));
        EXPECT_THAT(end.out, HasSubstr("self-intersections were not checked: "));
        EXPECT_THAT(end.out, HasSubstr(reason));
    }
}

TEST_F(InspectTopology, endsWithHearthWrapWhereItIsInterrupted)
{
    programs.write("hearth-wrap", "#!/bin/sh\n: > " + (folder / "started") + "\nexec sleep 60\n", true);
    const pid_t process = folder.start({programs / "hearth", "inspect", "open.obj", "--topology"});
    while (!folder.has("started"))
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(process, SIGTERM);
    const ProgramEnd end = folder.finish(process);
    EXPECT_EQ(end.exit_code, 130);
    EXPECT_EQ(end.out, "");
}

TEST_F(InspectTopology, writesNoGeometryToAFolderThatIsNotThere)
{
    const ProgramEnd end = inspect({"open.obj", "--ply", "nowhere/found.ply"});
    EXPECT_EQ(end.exit_code, 73);
    EXPECT_THAT(end.err, HasSubstr("nowhere/found.ply"));
    EXPECT_EQ(inspect({"open.obj", "--ply", "-"}).exit_code, 2); // the report goes there
    EXPECT_EQ(folder.run({programs / "hearth", "inspect", "open.obj", "--ply", "a.ply"}).exit_code, 2);
}

} // namespace hearth::test
