// Tests `hearth cook --receivers` with the real cookers: a pack's light beside closed forms.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "formats/base/double3.h"
#include "formats/container/container_reader.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/pack/pack_view.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/support/json_schema.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hearth::test
{

namespace
{

using namespace samples;
using formats::PackView;

constexpr Float3 kBulb{0.5f, 1.5f, 0.25f}, kDesk{-1, 1, -0.5f};

/// Floor of 4 x 4 m at y = 0 that faces up: u along x, v along -z, both from -2 to 2 m.
TriangleMesh makeFloorMesh()
{
    TriangleMesh floor = makeGrid(2, 2,
                                  [](Float2 uv, Float3& position, Float2& texture_uv)
                                  {
                                      position = {4 * uv.x - 2, 0, 2 - 4 * uv.y};
                                      texture_uv = uv;
                                  });
    setFlatNormals(floor);
    return floor;
}

/// Turn the last object by a clip.
void addTurn(Document& document)
{
    Animation turn{"turn", {}};
    turn.tracks.push_back({static_cast<int>(document.nodes.size()) - 1,
                           TrackPath::rotation,
                           TrackKind::linear,
                           {0, 1},
                           {{0, 0, 0, 1}, {0, 1, 0, 0}}});
    document.animations.push_back(turn);
}

/// Floor under two bulbs and a sun. Below it, where it throws no light on anything that is lit: two crates
/// whose UVs leave the square, and a fan that turns.
Document makeRoom()
{
    Document document;
    const int white = addPlainMaterial(document, "white", {0.8f, 0.8f, 0.8f});
    addObject(document, "floor", {{makeFloorMesh(), white}});
    addObject(document, "crate", {{makeBox({0, -2, 0}, {0.1f, 0.1f, 0.1f}, 1), white}});
    Node copy = document.nodes.back();
    copy.name = "crate 2";
    copy.placement.translation = {1, 0, 0};
    addRoot(document, copy);
    addObject(document, "fan", {{makeFloorMesh(), white}});
    document.nodes.back().placement.translation = {0, -3, 0};
    addTurn(document);
    for (const auto& [name, intensity, kind, position] :
         {std::tuple("bulb", 2.0f, LightKind::point, kBulb),
          std::tuple("desk", 1.0f, LightKind::point, kDesk),
          std::tuple("sun", 0.25f, LightKind::directional, Float3{0, 5, 0})})
    {
        samples::Light light;
        light.name = name;
        light.kind = kind;
        light.intensity = intensity;
        addLight(document, light, position, {-0.70710678f, 0, 0, 0.70710678f});
    }
    return document;
}

/// Floor of its own beside the room, with a sign that shines.
/// has_lamp  adds a lamp over the floor
Document makeLobby(bool has_lamp)
{
    Document document;
    const int white = addPlainMaterial(document, "white", {0.8f, 0.8f, 0.8f});
    addObject(document, "lobby floor", {{makeFloorMesh(), white}});
    document.nodes.back().placement.translation = {10, 0, 0};
    if (!has_lamp)
        return document;
    addObject(document, "sign", {{makeFloorMesh(), addEmissiveMaterial(document, "glow", {1, 1, 1}, 0.5f)}});
    document.nodes.back().placement.translation = {10, 0, -5};
    samples::Light lamp;
    lamp.name = "lobby lamp";
    addLight(document, lamp, {10, 2, 0}, {0, 0, 0, 1});
    return document;
}

/// Decode a word of RGB9E5, as its format says.
Float3 decodeWord(uint32_t word)
{
    const double step = std::ldexp(1.0, static_cast<int>(word >> 27) - 24);
    return narrow(Double3{(word & 511) * step, (word >> 9 & 511) * step, (word >> 18 & 511) * step});
}

class CookReceivers : public ::testing::Test
{
protected:
    CookReceivers()
    {
        EXPECT_TRUE(samples::writeFile(folder / "room.glb", encodeGlb(makeRoom())).ok());
        std::string file = "#?RADIANCE\n\n-Y 4 +X 8\n"; // a sky of 2^-33
        for (int i = 0; i < 32; ++i)
            file += "\x80\x80\x80\x60";
        folder.write("night.hdr", file);
    }

    ProgramEnd cook(const std::vector<std::string>& options, const std::string& source = "room.glb")
    {
        std::vector<std::string> words{std::string(HEARTH_BIN) + "/hearth",
                                       "cook",
                                       source,
                                       "-o",
                                       "room.hearth",
                                       "--visibility=off",
                                       "--cache",
                                       folder.cacheSpec()};
        if (std::ranges::find(options, "bricks.mode=on") == options.end())
            words.emplace_back("--bricks=off");
        words.insert(words.end(), options.begin(), options.end());
        const ProgramEnd end = folder.run(words);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return end;
    }

    PackView open(const std::string& file)
    {
        return PackView::read(formats::ContainerReader::open(folder / file).value()).value();
    }

    Json inspect()
    {
        const ProgramEnd end =
            folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "room.hearth", "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return Json::parse(end.out).value();
    }

    /// Return kinds and names of the lamps of a file.
    static std::vector<std::string> listLamps(const Json& receivers)
    {
        std::vector<std::string> lamps;
        for (const Json& lamp : receivers["lamps"])
            lamps.push_back(lamp["kind"].get<std::string>() + " " + lamp["name"].get<std::string>());
        return lamps;
    }

    Sandbox folder;
};

} // namespace

TEST_F(CookReceivers, haveTheLightOfTheLamps)
{
    cook({"--receivers", "--sky", "night.hdr"});
    const PackView pack = open("room.hearth");
    ASSERT_EQ(pack.receiverAtlases().size(), 1u);
    const formats::ReceiverTables tables = pack.receivers();
    const formats::ReceiverRectRecord& rect = tables.rects[0]; // of the first instance
    EXPECT_EQ(rect.width, 64u);
    EXPECT_EQ(rect.height, 64u);
    size_t inside = 0;
    double largest = 0;
    for (const formats::ReceiverBlockRecord& block : tables.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t* const word = &tables.words[block.first_word + i];
            const uint32_t column = (*word & 16383) - rect.x, row = (*word >> 14) - rect.y;
            if (column >= rect.width || row >= rect.height) // around the rectangle
                continue;
            Float3 sum;
            for (uint32_t color = 1; color <= block.color_count; ++color)
                sum += decodeWord(word[color * block.texel_count]) * tables.atlas.scale;
            const Float3 at{4 * (static_cast<float>(column) + 0.5f) / 64 - 2, 0,
                            2 - 4 * (static_cast<float>(row) + 0.5f) / 64};
            double expected = 0;
            for (const auto& [position, candela] : {std::pair(kBulb, 2.0), std::pair(kDesk, 1.0)})
            {
                const double distance = double{length(position - at)};
                expected += candela * double{position.y} / (distance * distance * distance);
            }
            ASSERT_NEAR(double{sum.x}, expected, 0.005 * expected) << column << ", " << row;
            largest = std::max(largest, std::abs(double{sum.y} / expected - 1));
            ++inside;
        }
    EXPECT_EQ(inside, 64u * 64);
    std::printf("sum of lamps: off by %.3f %% at most\n", 100 * largest);
}

TEST_F(CookReceivers, areDescribed)
{
    const ProgramEnd end = cook({"--receivers", "--report", "report.json"});
    EXPECT_EQ(countOccurrences(end.err, "[W1406]"), 0u) << end.err;

    const Json receivers = inspect()["receivers"];
    EXPECT_EQ(receivers["codec"], "rgb9e5");
    EXPECT_EQ(listLamps(receivers),
              (std::vector<std::string>{"steady ", "light bulb", "light desk", "light sun"}));
    ASSERT_EQ(receivers["rectangles"].size(), 3u);
    const std::map<std::string, int> uv_sets{{"floor", 0}, {"crate", 1}, {"crate 2", 1}};
    for (const Json& rectangle : receivers["rectangles"])
        EXPECT_EQ(rectangle["uv_set"], uv_sets.at(rectangle["name"].get<std::string>()));

    EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.inspect.1.json", inspect()), "");
    const Json whole_report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.report.1.json", whole_report), "");
    const Json& report = whole_report["receivers"];
    EXPECT_EQ(report["stage"], "receivers");
    const Json& atlas = report["atlas"];
    EXPECT_EQ(atlas["texels"], receivers["texels"]);
    EXPECT_EQ(atlas["bytes"], receivers["bytes"]);
    EXPECT_EQ(atlas["lamps"], 4);
    EXPECT_EQ(atlas["instances"], 3);
    EXPECT_EQ(atlas["left_out"]["animated"], 1);
    EXPECT_EQ(atlas["faces"]["count"], 0) << "there are no bricks";
    EXPECT_LT(atlas["largest_dropped"].get<double>(), 0.03);

    const std::string program = std::string(HEARTH_BIN) + "/hearth";
    const ProgramEnd text = folder.run({program, "inspect", "room.hearth"});
    EXPECT_NE(text.out.find("lamp 1: light 0 \"bulb\""), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("\"floor\": 64 x 64 texels at ("), std::string::npos) << text.out;
    for (const char* picture : {"light.png", "light.exr"})
    {
        EXPECT_EQ(folder.run({program, "extract", "room.hearth", "--receivers", "-o", picture}).exit_code, 0);
        EXPECT_TRUE(folder.has(picture));
    }
    EXPECT_EQ(folder.run({program, "extract", "room.hearth", "--receivers", "-o", "light.csv"}).exit_code, 2);
}

/// Lamps of all faces sum to the light that the grid itself has, sign and sun included.
TEST_F(CookReceivers, areFacesOfBricksAsWell)
{
    ASSERT_TRUE(samples::writeFile(folder / "lobby.glb", encodeGlb(makeLobby(true))).ok());
    cook({"--receivers", "--set", "bricks.mode=on", "--set", "bricks.voxel_size=0.25", "--report",
          "report.json"},
         "lobby.glb");
    const PackView pack = open("room.hearth");
    const formats::ReceiverTables faces = pack.faceReceivers();
    ASSERT_EQ(pack.faceAtlases().size(), 1u);
    std::vector<Float3> sums(pack.brickLighting().size());
    std::vector<double> of_sign(sums.size());
    const std::vector<std::string> lamps = listLamps(inspect()["receivers"]);
    EXPECT_EQ(lamps, (std::vector<std::string>{"steady ", "light lobby lamp", "instance sign"}));
    for (const formats::ReceiverBlockRecord& block : faces.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
            for (uint32_t color = 0; color < block.color_count; ++color)
            {
                const uint32_t* const word = &faces.words[block.first_word + i];
                const Float3 light = decodeWord(word[(color + 1) * block.texel_count]) * faces.atlas.scale;
                sums[*word] += light;
                if ((block.lamps[color / 2] >> (16 * (color % 2)) & 0xFFFF) == 2)
                    of_sign[*word] += double{light.y};
            }
    size_t shining = 0;
    for (size_t face = 0; face < sums.size(); ++face)
    {
        const Float3 expected = shared::decodeRadiance(pack.brickLighting()[face]);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(sums[face][c], expected[c], 0.02f * expected[c] + 1e-4f) << face;
        const double emission = double{shared::decodeRadiance(pack.brickEmission()[face]).y};
        if (emission < 0.1) // a lamp of a small share may be dropped
            continue;
        EXPECT_GE(of_sign[face], 0.97 * emission) << face;
        ++shining;
    }
    EXPECT_GT(shining, 100u);

    EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.inspect.1.json", inspect()), "");
    EXPECT_EQ(inspect()["receivers"]["faces"]["count"], faces.atlas.texel_count);
    const Json report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(report["receivers"]["atlas"]["faces"]["count"], faces.atlas.texel_count);
    const ProgramEnd text = folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "room.hearth"});
    EXPECT_NE(text.out.find(" faces of bricks in rgb9e5; "), std::string::npos) << text.out;
}

TEST_F(CookReceivers, warnOfUvsThatCannotBeUsed)
{
    const auto run = [&](std::vector<std::string> words)
    {
        words[0] = std::string(HEARTH_BIN) + "/" + words[0];
        const ProgramEnd end = folder.run(words);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return end;
    };
    run({"hearth-import", "room.glb", "-o", "a.import.part"}); // without the UVs that it makes for receivers
    run({"hearth-clusters", "a.import.part", "-o", "a.clusters.part"});
    run({"hearth-textures", "a.import.part", "-o", "a.textures.part"});
    const ProgramEnd end = run({"hearth-receivers", "a.import.part", "a.clusters.part", "a.textures.part",
                                "-o", "a.receivers.part", "--stats", "a.json"});
    EXPECT_EQ(countOccurrences(end.err, "[W1406]"), 1u) << "once for two crates: " << end.err;
    EXPECT_NE(end.err.find("mesh crate of room.glb: warning: "), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("of its area has UVs outside [0, 1]"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("second UV set"), std::string::npos) << end.err;
    const Json left_out = Json::parse(folder.read("a.json")).value()["left_out"];
    EXPECT_EQ(left_out["uvs_outside"], 2);
    EXPECT_EQ(left_out["animated"], 1);
}

TEST_F(CookReceivers, areThoseOfAllSources)
{
    ASSERT_TRUE(samples::writeFile(folder / "lobby.glb", encodeGlb(makeLobby(true))).ok());
    cook({"lobby.glb", "--receivers"});
    const Json receivers = inspect()["receivers"];
    EXPECT_EQ(listLamps(receivers),
              (std::vector<std::string>{"steady ", "light bulb", "light desk", "light sun",
                                        "light lobby lamp", "instance sign"}));
    std::set<std::string> names;
    for (const Json& rectangle : receivers["rectangles"])
        names.insert(rectangle["name"].get<std::string>());
    EXPECT_EQ(names, (std::set<std::string>{"floor", "crate", "crate 2", "lobby floor", "sign"}));
    // the lamp of the lobby is the brightest in the middle of its floor
    const PackView pack = open("room.hearth");
    const formats::ReceiverTables tables = pack.receivers();
    const auto rect = std::ranges::find_if(
        tables.rects, [&](const formats::ReceiverRectRecord& at)
        { return pack.text(pack.nodes()[pack.instances()[at.instance].node].name) == "lobby floor"; });
    ASSERT_NE(rect, tables.rects.end());
    const uint32_t middle = (rect->x + 32) | (rect->y + 32) << 14;
    size_t found = 0;
    for (const formats::ReceiverBlockRecord& block : tables.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t* const word = &tables.words[block.first_word + i];
            if (*word != middle)
                continue;
            for (uint32_t color = 0; color < block.color_count; ++color)
                if ((block.lamps[color / 2] >> (16 * (color % 2)) & 0xFFFF) == 4)
                {
                    const Float3 light = decodeWord(word[(1 + color) * block.texel_count]);
                    EXPECT_NEAR(light.x * tables.atlas.scale, 0.25f, 0.01f); // 1 cd at 2 m, and dropped ones
                    ++found;
                }
        }
    EXPECT_EQ(found, 1u);
}

TEST_F(CookReceivers, haveTheDefaultSunInTheSteadyLight)
{
    ASSERT_TRUE(samples::writeFile(folder / "lobby.glb", encodeGlb(makeLobby(false))).ok());
    cook({"--receivers"}, "lobby.glb");
    EXPECT_EQ(listLamps(inspect()["receivers"]), std::vector<std::string>{"steady "});
}

/// Passes over bricks light faces by every light that is no lamp, so faces must not have the default sun.
TEST_F(CookReceivers, haveNoDefaultSunOnFaces)
{
    ASSERT_TRUE(samples::writeFile(folder / "lobby.glb", encodeGlb(makeLobby(false))).ok());
    cook({"--receivers", "--set", "bricks.mode=on", "--set", "bricks.voxel_size=0.25"}, "lobby.glb");
    const PackView pack = open("room.hearth");
    const formats::ReceiverTables faces = pack.faceReceivers();
    size_t sunlit = 0;
    for (const formats::ReceiverBlockRecord& block : faces.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t* const word = &faces.words[block.first_word + i];
            ASSERT_EQ(block.color_count, 1u) << "steady light alone";
            const float sky = decodeWord(word[block.texel_count]).y * faces.atlas.scale;
            const float all = shared::decodeRadiance(pack.brickLighting()[shared::receiverFace(*word)]).y;
            EXPECT_LE(sky, 1.02f * all + 1e-4f);
            sunlit += sky < 0.6f * all ? 1 : 0;
        }
    EXPECT_GT(sunlit, 100u) << "the top of the floor is in the sun";
}

TEST_F(CookReceivers, sayWhyThereAreNone)
{
    Document document = makeLobby(false);
    addTurn(document);
    ASSERT_TRUE(samples::writeFile(folder / "fan.glb", encodeGlb(document)).ok());
    cook({"--receivers"}, "fan.glb");
    EXPECT_FALSE(inspect().contains("receivers"));
    const ProgramEnd text = folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "room.hearth"});
    EXPECT_NE(text.out.find("receivers  none: no instance"), std::string::npos) << text.out;
}

TEST_F(CookReceivers, haveTheSameBytesForAnyThreads)
{
    std::set<std::string> packs;
    for (const char* jobs : {"-j1", "-j4"})
    {
        cook({"--receivers", "--no-cache", jobs});
        packs.insert(folder.read("room.hearth"));
    }
    EXPECT_EQ(packs.size(), 1u);
}

TEST_F(CookReceivers, areCookedAgainForTheirSettingsAlone)
{
    cook({});
    EXPECT_TRUE(open("room.hearth").receiverAtlases().empty());
    cook({"--receivers"});
    const uint32_t texels = open("room.hearth").receivers().atlas.texel_count;
    const auto cookAnew = [&](const std::string& bounces)
    {
        cook({"--receivers", "--set", "receivers.lights=3", "--set", "receivers.codec=rgbm", "--set",
              "receivers.bounces=" + bounces, "--report", "report.json"});
        return Json::parse(folder.read("report.json")).value();
    };
    const Json report = cookAnew("2");
    EXPECT_EQ(report["receivers"]["state"], "cooked");
    EXPECT_EQ(report["assets"][0]["stages"][0]["state"], "cached");
    const PackView pack = open("room.hearth");
    const formats::ReceiverTables tables = pack.receivers();
    EXPECT_EQ(tables.atlas.texel_count, texels);
    EXPECT_EQ(tables.atlas.codec, 1u);
    for (const formats::ReceiverBlockRecord& block : tables.blocks)
        EXPECT_LE(block.color_count, 3u);
    EXPECT_EQ(cookAnew("2")["receivers"]["state"], "cached");

    cook({"--receivers", "--set", "receivers.texels_per_metre=8"});
    EXPECT_LT(open("room.hearth").receivers().atlas.texel_count, texels / 3);
}

} // namespace hearth::test
