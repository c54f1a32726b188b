// Tests authored LODs as files of one folder, found by their names or by rules, with the real cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "formats/pack/pack_view.h"
#include "tests/support/json_schema.h"
#include "tests/support/sandbox.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

using namespace formats;

constexpr uint32_t kMidTriangles = 2 * 6 * 6, kLowTriangles = 2;

/// Lines of a square of n x n quads: "PREFIX x y z" for each vertex, then "FACE a b c d", counted from
/// `first`.
std::string squareLines(int n, const std::string& vertex, const std::string& face, int first)
{
    std::string text;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            text += vertex + std::to_string(static_cast<double>(x) / n) + " " +
                    std::to_string(static_cast<double>(y) / n) + " 0\n";
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
        {
            const int a = y * (n + 1) + x + first;
            text += face + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + n + 2) +
                    " " + std::to_string(a + n + 1) + "\n";
        }
    return text;
}

std::string objSquare(int n)
{
    return squareLines(n, "v ", "f ", 1);
}

std::string plySquare(int n)
{
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string((n + 1) * (n + 1)) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(n * n) +
           "\nproperty list uchar int vertex_indices\nend_header\n" + squareLines(n, "", "4 ", 0);
}

/// Record of a level in chunk ALVL.
struct Level
{
    uint32_t triangles;
    uint32_t number;
    std::string name;

    bool operator==(const Level&) const = default;
};

void PrintTo(const Level& level, std::ostream* out)
{
    *out << level.name << " (" << level.number << "), " << level.triangles << " triangles";
}

struct Scene
{
    size_t instances = 0;
    std::vector<Level> authored;
    bool has_chunk = false;
};

const std::vector<Level> kLevelsOfRock{{kMidTriangles, 1, "rock_LOD1.ply"},
                                       {kLowTriangles, 3, "Rock_lod3.obj"}};

class LodFiles : public ::testing::Test
{
protected:
    LodFiles()
    {
        fs::create_directory(folder / "props");
        folder.write("props/rock_LOD0.obj", objSquare(20));
        folder.write("props/rock_LOD1.ply", plySquare(6));
        folder.write("props/Rock_lod3.obj", objSquare(1));
        folder.write("props/tree.obj", objSquare(2));
    }

    ProgramEnd hearth(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth");
        return folder.run(arguments);
    }

    /// Cook into a.hearth.
    ProgramEnd cook(std::vector<std::string> arguments)
    {
        fs::remove(folder / "a.hearth");
        arguments.insert(arguments.begin(), "cook");
        arguments.insert(arguments.end(), {"-o", "a.hearth"});
        return hearth(arguments);
    }

    /// Return the bytes of the pack.
    std::string cookPack(const std::vector<std::string>& arguments)
    {
        const ProgramEnd end = cook(arguments);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return folder.read("a.hearth");
    }

    Scene cookScene(const std::vector<std::string>& arguments)
    {
        cookPack(arguments);
        auto reader = ContainerReader::open(folder / "a.hearth");
        EXPECT_TRUE(reader.ok());
        const bool has_chunk = reader->find(kChunkAuthoredLevels) != nullptr;
        const auto pack = PackView::read(std::move(*reader));
        EXPECT_TRUE(pack.ok());
        Scene scene{pack->instances().size(), {}, has_chunk};
        for (const AuthoredLevelRecord& record : pack->authoredLevels())
        {
            const MeshRecord& mesh = pack->meshes()[record.mesh];
            scene.authored.push_back({pack->levels()[mesh.levels.first + record.level].triangle_count,
                                      record.number, std::string(pack->text(record.name))});
        }
        EXPECT_EQ(hearth({"verify", "a.hearth"}).exit_code, 0);
        return scene;
    }

    Sandbox folder;
};

} // namespace

TEST_F(LodFiles, ofAFolderAreOneSource)
{
    const Scene scene = cookScene({"props"});
    EXPECT_EQ(scene.instances, 2u) << "the rock and the tree";
    EXPECT_EQ(scene.authored, kLevelsOfRock);
}

TEST_F(LodFiles, areThoseOfTheirSourceBehindOthers)
{
    const std::vector<std::string> sources{"props/tree.obj", "props/rock_*", "props/Rock_*"};
    EXPECT_EQ(cookScene(sources).authored, kLevelsOfRock);
    std::vector<std::string> visible = sources;
    visible.insert(visible.end(), {"--visibility", "--visibility-quality", "draft"});
    EXPECT_EQ(cookScene(visible).authored, kLevelsOfRock)
        << "the visibility cooker keeps what it does not know";
}

TEST_F(LodFiles, areShownWithTheNumbersOfTheirNames)
{
    cookPack({"props"});
    const std::string text = hearth({"inspect", "a.hearth"}).out;
    EXPECT_NE(text.find("  by hand: rock_LOD1.ply (LOD 1)\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  by hand: Rock_lod3.obj (LOD 3)\n"), std::string::npos) << text;
    const Json json = Json::parse(hearth({"inspect", "a.hearth", "--format", "json"}).out).value();
    EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.inspect.1.json", json), "");
    std::vector<std::string> shown;
    for (const Json& level : json["meshes"][0]["levels"])
        if (const Json* authored = level.find("authored"))
            shown.push_back(authored->dump());
    EXPECT_EQ(shown, (std::vector<std::string>{R"({"name":"rock_LOD1.ply","number":1})",
                                               R"({"name":"Rock_lod3.obj","number":3})"}));
}

TEST_F(LodFiles, areTheSameHoweverTheyAreNamed)
{
    const std::string of_folder = cookPack({"props"});
    EXPECT_EQ(cookPack({"props/*"}), of_folder);
    EXPECT_EQ(cookPack({"./props/Rock_lod3.obj", "props/rock_LOD1.ply", "props/rock_LOD0.obj",
                        "props/tree.obj", "props/rock_LOD1.ply"}),
              of_folder);
    EXPECT_EQ(cookPack({"props/rock_*", "props/Rock_*"}),
              cookPack({"props/rock_LOD0.obj", "--lod", "3=props/Rock_lod3.obj", "--lod",
                        "1=props/rock_LOD1.ply"}));
}

TEST_F(LodFiles, standAloneWithoutALevel0)
{
    fs::rename(folder / "props/rock_LOD0.obj", folder / "props/rock.obj");
    const Scene scene = cookScene({"props"});
    EXPECT_EQ(scene.instances, 4u);
    EXPECT_FALSE(scene.has_chunk);
}

TEST_F(LodFiles, ofTwoFoldersAreStrangers)
{
    fs::create_directory(folder / "props/far");
    fs::rename(folder / "props/rock_LOD1.ply", folder / "props/far/rock_LOD1.ply");
    const Scene scene = cookScene({"props"});
    EXPECT_EQ(scene.instances, 3u);
    EXPECT_EQ(scene.authored, (std::vector<Level>{{kLowTriangles, 3, "Rock_lod3.obj"}}));
}

TEST_F(LodFiles, warnOfOneLevel)
{
    folder.write("props/rock_LOD1.obj", objSquare(5));
    const ProgramEnd end = cook({"props"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_NE(end.err.find("props/rock_LOD1.ply: warning: is level 1 of props/rock_LOD0.obj, as is "
                           "props/rock_LOD1.obj, which is used: this file is left out [W1514] hint: "),
              std::string::npos)
        << end.err;
    EXPECT_NE(end.err.find("1 file that no source uses (props/rock_LOD1.ply)"), std::string::npos) << end.err;
    EXPECT_EQ(cookScene({"props"}).authored,
              (std::vector<Level>{{2 * 5 * 5, 1, "rock_LOD1.obj"}, kLevelsOfRock[1]}));
    EXPECT_NE(cook({"props", "--warnings-as-errors=W1514"}).exit_code, 0);
    const ProgramEnd planned = hearth({"plan", "props", "-o", "p.json"});
    EXPECT_EQ(countOccurrences(planned.err, "[W1514]"), 1u) << planned.err;
}

TEST_F(LodFiles, warnOfTwoLevels0)
{
    folder.write("props/rock_LOD0.ply", plySquare(9));
    const ProgramEnd end = cook({"props"});
    EXPECT_NE(end.err.find("props/rock_LOD0.ply: warning: is level 0, as is props/rock_LOD0.obj"),
              std::string::npos)
        << end.err;
    const Scene scene = cookScene({"props"});
    EXPECT_EQ(scene.instances, 3u);
    EXPECT_EQ(scene.authored, kLevelsOfRock);
}

TEST_F(LodFiles, standAloneWhereARuleSaysSo)
{
    folder.write("hearth.toml", "[[rule]]\nmatch = 'props/rock*'\nimport.lods = []\n");
    const Scene scene = cookScene({"props"});
    EXPECT_EQ(scene.instances, 4u) << "Rock_lod3, which the rule does not match, has no level 0";
    EXPECT_FALSE(scene.has_chunk);
    fs::remove(folder / "hearth.toml");
    EXPECT_EQ(cookScene({"props", "--set", "import.lods=[]"}).instances, 4u);
    folder.write("hearth.toml", "[[rule]]\nmatch = 'props/*.ply'\nimport.lods = []\n");
    const Scene but_one = cookScene({"props"});
    EXPECT_EQ(but_one.instances, 3u);
    EXPECT_EQ(but_one.authored, (std::vector<Level>{kLevelsOfRock[1]}));
}

TEST_F(LodFiles, areThoseThatARuleLists)
{
    fs::rename(folder / "props/rock_LOD0.obj", folder / "props/stone.obj");
    fs::create_directory(folder / "low");
    fs::rename(folder / "props/Rock_lod3.obj", folder / "low/stone.obj");
    fs::rename(folder / "props/rock_LOD1.ply", folder / "props/stone_mid.ply");
    const std::string list = "import.lods = ['stone_mid.ply', '../low/stone.obj']\n";
    const std::vector<Level> expected{{kMidTriangles, 1, "stone_mid.ply"}, {kLowTriangles, 2, "stone.obj"}};
    // in the source alone, and in its LODs too
    for (const char* match : {"props/stone.obj", "props/stone*"})
    {
        folder.write("hearth.toml", std::string("[[rule]]\nmatch = '") + match + "'\n" + list);
        const Scene scene = cookScene({"props"});
        EXPECT_EQ(scene.instances, 2u) << match;
        EXPECT_EQ(scene.authored, expected) << match;
    }
    const ProgramEnd end = cook({"props/stone.obj"});
    EXPECT_EQ(end.err.find("W1513"), std::string::npos) << end.err;
    folder.write("hearth.toml",
                 std::string("[[rule]]\nmatch = 'props/stone_mid.ply'\nclusters.normal_bits = 8\n") +
                     "[[rule]]\nmatch = 'props/stone.obj'\n" + list);
    const ProgramEnd level = cook({"props/stone.obj"});
    EXPECT_EQ(level.err.find("W1513"), std::string::npos) << "it matches a model: " << level.err;
}

TEST_F(LodFiles, thatARuleMakesLevelsOfThemselvesAreRefused)
{
    folder.write("hearth.toml", "[[rule]]\nmatch = 'props/tree.obj'\nimport.lods = ['tree.obj']\n");
    const ProgramEnd itself = cook({"props"});
    EXPECT_EQ(itself.exit_code, 78);
    EXPECT_NE(itself.err.find("hearth.toml:3"), std::string::npos) << itself.err;
    EXPECT_NE(itself.err.find("props/tree.obj, which is the same file"), std::string::npos) << itself.err;
    folder.write("hearth.toml", "[[rule]]\nmatch = 'props/*.obj'\n"
                                "import.lods = ['tree.obj', 'rock_LOD0.obj', 'Rock_lod3.obj']\n");
    const ProgramEnd all = cook({"props"});
    EXPECT_EQ(all.exit_code, 78) << "no source would be left";
    EXPECT_NE(all.err.find("which is a level itself"), std::string::npos) << all.err;
}

TEST_F(LodFiles, ofACommandLineGoOverNamesAndRules)
{
    folder.write("hearth.toml", "[[rule]]\nmatch = '**'\nimport.lods = ['none.obj']\n");
    const Scene scene = cookScene({"props/rock_LOD0.obj", "--lod", "5=props/tree.obj"});
    EXPECT_EQ(scene.authored, (std::vector<Level>{{2 * 2 * 2, 5, "tree.obj"}}));
    const ProgramEnd two = cook({"props/rock_LOD0.obj", "props/rock_LOD1.ply", "--lod", "5=props/tree.obj"});
    EXPECT_EQ(two.exit_code, 2);
    EXPECT_NE(two.err.find("needs a cook of one source"), std::string::npos) << two.err;
}

TEST_F(LodFiles, thatCannotBeGroupedNameTheRemedy)
{
    fs::remove(folder / "props/rock_LOD0.obj");
    folder.write("props/rock_LOD0.gltf",
                 R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"mesh":0,"translation":[2,0,0]}],)"
                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"scenes":[{"nodes":[0,1]}],)"
                 R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3","bufferView":0,)"
                 R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
                 R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                 R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const ProgramEnd end = cook({"props"});
    EXPECT_EQ(end.exit_code, 65) << end.err;
    EXPECT_NE(end.err.find("rock_LOD0.gltf: error: draws 2 meshes"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("import.lods = []"), std::string::npos) << end.err;
    folder.write("hearth.toml", "[[rule]]\nmatch = 'props/rock*'\nimport.lods = []\n");
    EXPECT_EQ(cookScene({"props"}).instances, 5u) << "two of them are of rock_LOD0.gltf";
}

TEST_F(LodFiles, areNotOverwritten)
{
    const std::string before = folder.read("props/rock_LOD1.ply");
    const ProgramEnd end = hearth({"cook", "props", "-o", "props/rock_LOD1.ply"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.err.find("would overwrite a level of detail"), std::string::npos) << end.err;
    EXPECT_EQ(hearth({"cook", "props", "-o", "a.hearth", "--depfile", "props/rock_LOD1.ply"}).exit_code, 2);
    EXPECT_EQ(folder.read("props/rock_LOD1.ply"), before);
}

TEST_F(LodFiles, areNamedByDepfilesAndByWhy)
{
    cookPack({"props", "--depfile", "a.d"});
    EXPECT_NE(folder.read("a.d").find("props/rock_LOD1.ply"), std::string::npos) << folder.read("a.d");
    const ProgramEnd again = cook({"props"});
    EXPECT_EQ(countOccurrences(again.err, "left out"), 0u) << "levels are used: " << again.err;
    folder.write("props/rock_LOD1.ply", plySquare(7));
    const std::string why = hearth({"why", "a.hearth"}).out;
    EXPECT_NE(why.find("rock_LOD1.ply: its content has changed"), std::string::npos) << why;
    EXPECT_EQ(countOccurrences(why, "clusters   props/tree.obj"), 0u) << why;
    EXPECT_EQ(cookScene({"props"}).authored.front(), (Level{2 * 7 * 7, 1, "rock_LOD1.ply"}));
}

TEST_F(LodFiles, areCookedByAFarm)
{
    const std::string local = cookPack({"props"});
    ASSERT_EQ(hearth({"plan", "props", "-o", "p.json", "--shards", "2"}).exit_code, 0);
    const Json plan = Json::parse(folder.read("p.json")).value();
    EXPECT_EQ(plan["cook"]["lods"].dump(), R"([["1=props/rock_LOD1.ply","3=props/Rock_lod3.obj"],[]])");
    for (const char* shard : {"0/2", "1/2"})
        EXPECT_EQ(hearth({"run", "p.json", "--shard", shard}).exit_code, 0);
    ASSERT_EQ(hearth({"merge", "p.json", "-o", "farm.hearth"}).exit_code, 0);
    EXPECT_EQ(folder.read("farm.hearth"), local);
}

} // namespace hearth::test
