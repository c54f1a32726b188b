// Tests the diff of two packs: each entry is matched by name, whatever its place in a table.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/command/inspect/pack_diff.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <functional>
#include <gtest/gtest.h>
#include <set>

namespace hearth::test
{

namespace
{

using namespace formats;
using command::EntryChange;
using command::PackDiff;
using command::PackEntry;
using command::Property;

class Diff : public ::testing::Test
{
protected:
    PackDiff diffed(const PackModel& a, const PackModel& b, bool b_is_compressed = false)
    {
        writePackFile(a, sandbox / "a.hearth");
        const AlignedBytes image = b.bytes(b_is_compressed);
        const auto bytes = image.span();
        sandbox.write("b.hearth", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const auto pack_a = command::openPack(sandbox / "a.hearth");
        const auto pack_b = command::openPack(sandbox / "b.hearth");
        EXPECT_TRUE(pack_a.ok() && pack_b.ok()) << (pack_a.ok() ? "" : formatMessage(pack_a.error()))
                                                << (pack_b.ok() ? "" : formatMessage(pack_b.error()));
        if (!pack_a.ok() || !pack_b.ok())
            return {};
        return command::diffPacks(*pack_a, *pack_b).value();
    }

    /// Return lines such as "changed mesh strip: geometry" or "added light sun", one for each property.
    static std::set<std::string> formatLines(const PackDiff& diff)
    {
        std::set<std::string> lines;
        for (const EntryChange& change : diff.entries)
        {
            const char* type = change.type == EntryChange::ChangeType::added     ? "added "
                               : change.type == EntryChange::ChangeType::removed ? "removed "
                                                                                 : "changed ";
            const std::string entry = type + change.kind + " " + change.name;
            if (change.properties.empty())
                lines.insert(entry);
            for (const command::PropertyChange& property : change.properties)
                lines.insert(entry + ": " + property.name);
        }
        return lines;
    }

    Sandbox sandbox;
};

/// Append a copy of the table's last record under another name.
template <typename Record>
void addNamed(PackModel& pack, std::vector<Record>& table, const std::string& name)
{
    table.push_back(table.back());
    table.back().name = {static_cast<uint32_t>(pack.strings.size()), static_cast<uint32_t>(name.size())};
    pack.strings += name;
}

} // namespace

TEST_F(Diff, samePacksAreTheSame)
{
    const PackDiff diff = diffed(smallPack(), smallPack());
    EXPECT_TRUE(diff.isSame());
    EXPECT_EQ(command::diffText(diff), "the same\n");
    const Json json = Json::parse(command::diffJson(diff, "a", "b")).value();
    EXPECT_EQ(json["schema"], "hearth.diff/1");
    EXPECT_EQ(json["same"], true);
    EXPECT_EQ(json["changes"].size(), 0u);
    EXPECT_GT(json["chunks"].size(), 10u);
}

TEST_F(Diff, otherBytesOfTheSameMeaningAreNoChange)
{
    const PackDiff diff = diffed(smallPack(), smallPack(), true);
    EXPECT_TRUE(diff.isSameByMeaning()) << command::diffText(diff);
    EXPECT_FALSE(diff.isSame());
    EXPECT_NE(command::diffText(diff).find("the same by meaning, in other bytes"), std::string::npos);
}

TEST_F(Diff, eachChangeIsToldUnderItsName)
{
    struct Row
    {
        std::set<std::string> lines;
        std::function<void(PackModel&)> change;
    };
    const std::vector<Row> rows{
        {{"changed material paint: metallic"}, [](PackModel& pack) { pack.materials[0].metallic = 0.123F; }},
        {{"changed layers of material paint: clearcoat"},
         [](PackModel& pack) { pack.material_layers[0].clearcoat = 0.25F; }},
        {{"changed material paint: base_color_texture.wrap_u"},
         [](PackModel& pack) { pack.materials[0].base_color_texture.wrap_u = 2; }},
        {{"changed light light: intensity"}, [](PackModel& pack) { pack.lights[0].intensity *= 2; }},
        {{"changed light light: flicker_rate"}, [](PackModel& pack) { pack.lights[1].flicker_rate = 9; }},
        {{"changed animation packed: keys of intensity of light light"},
         [](PackModel& pack) { pack.keys[pack.channels[5].first_value] = 11; }},
        {{"changed camera camera: y_fov_rad"}, [](PackModel& pack) { pack.cameras[0].y_fov_rad *= 1.25F; }},
        {{"changed instance strip node: world_from_object"},
         [](PackModel& pack)
         {
             pack.instances[0].world_from_object.m[0][3] += 1;
             pack.assets[0].box_max.x += 1;
         }},
        {{"changed mesh strip: source vertices"},
         [](PackModel& pack) { pack.meshes[0].source_vertices += 1; }},
        {{"changed mesh strip: level 1", "changed mesh strip: hierarchy"},
         [](PackModel& pack)
         {
             for (GroupRecord& group : pack.groups)
                 if (group.error == 0.1F)
                     group.error = 0.15F;
             for (LevelRecord& level : pack.levels)
                 if (level.max_error == 0.1F)
                     level.max_error = 0.15F;
         }},
        {{"changed specular table : values"},
         [](PackModel& pack) { pack.specular_tables[0].values[5] ^= 1; }},
        {{"changed probe : texels"}, [](PackModel& pack) { pack.probe_texels[5] ^= 1; }},
        {{"changed probe : irradiance"}, [](PackModel& pack) { pack.probes[0].irradiance.x = 4; }},
        {{"changed receivers : light"}, [](PackModel& pack) { pack.receiver_words[2] ^= 1; }},
        {{"changed receivers : scale"}, [](PackModel& pack) { pack.receiver_atlases[0].scale = 0.25f; }},
        {{"changed surroundings : instances"},
         [](PackModel& pack) { pack.surroundings[0].visibility[3] = 0x3800; }},
        {{"changed surroundings : radiance transfers"},
         [](PackModel& pack) { pack.radiance_transfers[0].values[5] ^= 1; }},
        {{"added light sun", "changed bricks : reflectors"},
         [](PackModel& pack)
         {
             addNamed(pack, pack.lights, "sun");
             pack.bricks.reflectors.emplace_back();
         }},
        {{"added camera far"}, [](PackModel& pack) { addNamed(pack, pack.cameras, "far"); }},
        {{"removed camera camera", "removed extras camera camera"},
         [](PackModel& pack)
         {
             pack.cameras.clear();
             std::erase_if(pack.extras, [](const ExtrasRecord& record)
                           { return record.owner == static_cast<uint32_t>(ExtrasOwner::camera); });
         }},
        {{"changed extras node strip node: json"},
         [](PackModel& pack)
         {
             pack.extras[0].json = {static_cast<uint32_t>(pack.strings.size()), 2};
             pack.strings += "{}";
         }},
    };
    for (const Row& row : rows)
    {
        PackModel changed = smallPack();
        row.change(changed);
        const PackDiff diff = diffed(smallPack(), changed);
        EXPECT_EQ(formatLines(diff), row.lines) << command::diffText(diff);
        EXPECT_TRUE(diff.settings.empty());
    }
}

TEST_F(Diff, texelsAreCompared)
{
    PackModel changed = smallPack();
    changed.image_data[0][3] ^= std::byte{1};
    const PackDiff diff = diffed(smallPack(), changed);
    ASSERT_EQ(diff.entries.size(), 1u) << command::diffText(diff);
    EXPECT_EQ(diff.entries[0].kind, "texture");
    ASSERT_EQ(diff.entries[0].properties.size(), 1u);
    EXPECT_EQ(diff.entries[0].properties[0].name, "texels");
    EXPECT_EQ(diff.entries[0].note, "baseColor of paint, clearcoat of paint");
    EXPECT_EQ(Json::parse(command::diffJson(diff, "a", "b")).value()["changes"][0]["note"],
              diff.entries[0].note);
}

TEST_F(Diff, encodingsAreComparedInTheUnitsOfPeople)
{
    PackModel pack = smallPack();
    pack.images[0].role = static_cast<uint8_t>(ImageRole::normal);
    pack.images[0].error = 0.05F;
    pack.images[0].target = 0.04F;
    PackModel changed = pack;
    changed.images[0].error = 0.035F;
    changed.images[0].target_smooth = 0.01F; // which no error is beside
    changed.images[0].swizzle[1] = static_cast<uint8_t>(Swizzle::alpha);
    const PackDiff diff = diffed(pack, changed);
    ASSERT_EQ(diff.entries.size(), 1u) << command::diffText(diff);
    const std::string text = command::diffText(diff);
    EXPECT_NE(text.find("    swizzle: rgba -> raba\n"
                        "    error: 2.86 degrees (target 2.29, missed) -> 2.01 degrees (target 2.29)\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("target_smooth"), std::string::npos) << text;
}

TEST_F(Diff, textHasTotalsFirstAndHashesOnDemand)
{
    PackModel pack = smallPack();
    pack.bricks.reflectors.clear(); // of which each light would need one
    PackModel changed = pack;
    changed.image_data[0][3] ^= std::byte{1};
    changed.materials[0].metallic = 0.123F;
    addNamed(changed, changed.lights, "sun");
    const PackDiff diff = diffed(pack, changed);
    const std::string text = command::diffText(diff);
    EXPECT_TRUE(text.starts_with("2 changed, 1 added, 0 removed\n"
                                 "    material: 1 changed, 0 added, 0 removed\n"
                                 "    texture: 1 changed, 0 added, 0 removed\n"
                                 "    light: 0 changed, 1 added, 0 removed\n"
                                 "bytes    "))
        << text;
    const std::string texture =
        "changed  texture " + diff.entries[1].name + " (" + diff.entries[1].note + ")\n";
    EXPECT_NE(text.find("\n\nchanged  material paint\n    metallic: "), std::string::npos) << text;
    EXPECT_NE(text.find(texture + "    texels: other content\n"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("added    light sun\n")) << text;
    const std::string with_hashes = command::diffText(diff, {}, true);
    const command::PropertyChange& texels = diff.entries[1].properties.at(0);
    EXPECT_NE(with_hashes.find(texture + "    texels: " + texels.a + " -> " + texels.b + "\n"),
              std::string::npos)
        << with_hashes;
}

TEST_F(Diff, placesInTablesMeanNothing)
{
    // a material in front of all others: records that refer to materials by index still mean the same
    PackModel shifted = smallPack();
    addNamed(shifted, shifted.materials, "varnish");
    std::rotate(shifted.materials.begin(), shifted.materials.end() - 1, shifted.materials.end());
    for (ClusterRecord& cluster : shifted.clusters)
        cluster.material += cluster.material == kInvalidIndex ? 0 : 1;
    for (MaterialLayersRecord& layers : shifted.material_layers)
        ++layers.material;
    for (ExtrasRecord& record : shifted.extras)
        record.index += record.owner == static_cast<uint32_t>(ExtrasOwner::material) ? 1 : 0;
    EXPECT_EQ(formatLines(diffed(smallPack(), shifted)), std::set<std::string>{"added material varnish"});
    EXPECT_EQ(formatLines(diffed(shifted, smallPack())), std::set<std::string>{"removed material varnish"});
}

TEST_F(Diff, metaIsToldNumberByNumber)
{
    PackModel a = smallPack();
    PackModel b = smallPack();
    a.meta = importMeta("a.gltf");
    b.meta = importMeta("b.gltf");
    EXPECT_EQ(formatLines(diffed(a, b)),
              (std::set<std::string>{"removed source a.gltf", "added source b.gltf"}));
    a.meta = R"({"settings":{"clusters":{"levels":[1,2]}},"tool":{"version":"1"}})";
    b.meta = R"({"settings":{"clusters":{"levels":[1,3],"x":true}},"tool":{"version":"2"}})";
    const PackDiff diff = diffed(a, b);
    EXPECT_TRUE(diff.entries.empty());
    const Json json = Json::parse(command::diffJson(diff, "a", "b")).value();
    EXPECT_EQ(json["settings"], Json::parse(R"([{"what": "/settings/clusters/levels/1", "a": "2", "b": "3"},
                                                {"what": "/tool/version", "a": "\"1\"", "b": "\"2\""},
                                                {"what": "/settings/clusters/x", "a": "", "b": "true"}])")
                                    .value());
}

TEST(DiffThings, pairsThoseOfOneNameByWhatTheyAre)
{
    const auto grass = [](const std::string& place) {
        return PackEntry{"instance", "grass", {{"place", place}}};
    };
    const std::vector<PackEntry> a{grass("1"), grass("2"), grass("3"), grass("3")};
    const std::vector<PackEntry> b{grass("3"), grass("0"), grass("1"), grass("2"), grass("3"), grass("4")};
    EXPECT_EQ(command::diffEntries(a, b).size(), 2u) << "0 and 4 are new, whatever stands where";
    const auto moved =
        command::diffEntries(std::vector{grass("1"), grass("2")}, std::vector{grass("2"), grass("7")});
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_EQ(moved[0].type, EntryChange::ChangeType::changed);
    EXPECT_EQ(moved[0].properties[0].a, "1");
    EXPECT_EQ(moved[0].properties[0].b, "7");
    EXPECT_EQ(command::diffEntries(b, a)[0].type, EntryChange::ChangeType::removed);
    // two images without names
    const auto image = [](const std::string& note, const std::string& texels) {
        return PackEntry{"texture", "image 0", {{"texels", texels, true}}, note};
    };
    const auto textures =
        command::diffEntries(std::vector{image("normal of Bark", "1"), image("normal of Leaf", "2")},
                             std::vector{image("normal of Leaf", "3"), image("normal of Moss", "4")});
    ASSERT_EQ(textures.size(), 2u);
    EXPECT_EQ(textures[0].note, "normal of Leaf");
    EXPECT_EQ(textures[0].properties.at(0).b, "3");
    EXPECT_EQ(textures[1].properties.at(0).a, "1");
    EXPECT_EQ(textures[1].properties.at(0).b, "4");
    const std::vector<PackEntry> other{{"light", "grass", {{"place", "1"}}}};
    EXPECT_EQ(command::diffEntries(a, other).size(), 5u) << "kinds are not mixed";
}

TEST_F(Diff, theCommandSaysSoByItsExitCode)
{
    writePackFile(smallPack(), sandbox / "a.hearth");
    PackModel changed = smallPack();
    changed.materials[0].metallic = 0.123F;
    writePackFile(changed, sandbox / "b.hearth");
    const auto diff = [&](std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {HEARTH_BIN "/hearth", "diff"});
        return sandbox.run(arguments);
    };
    EXPECT_EQ(diff({"a.hearth", "a.hearth"}).exit_code, 0);
    const ProgramEnd end = diff({"a.hearth", "b.hearth"});
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_NE(end.out.find("changed  material paint\n    metallic: "), std::string::npos) << end.out;
    EXPECT_EQ(diff({"a.hearth", "b.hearth", "--hashes"}).exit_code, 1);
    EXPECT_EQ(Json::parse(diff({"a.hearth", "b.hearth", "--format", "json"}).out).value()["same"], false);
    EXPECT_EQ(diff({"a.hearth", "nowhere.hearth"}).exit_code, 66);
    EXPECT_EQ(diff({"a.hearth"}).exit_code, 2);
    writeParts(smallPack(), sandbox.path(), "part");
    EXPECT_EQ(diff({"a.hearth", "part.clusters.part"}).exit_code, 65);
}

} // namespace hearth::test
