// Tests units and up axes of sources: hearth-import --scale and --up, and their effect on whole scenes. The
// reference transforms points by hand, or writes the scene in metres by hand.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/mesh/source_mesh.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"
#include "pipelines/import/part/source_space.h"
#include "tests/support/sandbox.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr const char* kHearth = HEARTH_BIN "/hearth";
constexpr const char* kImport = HEARTH_BIN "/hearth-import";
constexpr const char* kSamples = HEARTH_BIN "/hearth-samples";

using Points = std::vector<Double3>;

/// Import part in memory.
struct Part
{
    PackView view;
    std::vector<mesh::SourceMesh> meshes;
};

Part readPart(const std::string& path)
{
    auto reader = ContainerReader::open(path);
    EXPECT_TRUE(reader.ok());
    std::vector<mesh::SourceMesh> meshes;
    while (reader->find(kChunkSourceMesh, static_cast<uint32_t>(meshes.size())) != nullptr)
    {
        auto mesh = mesh::readSourceMesh(*reader, static_cast<uint32_t>(meshes.size()));
        EXPECT_TRUE(mesh.ok());
        meshes.push_back(std::move(*mesh));
    }
    auto view = PackView::read(std::move(*reader));
    EXPECT_TRUE(view.ok());
    return {std::move(*view), std::move(meshes)};
}

/// Return the skinned position of a vertex.
Double3 skinned(const mesh::SourceMesh& mesh, size_t vertex, std::span<const Affine3d> palette)
{
    Double3 sum;
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
    {
        const Float4 w = mesh.weight_sets[set][vertex];
        const double weights[] = {w.x, w.y, w.z, w.w};
        for (size_t i = 0; i < 4; ++i)
            if (weights[i] > 0)
                sum = sum + transformPoint(palette[mesh.joint_sets[set][vertex].joint[i]],
                                           widen(mesh.positions[vertex])) *
                                weights[i];
    }
    return sum;
}

/// Return every vertex of every instance in the world: skinned ones in a pose of the first clip, others at
/// rest.
Points worldPoints(const Part& part, double time)
{
    const AnimationTables tables = animationTables(part.view);
    ScenePose pose = restPose(tables);
    if (!tables.animations.empty())
        sampleAnimation(tables, tables.animations[0], time, pose);
    std::vector<Affine3d> world_from_node(tables.nodes.size());
    poseNodes(tables, pose, nodesParentsFirst(tables.nodes), world_from_node);
    Points points;
    for (const InstanceRecord& instance : part.view.instances())
    {
        const mesh::SourceMesh& mesh = part.meshes[instance.mesh];
        const uint32_t skin = tables.nodes[instance.node].skin;
        std::vector<Affine3d> palette(skin == kInvalidIndex ? 0 : tables.skins[skin].joints.count);
        if (skin != kInvalidIndex)
            skinPalette(tables, tables.skins[skin], world_from_node, palette);
        for (size_t v = 0; v < mesh.positions.size(); ++v)
            points.push_back(skin == kInvalidIndex ? transformPoint(widened(instance.world_from_object),
                                                                    widen(mesh.positions[v]))
                                                   : skinned(mesh, v, palette));
    }
    return points;
}

double computeSize(const Points& points)
{
    double size = 0;
    for (const Double3& p : points)
        size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return size;
}

/// Check that points are equal to `tolerance` of the size of the whole.
void expectEqual(const Points& points, const Points& expected, double tolerance)
{
    ASSERT_EQ(points.size(), expected.size());
    ASSERT_FALSE(points.empty());
    double most = 0;
    for (size_t i = 0; i < points.size(); ++i)
        most = std::max(most, length(points[i] - expected[i]));
    EXPECT_LE(most, tolerance * computeSize(expected));
}

class SourceSpace : public ::testing::Test
{
protected:
    /// Return the part of a source.
    Part import(const std::string& source, std::vector<std::string> options = {})
    {
        options.insert(options.begin(), {kImport, source, "-o", "a.part"});
        const ProgramEnd end = sandbox_.run(options);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return readPart(sandbox_ / "a.part");
    }

    void writeFloats(const std::string& name, const std::vector<float>& values)
    {
        sandbox_.write(name, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
    }

    /// Write a scene with every kind of length, scaled by `f`: with f = 0.01, a scene in centimetres is in
    /// metres.
    void writeScene(const std::string& name, float f)
    {
        writeFloats(name + ".bin", {0, 0, 0, f, 0, 0, 0, 2 * f, 0, 3 * f, 0, 0, 0, 4 * f, f});
        sandbox_.write(name + ".gltf", fmt::format(
                                           R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0,2,3]}}],
"extensionsUsed":["KHR_lights_punctual","EXT_mesh_gpu_instancing"],
"extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"point","intensity":7,"range":{0}}},{{"type":"point"}}]}}}},
"nodes":[
{{"mesh":0,"translation":[{0},{1},{2}],"rotation":[0.6,0,0,0.8],"scale":[2,3,4],"children":[1,4]}},
{{"camera":0,"translation":[{1},0,0],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}},
{{"camera":1,"extensions":{{"KHR_lights_punctual":{{"light":1}}}}}},
{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":1}}}}}}}},
{{"translation":[0,{2},0],"extras":{{"hearth_shadow_radius":{0}}}}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":1,"znear":{0},"zfar":{2}}}}},
{{"type":"orthographic","orthographic":{{"xmag":{0},"ymag":{1},"znear":0,"zfar":{2}}}}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[{0},{1},0]}},
{{"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"}}],
"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}}],
"buffers":[{{"byteLength":60,"uri":"{3}.bin"}}]}})",
                                           f, 2 * f, 30 * f, name));
    }

    void makeCharacter()
    {
        const std::string triangles = kSanitized ? "2000" : "20000";
        ASSERT_EQ(sandbox_.run({kSamples, "character", "--triangles", triangles, "-o", "c.glb"}).exit_code,
                  0);
    }

    Sandbox sandbox_;
};

void expectNear(const Affine3& a, const Affine3& b)
{
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            EXPECT_NEAR(a.m[row][column], b.m[row][column], 1e-6) << row << " " << column;
}

} // namespace

TEST_F(SourceSpace, ofASceneIsThatOfTheSceneWrittenInMetres)
{
    constexpr float kFactor = 0.01f;
    writeScene("centimetres", 1);
    writeScene("metres", kFactor);
    const Part scaled = import("centimetres.gltf", {"--scale", "0.01"});
    const Part metres = import("metres.gltf");
    EXPECT_EQ(scaled.view.instances().size(), 3u) << "two of them by instancing";
    expectEqual(worldPoints(scaled, 0), worldPoints(metres, 0), 1e-6);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(scaled.view.instances()[i].scale_max, kFactor * metres.view.instances()[i].scale_max,
                    1e-6)
            << "meshes keep their coordinates";
    ASSERT_EQ(metres.view.cameras().size(), 2u);
    for (size_t i = 0; i < 2; ++i)
    {
        const CameraRecord &a = scaled.view.cameras()[i], &b = metres.view.cameras()[i];
        expectNear(a.world_from_camera, b.world_from_camera);
        EXPECT_EQ(a.y_fov_rad, b.y_fov_rad);
        EXPECT_FLOAT_EQ(a.z_near, b.z_near);
        EXPECT_FLOAT_EQ(a.z_far, b.z_far);
        EXPECT_FLOAT_EQ(a.x_magnification, b.x_magnification);
        EXPECT_FLOAT_EQ(a.y_magnification, b.y_magnification);
    }
    ASSERT_EQ(metres.view.lights().size(), 2u);
    for (size_t i = 0; i < 2; ++i)
    {
        const LightRecord &a = scaled.view.lights()[i], &b = metres.view.lights()[i];
        expectNear(a.world_from_light, b.world_from_light);
        EXPECT_EQ(a.intensity, b.intensity) << "candela are candela";
        EXPECT_FLOAT_EQ(a.range, b.range);
    }
    EXPECT_EQ(scaled.view.lights()[1].range, 0) << "without a limit";
    ASSERT_EQ(metres.view.shadowSpheres().size(), 1u);
    const ShadowSphereRecord &a = scaled.view.shadowSpheres()[0], &b = metres.view.shadowSpheres()[0];
    EXPECT_LE(length(widen(a.center) - widen(b.center)), 1e-6);
    EXPECT_FLOAT_EQ(a.radius, b.radius);
}

TEST_F(SourceSpace, carriesSkinsAndClips)
{
    makeCharacter();
    const Part part = import("c.glb");
    const Part brought = import("c.glb", {"--scale", "0.01", "--up", "z"});
    ASSERT_FALSE(part.view.skins().empty());
    const AnimationRecord& clip = part.view.animations()[0];
    EXPECT_EQ(brought.view.animations()[0].duration, clip.duration);
    Points before;
    for (const double share : {0.0, 0.3, 0.77})
    {
        const double time = share * double{clip.duration};
        Points expected = worldPoints(part, time);
        for (Double3& p : expected)
            p = Double3{p.x, p.z, -p.y} * 0.01;
        const Points points = worldPoints(brought, time);
        expectEqual(points, expected, 2e-5);
        if (!before.empty())
            EXPECT_GT(length(points.back() - before.back()), 0) << "it moves";
        before = points;
    }
}

TEST_F(SourceSpace, ofASkinnedPackHasItsPosedBounds)
{
    makeCharacter();
    const auto boxes = [&](const std::vector<std::string>& options)
    {
        std::vector<std::string> cook{kHearth, "cook", "c.glb", "-o", "c.hearth", "-q"};
        cook.insert(cook.end(), options.begin(), options.end());
        const ProgramEnd end = sandbox_.run(cook);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(sandbox_.run({kHearth, "verify", "c.hearth"}).exit_code, 0);
        auto reader = ContainerReader::open(sandbox_ / "c.hearth");
        const auto pack = PackView::read(std::move(*reader));
        const std::string clip(pack->text(pack->animations()[0].name));
        const ProgramEnd bounds = sandbox_.run({kHearth, "inspect", "c.hearth", "--bounds", "--animation",
                                                clip, "--time", "0.4", "--format", "json"});
        EXPECT_EQ(bounds.exit_code, 0) << bounds.err;
        Points corners;
        const Json json = Json::parse(bounds.out).value();
        for (const Json& mesh : json["meshes"])
            for (const Json& cluster : mesh["clusters"])
                for (const char* end_of_box : {"min", "max"})
                {
                    const Json& corner = cluster["box"][end_of_box];
                    corners.push_back(
                        {corner[0].get<double>(), corner[1].get<double>(), corner[2].get<double>()});
                }
        return corners;
    };
    Points expected = boxes({});
    for (Double3& p : expected)
        p = p * 0.5;
    expectEqual(boxes({"--scale", "0.5"}), expected, 2e-5);
}

TEST_F(SourceSpace, withZUpIsThatWithYUp)
{
    const float vertices[][3] = {{1, 2, 3}, {4, -5, 6.5f}, {-7, 8, 9}, {0, 1, 0.25f}};
    std::string y_up, z_up;
    for (const auto& [x, y, z] : vertices)
    {
        y_up += fmt::format("v {} {} {}\n", x, z, -y);
        z_up += fmt::format("v {} {} {}\n", x, y, z);
    }
    const std::string faces = "f 1 2 3\nf 1 3 4\n";
    sandbox_.write("y.obj", y_up + faces);
    sandbox_.write("z.obj", z_up + faces);
    const Points expected = worldPoints(import("y.obj"), 0);
    expectEqual(worldPoints(import("z.obj", {"--up", "z"}), 0), expected, 0);
    EXPECT_GT(length(worldPoints(import("z.obj"), 0)[0] - expected[0]), 1) << "they differ without it";
}

TEST_F(SourceSpace, ofMetresWithYUpChangesNothing)
{
    writeScene("scene", 1);
    import("scene.gltf");
    const std::string bytes = sandbox_.read("a.part");
    import("scene.gltf", {"--scale", "1", "--up", "y"});
    EXPECT_EQ(sandbox_.read("a.part"), bytes);
}

TEST_F(SourceSpace, holdsForAuthoredLevels)
{
    sandbox_.write("r_LOD0.obj", "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 100 100 0\nf 1 2 3\nf 2 4 3\n");
    sandbox_.write("r_LOD1.obj", "v 0 0 0\nv 100 0 0\nv 0 100 0\nf 1 2 3\n");
    const Part part = import("r_LOD0.obj", {"--lod", "1=r_LOD1.obj", "--scale", "0.01", "--up", "z"});
    ASSERT_EQ(part.meshes.size(), 2u);
    const Affine3d world = widened(part.view.instances()[0].world_from_object);
    for (const mesh::SourceMesh& mesh : part.meshes)
    {
        const Double3 corner = transformPoint(world, widen(mesh.positions[2]));
        EXPECT_NEAR(length(corner - Double3{0, 0, -1}), 0, 1e-6);
    }
}

TEST_F(SourceSpace, isASettingOfSources)
{
    std::filesystem::create_directory(sandbox_ / "scans");
    for (const char* name : {"scans/a.obj", "b.obj"})
        sandbox_.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    sandbox_.write("hearth.toml", "[[rule]]\nmatch = 'scans/**'\nimport.scale = 0.001\nimport.up = 'z'\n");
    const ProgramEnd end = sandbox_.run({kHearth, "cook", "scans/a.obj", "b.obj", "-o", "a.hearth"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    auto reader = ContainerReader::open(sandbox_ / "a.hearth");
    const auto pack = PackView::read(std::move(*reader));
    ASSERT_EQ(pack->instances().size(), 2u);
    EXPECT_FLOAT_EQ(pack->instances()[0].world_from_object.m[2][1], -0.001f);
    EXPECT_EQ(pack->instances()[1].world_from_object, Affine3{});
    for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
             {"--scale", "0"}, {"--scale", "-1"}, {"--scale", "cm"}, {"--up", "w"}})
    {
        EXPECT_EQ(sandbox_.run({kHearth, "cook", "b.obj", "-o", "b.hearth", option, value}).exit_code, 2)
            << option << " " << value;
        EXPECT_EQ(sandbox_.run({kImport, "b.obj", "-o", "b.part", option, value}).exit_code, 2)
            << option << " " << value;
    }
    sandbox_.write("hearth.toml", "[[rule]]\nmatch = '**'\nimport.scale = 0\n");
    EXPECT_EQ(sandbox_.run({kHearth, "cook", "b.obj", "-o", "b.hearth"}).exit_code, 78);
}

TEST_F(SourceSpace, ofRootsOutsideOfTheSceneAndOfLightsIsTheSame)
{
    auto part = import::PartBuilder::create(sandbox_ / "b.part", "b.gltf");
    ASSERT_TRUE(part.ok());
    NodeRecord node{};
    node.parent = node.mesh = node.skin = kInvalidIndex;
    node.rotation = {0, 0, 0, 1};
    node.parent_from_node = Affine3{};
    part->nodes = {node, node, node};
    part->nodes[2].parent = 1;
    ASSERT_TRUE(import::convertToMetres({0.5, import::UpAxis::y}, *part).ok());
    ASSERT_EQ(part->nodes.size(), 4u);
    EXPECT_EQ(part->nodes[0].parent, 3u);
    EXPECT_EQ(part->nodes[1].parent, 3u);
    EXPECT_EQ(part->nodes[2].parent, 1u);
    EXPECT_EQ(part->nodes[3].parent, kInvalidIndex);
    LightRecord light{};
    light.world_from_light = Affine3{};
    light.range = 1e35f;
    part->lights = {light};
    // a range of two keys, which two channels share, and an intensity
    part->keys = {0, 1, 2, 4};
    AnimationChannelRecord channel{};
    channel.path = static_cast<uint32_t>(AnimationPath::light_range);
    channel.components = 1;
    channel.key_count = 2;
    channel.first_value = 2;
    AnimationChannelRecord other = channel;
    other.path = static_cast<uint32_t>(AnimationPath::light_intensity);
    other.first_value = 0;
    part->channels = {channel, channel, other};
    ASSERT_TRUE(import::convertToMetres({0.5, import::UpAxis::y}, *part).ok());
    EXPECT_EQ(part->keys, (std::vector<float>{0, 1, 1, 2}));
    EXPECT_EQ(part->lights[0].range, 0.5e35f);
    const Status status = import::convertToMetres({1e9, import::UpAxis::y}, *part);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::input_too_large);
}

} // namespace hearth::test
