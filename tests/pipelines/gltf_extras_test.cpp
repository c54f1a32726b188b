// Tests extras of glTF files: their way into the part as they are written, and messages about what is not
// kept.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/records/extras.h"
#include "pipelines/import/gltf/document/json_source.h"
#include "tests/pipelines/gltf_fixture.h"

#include <gmock/gmock.h>

namespace hearth::import::test
{

namespace
{

using namespace formats;
using testing::ElementsAre;
using testing::HasSubstr;

/// Line "node 3: {...}" for each record of the part's extras.
std::vector<std::string> listExtras(const Imported& result)
{
    EXPECT_TRUE(result.ok()) << result.message();
    if (!result.ok() || result.part->find(kChunkExtras) == nullptr)
        return {};
    const std::string strings = result.text(kChunkStrings);
    std::vector<std::string> lines;
    for (const ExtrasRecord& record : result.records<ExtrasRecord>(kChunkExtras))
        lines.push_back(std::string(kExtrasOwnerNames.at(record.owner)) + " " + std::to_string(record.index) +
                        ": " + strings.substr(record.json.offset, record.json.length));
    return lines;
}

GltfData makeSquare()
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("SCALAR", kSquareIndices);
    return data;
}

const std::string kMesh = R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]})";

/// Warnings that name extras or extensions, as "pointer: text".
std::vector<std::string> listWarnings(const Imported& result, Issue issue)
{
    std::vector<std::string> lines;
    for (const Error& warning : result.warnings)
        if (warning.issue == issue)
            lines.push_back(warning.where + ": " + warning.detail);
    return lines;
}

} // namespace

TEST(CutValues, keepsTheTextButWhiteSpace)
{
    // values in the order of the text: {} 0, "a" 1, [] 2, 1.50 3, "x y" 4, {} 5, null 6, 2 7
    const std::string text =
        " { \"k\" : \"a\" , \"l\":[ 1.50,\n\t\"x \\\" : y\" , { \"n\" : null } ] , \"m\": 2}\r\n";
    const auto cut = [&](std::vector<uint32_t> positions) { return cutValues(text, positions); };
    EXPECT_THAT(cut({0}), ElementsAre(R"({"k":"a","l":[1.50,"x \" : y",{"n":null}],"m":2})"));
    EXPECT_THAT(cut({1, 3, 4, 6, 7}), ElementsAre("\"a\"", "1.50", R"("x \" : y")", "null", "2"));
    EXPECT_THAT(cut({2, 7}), ElementsAre(R"([1.50,"x \" : y",{"n":null}])", "2"));
    EXPECT_TRUE(cut({}).empty());
    EXPECT_THAT(cutValues("-0.0e+10", std::vector<uint32_t>{0}), ElementsAre("-0.0e+10"));
}

TEST(GltfExtras, ofEveryObjectThatIsKept)
{
    const Imported result = makeSquare().import(
        R"("extras":{"file":1},
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","extras":{"light":1}}]}},
        "nodes":[{"mesh":0,"children":[1,2]},
                 {"camera":0,"extras":{"node":1}},
                 {"extensions":{"KHR_lights_punctual":{"light":0}},"extras":"text"}],
        "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1},"extras":{"camera":1}}],
        "scenes":[{"nodes":[0],"extras":{"scene":0}},{"nodes":[0],"extras":{"scene":1}}],"scene":1,
        "materials":[{},{"extras":[null]}],
        "skins":[{"joints":[1],"extras":{"skin":1}}],
        "animations":[{"channels":[],"samplers":[],"extras":{"events":[0.5]}}],
        "meshes":[)" +
        replaced(kMesh, "]}", R"(],"extras":{"targetNames":["a"]}})") + "]");
    EXPECT_THAT(listExtras(result),
                ElementsAre(R"(node 1: {"node":1})", "node 2: \"text\"", R"(mesh 0: {"targetNames":["a"]})",
                            "material 1: [null]", R"(camera 0: {"camera":1})", R"(light 0: {"light":1})",
                            R"(skin 0: {"skin":1})", R"(animation 0: {"events":[0.5]})",
                            R"(scene 0: {"scene":1})", R"(file 0: {"file":1})"));
    EXPECT_THAT(listWarnings(result, Issue::dropped),
                testing::Contains("/scenes/0: extras of this object are not kept"));
}

TEST(GltfExtras, keepEveryDigitAndName)
{
    const std::string extras =
        "{ \"big\" : 12345678901234567890, \"exact\":0.10, \"small\": 1E-300,\n"
        "  \"t\\u00fcr \\/\" : [ 1.0 , -0 , \"\xC3\xBC \" ] , \"again\":1,\"again\":2 }";
    const Imported result =
        makeSquare().import(R"("meshes":[)" + kMesh + R"(],"nodes":[{"mesh":0,"extras":)" + extras + "}]");
    EXPECT_THAT(listExtras(result),
                ElementsAre("node 0: {\"big\":12345678901234567890,\"exact\":0.10,\"small\":1E-300,"
                            "\"t\\u00fcr \\/\":[1.0,-0,\"\xC3\xBC \"],\"again\":1,\"again\":2}"));
}

TEST(GltfExtras, ofTheAssetAreKept)
{
    const std::string json = replaced(makeSquare().json(R"("meshes":[)" + kMesh + "]"), R"("version":"2.0")",
                                      R"("version":"2.0","extras":{"author":"me"})");
    EXPECT_THAT(listExtras(importBytes(glb(json, makeSquare().binary()))),
                ElementsAre(R"(asset 0: {"author":"me"})"));
}

TEST(GltfExtras, followAMeshIntoItsCopies)
{
    // the mesh is drawn with a skin and without: the part has it twice. Two nodes share a camera
    GltfData data = makeSquare();
    data.add("VEC4", std::vector<uint8_t>(16, 0));
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const Imported result = data.import(
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}],
        "extras":{"m":1}}],"skins":[{"joints":[0]}],
        "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1},"extras":{"c":1}},
                   {"type":"perspective","perspective":{"yfov":1,"znear":0.1},"extras":{"c":2}}],
        "nodes":[{"camera":0},{"mesh":0,"skin":0,"camera":0},{"mesh":0}])");
    EXPECT_THAT(listExtras(result), ElementsAre(R"(mesh 0: {"m":1})", R"(mesh 1: {"m":1})",
                                                R"(camera 0: {"c":1})", R"(camera 1: {"c":1})"));
    EXPECT_THAT(listWarnings(result, Issue::dropped),
                testing::Contains("/cameras/1: extras of this object are not kept"))
        << "no node has the camera";
}

TEST(GltfExtras, thatAreNotKeptAreNamed)
{
    const Imported result = makeSquare().import(
        R"("meshes":[)" + replaced(kMesh, R"("indices":1)", R"("indices":1,"extras":{})") +
        R"(],"samplers":[{"extras":1},{},{"extras":2},{"extras":{"extras":3}}],
        "textures":[{"extras":1},{"extras":1}])");
    EXPECT_TRUE(listExtras(result).empty());
    EXPECT_THAT(
        listWarnings(result, Issue::dropped),
        testing::Contains("/meshes/0/primitives/0: extras of this object are not kept (6 places: "
                          "/meshes/0/primitives/0, /samplers/0, /samplers/2, /samplers/3 and 2 more)"));
}

TEST(GltfExtras, areLimited)
{
    const auto importSized = [](size_t bytes)
    {
        return makeSquare().import(R"("meshes":[)" + kMesh + R"(],"nodes":[{},{"mesh":0,"extras":")" +
                                   std::string(bytes - 2, 'x') + "\"}]");
    };
    EXPECT_EQ(listExtras(importSized(size_t{1} << 24)).size(), 1u);
    const Imported large = importSized((size_t{1} << 24) + 1);
    ASSERT_FALSE(large.ok());
    EXPECT_THAT(large.message(),
                HasSubstr("|/nodes/1/extras: error: extras of 16777217 bytes, at most "
                          "16777216 are kept; put so much data into a file of its own [E1003]"));
    const Imported deep = makeSquare().import(R"("extras":)" + std::string(200, '[') + std::string(200, ']'));
    ASSERT_FALSE(deep.ok());
    EXPECT_THAT(deep.message(), HasSubstr("the JSON text is nested more than 128 levels deep [E1100]"));
}

TEST(GltfExtensions, thatAreNotKeptAreNamedWithTheirObjects)
{
    const std::string iridescent = R"({"extensions":{"KHR_materials_iridescence":{"iridescenceFactor":1}}})";
    const Imported result = makeSquare().import(
        R"("extensionsUsed":["KHR_materials_iridescence","EXT_nowhere"],"meshes":[)" + kMesh +
        R"(],"materials":[{},)" + iridescent + ",{}," + iridescent + "," + iridescent +
        R"(],"nodes":[{"mesh":0,"extensions":{"MY~a/b":{}},"extras":{"extensions":{"NOT_ONE":{}}}}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_THAT(
        listWarnings(result, Issue::dropped),
        ElementsAre(": extension EXT_nowhere is not kept: extensionsUsed names it, but no object has it",
                    "/materials/1: extension KHR_materials_iridescence is not kept (3 places: "
                    "/materials/1, /materials/3 and /materials/4)",
                    "/nodes/0: extension MY~a/b is not kept"));
}

TEST(GltfLods, warnOfScreenCoverages)
{
    const std::string meshes = R"("meshes":[)" + kMesh + "," + kMesh + "],";
    const std::string lod = R"({"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}},)";
    const Imported result = makeSquare().import(
        meshes + R"("nodes":[)" + lod + R"("extras":{"MSFT_screencoverage":[0.5,0.1]}},{"mesh":1},)" + lod +
        R"("extras":{"MSFT_screencoverage":[0.3]}},)" + lod + R"("extras":{}}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_THAT(listWarnings(result, Issue::lod_coverage),
                ElementsAre("/nodes/0: MSFT_screencoverage is not used: levels switch by their error "
                            "(2 places: /nodes/0 and /nodes/2)"));
    EXPECT_THAT(listExtras(result), testing::Contains(R"(node 0: {"MSFT_screencoverage":[0.5,0.1]})"));
}

} // namespace hearth::import::test
