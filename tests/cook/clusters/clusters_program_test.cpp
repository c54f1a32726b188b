// Runs hearth-clusters as a user would: its input, its output and its exit codes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "formats/pack/pack_check.h"
#include "tests/support/sandbox.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace
{

using namespace hearth;

constexpr const char* kImport = HEARTH_BIN "/hearth-import";

const std::string kProgram = HEARTH_BIN "/hearth-clusters";

std::string formatObj(const mesh::SourceMesh& mesh)
{
    std::ostringstream text;
    for (const Float3& p : mesh.positions)
        text << "v " << p.x << " " << p.y << " " << p.z << "\n";
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        text << "f " << mesh.indices[i] + 1 << " " << mesh.indices[i + 1] + 1 << " "
             << mesh.indices[i + 2] + 1 << "\n";
    return text.str();
}

class ClustersProgram : public ::testing::Test
{
protected:
    ClustersProgram() { sandbox_.write("rock.obj", formatObj(shapes::rock(16, 0.3f))); }

    test::ProgramEnd run(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), kProgram);
        return sandbox_.run(arguments);
    }

    test::Sandbox sandbox_;
};

TEST_F(ClustersProgram, readsASourceAsItReadsItsPart)
{
    ASSERT_EQ(run({"rock.obj", "-o", "direct.part"}).exit_code, 0);
    ASSERT_EQ(sandbox_.run({kImport, "rock.obj", "-o", "import.part"}).exit_code, 0);
    ASSERT_EQ(run({"import.part", "-o", "two-steps.part"}).exit_code, 0);
    EXPECT_EQ(sandbox_.read("direct.part"), sandbox_.read("two-steps.part"));
    EXPECT_EQ(sandbox_.list(),
              (std::vector<std::string>{"direct.part", "import.part", "rock.obj", "two-steps.part"}))
        << "the private folder is gone";

    auto reader = formats::ContainerReader::open(sandbox_ / "direct.part");
    ASSERT_TRUE(reader.ok());
    const auto view = formats::PackView::read(std::move(*reader));
    ASSERT_TRUE(view.ok());
    EXPECT_TRUE(formats::checkHierarchy(*view).ok());
    EXPECT_EQ(view->meshes()[0].source_triangles, 12u * 16 * 16);
}

TEST_F(ClustersProgram, keepsTheWordsAndTheCodeOfTheImport)
{
    sandbox_.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    const test::ProgramEnd broken = run({"broken.obj", "-o", "out.part"});
    EXPECT_EQ(broken.exit_code, 65);
    EXPECT_NE(broken.err.find("broken.obj|line 2"), std::string::npos) << broken.err;
    const test::ProgramEnd missing = run({"no.obj", "-o", "out.part"});
    EXPECT_EQ(missing.exit_code, 66);
    EXPECT_NE(missing.err.find("no.obj: error:"), std::string::npos) << missing.err;
    EXPECT_EQ(sandbox_.list(), (std::vector<std::string>{"broken.obj", "rock.obj"}));
}

TEST_F(ClustersProgram, saysWhereItsOutputCannotBe)
{
    const test::ProgramEnd end = run({"rock.obj", "-o", "no/such/folder/out.part"});
    EXPECT_EQ(end.exit_code, 73) << end.err;
}

TEST_F(ClustersProgram, writesStatisticsThatDoNotDifferFromRunToRun)
{
    const test::ProgramEnd end = run({"rock.obj", "-o", "rock.part", "--stats", "-"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    ASSERT_EQ(run({"rock.obj", "-o", "rock.part", "--stats", "stats.json", "-j", "1"}).exit_code, 0);
    EXPECT_EQ(sandbox_.read("stats.json"), end.out);

    const Json json = Json::parse(end.out).value();
    EXPECT_EQ(json.at("schema"), "hearth.clusters/1");
    EXPECT_EQ(json.at("source"), "rock.obj");
    const Json& mesh = json.at("meshes").at(0);
    EXPECT_FALSE(mesh.contains("seconds"));
    EXPECT_EQ(mesh.at("source").at("triangles"), 3072);
    const Json& levels = mesh.at("levels");
    EXPECT_EQ(levels.at(0).at("triangles"), 3072);
    EXPECT_EQ(levels.at(0).at("clusters"), 24);
    EXPECT_EQ(levels.at(0).at("fill"), 1.0);
    EXPECT_EQ(levels.at(0).at("max_error"), 0.0);
    for (size_t l = 1; l < levels.size(); ++l)
    {
        EXPECT_GT(levels[l].at("mean_error").get<double>(), levels[l - 1].at("mean_error").get<double>());
        EXPECT_LE(levels[l].at("mean_error").get<double>(), levels[l].at("max_error").get<double>());
        EXPECT_LT(levels[l].at("triangles").get<double>(), levels[l - 1].at("triangles").get<double>());
    }
    for (const char* error : {"position_error", "normal_error"})
    {
        EXPECT_EQ(levels.at(0).at(error).at("max"), 0.0);
        EXPECT_GT(levels.at(1).at(error).at("mean").get<double>(), 0.0);
        EXPECT_LE(levels.at(1).at(error).at("mean").get<double>(),
                  levels.at(1).at(error).at("max").get<double>());
    }
    EXPECT_EQ(levels.at(1).at("uv_error").at("max"), 0.0) << "the source has no UVs";
    const Json& manual = mesh.at("discrete_lods");
    EXPECT_EQ(manual.at("lods").at(0).at("triangles"), 3072);
    EXPECT_EQ(manual.at("hierarchy_of_bytes"),
              manual.at("hierarchy_bytes").get<double>() / manual.at("bytes").get<double>());
    EXPECT_GT(manual.at("hierarchy_bytes").get<double>(), mesh.at("bytes").at("pages_stored").get<double>());
    EXPECT_EQ(json.at("totals").at("triangles"), 3072);
    EXPECT_EQ(json.at("totals").at("discrete_lods").at("bytes"), manual.at("bytes"));
    const Json& bytes = mesh.at("bytes");
    EXPECT_GT(bytes.at("pages").get<double>(), bytes.at("pages_stored").get<double>());
    EXPECT_EQ(bytes.at("pages_per_triangle"), bytes.at("pages").get<double>() / 3072);
}

TEST_F(ClustersProgram, followsAProfile)
{
    sandbox_.write("house.toml",
                   "[[clusters.mesh]]\nname = 'rock*'\n"
                   "targets = [{ level = 1, triangles = 2000 }, { level = 2, triangles = 5 }]\n");
    const test::ProgramEnd end =
        run({"rock.obj", "-o", "rock.part", "--profile", "house.toml", "--stats", "-"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json targets = Json::parse(end.out).value().at("meshes").at(0).at("targets");
    EXPECT_NEAR(targets.at(0).at("triangles").get<double>(), 2000, 60);
    EXPECT_EQ(targets.at(1).at("wanted"), 5);
    EXPECT_NE(end.err.find("mesh 0 'rock' has no 5 triangles at level 2, but"), std::string::npos) << end.err;
    EXPECT_EQ(end.err.find("at level 1"), std::string::npos) << end.err;

    sandbox_.write("bad.toml", "[clusters]\nlevels = [{ keep = 2 }]\n");
    const test::ProgramEnd bad = run({"rock.obj", "-o", "bad.part", "--profile", "bad.toml"});
    EXPECT_EQ(bad.exit_code, 78);
    EXPECT_NE(bad.err.find("bad.toml|line 2, clusters.levels[0].keep: error:"), std::string::npos) << bad.err;
    EXPECT_FALSE(sandbox_.has("bad.part"));

    // settings for the import are passed on to it
    sandbox_.write("clips.toml", "[animation]\nerror = -1\n");
    const test::ProgramEnd clips = run({"rock.obj", "-o", "bad.part", "--profile", "clips.toml"});
    EXPECT_EQ(clips.exit_code, 78);
    EXPECT_NE(clips.err.find("clips.toml|line 2, animation.error: error:"), std::string::npos) << clips.err;
}

TEST_F(ClustersProgram, isToldWhatAProfileWouldSay)
{
    sandbox_.write("house.toml", "[clusters]\nlevels = [{ keep = 0.3 }]\nnormal_bits = 16\n");
    ASSERT_EQ(run({"rock.obj", "-o", "file.part", "--profile", "house.toml"}).exit_code, 0);
    ASSERT_EQ(run({"rock.obj", "-o", "words.part", "--set", "clusters.levels=[{keep=0.3}]", "--set",
                   "clusters.normal_bits=16"})
                  .exit_code,
              0);
    EXPECT_EQ(sandbox_.read("file.part"), sandbox_.read("words.part"));

    const test::ProgramEnd bad = run({"rock.obj", "-o", "bad.part", "--set", "clusters.normal_bits=9"});
    EXPECT_EQ(bad.exit_code, 78);
    EXPECT_NE(bad.err.find("--set|line 1, clusters.normal_bits: error: must be 8 or 16"), std::string::npos)
        << bad.err;
    const test::ProgramEnd clips = run({"rock.obj", "-o", "bad.part", "--set", "animation.error=-1"});
    EXPECT_EQ(clips.exit_code, 78);
    EXPECT_NE(clips.err.find("--set|line 1, animation.error: error:"), std::string::npos) << clips.err;
}

TEST_F(ClustersProgram, codesNormalsAsAProfileSays)
{
    const auto isFine = [&](int bits)
    {
        sandbox_.write("house.toml",
                       "[[clusters.mesh]]\nname = 'rock'\nnormal_bits = " + std::to_string(bits) + "\n");
        EXPECT_EQ(run({"rock.obj", "-o", "rock.part", "--profile", "house.toml"}).exit_code, 0);
        auto reader = formats::ContainerReader::open(sandbox_ / "rock.part");
        EXPECT_TRUE(reader.ok());
        const auto view = formats::PackView::read(std::move(*reader));
        EXPECT_TRUE(view.ok());
        return (view->meshes()[0].attributes & formats::kVertexNormal16) != 0;
    };
    EXPECT_FALSE(isFine(8));
    EXPECT_TRUE(isFine(16));
}

TEST_F(ClustersProgram, givesVerticesAnOpenVisibilityOnRequest)
{
    for (const bool wanted : {false, true})
    {
        std::vector<std::string> arguments{"rock.obj", "-o", "rock.part"};
        if (wanted)
            arguments.push_back("--visibility");
        ASSERT_EQ(run(arguments).exit_code, 0);
        auto reader = formats::ContainerReader::open(sandbox_ / "rock.part");
        ASSERT_TRUE(reader.ok());
        const auto view = formats::PackView::read(std::move(*reader));
        ASSERT_TRUE(view.ok());
        const formats::MeshRecord& mesh = view->meshes()[0];
        ASSERT_EQ((mesh.attributes & formats::kVertexVisibility) != 0, wanted);
        const std::vector<std::byte> page = view->decodePage(0).value();
        const auto cluster = formats::ClusterGeometry::at(page, view->clusters()[0], mesh);
        ASSERT_TRUE(cluster.has_value());
        for (uint32_t v = 0; wanted && v < cluster->vertexCount(); ++v)
            ASSERT_EQ(cluster->visibilityCode(v), formats::kVisibilityUnoccluded);
    }
}

TEST_F(ClustersProgram, takesLevelsMadeByHandAsTheImportDoes)
{
    sandbox_.write("low.obj", formatObj(shapes::rock(8, 0.3f)));
    ASSERT_EQ(run({"rock.obj", "--lod", "1=low.obj", "-o", "direct.part"}).exit_code, 0);
    ASSERT_EQ(sandbox_.run({kImport, "rock.obj", "--lod", "1=low.obj", "-o", "import.part"}).exit_code, 0);
    ASSERT_EQ(run({"import.part", "-o", "two-steps.part"}).exit_code, 0);
    EXPECT_EQ(sandbox_.read("direct.part"), sandbox_.read("two-steps.part"));
    ASSERT_EQ(run({"rock.obj", "-o", "plain.part"}).exit_code, 0);
    EXPECT_NE(sandbox_.read("direct.part"), sandbox_.read("plain.part"));

    const test::ProgramEnd late = run({"import.part", "--lod", "1=low.obj", "-o", "out.part"});
    EXPECT_EQ(late.exit_code, 2);
    EXPECT_NE(late.err.find("--lod"), std::string::npos) << late.err;
    EXPECT_FALSE(sandbox_.has("out.part"));
}

TEST_F(ClustersProgram, findsTheMaterialsOfAProfileByName)
{
    sandbox_.write("rock.mtl", "newmtl stone\nKd 1 0 0\n");
    sandbox_.write("stone.obj", "mtllib rock.mtl\nusemtl stone\n" + formatObj(shapes::rock(16, 0.3f)));
    sandbox_.write("house.toml", "[[clusters.material]]\nname = 'st*'\nlevels = [{ keep = 0.85 }]\n");
    const auto trianglesOfLevel1 = [&](const std::string& source)
    {
        const test::ProgramEnd end =
            run({source, "-o", "rock.part", "--profile", "house.toml", "--stats", "-"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return Json::parse(end.out).value().at("meshes").at(0).at("levels").at(1).at("triangles").get<int>();
    };
    EXPECT_GT(trianglesOfLevel1("stone.obj"), 3072 * 3 / 4);
    EXPECT_LE(trianglesOfLevel1("rock.obj"), 3072 / 2) << "another material";
}

TEST_F(ClustersProgram, addsTimesOnRequest)
{
    const test::ProgramEnd end = run({"rock.obj", "-o", "rock.part", "--stats", "-", "--stats-times"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_GT(Json::parse(end.out).value().at("meshes").at(0).at("seconds").get<double>(), 0.0);
    EXPECT_EQ(run({"rock.obj", "-o", "rock.part", "--stats-times"}).exit_code, 2);
}

TEST_F(ClustersProgram, writesALevelAsObj)
{
    const test::ProgramEnd end = run(
        {"rock.obj", "-o", "rock.part", "--stats", "-", "--debug-level", "1", "--debug-output", "level.obj"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const Json level = Json::parse(end.out).value().at("meshes").at(0).at("levels").at(1);
    std::istringstream text(sandbox_.read("level.obj"));
    size_t faces = 0, vertices = 0;
    std::set<std::string> groups;
    for (std::string line; std::getline(text, line);)
    {
        vertices += line.starts_with("v ") ? 1u : 0u;
        if (line.starts_with("g "))
            groups.insert(line);
        if (!line.starts_with("f "))
            continue;
        ++faces;
        std::istringstream corners(line.substr(2));
        for (size_t corner = 0; corners >> corner;)
            EXPECT_TRUE(corner >= 1 && corner <= vertices) << line;
    }
    EXPECT_EQ(level.at("triangles"), faces);
    EXPECT_EQ(level.at("clusters"), groups.size());
}

TEST_F(ClustersProgram, writesALevelAsPlyWithAColourForEachCluster)
{
    ASSERT_EQ(run({"rock.obj", "-o", "rock.part", "--debug-output", "level.ply"}).exit_code, 0);
    const std::string ply = sandbox_.read("level.ply");
    const size_t end = ply.find("end_header\n") + 11;
    const size_t vertices = std::stoul(ply.substr(ply.find("element vertex ") + 15));
    const size_t faces = std::stoul(ply.substr(ply.find("element face ") + 13));
    EXPECT_EQ(faces, 3072u);
    EXPECT_EQ(ply.size(), end + vertices * 15 + faces * 13);
    std::set<std::string> colors;
    for (size_t v = 0; v < vertices; ++v)
        colors.insert(ply.substr(end + v * 15 + 12, 3));
    EXPECT_EQ(colors.size(), 24u) << "one for each cluster of level 0";

    // and hearth-import can read it back
    EXPECT_EQ(sandbox_.run({kImport, "level.ply", "-o", "again.part"}).exit_code, 0);
}

TEST_F(ClustersProgram, refusesToDumpWhatIsNotThere)
{
    EXPECT_EQ(run({"rock.obj", "-o", "rock.part", "--debug-output", "level.stl"}).exit_code, 2);
    EXPECT_EQ(
        run({"rock.obj", "-o", "rock.part", "--debug-output", "level.ply", "--debug-mesh", "1"}).exit_code,
        2);
    const test::ProgramEnd level =
        run({"rock.obj", "-o", "rock.part", "--debug-output", "level.ply", "--debug-level", "40"});
    EXPECT_EQ(level.exit_code, 2);
    EXPECT_NE(level.err.find("there is no level 40"), std::string::npos) << level.err;
    EXPECT_EQ(run({"rock.obj", "-o", "rock.part", "--debug-output", "no/level.ply"}).exit_code, 73);
    EXPECT_EQ(sandbox_.list(), std::vector<std::string>{"rock.obj"});
}

} // namespace
