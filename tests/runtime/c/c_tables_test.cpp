// Tests names, instances and cameras of a pack through hearth.h against the tables of the pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/hearth.hpp"
#include "tests/support/small_pack.h"

#include <cmath>
#include <gmock/gmock.h>
#include <map>

namespace hearth::test
{

namespace
{

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

/// A pack with records in all tables.
class CTablesTest : public testing::Test
{
protected:
    void SetUp() override
    {
        model_.cameras[0].world_from_camera = {{{0, 0, 1, 5}, {0, 1, 0, 6}, {-1, 0, 0, 7}}}; // looks along -x
        model_.cameras[0].aspect = 1.5f;
        bytes_ = model_.bytes();
        ASSERT_EQ(Pack::openMemory(bytes_.span().data(), bytes_.size(), "small", pack_, &message_), HEARTH_OK)
            << message_;
    }

    uint32_t count(uint32_t table) const
    {
        uint32_t count = 0;
        EXPECT_EQ(pack_.getCount(table, count), HEARTH_OK);
        return count;
    }

    std::string name(uint32_t table, uint32_t index)
    {
        std::string_view name = "none";
        EXPECT_EQ(pack_.getName(table, index, name, &message_), HEARTH_OK) << message_;
        return std::string(name);
    }

    /// Expect that the names of `records` are those of the table.
    template <typename Record>
    void expectNames(uint32_t table, const std::vector<Record>& records)
    {
        ASSERT_EQ(count(table), records.size()) << table;
        ASSERT_GT(records.size(), 0u) << table;
        for (uint32_t i = 0; i < records.size(); ++i)
            EXPECT_EQ(name(table, i), model_.strings.substr(records[i].name.offset, records[i].name.length));
    }

    PackModel model_ = smallPack();
    AlignedBytes bytes_;
    Pack pack_;
    std::string message_;
};

} // namespace

TEST_F(CTablesTest, namesAreThoseOfTheSource)
{
    expectNames(HEARTH_TABLE_NODES, model_.nodes);
    expectNames(HEARTH_TABLE_MESHES, model_.meshes);
    expectNames(HEARTH_TABLE_MATERIALS, model_.materials);
    expectNames(HEARTH_TABLE_IMAGES, model_.images);
    expectNames(HEARTH_TABLE_CAMERAS, model_.cameras);
    expectNames(HEARTH_TABLE_LIGHTS, model_.lights);
    expectNames(HEARTH_TABLE_SKINS, model_.skins);
    expectNames(HEARTH_TABLE_ANIMATIONS, model_.animations);
    expectNames(HEARTH_TABLE_ASSETS, model_.assets);
    EXPECT_EQ(name(HEARTH_TABLE_NODES, 0), "Wurzel \xC3\xA4\xE2\x82\xAC");
    EXPECT_EQ(name(HEARTH_TABLE_CAMERAS, 1), "camera");
    ASSERT_EQ(count(HEARTH_TABLE_INSTANCES), model_.instances.size());
    for (uint32_t i = 0; i < model_.instances.size(); ++i)
        EXPECT_EQ(name(HEARTH_TABLE_INSTANCES, i), name(HEARTH_TABLE_NODES, model_.instances[i].node));
}

TEST_F(CTablesTest, aRecordWithoutANameHasAnEmptyOne)
{
    model_.materials[0].name = {0, 0};
    const AlignedBytes bytes = model_.bytes();
    Pack pack;
    ASSERT_EQ(Pack::openMemory(bytes.span().data(), bytes.size(), "small", pack, &message_), HEARTH_OK);
    hearth_name name{nullptr, 7};
    EXPECT_EQ(hearth_pack_get_name(pack.get(), HEARTH_TABLE_MATERIALS, 0, &name, nullptr, 0), HEARTH_OK);
    EXPECT_NE(name.text, nullptr);
    EXPECT_EQ(name.length, 0u);
}

TEST_F(CTablesTest, recordsAreFoundByName)
{
    for (uint32_t table = 0; table <= HEARTH_TABLE_JOINTS; ++table)
    {
        std::map<std::string, std::vector<uint32_t>> records; // by name
        for (uint32_t i = 0; i < count(table); ++i)
            records[name(table, i)].push_back(i);
        EXPECT_FALSE(records.empty()) << table;
        for (const auto& [name, indices] : records)
        {
            std::vector<uint32_t> found;
            for (uint32_t i = 0; pack_.findRecord(table, name, i, i) == HEARTH_OK; ++i)
                found.push_back(i);
            EXPECT_EQ(found, indices) << table << " " << name;
        }
    }
    uint32_t index = 7;
    ASSERT_EQ(pack_.findRecord(HEARTH_TABLE_LIGHTS, "light", index, 1, &message_), HEARTH_OK) << message_;
    EXPECT_EQ(index, 1u) << "the pack has three of this name";
    EXPECT_EQ(pack_.findRecord(HEARTH_TABLE_LIGHTS, "light", index, 3, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("the pack has no light called light, from light 3 on"));
    EXPECT_EQ(pack_.findRecord(HEARTH_TABLE_INSTANCES, "strip nod", index, 0, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("the pack has no instance called strip nod ["));
    EXPECT_EQ(index, 1u);
    EXPECT_EQ(pack_.findRecord(12, "light", index), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_find_record(pack_.get(), 0, nullptr, 0, &index, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_find_record(pack_.get(), 0, "light", 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_find_record(nullptr, 0, "light", 0, &index, nullptr, 0), HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, jointsAreInTheOrderOfPoses)
{
    hearth_pack_mesh mesh = HEARTH_PACK_MESH_INIT;
    ASSERT_EQ(pack_.getMesh(2, mesh, &message_), HEARTH_OK) << message_;
    EXPECT_EQ(mesh.is_deformed, 1u);
    EXPECT_EQ(mesh.morph_weight_count, 1u);
    hearth_pack_skin skin = HEARTH_PACK_SKIN_INIT;
    ASSERT_EQ(pack_.getSkin(mesh.skin, skin, &message_), HEARTH_OK) << message_;
    ASSERT_EQ(skin.joint_count, 2u);
    EXPECT_EQ(skin.root, UINT32_MAX);
    EXPECT_EQ(name(HEARTH_TABLE_JOINTS, skin.first_joint + 1), "between");
    hearth_pack_joint joint = HEARTH_PACK_JOINT_INIT;
    ASSERT_EQ(pack_.getJoint(skin.first_joint + 1, joint, &message_), HEARTH_OK) << message_;
    EXPECT_EQ(joint.node, 2u);
    EXPECT_EQ(joint.parent, skin.first_joint) << "the node of joint 0 is the parent of node 2";
    ASSERT_EQ(pack_.getJoint(skin.first_joint, joint), HEARTH_OK);
    EXPECT_EQ(joint.parent, UINT32_MAX);
    EXPECT_EQ(pack_.getJoint(2, joint, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no joint 2: the pack has 2"));
}

TEST_F(CTablesTest, posesOfRestFollowFromNodesAndJoints)
{
    model_.nodes[0].translation = {1, 2, 3};
    model_.nodes[0].rotation = {0, std::sqrt(0.5f), 0, std::sqrt(0.5f)};
    model_.nodes[0].scale = {2, 1, 1};
    model_.nodes[2].parent_from_node.m[0][3] = 7; // a product of these depends on their order
    model_.joints[1].joint_from_bind.m[2][3] = -5;
    const AlignedBytes bytes = model_.bytes();
    ASSERT_EQ(Pack::openMemory(bytes.span().data(), bytes.size(), "small", pack_, &message_), HEARTH_OK)
        << message_;
    Player player;
    ASSERT_EQ(Player::create(pack_, player), HEARTH_OK);
    hearth_player_info info = HEARTH_PLAYER_INFO_INIT;
    ASSERT_EQ(player.getInfo(info), HEARTH_OK);
    ASSERT_EQ(info.pose_count, 1u);
    ASSERT_EQ(info.poses[0].joint_count, 2u);
    for (uint32_t j = 0; j < 2; ++j)
    {
        hearth_pack_joint joint = HEARTH_PACK_JOINT_INIT;
        hearth_pack_node node = HEARTH_PACK_NODE_INIT;
        ASSERT_EQ(pack_.getJoint(j, joint), HEARTH_OK);
        ASSERT_EQ(pack_.getNode(joint.node, node), HEARTH_OK);
        const auto& world = node.world_from_node.m;
        const auto& bind = joint.joint_from_bind.m;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
            {
                const double product = world[row][0] * bind[0][column] + world[row][1] * bind[1][column] +
                                       world[row][2] * bind[2][column] + (column == 3 ? world[row][3] : 0);
                EXPECT_NEAR(info.poses[0].world_from_bind[j].m[row][column], product, 1e-12);
            }
    }
}

TEST_F(CTablesTest, nodesAndMeshesAreThoseOfTheTables)
{
    hearth_pack_node node = HEARTH_PACK_NODE_INIT;
    for (uint32_t i = 0; i < model_.nodes.size(); ++i)
    {
        ASSERT_EQ(pack_.getNode(i, node, &message_), HEARTH_OK) << message_;
        EXPECT_EQ(node.parent, model_.nodes[i].parent);
        EXPECT_EQ(node.mesh, model_.nodes[i].mesh);
        EXPECT_EQ(node.skin, model_.nodes[i].skin);
    }
    hearth_pack_mesh mesh = HEARTH_PACK_MESH_INIT;
    ASSERT_EQ(pack_.getMesh(0, mesh), HEARTH_OK);
    EXPECT_EQ(mesh.triangle_count, 8u) << "a strip of four quads";
    EXPECT_EQ(mesh.level_count, 2u);
    EXPECT_EQ(mesh.is_deformed, 0u);
    EXPECT_EQ(mesh.skin, UINT32_MAX);
    EXPECT_EQ(mesh.box_min[0], 0);
    EXPECT_EQ(mesh.box_max[0], 4);
    ASSERT_EQ(pack_.getMesh(1, mesh), HEARTH_OK);
    EXPECT_EQ(mesh.triangle_count, 0u);
    EXPECT_GT(mesh.box_min[0], mesh.box_max[0]) << "a mesh without triangles";
    node.struct_size = 4;
    EXPECT_EQ(pack_.getNode(0, node, &message_), HEARTH_ERROR_USAGE);
    EXPECT_EQ(pack_.getNode(4, node, &message_), HEARTH_ERROR_USAGE);
    EXPECT_EQ(pack_.getMesh(3, mesh, &message_), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_get_skin(pack_.get(), 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, lightsAreReadyToBeChanged)
{
    model_.lights[2].world_from_light.m[0][3] = 6;
    model_.lights[2].range = 3;
    const AlignedBytes bytes = model_.bytes();
    ASSERT_EQ(Pack::openMemory(bytes.span().data(), bytes.size(), "small", pack_, &message_), HEARTH_OK)
        << message_;
    hearth_light_change light{};
    constexpr uint32_t kTypes[] = {HEARTH_LIGHT_SUN, HEARTH_LIGHT_POINT, HEARTH_LIGHT_SPOT};
    for (uint32_t i = 0; i < 3; ++i)
    {
        ASSERT_EQ(pack_.getLight(i, light, &message_), HEARTH_OK) << message_;
        EXPECT_EQ(light.light, i);
        EXPECT_EQ(light.type, kTypes[i]);
        EXPECT_EQ(light.intensity, 10);
        EXPECT_EQ(light.color[2], 0.8f);
    }
    EXPECT_EQ(light.range, 3);
    EXPECT_EQ(light.outer_cone_rad, 0.5f);
    EXPECT_EQ(light.world_from_light[0][3], 6);
    uint32_t node = 7;
    EXPECT_EQ(hearth_pack_get_light(pack_.get(), 0, &light, &node, nullptr, 0), HEARTH_OK);
    EXPECT_EQ(node, model_.lights[0].node);
    EXPECT_EQ(pack_.getLight(3, light, &message_), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_get_light(pack_.get(), 0, nullptr, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, clipsHaveBounds)
{
    hearth_box box{}, strip{};
    ASSERT_EQ(pack_.getClipBounds(0, 0, 2, box, &message_), HEARTH_OK) << message_;
    ASSERT_EQ(pack_.getClipBounds(0, 0, 1, strip), HEARTH_OK);
    for (int axis = 0; axis < 3; ++axis)
    {
        EXPECT_LE(box.min[axis], strip.min[axis]);
        EXPECT_LE(strip.min[axis], strip.max[axis]);
        EXPECT_LE(strip.max[axis], box.max[axis]);
    }
    ASSERT_EQ(pack_.getClipBounds(0, 2, 0, box), HEARTH_OK);
    EXPECT_GT(box.min[0], box.max[0]) << "of no instance";
    EXPECT_EQ(pack_.getClipBounds(0, 1, 2, box, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("the pack has 2"));
    EXPECT_EQ(pack_.getClipBounds(9, 0, 1, box, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no animation 9"));
    EXPECT_EQ(hearth_pack_get_clip_bounds(nullptr, 0, 0, 1, &box, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_get_clip_bounds(pack_.get(), 0, 0, 1, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, objectsAreFoundByAnExtra)
{
    uint32_t index = 9;
    std::string_view value;
    ASSERT_EQ(pack_.findExtra(HEARTH_EXTRAS_NODE, "speed", index, value, 0, &message_), HEARTH_OK)
        << message_;
    EXPECT_EQ(index, 1u);
    EXPECT_EQ(value, "1.50");
    EXPECT_EQ(
        hearth_pack_find_extra(pack_.get(), HEARTH_EXTRAS_MATERIAL, "sound", 0, &index, nullptr, nullptr, 0),
        HEARTH_OK);
    EXPECT_EQ(index, 0u);
    EXPECT_EQ(pack_.findExtra(HEARTH_EXTRAS_NODE, "speed", index, value, 2, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("the pack has no node with the extra speed, from node 2 on"));
    EXPECT_EQ(pack_.findExtra(HEARTH_EXTRAS_MESH, "speed", index, value), HEARTH_ERROR_USAGE);
    EXPECT_EQ(pack_.findExtra(HEARTH_EXTRAS_FILE + 1, "speed", index, value), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_find_extra(nullptr, 0, "speed", 0, &index, nullptr, nullptr, 0),
              HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_find_extra(pack_.get(), 0, nullptr, 0, &index, nullptr, nullptr, 0),
              HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, extrasAreTheTextOfTheSource)
{
    std::string_view json = "none";
    for (const formats::ExtrasRecord& record : model_.extras)
    {
        EXPECT_EQ(pack_.getExtras(record.owner, record.index, json, &message_), HEARTH_OK) << message_;
        EXPECT_EQ(json, model_.strings.substr(record.json.offset, record.json.length)) << record.owner;
    }
    EXPECT_EQ(pack_.getExtras(HEARTH_EXTRAS_NODE, 1, json), HEARTH_OK);
    EXPECT_EQ(json, R"({"speed":1.50,"tag":"T\u00fcr"})");
    EXPECT_EQ(pack_.getExtras(HEARTH_EXTRAS_FILE, 0, json), HEARTH_OK);
    EXPECT_EQ(json, "12345678901234567890");
}

TEST_F(CTablesTest, anObjectWithoutExtrasHasNone)
{
    hearth_extras extras{"?", 7};
    EXPECT_EQ(hearth_pack_get_extras(pack_.get(), HEARTH_EXTRAS_NODE, 0, &extras, nullptr, 0), HEARTH_OK);
    EXPECT_EQ(extras.json, nullptr);
    EXPECT_EQ(extras.length, 0u);
    std::string_view json = "?";
    EXPECT_EQ(pack_.getExtras(HEARTH_EXTRAS_NODE, 0, json), HEARTH_OK);
    EXPECT_EQ(json, "");
    EXPECT_EQ(pack_.getExtras(HEARTH_EXTRAS_NODE, 4, json, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no node 4: the pack has 4"));
    EXPECT_EQ(pack_.getExtras(HEARTH_EXTRAS_SCENE, 1, json, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no asset 1: the pack has 1"));
    EXPECT_EQ(pack_.getExtras(HEARTH_EXTRAS_FILE + 1, 0, json, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("owner 10 is not one that this version knows"));
    EXPECT_EQ(hearth_pack_get_extras(pack_.get(), 0, 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_get_extras(nullptr, 0, 0, &extras, nullptr, 0), HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, instancesSayWhatTheyDraw)
{
    for (uint32_t i = 0; i < model_.instances.size(); ++i)
    {
        const formats::InstanceRecord& record = model_.instances[i];
        hearth_pack_instance instance = HEARTH_PACK_INSTANCE_INIT;
        ASSERT_EQ(pack_.getInstance(i, instance, &message_), HEARTH_OK) << message_;
        EXPECT_EQ(instance.mesh, record.mesh);
        EXPECT_EQ(instance.node, record.node);
        for (int row = 0; row < 3; ++row)
            EXPECT_THAT(instance.world_from_object[row], ElementsAreArray(record.world_from_object.m[row]));
    }
}

TEST_F(CTablesTest, camerasAreReadyForAFrame)
{
    hearth_pack_camera camera = HEARTH_PACK_CAMERA_INIT;
    ASSERT_EQ(pack_.getCamera(0, camera, &message_), HEARTH_OK) << message_;
    EXPECT_EQ(camera.struct_size, sizeof(camera));
    EXPECT_EQ(camera.type, static_cast<uint32_t>(HEARTH_CAMERA_PERSPECTIVE));
    EXPECT_EQ(camera.node, model_.cameras[0].node);
    EXPECT_EQ(camera.aspect, 1.5f);
    EXPECT_EQ(camera.z_far, 0);
    EXPECT_THAT(camera.world_from_camera[2], ElementsAre(-1, 0, 0, 7));
    EXPECT_THAT(camera.view.position, ElementsAre(5, 6, 7));
    EXPECT_THAT(camera.view.target, ElementsAre(4, 6, 7));
    EXPECT_THAT(camera.view.up, ElementsAre(0, 1, 0));
    EXPECT_EQ(camera.view.y_fov_rad, 1);
    EXPECT_EQ(camera.view.z_near, 0.1f);

    ASSERT_EQ(pack_.getCamera(1, camera, &message_), HEARTH_OK) << message_;
    EXPECT_EQ(camera.type, static_cast<uint32_t>(HEARTH_CAMERA_ORTHOGRAPHIC));
    EXPECT_EQ(camera.half_width, 2);
    EXPECT_EQ(camera.half_height, 2);
    EXPECT_EQ(camera.z_far, 100);
}

TEST_F(CTablesTest, proxiesAreTheirArrays)
{
    for (uint32_t i = 0; i < model_.proxies.size(); ++i)
    {
        const formats::ProxyRecord& record = model_.proxies[i];
        hearth_proxy proxy = HEARTH_PROXY_INIT;
        ASSERT_EQ(pack_.getProxy(i, proxy, &message_), HEARTH_OK) << message_;
        EXPECT_EQ(proxy.struct_size, sizeof(proxy));
        EXPECT_EQ(proxy.mesh, record.mesh);
        EXPECT_EQ(proxy.origin, record.origin);
        EXPECT_EQ(proxy.is_closed, record.is_closed);
        EXPECT_EQ(proxy.distance, record.distance);
        EXPECT_EQ(proxy.mesh_distance, record.mesh_distance);
        ASSERT_EQ(proxy.position_count, record.positions.count);
        ASSERT_EQ(proxy.index_count, record.indices.count);
        ASSERT_EQ(proxy.section_count, record.sections.count);
        ASSERT_EQ(proxy.binding_count, record.bindings.count);
        for (uint32_t p = 0; p < proxy.position_count; ++p)
        {
            const Float3 position = model_.proxy_positions[record.positions.first + p];
            EXPECT_THAT(std::vector<float>(proxy.positions + 3 * p, proxy.positions + 3 * p + 3),
                        ElementsAre(position.x, position.y, position.z));
        }
        EXPECT_THAT(
            std::vector<uint32_t>(proxy.indices, proxy.indices + proxy.index_count),
            ElementsAreArray(model_.proxy_indices.data() + record.indices.first, record.indices.count));
        for (uint32_t s = 0; s < proxy.section_count; ++s)
        {
            const formats::ProxySectionRecord& section = model_.proxy_sections[record.sections.first + s];
            EXPECT_EQ(proxy.sections[s].first_triangle, section.triangles.first);
            EXPECT_EQ(proxy.sections[s].triangle_count, section.triangles.count);
            EXPECT_EQ(proxy.sections[s].material, section.material);
            EXPECT_EQ(proxy.sections[s].is_convex, section.is_convex);
        }
        for (uint32_t b = 0; b < proxy.binding_count; ++b)
        {
            const formats::ProxyBindingRecord& binding = model_.proxy_bindings[record.bindings.first + b];
            EXPECT_EQ(proxy.bindings[b].triangle, binding.triangle);
            EXPECT_EQ(proxy.bindings[b].weights[0], binding.weights[0]);
            EXPECT_EQ(proxy.bindings[b].weights[1], binding.weights[1]);
            EXPECT_EQ(proxy.bindings[b].distance, binding.distance);
        }
        EXPECT_EQ(proxy.bindings == nullptr, record.bindings.count == 0);
    }
    EXPECT_GT(model_.proxies.size(), 1u);
}

TEST_F(CTablesTest, whatIsNotThereIsRefused)
{
    hearth_pack_camera camera = HEARTH_PACK_CAMERA_INIT;
    hearth_pack_instance instance = HEARTH_PACK_INSTANCE_INIT;
    uint32_t count = 0;
    char message[256] = "";
    EXPECT_EQ(pack_.getCamera(2, camera, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no camera 2: the pack has 2"));
    EXPECT_EQ(pack_.getInstance(1000, instance, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no instance 1000"));
    std::string_view name;
    EXPECT_EQ(pack_.getName(HEARTH_TABLE_ANIMATIONS, 1000, name, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no animation 1000"));
    hearth_proxy proxy = HEARTH_PROXY_INIT;
    EXPECT_EQ(pack_.getProxy(2, proxy, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("there is no proxy 2: the pack has 2"));
    EXPECT_EQ(hearth_pack_get_proxy(pack_.get(), 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(pack_.getName(HEARTH_TABLE_JOINTS + 1, 0, name, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("table 12 is not one that this version knows"));
    EXPECT_EQ(hearth_pack_get_count(pack_.get(), 12, &count, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_get_count(pack_.get(), 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_get_count(nullptr, 0, &count, message, sizeof(message)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message, HasSubstr("pack is NULL"));
    EXPECT_EQ(hearth_pack_get_name(pack_.get(), 0, 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    camera.struct_size = 8;
    EXPECT_EQ(pack_.getCamera(0, camera, &message_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("camera has a struct_size of 8"));
    EXPECT_EQ(hearth_pack_get_instance(pack_.get(), 0, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
}

TEST_F(CTablesTest, aPackInUseCountsItsPlayers)
{
    EXPECT_STREQ(pack_.lastError(), "");
    EXPECT_STREQ(hearth_pack_last_error(nullptr), "");
    Player player, other;
    ASSERT_EQ(Player::create(pack_, player), HEARTH_OK);
    EXPECT_EQ(hearth_pack_close(pack_.get()), HEARTH_ERROR_IN_USE);
    EXPECT_STREQ(hearth_pack_last_error(pack_.get()), "hearth_pack_close: error: 1 player is alive [E1000] "
                                                      "hint: destroy it before the pack");
    ASSERT_EQ(Player::create(pack_, other), HEARTH_OK);
    EXPECT_EQ(hearth_pack_close(pack_.get()), HEARTH_ERROR_IN_USE);
    EXPECT_THAT(hearth_pack_last_error(pack_.get()),
                HasSubstr("2 players are alive [E1000] hint: destroy them"));
}

} // namespace hearth::test
