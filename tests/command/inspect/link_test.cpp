// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/pages/mesh_copies.h"
#include "pipelines/link/link.h"

#include "formats/container/container_writer.h"
#include "formats/pack/pack_check.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <stdexcept>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Folder with parts of the small pack, once or several times.
class LinkPack : public ::testing::Test
{
protected:
    void addParts(const PackModel& pack, const std::string& prefix)
    {
        writeParts(pack, sandbox.path(), prefix);
        const std::string path = sandbox / prefix;
        sources.push_back({path + ".import.part", path + ".clusters.part", path + ".textures.part",
                           path + ".skinning.part"});
    }

    /// Write the small pack as an asset of this name, with every kind of reference that a record can have.
    static PackModel named(const std::string& name)
    {
        PackModel pack = smallPack();
        pack.meta = importMeta(name);
        pack.materials[0].metallic_roughness_texture.image = 1;
        pack.materials[0].normal_texture.image = 0;
        pack.materials[0].occlusion_texture.image = 1;
        pack.materials[0].emissive_texture.image = kInvalidIndex;
        pack.skins[0].skeleton_root = 2;
        return pack;
    }

    Status link()
    {
        return link::linkPack(sources, sandbox / "out.hearth", {specular, bricks, probes, receivers});
    }

    PackView linked()
    {
        const Status status = link();
        if (!status.ok())
            throw std::runtime_error(formatMessage(status.error())); // ends this test alone
        return PackView::read(ContainerReader::open(sandbox / "out.hearth").value()).value();
    }

    Sandbox sandbox;
    std::vector<link::SourceParts> sources;
    std::vector<std::string> specular;
    std::string bricks;
    std::vector<std::string> probes;
    std::string receivers;
};

template <typename T>
bool sameBytes(std::span<const T> a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

} // namespace

TEST_F(LinkPack, oneSourceKeepsEveryRecord)
{
    const PackModel model = named("a.gltf");
    addParts(model, "a");
    const PackView pack = linked();
    EXPECT_EQ(pack.container().kind(), ContainerKind::pack);
    EXPECT_TRUE(sameBytes(pack.nodes(), model.nodes));
    EXPECT_TRUE(sameBytes(pack.instances(), model.instances));
    EXPECT_TRUE(sameBytes(pack.cameras(), model.cameras));
    EXPECT_TRUE(sameBytes(pack.lights(), model.lights));
    EXPECT_TRUE(sameBytes(pack.materials(), model.materials));
    EXPECT_TRUE(sameBytes(pack.materialLayers(), model.material_layers));
    EXPECT_TRUE(sameBytes(pack.images(), model.images));
    EXPECT_TRUE(sameBytes(pack.skins(), model.skins));
    EXPECT_TRUE(sameBytes(pack.joints(), model.joints));
    EXPECT_TRUE(sameBytes(pack.animations(), model.animations));
    EXPECT_TRUE(sameBytes(pack.channels(), model.channels));
    EXPECT_TRUE(sameBytes(pack.keys(), model.keys));
    EXPECT_TRUE(sameBytes(pack.keyBits(), model.key_bits));
    EXPECT_TRUE(sameBytes(pack.morphWeights(), model.morph_weights));
    EXPECT_TRUE(sameBytes(pack.levels(), model.levels));
    EXPECT_TRUE(sameBytes(pack.groups(), model.groups));
    EXPECT_TRUE(sameBytes(pack.clusters(), model.clusters));
    EXPECT_TRUE(sameBytes(pack.pages(), model.pages));
    EXPECT_TRUE(sameBytes(pack.pageParents(), model.page_parents));
    EXPECT_TRUE(sameBytes(pack.deformedMeshes(), model.deformed_meshes));
    EXPECT_TRUE(sameBytes(pack.deformedClusters(), model.deformed_clusters));
    EXPECT_TRUE(sameBytes(pack.clusterJoints(), model.cluster_joints));
    ASSERT_EQ(pack.meshes().size(), model.meshes.size());
    EXPECT_EQ(pack.text(pack.meshes()[0].name), "strip");
    EXPECT_EQ(pack.text(pack.meshes()[2].name), "triangle");
    for (uint32_t i = 0; i < model.pages.size(); ++i)
        EXPECT_EQ(pack.decodePage(i).value(), model.decoded_pages[i]);
    for (uint32_t i = 0; i < model.images.size(); ++i)
        EXPECT_TRUE(sameBytes(pack.imageData(i).value().bytes(), model.image_data[i]));
}

TEST_F(LinkPack, leavesOutWhatOnlyCookersNeed)
{
    addParts(smallPack(), "a");
    const PackView pack = linked();
    EXPECT_EQ(pack.container().find(kChunkSourceMesh), nullptr);
    EXPECT_EQ(pack.container().find(kChunkDeformedGroups), nullptr);
}

TEST_F(LinkPack, groupsOfDeformedMeshesGetTheirSpheres)
{
    PackModel model = smallPack();
    model.deformed_groups = {{{7, 8, 9}, 5, 3}};
    addParts(model, "a");
    model.deformed_groups = {{{4, 5, 6}, 6, 3}};
    addParts(model, "b");
    const PackView pack = linked();
    ASSERT_EQ(pack.groups().size(), 8u);
    EXPECT_EQ(pack.groups()[3].sphere_center, (Float3{7, 8, 9}));
    EXPECT_EQ(pack.groups()[3].sphere_radius, 5);
    EXPECT_EQ(pack.groups()[7].sphere_center, (Float3{4, 5, 6}));
    EXPECT_EQ(pack.groups()[7].sphere_radius, 6);
    EXPECT_EQ(pack.groups()[2].sphere_center, model.groups[2].sphere_center);
}

TEST_F(LinkPack, instancesDrawTheCopiesOfTheirMeshes)
{
    PackModel model = smallPack();
    const uint32_t copied = model.instances[0].mesh;
    const auto copy = static_cast<uint32_t>(model.meshes.size());
    model.instance_meshes = {copy, model.instances[1].mesh};
    for (ExtrasRecord& extras : model.extras)
        if (static_cast<ExtrasOwner>(extras.owner) == ExtrasOwner::mesh)
            extras.index = copied;
    addParts(smallPack(), "a");
    addParts(model, "b");
    const std::string part = sandbox / "b.clusters.part", whole = sandbox / "copied.part";
    {
        const PackView view = PackView::read(ContainerReader::open(part).value()).value();
        ASSERT_TRUE(pages::copyMeshes(view, std::span(&copied, 1), whole).ok());
    }
    std::filesystem::rename(whole, part);
    const PackView pack = linked();
    ASSERT_EQ(pack.instances().size(), 4u);
    EXPECT_EQ(pack.instances()[2].mesh, copy + copy) << "behind the meshes of both sources";
    EXPECT_EQ(pack.instances()[3].mesh, copy + model.instances[1].mesh);
    EXPECT_EQ(pack.assets()[1].meshes.count, copy + 1);
    EXPECT_EQ(pack.findExtras(ExtrasOwner::mesh, copy + copied), "[1,2]");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::mesh, copy + copy), "[1,2]");
    EXPECT_EQ(pack.container().find(kChunkInstanceMeshes), nullptr);
}

TEST_F(LinkPack, refusesInstancesOfOtherMeshes)
{
    PackModel model = smallPack();
    model.instance_meshes = {0};
    addParts(model, "a");
    EXPECT_EQ(link().error().issue, Issue::meaning_reference) << "it has two instances";
    sources.clear();
    model.instance_meshes = {0, static_cast<uint32_t>(model.meshes.size())};
    addParts(model, "b");
    EXPECT_EQ(link().error().issue, Issue::meaning_reference) << "there is no such mesh";
}

TEST_F(LinkPack, boundsOfASecondSourceStandBehindTheFirst)
{
    addParts(smallPack(), "a");
    addParts(smallPack(), "b");
    const PackView pack = linked();
    ASSERT_EQ(pack.deformedMeshes().size(), 2u);
    EXPECT_EQ(pack.deformedMeshes()[1].mesh, 5u);
    EXPECT_EQ(pack.deformedMeshes()[1].skin, 1u);
    EXPECT_EQ(pack.deformedMeshes()[1].clusters.first, 1u);
    EXPECT_EQ(pack.deformedClusters()[1].joints.first, 2u);
    EXPECT_EQ(pack.clusterJoints()[2], 1u) << "joints count in their skin";
}

TEST_F(LinkPack, refusesASphereOfAGroupThatIsNotThere)
{
    PackModel model = smallPack();
    model.deformed_groups[0].group = 4;
    addParts(model, "a");
    EXPECT_EQ(link().error().issue, Issue::meaning_reference);
}

TEST_F(LinkPack, sourceWithoutDeformedMeshesNeedsNoBounds)
{
    PackModel model = smallPack();
    model.nodes[3].mesh = model.nodes[3].skin = kInvalidIndex;
    model.nodes[3].morph_weights = {};
    model.deformed_meshes.clear();
    model.deformed_clusters.clear();
    model.cluster_joints.clear();
    model.deformed_groups.clear();
    addParts(model, "a");
    EXPECT_EQ(linked().container().find(kChunkDeformedMeshes), nullptr);
}

TEST_F(LinkPack, takesOneTableOfSpecularOcclusion)
{
    addParts(smallPack(), "a");
    EXPECT_TRUE(linked().specularTables().empty()) << "that of an import part is none";
    PackModel model = smallPack();
    writeSpecularPart(model, sandbox / "one.part");
    writeSpecularPart(model, sandbox / "same.part");
    model.specular_tables[0].values[15] = 254;
    writeSpecularPart(model, sandbox / "other.part");

    specular = {sandbox / "one.part", sandbox / "same.part"};
    const PackView pack = linked();
    EXPECT_TRUE(sameBytes(pack.specularTables(), smallPack().specular_tables));

    specular.push_back(sandbox / "other.part");
    const Status differs = link();
    ASSERT_FALSE(differs.ok());
    EXPECT_EQ(differs.error().issue, Issue::meaning_reference);
    EXPECT_EQ(differs.error().file, sandbox / "other.part");

    specular = {sandbox / "a.clusters.part"};
    EXPECT_EQ(link().error().issue, Issue::chunk_missing);
}

TEST_F(LinkPack, surroundingsStayWithTheirInstances)
{
    const PackModel model = smallPack();
    addParts(model, "a");
    PackModel without = smallPack();
    without.surroundings.clear();
    without.radiance_transfers.clear();
    addParts(without, "b");
    addParts(model, "c");
    const PackView pack = linked();
    const size_t count = model.instances.size();
    ASSERT_EQ(pack.surroundings().size(), 3 * count);
    ASSERT_EQ(pack.radianceTransfers().size(), 2u);
    EXPECT_EQ(pack.surroundings()[count - 1].transfer, 0u);
    EXPECT_EQ(pack.surroundings()[3 * count - 1].transfer, 1u);
    EXPECT_EQ(pack.surroundings()[3 * count - 1].visibility[3], model.surroundings.back().visibility[3]);
    for (const size_t i : {size_t{0}, count, 2 * count - 1})
    {
        EXPECT_EQ(pack.surroundings()[i].transfer, kInvalidIndex) << i;
        EXPECT_EQ(pack.surroundings()[i].visibility[3], kHalfOne) << i;
    }
}

TEST_F(LinkPack, refusesSurroundingsOfOtherInstances)
{
    PackModel model = smallPack();
    model.surroundings.pop_back();
    addParts(model, "a");
    EXPECT_EQ(link().error().issue, Issue::meaning_reference);
}

TEST_F(LinkPack, takesTheBricksOfAPart)
{
    addParts(smallPack(), "a");
    EXPECT_TRUE(linked().brickGrid().empty()) << "those of an import part are none";
    writeBricksPart(smallPack(), sandbox / "bricks.part");
    bricks = sandbox / "bricks.part";
    const PackView pack = linked();
    const BrickModel& expected = smallPack().bricks;
    EXPECT_TRUE(sameBytes(pack.brickGrid(), smallPack().brick_grids));
    EXPECT_TRUE(sameBytes(pack.brickGroupsAlongAxis(), expected.groups));
    EXPECT_TRUE(sameBytes(pack.bricks(), expected.bricks));
    EXPECT_TRUE(sameBytes(pack.brickOpacity(), expected.opacity));
    EXPECT_TRUE(sameBytes(pack.brickAlbedo(), expected.albedo));
    EXPECT_TRUE(sameBytes(pack.brickNormals(), expected.normals));
    EXPECT_TRUE(sameBytes(pack.brickEmission(), expected.emission));
    EXPECT_TRUE(sameBytes(pack.brickLighting(), expected.lighting));
    EXPECT_TRUE(sameBytes(pack.reflectors(), expected.reflectors));
}

TEST_F(LinkPack, refusesWrongBricksAndNone)
{
    addParts(smallPack(), "a");
    bricks = sandbox / "a.clusters.part";
    EXPECT_EQ(link().error().issue, Issue::chunk_missing);

    PackModel model = smallPack();
    model.bricks.opacity[0] = 0;
    bricks = sandbox / "wrong.part";
    writeBricksPart(model, bricks);
    const Status wrong = link();
    ASSERT_FALSE(wrong.ok());
    EXPECT_EQ(wrong.error().issue, Issue::meaning_value);
    EXPECT_EQ(wrong.error().file, bricks);
    EXPECT_FALSE(sandbox.has("out.hearth"));
}

TEST_F(LinkPack, takesTheReceiversOfAPart)
{
    addParts(smallPack(), "a");
    EXPECT_TRUE(linked().receiverAtlases().empty()) << "those of an import part are none";
    receivers = sandbox / "receivers.part";
    writeReceiversPart(smallPack(), receivers);
    EXPECT_EQ(link().error().issue, Issue::meaning_reference)
        << "light of bricks that the pack does not have";
    EXPECT_EQ(link().error().file, receivers);
    bricks = sandbox / "bricks.part";
    writeBricksPart(smallPack(), bricks);
    const PackView pack = linked();
    const PackModel expected = smallPack();
    EXPECT_TRUE(sameBytes(pack.faceAtlases(), expected.face_atlases));
    EXPECT_TRUE(sameBytes(pack.faceReceivers().blocks, expected.face_blocks));
    EXPECT_TRUE(sameBytes(pack.faceReceivers().words, expected.face_words));
    EXPECT_TRUE(sameBytes(pack.receiverAtlases(), expected.receiver_atlases));
    EXPECT_TRUE(sameBytes(pack.receivers().lamps, expected.receiver_lamps));
    EXPECT_TRUE(sameBytes(pack.receivers().rects, expected.receiver_rects));
    EXPECT_TRUE(sameBytes(pack.receivers().blocks, expected.receiver_blocks));
    EXPECT_TRUE(sameBytes(pack.receivers().words, expected.receiver_words));
}

TEST_F(LinkPack, refusesWrongReceiversAndNone)
{
    addParts(smallPack(), "a");
    receivers = sandbox / "a.clusters.part";
    EXPECT_EQ(link().error().issue, Issue::chunk_missing);
    PackModel model = smallPack();
    model.receiver_atlases[0].codec = 7;
    receivers = sandbox / "wrong.part";
    writeReceiversPart(model, receivers);
    EXPECT_EQ(link().error().issue, Issue::meaning_value);
    EXPECT_EQ(link().error().file, receivers);
    bricks = sandbox / "bricks.part";
    writeBricksPart(smallPack(), bricks);
    model = smallPack();
    model.receiver_lamps[1].index = 99; // of the lights, which are in another part
    writeReceiversPart(model, receivers);
    EXPECT_EQ(link().error().issue, Issue::meaning_reference);
}

TEST_F(LinkPack, takesAProbe)
{
    addParts(smallPack(), "a");
    EXPECT_TRUE(linked().probes().empty()) << "that of an import part is none";
    PackModel model = smallPack();
    probes = {sandbox / "sky.part"};
    writeProbePart(model, probes[0]);
    const PackView pack = linked();
    EXPECT_TRUE(sameBytes(pack.probes(), model.probes));
    EXPECT_TRUE(sameBytes(pack.probeTexels(), model.probe_texels));

    model.probes[0].window = -1;
    writeProbePart(model, probes[0]);
    const Status wrong = link();
    ASSERT_FALSE(wrong.ok());
    EXPECT_EQ(wrong.error().issue, Issue::meaning_value);
    EXPECT_EQ(wrong.error().file, probes[0]);
    writeSpecularPart(model, probes[0]);
    EXPECT_EQ(link().error().issue, Issue::chunk_missing);
}

TEST_F(LinkPack, joinsTheProbesOfParts)
{
    addParts(smallPack(), "a");
    PackModel model = smallPack();
    probes = {sandbox / "sky.part", sandbox / "rooms.part"};
    writeProbePart(model, probes[0]);
    const std::vector<uint32_t> sky = model.probe_texels;
    model.probe_texels[3] += 5;
    model.probes[0].irradiance.x = 4;
    writeProbePart(model, probes[1]);
    const PackView pack = linked();
    ASSERT_EQ(pack.probes().size(), 2u);
    EXPECT_EQ(pack.probes()[0].irradiance.x, 3);
    EXPECT_EQ(pack.probes()[1].irradiance.x, 4);
    ASSERT_EQ(pack.probeTexels().size(), 2 * sky.size());
    EXPECT_EQ(pack.probes()[1].texels.first, sky.size());
    EXPECT_EQ(pack.probeTexels()[sky.size() + 3], sky[3] + 5);
}

TEST_F(LinkPack, refusesAWrongTableOfSpecularOcclusion)
{
    addParts(smallPack(), "a");
    PackModel model = smallPack();
    model.specular_tables[0].spacing = 7;
    writeSpecularPart(model, sandbox / "wrong.part");
    specular = {sandbox / "wrong.part"};
    EXPECT_EQ(link().error().issue, Issue::meaning_value);
    EXPECT_FALSE(sandbox.has("out.hearth"));
}

TEST_F(LinkPack, secondSourceStandsBehindTheFirst)
{
    const PackModel model = named("a.gltf");
    // longer strings in front: a name that was not relocated would read as another one
    PackModel first = model;
    first.strings.insert(0, "0123456789");
    const auto move = [](auto& records)
    {
        for (auto& record : records)
            record.name.offset += 10;
    };
    move(first.nodes);
    move(first.cameras);
    move(first.lights);
    move(first.materials);
    move(first.images);
    move(first.skins);
    move(first.animations);
    move(first.meshes);
    for (ExtrasRecord& record : first.extras)
        record.json.offset += 10;
    addParts(first, "a");
    PackModel second = named("b.gltf");
    for (std::vector<std::byte>& texels : second.image_data)
        texels[0] = std::byte{0x11}; // equal images would be one
    addParts(second, "b");
    const PackView pack =
        linked(); // checked: every index of both is inside its table, every page where it should be

    const uint32_t nodes = static_cast<uint32_t>(model.nodes.size());
    const uint32_t meshes = static_cast<uint32_t>(model.meshes.size());
    const uint32_t clusters = static_cast<uint32_t>(model.clusters.size());
    ASSERT_EQ(pack.nodes().size(), 2 * nodes);
    ASSERT_EQ(pack.meshes().size(), 2 * meshes);
    ASSERT_EQ(pack.clusters().size(), 2 * clusters);
    EXPECT_EQ(pack.nodes()[nodes + 1].parent, nodes + model.nodes[1].parent);
    EXPECT_EQ(pack.nodes()[nodes].parent, kInvalidIndex);
    EXPECT_EQ(pack.nodes()[nodes + 3].mesh, meshes + 2);
    EXPECT_EQ(pack.nodes()[nodes + 3].skin, 1u);
    EXPECT_EQ(pack.nodes()[nodes + 3].morph_weights.first, 1u);
    EXPECT_EQ(pack.instances()[2].mesh, meshes);
    EXPECT_EQ(pack.instances()[2].node, nodes + 1);
    EXPECT_EQ(pack.materials()[1].base_color_texture.image, 2u);
    EXPECT_EQ(pack.materials()[1].metallic_roughness_texture.image, 3u);
    EXPECT_EQ(pack.materials()[1].normal_texture.image, 2u);
    EXPECT_EQ(pack.materials()[1].occlusion_texture.image, 3u);
    EXPECT_EQ(pack.materials()[1].emissive_texture.image, kInvalidIndex);
    ASSERT_EQ(pack.materialLayers().size(), 2u);
    EXPECT_EQ(pack.materialLayers()[1].material, 1u);
    EXPECT_EQ(pack.materialLayers()[1].clearcoat_texture.image, 2u);
    EXPECT_EQ(pack.materialLayers()[1].sheen_texture.image, kInvalidIndex);
    EXPECT_EQ(pack.cameras()[2].node, nodes);
    EXPECT_EQ(pack.lights()[3].node, nodes);
    EXPECT_EQ(pack.skins()[1].joints.first, 2u);
    EXPECT_EQ(pack.skins()[1].skeleton_root, nodes + 2);
    EXPECT_EQ(pack.joints()[3].node, nodes + 2);
    EXPECT_EQ(pack.animations()[3].channels.first, 7u);
    EXPECT_EQ(pack.animations()[5].light_channels.first, 12u);
    EXPECT_EQ(pack.channels()[7].target, nodes + 1);
    EXPECT_EQ(pack.channels()[7].first_time, model.keys.size());
    EXPECT_EQ(pack.channels()[7].first_value, model.keys.size() + 3);
    EXPECT_EQ(pack.channels()[7].first_word, 0u);
    EXPECT_EQ(pack.channels()[10].first_word, model.key_bits.size());
    EXPECT_EQ(pack.channels()[12].target, model.lights.size() + 1) << "a channel of a light";
    EXPECT_EQ(pack.keyBits()[2], model.key_bits[0]);
    EXPECT_EQ(pack.clusters()[clusters].material, 1u);
    EXPECT_EQ(pack.pages()[pack.clusters()[clusters].page].mesh, meshes);
    EXPECT_EQ(pack.clusters()[clusters].refined_group, model.groups.size() + 1);
    EXPECT_EQ(pack.clusters()[2 * clusters - 1].refined_group, kInvalidIndex);
    EXPECT_EQ(pack.pageParents()[2], model.pages.size());

    EXPECT_EQ(pack.text(pack.nodes()[nodes + 1].name), "strip node");
    EXPECT_EQ(pack.text(pack.meshes()[meshes].name), "strip");
    EXPECT_EQ(pack.text(pack.images()[2].name), "paint.png");
    EXPECT_EQ(pack.text(pack.cameras()[2].name), "camera");
    EXPECT_EQ(pack.text(pack.lights()[3].name), "light");
    EXPECT_EQ(pack.text(pack.materials()[1].name), "paint");
    EXPECT_EQ(pack.text(pack.skins()[1].name), "skin");
    EXPECT_EQ(pack.text(pack.animations()[3].name), "move");
    for (uint32_t i = 0; i < model.pages.size(); ++i)
        EXPECT_EQ(pack.decodePage(static_cast<uint32_t>(model.pages.size()) + i).value(),
                  model.decoded_pages[i]);
    EXPECT_TRUE(sameBytes(pack.imageData(3).value().bytes(), second.image_data[1]));
}

TEST_F(LinkPack, equalImagesAreStoredOnce)
{
    PackModel second = named("b.gltf");
    second.image_data[1][3] = std::byte{0x11}; // of equal size, but not equal
    addParts(named("a.gltf"), "a");
    addParts(second, "b");
    const PackView pack = linked();
    ASSERT_EQ(pack.images().size(), 3u);
    EXPECT_EQ(pack.materials()[0].base_color_texture.image, 0u);
    EXPECT_EQ(pack.materials()[0].metallic_roughness_texture.image, 1u);
    EXPECT_EQ(pack.materials()[1].base_color_texture.image, 0u) << "that of the first source";
    EXPECT_EQ(pack.materials()[1].metallic_roughness_texture.image, 2u);
    EXPECT_EQ(pack.materials()[1].emissive_texture.image, kInvalidIndex);
    EXPECT_EQ(pack.materialLayers()[1].clearcoat_texture.image, 0u);
    EXPECT_TRUE(sameBytes(pack.imageData(2).value().bytes(), second.image_data[1]));
}

TEST_F(LinkPack, equalImagesGetTheStrictestOfTheirTargets)
{
    const float targets[][2] = {{0.02F, 0}, {0.01F, 0.003F}, {0, 0}, {0.03F, 0.004F}};
    const std::string names = "abcd";
    for (size_t i = 0; i < names.size(); ++i)
    {
        PackModel part = named(names.substr(i, 1) + ".gltf");
        part.images[0].target = targets[i][0];
        part.images[0].target_smooth = targets[i][1];
        addParts(part, names.substr(i, 1));
    }
    const PackView pack = linked();
    ASSERT_EQ(pack.images().size(), 2u);
    EXPECT_EQ(pack.images()[0].target, 0.01F);
    EXPECT_EQ(pack.images()[0].target_smooth, 0.003F) << "0 is none";
    EXPECT_EQ(pack.images()[1].target, 0);
}

TEST_F(LinkPack, imagesOfEqualBytesAndOtherFormatsStayTwo)
{
    PackModel second = named("b.gltf");
    second.images[0].format = static_cast<uint32_t>(TexelFormat::rgba8_unorm);
    addParts(named("a.gltf"), "a");
    addParts(second, "b");
    EXPECT_EQ(linked().images().size(), 3u);
}

TEST_F(LinkPack, extrasOfEachSourceStayWithTheirObjects)
{
    const PackModel model = named("a.gltf");
    addParts(model, "a");
    PackModel second = named("b.gltf");
    const auto at = static_cast<uint32_t>(second.strings.size());
    second.strings += "{}";
    for (ExtrasRecord& record : second.extras)
        record.json = {at, 2};
    second.extras.erase(second.extras.begin()); // that of node 1
    addParts(second, "b");
    const PackView pack = linked();
    ASSERT_EQ(pack.extras().size(), 19u);
    for (const ExtrasRecord& record : model.extras)
        EXPECT_EQ(pack.findExtras(static_cast<ExtrasOwner>(record.owner), record.index),
                  model.strings.substr(record.json.offset, record.json.length));
    const auto count = [](const auto& table) { return static_cast<uint32_t>(table.size()); };
    EXPECT_EQ(pack.findExtras(ExtrasOwner::node, count(model.nodes) + 1), "");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::mesh, count(model.meshes) + 2), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::material, count(model.materials)), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::camera, count(model.cameras) + 1), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::light, count(model.lights) + 2), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::skin, count(model.skins)), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::animation, count(model.animations) + 1), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::asset, 1), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::scene, 1), "{}");
    EXPECT_EQ(pack.findExtras(ExtrasOwner::file, 1), "{}");
}

TEST_F(LinkPack, withoutExtrasThereIsNoChunk)
{
    PackModel model = named("a.gltf");
    model.extras.clear();
    addParts(model, "a");
    EXPECT_EQ(linked().container().find(kChunkExtras), nullptr);
}

TEST_F(LinkPack, withoutLayersThereIsNoChunk)
{
    PackModel model = named("a.gltf");
    model.material_layers.clear();
    addParts(model, "a");
    EXPECT_EQ(linked().container().find(kChunkMaterialLayers), nullptr);
}

TEST_F(LinkPack, anAssetForEachSource)
{
    addParts(named("Old.Rock.gltf"), "a");
    PackModel second = named("b.gltf");
    second.instances[0].world_from_object.m[0][3] = -20; // the strip, from 0 to 4 along x
    second.nodes[2].parent_from_node.m[1][3] = 10;       // one of the joints of the triangle
    second.nodes[2].has_trs = 0;
    // at a weight of 1; the small pack's weight of 0.5 reaches half of it
    second.deformed_clusters[0].morph_reach = 0.5f;
    addParts(second, "b");
    PackModel third = named(".hidden");
    third.instances.clear();
    third.surroundings.clear();
    third.radiance_transfers.clear();
    addParts(third, "c");
    const PackView pack = linked();

    ASSERT_EQ(pack.assets().size(), 3u);
    const auto nodes = static_cast<uint32_t>(second.nodes.size());
    const auto expectRange = [](Range range, uint32_t first, uint32_t count)
    {
        EXPECT_EQ(range.first, first);
        EXPECT_EQ(range.count, count);
    };
    for (uint32_t i = 0; i < 3; ++i)
    {
        SCOPED_TRACE(i);
        expectRange(pack.assets()[i].instances, 2 * i, i < 2 ? 2 : 0);
        expectRange(pack.assets()[i].meshes, 3 * i, 3);
        expectRange(pack.assets()[i].nodes, nodes * i, nodes);
    }
    EXPECT_EQ(pack.text(pack.assets()[0].name), "Old.Rock");
    EXPECT_EQ(pack.text(pack.assets()[1].name), "b");
    EXPECT_EQ(pack.text(pack.assets()[2].name), ".hidden");

    const auto expectBox = [](const AssetRecord& asset, Float3 low, Float3 high)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            EXPECT_LE(asset.box_min[axis], low[axis]);
            EXPECT_GE(asset.box_max[axis], high[axis]);
            EXPECT_NEAR(asset.box_min[axis], low[axis], 1e-5f);
            EXPECT_NEAR(asset.box_max[axis], high[axis], 1e-5f);
        }
    };
    EXPECT_EQ(pack.assets()[0].box_min, (Float3{0, 0, 0})) << "what floats can say is not rounded";
    expectBox(pack.assets()[0], {0, 0, 0}, {4, 96 / 1024.0f, 1});
    expectBox(pack.assets()[1], {-20, -0.25f, -0.25f}, {1.25f, 10.25f, 1.25f});
    EXPECT_EQ(pack.assets()[2].box_min, (Float3{}));
    EXPECT_EQ(largestSide(pack.assets()[2]), 0) << "draws nothing";
    EXPECT_NEAR(largestSide(pack.assets()[1]), 21.25f, 1e-4f);
}

TEST_F(LinkPack, refusesAPartWhoseJointsAreWrong)
{
    PackModel model = smallPack();
    model.nodes[2].parent = 1; // and the parent of node 1 is node 2
    addParts(model, "a");
    const Status wrong = link();
    ASSERT_FALSE(wrong.ok());
    EXPECT_EQ(wrong.error().issue, Issue::meaning_tree);
    EXPECT_EQ(wrong.error().file, sandbox / "a.import.part");
    EXPECT_FALSE(sandbox.has("out.hearth"));
}

TEST_F(LinkPack, sameBytesWhereverItIsDone)
{
    addParts(named("a.gltf"), "a");
    addParts(named("b.gltf"), "b");
    ASSERT_TRUE(link().ok());
    const std::string first = sandbox.read("out.hearth");

    Sandbox other;
    for (const char* prefix : {"x", "y"})
        writeParts(named(prefix == std::string("x") ? "a.gltf" : "b.gltf"), other.path(), prefix);
    const auto parts = [&](const std::string& prefix)
    {
        return link::SourceParts{other / (prefix + ".import.part"), other / (prefix + ".clusters.part"),
                                 other / (prefix + ".textures.part"), other / (prefix + ".skinning.part")};
    };
    const link::SourceParts again[] = {parts("x"), parts("y")};
    ASSERT_TRUE(link::linkPack(again, other / "elsewhere.hearth").ok());
    EXPECT_EQ(other.read("elsewhere.hearth"), first);
}

TEST_F(LinkPack, metaTellsWhatWentIn)
{
    addParts(named("a.gltf"), "a");
    addParts(named("b.gltf"), "b");
    const auto meta = Json::parse(linked().meta()).value();
    EXPECT_EQ(meta["schema"], "hearth.meta/1");
    ASSERT_EQ(meta["sources"].size(), 2u);
    EXPECT_EQ(meta["sources"][1]["name"], "b.gltf");
    EXPECT_EQ(meta["counts"]["triangles"], 18);
    EXPECT_EQ(meta["counts"]["joints"], 4);
    ASSERT_EQ(meta["messages"].size(), 2u);
    EXPECT_EQ(meta["messages"][1]["source"], "b.gltf");
    EXPECT_EQ(meta["messages"][1]["code"], "W1400");
    EXPECT_EQ(meta["messages_left_out"], 6);
    EXPECT_EQ(meta["dropped"].size(), 2u);
    EXPECT_FALSE(meta.contains("skipped")) << "a pack that lacks nothing has the bytes of any other cook";
    // paths of the build machine are not stored in the pack
    EXPECT_EQ(meta.dump().find("/where"), std::string::npos);
    EXPECT_EQ(meta.dump().find(sandbox.path()), std::string::npos);
}

TEST_F(LinkPack, takesMaterialsWithTheirLayersFromATexturesPartThatHasSome)
{
    PackModel model = named("a.gltf");
    addParts(model, "a");
    model.materials[0].roughness = 0.125f;
    for (TextureRef MaterialRecord::*const texture : kMaterialTextureFields)
        if ((model.materials[0].*texture).image != kInvalidIndex)
            (model.materials[0].*texture).image = 0;
    ASSERT_FALSE(model.material_layers.empty());
    for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
        (model.material_layers[0].*texture).image = kInvalidIndex;
    model.images.resize(1);
    const std::string made = "orm roughness"; // a name that the importer did not know
    model.images[0].name = {static_cast<uint32_t>(model.strings.size()), static_cast<uint32_t>(made.size())};
    auto writer = formats::ContainerWriter::create(sandbox / "a.textures.part", ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    EXPECT_TRUE(writer->addText(kChunkStrings, model.strings + made).ok());
    EXPECT_TRUE(writer->addChunk({.type = kChunkImageData}, model.image_data[0], 1, Codec::none).ok());
    EXPECT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, model.images).ok());
    EXPECT_TRUE(writer->addRecords<MaterialRecord>(kChunkMaterials, model.materials).ok());
    EXPECT_TRUE(writer->addRecords<MaterialLayersRecord>(kChunkMaterialLayers, model.material_layers).ok());
    EXPECT_TRUE(writer->finish().ok());
    addParts(named("b.gltf"), "b");

    const PackView pack = linked();
    EXPECT_TRUE(sameBytes(pack.materials().first(1), model.materials));
    EXPECT_TRUE(sameBytes(pack.materialLayers().first(1), model.material_layers));
    ASSERT_EQ(pack.images().size(), 3u);
    const auto nameInSource = [&](StringRef name)
    { return std::string_view(model.strings).substr(name.offset, name.length); };
    EXPECT_EQ(pack.text(pack.images()[0].name), made);
    EXPECT_EQ(pack.text(pack.images()[1].name), nameInSource(smallPack().images[0].name));
    EXPECT_EQ(pack.text(pack.meshes()[0].name), nameInSource(model.meshes[0].name));
    ASSERT_EQ(pack.materials().size(), 2u);
    EXPECT_EQ(pack.materials()[1].normal_texture.image, 1u) << "after the one image of a.gltf";
    EXPECT_EQ(pack.materials()[1].occlusion_texture.image, 2u);
}

TEST_F(LinkPack, refusesATexturesPartWithOtherStrings)
{
    const PackModel model = named("a.gltf");
    addParts(model, "a");
    auto writer = formats::ContainerWriter::create(sandbox / "a.textures.part", ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    for (uint32_t i = 0; i < model.images.size(); ++i)
        EXPECT_TRUE(
            writer->addChunk({.type = kChunkImageData, .index = i}, model.image_data[i], 1, Codec::none)
                .ok());
    EXPECT_TRUE(writer->addText(kChunkStrings, "x" + model.strings).ok());
    EXPECT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, model.images).ok());
    EXPECT_TRUE(writer->finish().ok());
    const Status status = link();
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::meaning_reference);
    EXPECT_EQ(status.error().file, sandbox / "a.textures.part");
}

TEST_F(LinkPack, refusesPartsOfDifferentSources)
{
    addParts(smallPack(), "a");
    PackModel other = smallPack();
    other.images.pop_back();
    other.image_data.pop_back();
    other.materials[0].emissive_texture.image = kInvalidIndex;
    addParts(other, "b");
    sources = {{sources[0].import_part, sources[0].clusters_part, sources[1].textures_part,
                sources[0].skinning_part}};
    const Status status = link();
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::meaning_reference);
    EXPECT_EQ(status.error().file, sandbox / "b.textures.part");
    EXPECT_FALSE(sandbox.has("out.hearth"));
}

TEST_F(LinkPack, refusesAPackInPlaceOfAPart)
{
    addParts(smallPack(), "a");
    writePackFile(smallPack(), sandbox / "pack");
    sources[0].clusters_part = sandbox / "pack";
    EXPECT_EQ(link().error().issue, Issue::container_kind);
}

TEST_F(LinkPack, refusesAMissingPart)
{
    addParts(smallPack(), "a");
    sources[0].textures_part = sandbox / "nothing";
    EXPECT_EQ(link().error().issue, Issue::input_missing);
}

TEST_F(LinkPack, refusesMetaThatIsNoObject)
{
    PackModel pack = smallPack();
    pack.meta = "[1]";
    addParts(pack, "a");
    EXPECT_EQ(link().error().issue, Issue::meaning_value);
}

TEST_F(LinkPack, leavesAnOldOutputAloneWhenThePackMeansNothing)
{
    PackModel pack = smallPack();
    pack.clusters[0].material = 7; // there is one material
    addParts(pack, "a");
    sandbox.write("out.hearth", "old");
    const std::vector<std::string> before = sandbox.list();
    const Status status = link();
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::meaning_reference);
    EXPECT_EQ(status.error().file, sandbox / "out.hearth");
    EXPECT_EQ(sandbox.read("out.hearth"), "old");
    EXPECT_EQ(sandbox.list(), before);
}

TEST_F(LinkPack, refusesAnyDamagedByteOfItsParts)
{
    addParts(smallPack(), "a");
    ASSERT_TRUE(link().ok());
    const std::string whole = sandbox.read("out.hearth");
    for (const char* part : {"a.import.part", "a.clusters.part", "a.textures.part"})
    {
        const std::string good = sandbox.read(part);
        for (size_t at = 0; at < good.size(); at += 97)
        {
            std::string bad = good;
            bad[at] = static_cast<char>(bad[at] ^ 0x10);
            sandbox.write(part, bad);
            // data that only the cookers read, and the zeros between chunks, may be damaged: the pack stays
            // the same
            const std::string made = link().ok() ? sandbox.read("out.hearth") : whole;
            ASSERT_EQ(made, whole) << part << " byte " << at;
        }
        sandbox.write(part, good);
    }
}

TEST_F(LinkPack, saysWhereItCannotWrite)
{
    addParts(smallPack(), "a");
    const Status status = link::linkPack(sources, sandbox / "no/such/folder/out.hearth");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::cannot_write);
    EXPECT_EQ(status.error().file, sandbox / "no/such/folder/out.hearth");
}

} // namespace hearth::test
