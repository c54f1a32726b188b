// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/inspect/inspect.h"

#include "pipelines/command/extract/open_pack.h"
#include "pipelines/command/inspect/verify.h"
#include "pipelines/command/shell/explain.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hearth::test
{

using namespace formats;

namespace
{

class Inspect : public ::testing::Test
{
protected:
    Json inspected(const PackModel& model)
    {
        writePackFile(model, sandbox / "small.hearth");
        const auto pack = command::openContainer(sandbox / "small.hearth");
        if (!pack.ok())
        {
            ADD_FAILURE() << formatMessage(pack.error());
            return {};
        }
        text = command::inspectText(*pack, command::summarize(*pack));
        return Json::parse(command::inspectJson(*pack, command::summarize(*pack))).value();
    }

    Sandbox sandbox;
    std::string text;
};

PackModel smallPackWithMeta()
{
    PackModel model = smallPack();
    model.meta = importMeta("small.gltf");
    return model;
}

} // namespace

TEST_F(Inspect, namesItsSchemaAndFile)
{
    const Json json = inspected(smallPack());
    EXPECT_EQ(json["schema"], "hearth.inspect/1");
    EXPECT_EQ(json["kind"], "pack");
    EXPECT_EQ(json["file"], sandbox / "small.hearth");
    EXPECT_EQ(json["totals"]["bytes"]["file"], sandbox.read("small.hearth").size());
}

TEST_F(Inspect, countsWhatEachMeshHas)
{
    const Json json = inspected(smallPack());
    ASSERT_EQ(json["meshes"].size(), 3u);
    const Json& strip = json["meshes"][0];
    EXPECT_EQ(strip["name"], "strip");
    EXPECT_EQ(strip["attributes"], "position normal tangent uv0 color visibility");
    EXPECT_EQ(strip["source"], (Json{{"triangles", 8}, {"vertices", 24}, {"faces", 8}}));
    ASSERT_EQ(strip["levels"].size(), 2u);
    EXPECT_EQ(strip["levels"][0], (Json{{"clusters", 4},
                                        {"triangles", 8},
                                        {"max_error", 0.0},
                                        {"position_error", 0.0},
                                        {"normal_error", 0.0},
                                        {"uv_error", 0.0}}));
    EXPECT_EQ(strip["levels"][1]["clusters"], 2);
    EXPECT_EQ(strip["levels"][1]["triangles"], 4);
    EXPECT_FLOAT_EQ(strip["levels"][1]["max_error"].get<float>(), 0.1f);
    EXPECT_FLOAT_EQ(strip["levels"][1]["position_error"].get<float>(), 0.05f);
    EXPECT_EQ(strip["levels"][1]["normal_error"], 0.25);
    EXPECT_FLOAT_EQ(strip["levels"][1]["uv_error"].get<float>(), 0.1f);
    EXPECT_EQ(strip["groups"], 3);
    EXPECT_EQ(strip["pages"], 3);
    EXPECT_DOUBLE_EQ(strip["fill"]["triangles_per_cluster"].get<double>(), 2.0);
    EXPECT_DOUBLE_EQ(strip["fill"]["vertices_per_cluster"].get<double>(), 4.0);
    // 6 quads of 4 vertices, each 6 words, behind a UV base of 2; 6 indices each, padded to 8 bytes
    EXPECT_EQ(strip["bytes"]["vertices"], 6 * (4 * 6 + 2) * 4);
    EXPECT_EQ(strip["bytes"]["indices"], 6 * 8);
    EXPECT_EQ(strip["bytes"]["pages"], 6 * ((4 * 6 + 2) * 4 + 8));
    EXPECT_EQ(strip["bytes"]["records"], 104 + 2 * 16 + 3 * 64 + 6 * 48 + 3 * 56 + 2 * 4);

    EXPECT_TRUE(json["meshes"][1]["levels"].empty());
    EXPECT_EQ(json["meshes"][2]["morph_targets"], 1);
    EXPECT_TRUE(json["meshes"][2]["skinned"].get<bool>());
    EXPECT_EQ(json["meshes"][0]["bytes"]["bounds"], 0);
    EXPECT_EQ(json["meshes"][2]["bytes"]["bounds"], 48 + 48 + 2 * 4) << "a cluster that two joints move";
    EXPECT_EQ(json["totals"]["bytes"]["bounds"], 48 + 48 + 2 * 4);
}

TEST_F(Inspect, showsErrorsOfImagesBesideTheirTargets)
{
    PackModel model = smallPack();
    ImageRecord& paint = model.images[0];
    paint.role = static_cast<uint8_t>(ImageRole::color);
    paint.error = 0.01F;
    paint.target = 0.0112F;
    paint.error_smooth = 0.002F;
    paint.target_smooth = 0.0025F;
    Json json = inspected(model)["scene"]["images"];
    EXPECT_EQ(json[0]["target"], paint.target);
    EXPECT_EQ(json[0]["target_smooth"], paint.target_smooth);
    EXPECT_EQ(json[0]["holds_target"], true);
    EXPECT_TRUE(json[1]["target"].is_null() && json[1]["target_smooth"].is_null()) << "plain texels";
    EXPECT_EQ(json[1]["holds_target"], true);
    EXPECT_NE(text.find(", color, 40.0 dB (target 39.0)\n"), std::string::npos) << text;

    paint.error_smooth = 0.003F;
    json = inspected(model)["scene"]["images"];
    EXPECT_EQ(json[0]["holds_target"], false);
    EXPECT_NE(text.find(", color, 40.0 dB (target 39.0), smooth areas 50.5 dB (target 52.0, missed)\n"),
              std::string::npos)
        << text;
}

TEST_F(Inspect, listsTheAssetsWithTheirSizes)
{
    PackModel model = smallPack();
    Json json = inspected(model);
    ASSERT_EQ(json["assets"].size(), 1u);
    EXPECT_EQ(json["assets"][0], (Json{{"index", 0},
                                       {"name", "Lager\xC3\xB6"},
                                       {"box", {{0.0, 0.0, 0.0}, {4.0, 0.5, 1.0}}},
                                       {"size", {4.0, 0.5, 1.0}},
                                       {"instances", {{"first", 0}, {"count", 2}}},
                                       {"meshes", {{"first", 0}, {"count", 3}}},
                                       {"nodes", {{"first", 0}, {"count", 4}}}}));
    EXPECT_NE(text.find("asset      \"Lager\xC3\xB6\": 4 x 0.5 x 1 m, 3 meshes, 2 instances\n"),
              std::string::npos)
        << text;

    model.assets.clear();
    model.extras.clear();
    json = inspected(model);
    EXPECT_TRUE(json["assets"].empty()) << "a pack that is older";
    EXPECT_EQ(text.find("asset "), std::string::npos);
}

TEST_F(Inspect, describesTheBricks)
{
    PackModel model = smallPack();
    Json json = inspected(model);
    EXPECT_EQ(json["bricks"]["voxel_size"], 0.5);
    EXPECT_EQ(json["bricks"]["origin"], (Json{-4, 0, -1}));
    EXPECT_EQ(json["bricks"]["dims"], (Json{19, 5, 3}));
    EXPECT_EQ(json["bricks"]["groups"], 2);
    EXPECT_EQ(json["bricks"]["bricks"], 3);
    EXPECT_EQ(json["bricks"]["solid_voxels"], 4);
    EXPECT_EQ(json["bricks"]["faces"], 22);
    const uint64_t bytes = 48 + 2 * 12 + 3 * 64 + 4 + 22 * (4 + 2 + 4 + 4) + 3 * 40;
    EXPECT_EQ(json["bricks"]["bytes"], bytes);
    const auto row = std::find_if(json["chunks"].begin(), json["chunks"].end(),
                                  [](const Json& chunk) { return chunk["kind"] == "bricks"; });
    ASSERT_NE(row, json["chunks"].end());
    EXPECT_EQ((*row)["size"], bytes);
    EXPECT_EQ((*row)["stored"], bytes);
    EXPECT_EQ((*row)["chunks"].size(), 9u);
    EXPECT_NE(
        text.find("bricks     19 x 5 x 3 voxels of 0.5 m from (-4, 0, -1): 4 solid in 3 bricks, 22 faces"),
        std::string::npos)
        << text;

    model.face_atlases.clear();
    model.face_blocks.clear();
    model.face_words.clear();
    model.brick_grids.clear();
    model.bricks = {};
    json = inspected(model);
    EXPECT_FALSE(json.contains("bricks"));
}

TEST_F(Inspect, describesTheReceivers)
{
    PackModel model = smallPack();
    Json json = inspected(model);
    const Json receivers = json["receivers"];
    EXPECT_EQ(receivers["width"], 6);
    EXPECT_EQ(receivers["height"], 4);
    EXPECT_EQ(receivers["codec"], "rgb9e5");
    EXPECT_EQ(receivers["texels"], 3);
    EXPECT_EQ(receivers["bytes"], 64 + 3 * 8 + 2 * 24 + 2 * 40 + 10 * 4);
    EXPECT_EQ(receivers["faces"]["count"], 3);
    EXPECT_EQ(receivers["faces"]["bytes"], 64 + 2 * 40 + 8 * 4);
    ASSERT_EQ(receivers["lamps"].size(), 3u);
    EXPECT_EQ(receivers["lamps"][0]["kind"], "steady");
    EXPECT_EQ(receivers["lamps"][1]["kind"], "light");
    EXPECT_EQ(receivers["lamps"][1]["name"], json["scene"]["lights"][0]["name"]);
    EXPECT_EQ(receivers["lamps"][2]["kind"], "instance");
    ASSERT_EQ(receivers["rectangles"].size(), 2u);
    EXPECT_EQ(receivers["rectangles"][1]["x"], 4);
    EXPECT_NE(text.find("receivers  6 x 4, 3 texels in rgb9e5, 3 lamps, 2 rectangles"), std::string::npos)
        << text;
    EXPECT_NE(text.find("lamp 0: steady"), std::string::npos) << text;
    EXPECT_NE(text.find("2 x 2 texels at (4, 0), UV set 0"), std::string::npos) << text;

    model.receiver_atlases.clear();
    model.receiver_rects.clear();
    model.receiver_blocks.clear();
    model.receiver_words.clear();
    json = inspected(model);
    EXPECT_EQ(json["receivers"]["texels"], 0) << "there are faces";
    model.face_atlases.clear();
    model.face_blocks.clear();
    model.face_words.clear();
    model.receiver_lamps.clear();
    json = inspected(model);
    EXPECT_FALSE(json.contains("receivers"));
    EXPECT_EQ(text.find("receivers "), std::string::npos) << text;
}

TEST_F(Inspect, countsTheScene)
{
    const Json scene = inspected(smallPack())["scene"];
    EXPECT_EQ(scene["nodes"], 4);
    EXPECT_EQ(scene["instances"], 2);
    EXPECT_EQ(scene["instanced_triangles"], 9);
    EXPECT_EQ(scene["joints"], 2);
    EXPECT_EQ(scene["morph_targets"], 1);
    ASSERT_EQ(scene["cameras"].size(), 2u);
    EXPECT_EQ(scene["cameras"][1]["type"], "orthographic");
    ASSERT_EQ(scene["lights"].size(), 3u);
    EXPECT_EQ(scene["lights"][2]["type"], "spot");
    EXPECT_EQ(scene["materials"][0]["alpha_mode"], "mask");
    EXPECT_EQ(scene["materials"][0]["layers"], (Json{{"ior", 1.5},
                                                     {"specular", 1.0},
                                                     {"specular_color", {1.0, 1.0, 1.0}},
                                                     {"clearcoat", 0.5},
                                                     {"clearcoat_roughness", 0.0},
                                                     {"sheen_color", {0.0, 0.0, 0.0}},
                                                     {"sheen_roughness", 0.0}}));
    EXPECT_NE(text.find("layers of material 0 \"paint\": clear coat 0.5 (roughness 0)\n"), std::string::npos)
        << text;
    ASSERT_EQ(scene["images"].size(), 2u);
    EXPECT_EQ(scene["images"][0]["name"], "paint.png");
    EXPECT_EQ(scene["images"][0]["width"], 4);
    EXPECT_EQ(scene["images"][0]["mips"], 3);
    EXPECT_EQ(scene["images"][0]["bytes"], 44);
    EXPECT_EQ(scene["images"][1]["format"], "rgba16-float");
    EXPECT_EQ(scene["skins"][0]["joints"], 2);
    EXPECT_EQ(scene["animations"][0]["channels"], 2);
    EXPECT_EQ(scene["animations"][0]["light_channels"], 0);
    EXPECT_EQ(scene["animations"][2]["light_channels"], 2);
    EXPECT_EQ(scene["lights"][1]["flicker"], (Json{{"rate", 8.0}, {"amplitude", 0.25}, {"seed", 7}}));
    EXPECT_FALSE(scene["lights"][0].contains("flicker"));
}

TEST_F(Inspect, listsExtras)
{
    PackModel model = smallPack();
    const Json extras = inspected(model)["scene"]["extras"];
    ASSERT_EQ(extras.size(), model.extras.size());
    EXPECT_EQ(extras[0], Json({{"owner", "node"},
                               {"index", 1},
                               {"name", "strip node"},
                               {"json", R"({"speed":1.50,"tag":"T\u00fcr"})"}}));
    EXPECT_EQ(extras[9]["owner"], "file");
    EXPECT_EQ(extras[9]["name"], "Lager\xC3\xB6");
    EXPECT_EQ(extras[9]["json"], "12345678901234567890");

    // a character of two bytes does not fit the line
    const std::string json = "\"" + std::string(158, 'x') + "\xC3\xB6\"";
    model.extras[1].json = {static_cast<uint32_t>(model.strings.size()), static_cast<uint32_t>(json.size())};
    model.strings += json;
    inspected(model);
    EXPECT_THAT(text, testing::HasSubstr(
                          "\nextras of node 1 \"strip node\": {\"speed\":1.50,\"tag\":\"T\\u00fcr\"}\n"));
    EXPECT_THAT(text, testing::HasSubstr("\nextras of mesh 2 \"triangle\": \"" + std::string(158, 'x') +
                                         "... (162 bytes)\n"));
}

TEST_F(Inspect, aJointOfTwoSkinsIsOneJoint)
{
    PackModel model = smallPack();
    model.joints.push_back(model.joints[0]);
    SkinRecord skin = model.skins[0];
    skin.joints = {2, 1};
    model.skins.push_back(skin);
    EXPECT_EQ(inspected(model)["scene"]["joints"], 2);
}

TEST_F(Inspect, saysWhatBecameOfEachClip)
{
    PackModel model = smallPack();
    model.meta = R"({"clips":[{"keys_before":9,"keys":4,"bytes_before":500,"bytes":90,"stated_error":0.5,)"
                 R"("proven_error":0.25},{"keys":"many"}]})";
    const Json animations = inspected(model)["scene"]["animations"];
    EXPECT_EQ(animations[0]["keys"], Json({{"source", 9}, {"kept", 4}}));
    EXPECT_EQ(animations[0]["bytes"], Json({{"source", 500}, {"kept", 90}}));
    EXPECT_EQ(animations[0]["errors"], Json({{"stated", 0.5}, {"proven", 0.25}}));
    EXPECT_EQ(animations[1]["keys"], Json({{"source", 0}, {"kept", 0}}));
    EXPECT_FALSE(animations[2].contains("keys"));
    EXPECT_EQ(animations[2]["error"], 0.25);
}

TEST_F(Inspect, passesOnWhatMetaTells)
{
    const Json json = inspected(smallPackWithMeta());
    EXPECT_EQ(json["totals"]["source"]["triangles"], 9);
    EXPECT_EQ(json["totals"]["source"]["joints"], 2);
    EXPECT_EQ(json["sources"][0]["name"], "small.gltf");
    EXPECT_EQ(json["messages"][0]["code"], "W1400");
    EXPECT_EQ(json["messages"][0]["pointer"], "/extras");
    EXPECT_EQ(json["dropped"][0], "extras");
    EXPECT_NE(text.find("W1400"), std::string::npos);
}

TEST_F(Inspect, listsEveryChunk)
{
    const PackModel model = smallPack();
    const Json chunks = inspected(model)["chunks"];
    ASSERT_EQ(chunks.size(), model.chunks().size() - (kBrickChunks.size() - 1));
    EXPECT_EQ(chunks[0]["kind"], "META");
    EXPECT_EQ(chunks.back()["kind"], "IMGD");
    EXPECT_EQ(chunks.back()["index"], 1);
    EXPECT_EQ(chunks.back()["size"], 32);
    EXPECT_EQ(chunks.back()["stored"], 32);
}

TEST_F(Inspect, textHoldsTheSameNumbers)
{
    inspected(smallPackWithMeta());
    for (const char* part : {"mesh 0 \"strip\": 8 triangles", "no triangles", "image 0 \"paint.png\": 4 x 2",
                             "4 nodes, 2 instances (9 triangles)", "9 triangles", "IMGD"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST_F(Inspect, aNameCannotSteerTheTerminal)
{
    PackModel model = smallPack();
    model.images[0].name = {static_cast<uint32_t>(model.strings.size()), 8};
    model.strings += "\033[2J\nbad";
    inspected(model);
    EXPECT_EQ(text.find('\033'), std::string::npos);
    EXPECT_EQ(text.find("\nbad"), std::string::npos);
}

TEST_F(Inspect, readsPartsToo)
{
    writeParts(smallPackWithMeta(), sandbox.path(), "a");
    const auto part = command::openContainer(sandbox / "a.import.part");
    ASSERT_TRUE(part.ok());
    const Json json = Json::parse(command::inspectJson(*part, command::summarize(*part))).value();
    EXPECT_EQ(json["kind"], "part");
    EXPECT_EQ(json["scene"]["nodes"], 4);
    EXPECT_EQ(json["chunks"].back()["kind"], "SMSH");
}

TEST(ReadMeta, leavesOutWhatHasTheWrongType)
{
    for (const char* text :
         {"", "{", "[]", "1", R"({"tool":3,"sources":4,"counts":[],"messages":{},"dropped":1})",
          R"({"sources":[1,{"name":2,"bytes":-1}],"counts":{"triangles":"x"},"messages":[null]})"})
    {
        const command::MetaSummary meta = command::readMeta(text);
        EXPECT_TRUE(meta.counts.empty()) << text;
        EXPECT_TRUE(meta.messages.empty()) << text;
        EXPECT_TRUE(meta.dropped.empty()) << text;
    }
}

TEST(VerifyFile, saysWhatIsRight)
{
    const Sandbox sandbox;
    writePackFile(smallPack(), sandbox / "a.hearth");
    const auto result = command::verifyFile(sandbox / "a.hearth");
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(countOccurrences(*result, "\n"), 1u);
    EXPECT_NE(result->find("ok"), std::string::npos);
    EXPECT_TRUE(Json::parse(command::verifyJson("a", result)).value()["ok"].get<bool>());
}

TEST(VerifyFile, refusesDamageAndNonsense)
{
    const Sandbox sandbox;
    writePackFile(smallPack(), sandbox / "a.hearth");
    std::string bytes = sandbox.read("a.hearth");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    sandbox.write("damaged.hearth", bytes);
    EXPECT_EQ(exitCode(command::verifyFile(sandbox / "damaged.hearth").error()), 65);

    PackModel model = smallPack();
    model.nodes[1].parent = 1;
    writePackFile(model, sandbox / "nonsense.hearth");
    const auto result = command::verifyFile(sandbox / "nonsense.hearth");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().issue, Issue::meaning_tree);
    const Json json = Json::parse(command::verifyJson("nonsense", result)).value();
    EXPECT_FALSE(json["ok"].get<bool>());
    const std::string number = std::to_string(static_cast<unsigned>(Issue::meaning_tree));
    EXPECT_EQ(json["error"]["code"].get<std::string>().substr(1), number);

    EXPECT_EQ(exitCode(command::verifyFile(sandbox / "missing").error()), 66);
}

TEST(Explain, knowsEveryIssueHoweverItIsWritten)
{
    for (const IssueInfo& info : allIssues())
    {
        const std::string number = std::to_string(static_cast<unsigned>(info.issue));
        for (const char* prefix : {"", "E", "W", "e", "w"})
        {
            const auto page = command::explain(prefix + number);
            ASSERT_TRUE(page.ok()) << prefix << number;
            EXPECT_NE(page->find(info.summary), std::string::npos);
        }
        EXPECT_NE(command::explain("")->find(info.summary), std::string::npos);
    }
}

TEST(Explain, refusesNumbersThatAreNoIssue)
{
    for (const char* code : {"E9999", "E", "E12x", "x1001", "-1", "99999999999999999999"})
        EXPECT_EQ(command::explain(code).error().issue, Issue::usage) << code;
}

} // namespace hearth::test
