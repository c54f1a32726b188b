// Tests the import of nodes, instances, cameras, lights, skins and animations.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/scale_bound.h"
#include "pipelines/import/part/transform.h"
#include "tests/pipelines/gltf_fixture.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <numbers>
#include <random>

namespace hearth::import::test
{

namespace
{

using namespace formats;

/// Mesh 0 is the square; accessors 0 and 1 are its own.
GltfData squareData()
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("SCALAR", kSquareIndices);
    return data;
}
const std::string kSquareMesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)";

std::vector<InstanceRecord> getInstances(const Imported& result)
{
    return result.records<InstanceRecord>(kChunkInstances);
}

void expectNear(Float3 a, Float3 b, float tolerance = 1e-5f)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(GltfScene, multipliesTransformsDownTheTree)
{
    // rotate by a quarter turn about z and move; below it scale by 2 and move
    const Imported result = squareData().import(kSquareMesh + R"("nodes":[
        {"mesh":0,"translation":[1,0,0],"scale":[2,2,2]},
        {"children":[0],"translation":[0,10,0],"rotation":[0,0,0.70710678,0.70710678]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto instances = getInstances(result);
    ASSERT_EQ(instances.size(), 1u);
    expectNear(transformPoint(instances[0].world_from_object, {1, 0, 0}), {0, 13, 0});
    EXPECT_NEAR(instances[0].scale_max, 2, 1e-5);
    EXPECT_GE(instances[0].scale_max, 2.0f);
    EXPECT_EQ(instances[0].node, 0u);
    const auto nodes = result.records<NodeRecord>(kChunkNodes);
    EXPECT_EQ(nodes[0].parent, 1u);
    EXPECT_EQ(nodes[1].parent, kInvalidIndex);
    EXPECT_EQ(nodes[1].mesh, kInvalidIndex);
}

TEST(GltfScene, readsMatricesByColumns)
{
    const Imported result = squareData().import(
        kSquareMesh + R"("nodes":[{"mesh":0,"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    expectNear(transformPoint(getInstances(result)[0].world_from_object, {1, 0, 0}), {5, 7, 7});
    EXPECT_EQ(result.records<NodeRecord>(kChunkNodes)[0].has_trs, 0u);
}

TEST(GltfScene, marksMirroredInstances)
{
    const Imported result = squareData().import(
        kSquareMesh + R"("nodes":[{"mesh":0,"scale":[-1,1,1]},{"mesh":0,"scale":[-1,-1,1]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto instances = getInstances(result);
    EXPECT_EQ(instances[0].flags, uint32_t{kInstanceMirrored});
    EXPECT_EQ(instances[1].flags, 0u);
}

TEST(GltfScene, drawsOnlyTheDefaultScene)
{
    const std::string nodes = R"("nodes":[{"mesh":0},{"mesh":0,"children":[2]},{"mesh":0}],)";
    const auto nodesDrawn = [&](const std::string& scenes)
    {
        const Imported result = squareData().import(kSquareMesh + nodes + scenes);
        EXPECT_TRUE(result.ok()) << result.message();
        std::vector<uint32_t> drawn;
        for (const InstanceRecord& instance : getInstances(result))
            drawn.push_back(instance.node);
        return drawn;
    };
    EXPECT_EQ(nodesDrawn(R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])"),
              (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(nodesDrawn(R"("scenes":[{"nodes":[0]},{"nodes":[1]}])"), (std::vector<uint32_t>{0}));
    EXPECT_EQ(nodesDrawn(R"("extras":{})"), (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(nodesDrawn(R"("scenes":[{}])"), (std::vector<uint32_t>{}));
    EXPECT_EQ(nodesDrawn(R"("scenes":[{"nodes":[0,0]}])"), (std::vector<uint32_t>{0}));
    EXPECT_EQ(nodesDrawn(R"("scenes":[{"nodes":[2]}])"), (std::vector<uint32_t>{2}));
}

TEST(GltfScene, keepsMillimetresFarFromTheOrigin)
{
    const Imported result = squareData().import(kSquareMesh + R"("nodes":[
        {"mesh":0,"translation":[-20000000,0,0.001]},{"children":[0],"translation":[20000000,0,0]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    expectNear(transformPoint(getInstances(result)[0].world_from_object, {}), {0, 0, 0.001f}, 1e-7f);
}

TEST(GltfScene, survivesAChainOfAHundredThousandNodes)
{
    std::string nodes = R"("nodes":[{"mesh":0,"translation":[1,0,0]})";
    constexpr int kCount = hearth::test::kSanitized ? 20000 : 100000;
    for (int i = 1; i < kCount; ++i)
        nodes += R"(,{"translation":[1,0,0],"children":[)" + std::to_string(i - 1) + "]}";
    const Imported result = squareData().import(kSquareMesh + nodes + "]");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(getInstances(result)[0].world_from_object.m[0][3], static_cast<float>(kCount));
}

TEST(GltfScene, mendsRotationsThatAreNotUnit)
{
    const Imported result = squareData().import(
        kSquareMesh + R"("nodes":[{"mesh":0,"rotation":[0,0,3,3]},{"mesh":0,"rotation":[0,0,0,0]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    expectNear(transformPoint(getInstances(result)[0].world_from_object, {1, 0, 0}), {0, 1, 0});
    expectNear(transformPoint(getInstances(result)[1].world_from_object, {1, 0, 0}), {1, 0, 0});
    EXPECT_TRUE(result.hasWarning(Issue::repaired, "rotation"));
}

TEST(GltfInstancing, multipliesEachCopyIntoTheNode)
{
    GltfData data = squareData();
    data.add("VEC3", std::vector<float>{1, 0, 0, 0, 1, 0});
    data.add("VEC4", std::vector<int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0}, R"("normalized":true)");
    data.add("VEC3", std::vector<float>{1, 1, 1, 2, 2, 2});
    data.add("SCALAR", std::vector<float>{0, 1});
    const Imported result = data.import(kSquareMesh + R"("extensionsUsed":["EXT_mesh_gpu_instancing"],
        "nodes":[{"mesh":0,"scale":[10,10,10],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":
        {"TRANSLATION":2,"ROTATION":3,"SCALE":4,"_ID":5}}}}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto instances = getInstances(result);
    ASSERT_EQ(instances.size(), 2u);
    expectNear(transformPoint(instances[0].world_from_object, {1, 0, 0}), {20, 0, 0});
    expectNear(transformPoint(instances[1].world_from_object, {1, 0, 0}), {-20, 10, 0});
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "instance attribute _ID"));
}

TEST(GltfInstancing, ofASkinnedMeshLeavesOneCopyWhereItsJointsAre)
{
    GltfData data = squareData();
    data.add("VEC4", std::vector<uint8_t>(16));
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    data.add("VEC3", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1});
    const std::string meshes =
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}],)";
    const std::string node =
        R"("nodes":[{"mesh":0,%"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":4}}}},
        {"translation":[5,0,0]}])";
    const Imported skinned =
        data.import(meshes + R"("skins":[{"joints":[1]}],)" + replaced(node, "%", R"("skin":0,)"));
    ASSERT_TRUE(skinned.ok()) << skinned.message();
    ASSERT_EQ(getInstances(skinned).size(), 1u);
    EXPECT_EQ(getInstances(skinned)[0].world_from_object, Affine3{});
    EXPECT_TRUE(skinned.hasWarning(Issue::dropped, "instancing of a skinned mesh is not kept"));
    // without the skin the same node draws three
    const Imported rigid = data.import(meshes + replaced(node, "%", ""));
    ASSERT_TRUE(rigid.ok()) << rigid.message();
    EXPECT_EQ(getInstances(rigid).size(), 3u);
    EXPECT_FALSE(rigid.hasWarning(Issue::dropped, "instancing"));
}

TEST(GltfInstancing, refusesCountsThatDifferAndTooManyCopies)
{
    GltfData data = squareData();
    data.add("VEC3", std::vector<float>{1, 0, 0, 0, 1, 0});
    data.add("VEC3", std::vector<float>{1, 1, 1});
    const std::string node =
        R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2)";
    const Imported differing = data.import(kSquareMesh + node + R"(,"SCALE":3}}}}])");
    ASSERT_FALSE(differing.ok());
    EXPECT_EQ(differing.status.error().issue, Issue::gltf_extension_value);

    ImportOptions options;
    options.limits.max_instances = 1;
    const Imported many = data.import(kSquareMesh + node + "}}}}]", nullptr, options);
    ASSERT_FALSE(many.ok());
    EXPECT_EQ(many.status.error().issue, Issue::input_too_large);
}

TEST(GltfScene, placesCamerasAndLights)
{
    const Imported result = GltfData().import(R"("extensions":{"KHR_lights_punctual":{"lights":[
          {"type":"spot","color":[1,0.5,0],"intensity":40,"range":9,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
          {"type":"directional"}]}},
        "cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01,"aspectRatio":1.5}},
                   {"type":"orthographic","orthographic":{"xmag":2,"ymag":1,"znear":0,"zfar":10}}],
        "nodes":[{"camera":0,"translation":[0,0,4]},{"camera":1},
          {"translation":[0,3,0],"extensions":{"KHR_lights_punctual":{"light":0}}},
          {"extensions":{"KHR_lights_punctual":{"light":1}}}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto cameras = result.records<CameraRecord>(kChunkCameras);
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].y_fov_rad, 0.7f);
    EXPECT_EQ(cameras[0].z_far, 0.0f);
    EXPECT_EQ(cameras[0].world_from_camera.m[2][3], 4.0f);
    EXPECT_EQ(cameras[1].type, static_cast<uint32_t>(CameraType::orthographic));
    EXPECT_EQ(cameras[1].x_magnification, 2.0f);
    const auto lights = result.records<LightRecord>(kChunkLights);
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].type, static_cast<uint32_t>(LightType::spot));
    EXPECT_EQ(lights[0].color, (Float3{1, 0.5f, 0}));
    EXPECT_EQ(lights[0].outer_cone_rad, 0.2f);
    EXPECT_EQ(lights[0].world_from_light.m[1][3], 3.0f);
    EXPECT_EQ(lights[1].intensity, 1.0f);
}

constexpr const char* kTwoLights = R"("extensions":{"KHR_lights_punctual":{"lights":[
    {"type":"directional","name":"sun"},{"type":"spot","name":"lamp"},{"type":"point","name":"bulb"}]}},)";

/// Nodes: the sun, two nodes with the lamp, the bulb, and one below a root of scale 2 at (1, 2, 3) with these
/// extras.
Imported importShadowSphere(const std::string& extras)
{
    return GltfData().import(std::string(kTwoLights) + R"("nodes":[
        {"name":"noon","extensions":{"KHR_lights_punctual":{"light":0}}},
        {"name":"left","extensions":{"KHR_lights_punctual":{"light":1}}},
        {"name":"right","extensions":{"KHR_lights_punctual":{"light":1}}},
        {"name":"bulb","extensions":{"KHR_lights_punctual":{"light":2}}},
        {"scale":[2,1,1],"children":[5]},
        {"name":"stage","translation":[1,2,3],"extras":)" +
                             extras + "}]");
}

TEST(GltfScene, takesShadowSpheresFromExtras)
{
    const Imported all = importShadowSphere(R"({"hearth_shadow_radius":3})");
    ASSERT_TRUE(all.ok()) << all.message();
    const auto spheres = all.records<ShadowSphereRecord>(kChunkShadowSpheres);
    ASSERT_EQ(spheres.size(), 1u);
    EXPECT_EQ(spheres[0].node, 5u);
    EXPECT_EQ(spheres[0].light, kInvalidIndex);
    EXPECT_EQ(spheres[0].center, (Float3{2, 2, 3}));
    EXPECT_NEAR(spheres[0].radius, 6, 1e-5f);
    EXPECT_EQ(spheres[0].texels, 0u);

    // the light's name selects every node that has it; a node's name selects this node
    const auto makeLights = [](const std::string& name)
    {
        const Imported result = importShadowSphere(
            R"({"hearth_shadow_radius":3,"hearth_shadow_texels":512,"hearth_shadow_light":")" + name + "\"}");
        EXPECT_TRUE(result.ok()) << result.message();
        std::vector<uint32_t> lights;
        for (const ShadowSphereRecord& sphere : result.records<ShadowSphereRecord>(kChunkShadowSpheres))
        {
            EXPECT_EQ(sphere.texels, 512u);
            lights.push_back(sphere.light);
        }
        EXPECT_EQ(result.hasWarning(Issue::dropped, name), lights.empty());
        return lights;
    };
    EXPECT_EQ(makeLights("lamp"), (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(makeLights("right"), (std::vector<uint32_t>{2}));
    EXPECT_EQ(makeLights("noon"), (std::vector<uint32_t>{0}));
    EXPECT_EQ(makeLights("bulb"), (std::vector<uint32_t>{3}));
    EXPECT_EQ(makeLights("moon"), std::vector<uint32_t>{});
}

TEST(GltfScene, leavesOtherExtrasAloneAndRefusesWrongSpheres)
{
    for (const char* extras :
         {"7", "[1,2]", R"({"radius":"wide"})", R"({"hearth_shadow_texels":"no sphere"})"})
    {
        const Imported result = importShadowSphere(extras);
        EXPECT_TRUE(result.ok()) << extras << result.message();
        EXPECT_TRUE(result.records<ShadowSphereRecord>(kChunkShadowSpheres).empty());
    }
    const auto getIssue = [](const char* extras)
    {
        const Imported result = importShadowSphere(extras);
        return result.ok() ? std::nullopt : std::optional(result.status.error().issue);
    };
    EXPECT_EQ(getIssue(R"({"hearth_shadow_radius":"3"})"), Issue::gltf_extension_value);
    EXPECT_EQ(getIssue(R"({"hearth_shadow_radius":0})"), Issue::gltf_extension_value);
    EXPECT_EQ(getIssue(R"({"hearth_shadow_radius":3e38})"), Issue::gltf_extension_value);
    EXPECT_EQ(getIssue(R"({"hearth_shadow_radius":3,"hearth_shadow_texels":500})"),
              Issue::gltf_extension_value);
    EXPECT_EQ(getIssue(R"({"hearth_shadow_radius":3,"hearth_shadow_light":4})"), Issue::gltf_extension_value);
}

/// Square bound to two joints by its accessors 2 to 4: joint 0 moves it all, or each joint moves two corners.
Imported importSkinned(bool both_joints, const std::string& nodes)
{
    GltfData data = squareData();
    const uint8_t other = both_joints ? 1 : 0;
    data.add("VEC4", std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, other, 0, 0, 0, other, 0, 0, 0});
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    data.add("MAT4", std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, 0,  0, 1, //
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, -1, 0, 1});
    return data.import(
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}],
        "skins":[{"joints":[1,2],"inverseBindMatrices":4}],)" +
        nodes);
}

TEST(GltfSkins, keepTheMeshAsItIsBound)
{
    // the mesh's own node is far away, which is ignored; joints carry the mesh to the scene's space
    const Imported result = importSkinned(true, R"("nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},
        {"translation":[5,2,0],"children":[2]},{"translation":[0,1,0],"rotation":[0,0,0.70710678,0.70710678]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(getInstances(result)[0].world_from_object, Affine3{});
    EXPECT_NEAR(getInstances(result)[0].scale_max, 1, 1e-5);
    const auto joints = result.records<JointRecord>(kChunkJoints);
    ASSERT_EQ(joints.size(), 2u);
    EXPECT_EQ(joints[1].node, 2u);
    EXPECT_EQ(joints[1].joint_from_bind.m[1][3], -1.0f);
    const mesh::SourceMesh mesh = result.mesh();
    EXPECT_EQ(mesh.joint_sets[0][2].joint[0], 1);
    ASSERT_EQ(mesh.vertexCount(), 4u);
    EXPECT_EQ(mesh.positions[2], (Float3{1, 1, 0}));
    EXPECT_EQ(mesh.normals[2], (Float3{0, 0, 1}));
    EXPECT_TRUE(result.warnings.empty());
}

TEST(GltfSkins, sayWhichWayTrianglesTurnUnderTheirJoints)
{
    const auto instanceUnder = [](const std::string& root, const std::string& tip)
    {
        const Imported result =
            importSkinned(true, R"("nodes":[{"mesh":0,"skin":0,"scale":[-1,1,1]},)" + root + "," + tip + "]");
        EXPECT_TRUE(result.ok()) << result.message();
        return getInstances(result)[0];
    };
    const std::string plain_root = R"({"children":[2]})", plain_tip = R"({"translation":[0,1,0]})";
    const std::string mirrored_root = R"({"scale":[1,1,-2],"children":[2]})";
    // the scale of the mesh's own node is ignored
    EXPECT_EQ(instanceUnder(plain_root, plain_tip).flags, 0u);
    EXPECT_EQ(instanceUnder(mirrored_root, plain_tip).flags, kInstanceMirrored);
    EXPECT_EQ(instanceUnder(mirrored_root, R"({"scale":[-1,1,1]})").flags, 0u) << "one joint of each kind";
    EXPECT_EQ(instanceUnder(R"({"scale":[-1,-1,-1],"children":[2]})", plain_tip).world_from_object.m[0][0],
              -1.0f);
}

TEST(GltfSkins, withoutInverseBindMatricesBindWithoutThem)
{
    GltfData data = squareData();
    data.add("VEC4", std::vector<uint8_t>(16));
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const Imported result = data.import(
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}],
        "skins":[{"joints":[1]}],"nodes":[{"mesh":0,"skin":0},{"translation":[5,0,0]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.records<JointRecord>(kChunkJoints)[0].joint_from_bind, Affine3{});
    EXPECT_EQ(result.mesh().joint_sets.size(), 1u);
}

TEST(GltfSkins, refuseMatricesThatAreNotFinite)
{
    GltfData data = squareData();
    data.add("VEC4", std::vector<uint8_t>(16));
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    std::vector<float> matrix(16);
    matrix[3] = std::nanf("");
    data.add("MAT4", matrix);
    const Imported result = data.import(
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}],
        "skins":[{"joints":[1],"inverseBindMatrices":4}],"nodes":[{"mesh":0,"skin":0},{}])");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::gltf_data);
}

TEST(GltfSkins, giveACopyToEachFurtherSkin)
{
    GltfData data = squareData();
    data.add("VEC4", std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const std::string mesh =
        R"({"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]})";
    const Imported result = data.import(R"("meshes":[)" + mesh + "," + mesh + R"(],
        "skins":[{"joints":[5,6]},{"joints":[6,5]}],
        "nodes":[{"mesh":0,"skin":0},{"mesh":0,"skin":1},{"mesh":0},{"mesh":1,"skin":1},{"mesh":0,"skin":1},
        {"translation":[5,0,0]},{}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto nodes = result.records<NodeRecord>(kChunkNodes);
    const auto instances = getInstances(result);
    constexpr std::array<uint32_t, 5> kMeshes{0, 2, 3, 1, 2};
    constexpr std::array<uint32_t, 5> kSkins{0, 1, kInvalidIndex, 1, 1};
    for (size_t node = 0; node < kMeshes.size(); ++node)
    {
        EXPECT_EQ(nodes[node].mesh, kMeshes[node]) << node;
        EXPECT_EQ(nodes[node].skin, kSkins[node]) << node;
        EXPECT_EQ(instances[node].mesh, kMeshes[node]) << node;
    }
    EXPECT_EQ(result.mesh(2).positions, result.mesh(0).positions);
    EXPECT_EQ(result.mesh(2).joint_sets.size(), 1u);
    EXPECT_TRUE(result.mesh(3).joint_sets.empty()) << "nothing moves the copy without a skin";
    EXPECT_EQ(result.counts.triangles, 4u) << "copies are not counted";
}

TEST(GltfSkins, leaveTheMeshAtItsNodeWhereTheyCannotMoveIt)
{
    // joints of scale 0
    const Imported flat = importSkinned(true, R"("nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},
        {"translation":[5,0,0],"scale":[0,0,0]},{"translation":[7,1,0],"scale":[0,0,0]}])");
    ASSERT_TRUE(flat.ok()) << flat.message();
    EXPECT_TRUE(flat.hasWarning(Issue::degraded, "does not move its mesh"));
    EXPECT_EQ(getInstances(flat)[0].world_from_object.m[0][3], 100.0f);
    EXPECT_EQ(flat.records<NodeRecord>(kChunkNodes)[0].skin, kInvalidIndex);
    EXPECT_TRUE(flat.mesh().joint_sets.empty());
    // position outside the range of floats
    const Imported far =
        importSkinned(true, R"("nodes":[{"mesh":0,"skin":0},{"translation":[3e38,0,0],"children":[2]},
        {"translation":[3e38,1,0]}])");
    ASSERT_TRUE(far.ok()) << far.message();
    EXPECT_TRUE(far.hasWarning(Issue::degraded, "32-bit numbers"));
    EXPECT_TRUE(far.mesh().joint_sets.empty());
}

TEST(GltfAnimations, keepKeysAndMendThem)
{
    GltfData data = squareData();
    data.add("SCALAR", std::vector<float>{0, 1, 1, 0.5f, 2});
    data.add("VEC3", std::vector<float>{0, 0, 0, 1, 1, 1, 9, 9, 9, 8, 8, 8, 2, 2, 2});
    data.add("SCALAR", std::vector<float>{0, 4});
    data.add("VEC4",
             std::vector<float>{1, 2, 3, 4, 0, 0, 2, 0, 5, 6, 7, 8, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1});
    const Imported result = data.import(kSquareMesh + R"("nodes":[{"mesh":0}],"animations":[{"samplers":[
        {"input":2,"output":3,"interpolation":"STEP"},{"input":4,"output":5,"interpolation":"CUBICSPLINE"}],"channels":[
        {"sampler":0,"target":{"node":0,"path":"translation"}},{"sampler":1,"target":{"node":0,"path":"rotation"}},
        {"sampler":0,"target":{"path":"translation"}},{"sampler":0,"target":{"node":0,"path":"pointer"}}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto channels = result.records<AnimationChannelRecord>(kChunkChannels);
    const auto keys = result.records<float>(kChunkKeys);
    ASSERT_EQ(channels.size(), 2u);
    EXPECT_EQ(channels[0].key_count, 3u);
    EXPECT_EQ(std::vector<float>(keys.begin(), keys.begin() + 12),
              (std::vector<float>{0, 1, 2, 0, 0, 0, 1, 1, 1, 2, 2, 2}));
    EXPECT_EQ(channels[1].interpolation, static_cast<uint32_t>(Interpolation::cubic_spline));
    const float* spline = keys.data() + channels[1].first_value;
    EXPECT_EQ(std::vector<float>(spline, spline + 12),
              (std::vector<float>{1, 2, 3, 4, 0, 0, 1, 0, 5, 6, 7, 8}))
        << "tangents stay as they are, values get length 1";
    EXPECT_EQ(std::vector<float>(spline + 16, spline + 20), (std::vector<float>{0, 0, 0, 1}));
    EXPECT_EQ(result.records<AnimationRecord>(kChunkAnimations)[0].duration, 4.0f);
    EXPECT_TRUE(result.hasWarning(Issue::repaired, "time does not grow"));
    EXPECT_TRUE(result.hasWarning(Issue::repaired, "rotations"));
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "animation of \"pointer\""));
}

TEST(GltfAnimations, refuseNumbersThatAreNotFinite)
{
    for (const bool bad_time : {true, false})
    {
        GltfData data = squareData();
        data.add("SCALAR", std::vector<float>{0, bad_time ? std::nanf("") : 1.0f});
        data.add("VEC3", std::vector<float>{0, 0, 0, 1, bad_time ? 1.0f : std::nanf(""), 1});
        const Imported result = data.import(
            kSquareMesh + R"("nodes":[{"mesh":0}],"animations":[{"samplers":[{"input":2,"output":3}],
            "channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])");
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.status.error().issue, Issue::gltf_data);
        EXPECT_NE(result.message().find("not finite"), std::string::npos) << result.message();
    }
}

TEST(GltfAnimations, shareTheKeysOfASampler)
{
    GltfData data = squareData();
    data.add("SCALAR", std::vector<float>{0, 1});
    data.add("VEC3", std::vector<float>(6));
    std::string channels;
    for (int i = 0; i < 1000; ++i)
        channels += std::string(i == 0 ? "" : ",") + R"({"sampler":0,"target":{"node":0,"path":"scale"}})";
    const Imported result = data.import(
        kSquareMesh + R"("nodes":[{}],"animations":[{"samplers":[{"input":2,"output":3}],"channels":[)" +
        channels + "]}]");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.records<AnimationChannelRecord>(kChunkChannels).size(), 1000u);
    EXPECT_EQ(result.records<float>(kChunkKeys).size(), 8u);
}

TEST(Transform, boundsTheLargestStretch)
{
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 300; ++i)
    {
        Affine3 t;
        for (auto& row : t.m)
            for (float& value : row)
                value = normal(random) * (i % 3 == 0 ? 1e-4f : 100.0f);
        const float bound = scaleBound(t);
        float longest = 0;
        Float3 direction = normalizeOr({normal(random), normal(random), normal(random)}, {1, 0, 0});
        for (int step = 0; step < 60; ++step) // power iteration for the largest singular value
        {
            const Float3 image = transformVector(t, direction);
            longest = std::max(longest, length(image));
            const Affine3 transposed{{{t.m[0][0], t.m[1][0], t.m[2][0], 0},
                                      {t.m[0][1], t.m[1][1], t.m[2][1], 0},
                                      {t.m[0][2], t.m[1][2], t.m[2][2], 0}}};
            direction = normalizeOr(transformVector(transposed, image), direction);
        }
        EXPECT_GE(bound * (1 + 1e-6f), longest);
        EXPECT_LE(bound, longest * 1.01f);
    }
    const Affine3 flat{{{3, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
    EXPECT_NEAR(scaleBound(flat), 3, 1e-5);
    EXPECT_EQ(scaleBound(Affine3{{{0, 0, 0, 5}, {0, 0, 0, 5}, {0, 0, 0, 5}}}), 0.0f);
}

TEST(Transform, isNotNarrowedBeyondFloats)
{
    Transform t;
    EXPECT_TRUE(narrowed(t).has_value());
    t.m[1][2] = 1e39;
    EXPECT_FALSE(narrowed(t).has_value());
    t.m[1][2] = std::nan("");
    EXPECT_FALSE(narrowed(t).has_value());
}

} // namespace

} // namespace hearth::import::test
