// Tests proxies of artists in glTF files: names, extras, places, convex parts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/records/proxy.h"
#include "pipelines/import/part/proxy_name.h"
#include "tests/pipelines/gltf_fixture.h"

#include <cmath>

namespace hearth::import::test
{

namespace
{

using namespace formats;

using Nodes = std::vector<uint32_t>;

// Corner i has x = -1 or 1 by bit 0, y by bit 1, z by bit 2; twelve triangles, outwards.
const std::vector<float> kBox{-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                              -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
const std::vector<uint16_t> kBoxIndices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/// Accessors 0 to 3: positions and triangles of a box, the same without its last triangle, turned over. An
/// accessor 4 has the positions of the box with one corner in its middle.
GltfData boxData()
{
    GltfData data;
    data.add("VEC3", kBox);
    data.add("SCALAR", kBoxIndices);
    data.add("SCALAR", std::vector<uint16_t>(kBoxIndices.begin(), kBoxIndices.end() - 3));
    std::vector<uint16_t> turned = kBoxIndices;
    std::reverse(turned.begin(), turned.end());
    data.add("SCALAR", turned);
    std::vector<float> dented = kBox;
    std::fill(dented.end() - 3, dented.end(), 0.0f);
    data.add("VEC3", dented);
    return data;
}

/// Five meshes: a box, a second one, an open one, one that faces inwards, one with a dent.
const std::string kBoxes = R"("meshes":[
    {"name":"a","primitives":[{"attributes":{"POSITION":0},"indices":1}]},
    {"name":"b","primitives":[{"attributes":{"POSITION":0},"indices":1}]},
    {"name":"open","primitives":[{"attributes":{"POSITION":0},"indices":2}]},
    {"name":"inwards","primitives":[{"attributes":{"POSITION":0},"indices":3}]},
    {"name":"dented","primitives":[{"attributes":{"POSITION":4},"indices":1}]}],)";

Imported importBoxes(const std::string& rest, const ImportOptions& options = {})
{
    Imported result = boxData().import(kBoxes + rest, nullptr, options);
    EXPECT_TRUE(result.ok()) << result.message();
    return result;
}

std::vector<ProxyRecord> readProxies(const Imported& result)
{
    return result.part->find(kChunkProxies, 0) == nullptr ? std::vector<ProxyRecord>{}
                                                          : result.records<ProxyRecord>(kChunkProxies);
}

/// Return the meshes that have proxies.
std::vector<uint32_t> proxyMeshes(const Imported& result)
{
    std::vector<uint32_t> meshes;
    for (const ProxyRecord& record : readProxies(result))
        meshes.push_back(record.mesh);
    return meshes;
}

Nodes instanceNodes(const Imported& result)
{
    Nodes nodes;
    for (const InstanceRecord& instance : result.records<InstanceRecord>(kChunkInstances))
        nodes.push_back(instance.node);
    return nodes;
}

Box3 proxyBox(const Imported& result)
{
    Box3 box;
    for (const Float3 position : result.records<Float3>(kChunkProxyPositions))
        box.add(position);
    return box;
}

using Stems = std::vector<std::string>;

} // namespace

TEST(ProxyNames, sayForWhatAProxyStands)
{
    const auto stems = [](std::string_view name)
    {
        const auto parsed = parseProxyName(name);
        return parsed ? parsed->stems : Stems{};
    };
    EXPECT_EQ(stems("Rock_PROXY"), (Stems{"rock"}));
    EXPECT_EQ(stems("rock_proxy.001"), (Stems{"rock"}));
    EXPECT_EQ(stems("Rock.001_Proxy"), (Stems{"rock.001"}));
    EXPECT_EQ(stems("UCX_Rock"), (Stems{"rock"}));
    EXPECT_EQ(stems("ucx_Rock_01"), (Stems{"rock_01", "rock"}));
    EXPECT_EQ(stems("UCX_Rock.002"), (Stems{"rock.002", "rock"}));
    EXPECT_EQ(stems("UCX_Rock_01.002"), (Stems{"rock_01.002", "rock_01", "rock"}));
    for (const char* const name :
         {"", "Rock", "_PROXY", "_PROXY.001", "PROXY", "UCX_", "UCX", "Rock_PROXY_old"})
        EXPECT_EQ(stems(name), Stems{}) << name;
    EXPECT_TRUE(parseProxyName("UCX_Rock")->is_convex);
    EXPECT_FALSE(parseProxyName("Rock_PROXY")->is_convex);
}

TEST(GltfProxies, besideTheirMeshAreMovedToItAndNotDrawn)
{
    // in the space of the mesh, a box of half a metre around (0, 0, 1)
    const Imported result = importBoxes(R"("nodes":[
        {"name":"Rock","mesh":0,"translation":[10,0,0],"scale":[2,2,2]},
        {"name":"rock_proxy","mesh":1,"translation":[10,0,2],"scale":[0.5,0.5,0.5]}])");
    EXPECT_EQ(instanceNodes(result), (Nodes{0}));
    EXPECT_EQ(result.mesh(1).triangleCount(), 0u) << "its number stays";
    const std::vector<ProxyRecord> proxies = readProxies(result);
    ASSERT_EQ(proxies.size(), 1u);
    EXPECT_EQ(proxies[0].mesh, 0u);
    EXPECT_EQ(proxies[0].origin, static_cast<uint32_t>(ProxyOrigin::authored));
    EXPECT_EQ(proxies[0].is_closed, 1u);
    EXPECT_EQ(proxies[0].positions.count, 8u) << "welded";
    EXPECT_EQ(proxies[0].indices.count, 36u);
    const Box3 box = proxyBox(result);
    EXPECT_EQ(box.min, (Float3{-.25f, -.25f, .75f}));
    EXPECT_EQ(box.max, (Float3{.25f, .25f, 1.25f}));
    // distances of the boxes: .25 along z; from a corner below to the nearest one of the proxy
    const double far = std::sqrt(2 * .75 * .75 + 1.75 * 1.75);
    EXPECT_GE(double{proxies[0].distance}, .25);
    EXPECT_LE(double{proxies[0].distance}, .25 * 1.1);
    EXPECT_GE(double{proxies[0].mesh_distance}, far);
    EXPECT_LE(double{proxies[0].mesh_distance}, far * 1.1);
    EXPECT_TRUE(result.warnings.empty());
}

TEST(GltfProxies, areFoundByNamesOfNodesAndMeshesAboveBesideAndElsewhere)
{
    const auto meshes = [](const std::string& nodes) { return proxyMeshes(importBoxes(nodes)); };
    using Meshes = std::vector<uint32_t>;
    // below its mesh; the node of that name elsewhere has mesh 2
    EXPECT_EQ(meshes(R"("nodes":[{"name":"X","mesh":2},{"name":"X","mesh":0,"children":[2]},
        {"name":"X_PROXY","mesh":1}])"),
              (Meshes{0}));
    // beside it
    EXPECT_EQ(meshes(R"("nodes":[{"name":"X","mesh":2},{"children":[2,3]},{"name":"X","mesh":0},
        {"name":"X_PROXY","mesh":1}])"),
              (Meshes{0}));
    // elsewhere
    EXPECT_EQ(meshes(R"("nodes":[{"name":"X","mesh":0},{"children":[2]},{"name":"X_PROXY","mesh":1}])"),
              (Meshes{0}));
    // by the name of the mesh of a node; by the finest level
    EXPECT_EQ(meshes(R"("nodes":[{"name":"what","mesh":2},{"name":"UCX_Open","mesh":1}])"), (Meshes{2}));
    EXPECT_EQ(meshes(R"("nodes":[{"name":"X_LOD0","mesh":0},{"name":"X_LOD1","mesh":2},
        {"name":"X_PROXY","mesh":1}])"),
              (Meshes{0}));
    // number of a part, unless there is a mesh of that name
    EXPECT_EQ(meshes(R"("nodes":[{"name":"X","mesh":0},{"name":"UCX_X_01","mesh":1}])"), (Meshes{0}));
    EXPECT_EQ(meshes(R"("nodes":[{"name":"X","mesh":0},{"name":"X_01","mesh":2},
        {"name":"UCX_X_01","mesh":1}])"),
              (Meshes{2}));
}

TEST(GltfProxies, ofMeshesWithoutNodeLieInTheSpaceOfTheirMesh)
{
    const Imported result = boxData().import(R"("meshes":[
        {"name":"Rock","primitives":[{"attributes":{"POSITION":0},"indices":1}]},
        {"name":"Rock_PROXY","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "nodes":[{"mesh":0,"translation":[5,0,0]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(proxyMeshes(result), (std::vector<uint32_t>{0}));
    EXPECT_EQ(proxyBox(result).max, (Float3{1, 1, 1}));
}

TEST(GltfProxies, haveASectionForEachMaterial)
{
    const Imported result = boxData().import(R"("materials":[{"name":"tin"},{"name":"wood"}],"meshes":[
        {"primitives":[{"attributes":{"POSITION":0},"indices":1}]},
        {"primitives":[{"attributes":{"POSITION":0},"indices":2},
                       {"attributes":{"POSITION":0},"indices":1,"material":1},
                       {"attributes":{"POSITION":0},"indices":2,"material":0}]}],
        "nodes":[{"name":"x","mesh":0},{"name":"x_proxy","mesh":1}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto sections = result.records<ProxySectionRecord>(kChunkProxySections);
    ASSERT_EQ(sections.size(), 3u);
    EXPECT_EQ(sections[0].material, 0u);
    EXPECT_EQ(sections[0].triangles.count, 11u);
    EXPECT_EQ(sections[1].material, 1u);
    EXPECT_EQ(sections[1].triangles.count, 12u);
    EXPECT_EQ(sections[2].material, kInvalidIndex);
    EXPECT_EQ(sections[2].is_convex, 0u);
}

TEST(GltfProxies, convexPartsAreCheckedAndApartFromOtherProxies)
{
    // the second part is mirrored, so that its triangles are turned over with it
    const Imported result = importBoxes(R"("nodes":[{"name":"X","mesh":0},{"name":"UCX_X_01","mesh":1},
        {"name":"UCX_X_02","mesh":1,"scale":[-1,1,1]},{"name":"X_PROXY","mesh":1},
        {"name":"UCX_X_03","mesh":2},{"name":"UCX_X_04","mesh":3},{"name":"UCX_X_05","mesh":4}])");
    EXPECT_EQ(instanceNodes(result), (Nodes{0}));
    const std::vector<ProxyRecord> proxies = readProxies(result);
    ASSERT_EQ(proxies.size(), 2u);
    EXPECT_EQ(proxies[0].sections.count, 1u);
    EXPECT_EQ(proxies[0].is_closed, 1u);
    EXPECT_EQ(proxies[1].sections.count, 5u);
    EXPECT_EQ(proxies[1].is_closed, 0u);
    const auto sections = result.records<ProxySectionRecord>(kChunkProxySections);
    std::vector<uint32_t> convex;
    for (const ProxySectionRecord& section : sections)
        convex.push_back(section.is_convex);
    EXPECT_EQ(convex, (std::vector<uint32_t>{0, 1, 1, 0, 0, 0}));
    EXPECT_TRUE(result.hasWarning(Issue::degraded, "\"open\" of a proxy is not closed: fill its holes"));
    EXPECT_TRUE(result.hasWarning(Issue::degraded, "\"inwards\" of a proxy faces inwards"));
    EXPECT_TRUE(result.hasWarning(Issue::degraded, "\"dented\" of a proxy has dents: split it"));
    EXPECT_EQ(result.warnings.size(), 3u);
}

TEST(GltfProxies, aDentOfRoundingIsNone)
{
    // a corner that is off by a part in ten thousand of the diagonal, and by one in a hundred
    for (const float dent : {3e-4f, 3e-2f})
    {
        std::vector<float> positions = kBox;
        positions.back() -= dent;
        GltfData data = boxData();
        data.add("VEC3", positions);
        const Imported result = data.import(R"("meshes":[
            {"name":"X","primitives":[{"attributes":{"POSITION":0},"indices":1}]},
            {"name":"UCX_X","primitives":[{"attributes":{"POSITION":5},"indices":1}]}],
            "nodes":[{"mesh":0}])");
        ASSERT_TRUE(result.ok()) << result.message();
        EXPECT_EQ(result.records<ProxySectionRecord>(kChunkProxySections)[0].is_convex,
                  dent < 1e-2f ? 1u : 0u)
            << dent;
    }
}

TEST(GltfProxies, extrasMarkNodesAndMeshesWhateverTheirNames)
{
    // of nodes: below a mesh; by number, as Blender writes it; false
    EXPECT_EQ(proxyMeshes(importBoxes(R"("nodes":[{"mesh":0,"children":[1]},
        {"mesh":1,"extras":{"hearth_proxy":true}},{"mesh":2}])")),
              (std::vector<uint32_t>{0}));
    const Imported one = importBoxes(R"("nodes":[{"mesh":2},{"mesh":1,"extras":{"hearth_proxy":1.0}}])");
    EXPECT_EQ(proxyMeshes(one), (std::vector<uint32_t>{2})) << "the only mesh";
    EXPECT_EQ(instanceNodes(one), (Nodes{0}));
    const Imported no = importBoxes(R"("nodes":[{"name":"X","mesh":0},
        {"name":"X_PROXY","mesh":1,"extras":{"hearth_proxy":false}}])");
    EXPECT_TRUE(readProxies(no).empty());
    EXPECT_EQ(instanceNodes(no), (Nodes{0, 1}));
    EXPECT_TRUE(no.warnings.empty());
    // of a mesh
    const Imported convex = boxData().import(R"("meshes":[
        {"primitives":[{"attributes":{"POSITION":0},"indices":1}]},
        {"primitives":[{"attributes":{"POSITION":0},"indices":1}],"extras":{"hearth_proxy":"convex"}}],
        "nodes":[{"mesh":0},{"mesh":1}])");
    ASSERT_TRUE(convex.ok()) << convex.message();
    ASSERT_EQ(proxyMeshes(convex), (std::vector<uint32_t>{0}));
    EXPECT_EQ(convex.records<ProxySectionRecord>(kChunkProxySections)[0].is_convex, 1u);
}

TEST(GltfProxies, E1117_otherMarks)
{
    for (const char* const mark : {"2", "\"concave\"", "null", "[true]"})
    {
        const Imported result = boxData().import(kBoxes + R"("nodes":[{"mesh":0},
            {"mesh":1,"extras":{"hearth_proxy":)" +
                                                 mark + "}}]");
        ASSERT_FALSE(result.ok()) << mark;
        EXPECT_EQ(result.status.error().issue, Issue::gltf_extension_value);
        EXPECT_EQ(result.status.error().where, "/nodes/1/extras/hearth_proxy");
        EXPECT_NE(result.message().find("must be true, false or \"convex\""), std::string::npos);
        EXPECT_TRUE(result.folder->empty()) << "no part is left";
    }
}

TEST(GltfProxies, ofNoMeshAreNamed)
{
    const Imported called =
        importBoxes(R"("nodes":[{"name":"Rock","mesh":0},{"name":"UCX_Rok_01","mesh":1}])");
    EXPECT_TRUE(readProxies(called).empty());
    EXPECT_EQ(instanceNodes(called), (Nodes{0, 1})) << "people see it";
    EXPECT_EQ(called.mesh(1).triangleCount(), 12u);
    EXPECT_TRUE(called.hasWarning(Issue::dropped, "\"UCX_Rok_01\" is called as a proxy of a mesh \"rok\""));
    const Imported marked = importBoxes(R"("nodes":[{"name":"Rock","mesh":0},{"name":"Tree","mesh":2},
        {"name":"Hull","mesh":1,"extras":{"hearth_proxy":true}}])");
    EXPECT_TRUE(readProxies(marked).empty());
    EXPECT_EQ(instanceNodes(marked), (Nodes{0, 1}));
    EXPECT_TRUE(marked.hasWarning(Issue::dropped, "the proxy \"Hull\" is not kept"));
}

TEST(GltfProxies, nodesThatShareAMeshShareItsProxies)
{
    const std::string two = R"("nodes":[{"name":"X","mesh":0,"children":[2]},
        {"name":"Y","mesh":0,"translation":[5,0,0],"children":[3]},
        {"name":"X_PROXY","mesh":1},{"name":"Y_PROXY","mesh":)";
    const Imported same = importBoxes(two + "1}]");
    EXPECT_EQ(proxyMeshes(same), (std::vector<uint32_t>{0}));
    EXPECT_EQ(instanceNodes(same), (Nodes{0, 1}));
    EXPECT_TRUE(same.warnings.empty());
    const Imported other = importBoxes(two + "2}]");
    EXPECT_EQ(readProxies(other)[0].indices.count, 36u) << "that of the first node";
    EXPECT_TRUE(other.hasWarning(Issue::dropped, "mesh 0 has other proxies, of node 0"));
}

TEST(GltfProxies, thatCannotBeMovedAreNamed)
{
    const Imported result = importBoxes(R"("nodes":[{"name":"X","mesh":0,"scale":[1,0,1]},
        {"name":"X_PROXY","mesh":1,"translation":[1,0,0]}])");
    EXPECT_TRUE(readProxies(result).empty());
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "a proxy cannot be moved to its mesh"));
}

TEST(GltfProxies, ofASkinnedMeshAreInItsBindPose)
{
    // the node of a skinned mesh does not place it; a proxy of the same skin has its bind pose
    GltfData data = boxData();
    std::vector<uint8_t> joints(32);
    data.add("VEC4", joints);
    std::vector<float> weights;
    for (int i = 0; i < 8; ++i)
        weights.insert(weights.end(), {1, 0, 0, 0});
    data.add("VEC4", weights);
    const std::string primitive =
        R"({"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":5,"WEIGHTS_0":6},"indices":1}]})";
    const Imported result = data.import(R"("meshes":[)" + primitive + "," + primitive + R"(],
        "skins":[{"joints":[2]}],
        "nodes":[{"name":"X","mesh":0,"skin":0},
                 {"name":"X_PROXY","mesh":1,"skin":0,"translation":[7,0,0]},{"translation":[0,3,0]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    ASSERT_EQ(proxyMeshes(result), (std::vector<uint32_t>{0}));
    EXPECT_EQ(proxyBox(result).max, (Float3{1, 1, 1}));
}

TEST(GltfProxies, optionsLeaveThemOutOrDrawThem)
{
    const std::string nodes = R"("nodes":[{"name":"X","mesh":0},{"name":"X_PROXY","mesh":1}])";
    ImportOptions options;
    options.proxies = AuthoredProxies::left_out;
    const Imported left_out = importBoxes(nodes, options);
    EXPECT_TRUE(readProxies(left_out).empty());
    EXPECT_EQ(instanceNodes(left_out), (Nodes{0}));
    options.proxies = AuthoredProxies::unknown;
    const Imported unknown = importBoxes(nodes, options);
    EXPECT_TRUE(readProxies(unknown).empty());
    EXPECT_EQ(instanceNodes(unknown), (Nodes{0, 1}));
}

} // namespace hearth::import::test
