// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/small_pack.h"

#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/visibility_code.h"
#include "formats/container/container_reader.h"
#include "formats/gpu_shared/reflector.h"
#include "formats/pack/texture_pieces.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kStripAttributes = kVertexNormal | kVertexTangent | kVertexUv0 | kVertexColor |
                                      kVertexVisibility | 14u << kVertexUvStepShift;
constexpr float kGridStep = 1.0f / 1024;
constexpr float kFold = 96 * kGridStep; ///< metres by which every second edge of the strip is lifted
constexpr float kFoldError = 0.1f;
constexpr float kMorphStep = 1.0f / 64;

StringRef intern(PackModel& pack, std::string_view text)
{
    const StringRef ref{static_cast<uint32_t>(pack.strings.size()), static_cast<uint32_t>(text.size())};
    pack.strings += text;
    return ref;
}

template <typename T>
void appendValue(std::vector<std::byte>& bytes, const T& value)
{
    const size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(bytes.data() + at, &value, sizeof(T));
}

void padTo(std::vector<std::byte>& bytes, size_t alignment)
{
    while (bytes.size() % alignment != 0)
        bytes.push_back(std::byte{0});
}

struct Shape
{
    std::vector<Float3> positions;
    std::vector<uint8_t> indices;
};

/// Part of the strip between x0 and x1: two triangles that face +Y.
Shape quad(float x0, float y0, float x1, float y1)
{
    return {{{x0, y0, 0}, {x0, y0, 1}, {x1, y1, 1}, {x1, y1, 0}}, {0, 1, 2, 0, 2, 3}};
}

/// u = x / 4, v = z, counted from 0.
void appendVertex(std::vector<std::byte>& page, Float3 position, const ClusterRecord& cluster,
                  uint32_t layout)
{
    const auto offset = [&](int axis)
    { return static_cast<uint32_t>(static_cast<int32_t>(position[axis] / kGridStep) - cluster.base[axis]); };
    const Float3 up{0, 1, 0};
    const uint32_t normal = (layout & kVertexNormal) ? encodeNormal(layout, up) : 0;
    appendValue(page, offset(0) | offset(1) << 16);
    appendValue(page, offset(2) | normal << 16);
    if (layout & kVertexTangent)
        appendValue(page, encodeTangent(layout, {1, 0, 0, -1}, up));
    if (layout & kVertexUv0)
        appendValue(page, static_cast<uint32_t>(position.x * 4096) | static_cast<uint32_t>(position.z * 16384)
                                                                         << 16);
    if (layout & kVertexColor)
        appendValue(page, encodeColor(layout, {1, 0.5f, 0.25f, 1})[0]);
    if (layout & kVertexVisibility)
        appendValue(page,
                    encodeVisibility(std::numbers::pi_v<float>, {1, 2, 0}, decodeNormal(layout, normal)));
    if (layout & kVertexInfluences)
        for (const uint32_t word : {1u, 0u, 40000u | 25535u << 16, 0u})
            appendValue(page, word);
}

/// Deltas of target 0, which lifts the last vertex by a half and turns its normal.
void appendMorphs(std::vector<std::byte>& page, size_t vertex_count)
{
    for (const uint32_t word : {1u, 0u, std::bit_cast<uint32_t>(kMorphStep)})
        appendValue(page, word);
    for (size_t i = 0; i + 3 < 3 * vertex_count; ++i)
        appendValue(page, uint32_t{0});
    for (const uint32_t word : {packMorphDelta(0, 512), packMorphDelta(32, -1024), packMorphDelta(0, 0)})
        appendValue(page, word);
}

/// Bounds of the shape: its box, and a cone that contains all its normals.
ClusterRecord computeBounds(const Shape& shape, uint16_t cone_cutoff)
{
    Box3 box;
    for (const Float3 p : shape.positions)
        box.add(p);
    ClusterRecord cluster{};
    for (int axis = 0; axis < 3; ++axis)
    {
        cluster.base[axis] = static_cast<int32_t>(box.min[axis] / kGridStep);
        cluster.extent[axis] = static_cast<uint16_t>((box.max[axis] - box.min[axis]) / kGridStep);
    }
    cluster.cone_axis = static_cast<uint16_t>(NormalCode<8>::encode({0, 1, 0}));
    cluster.cone_cutoff = cone_cutoff;
    cluster.cone_back = static_cast<uint16_t>(2 / kGridStep / kConeBackSteps);
    return cluster;
}

/// Add a cluster: its geometry at the end of the last page, its record in the last group.
void addCluster(PackModel& pack, const Shape& shape, uint32_t refined_group)
{
    const uint32_t group = static_cast<uint32_t>(pack.groups.size() - 1);
    const uint32_t mesh = static_cast<uint32_t>(pack.meshes.size() - 1);
    std::vector<std::byte>& page = pack.decoded_pages.back();

    const uint32_t layout = pack.meshes.back().attributes;
    ClusterRecord cluster = computeBounds(shape, (layout & kVertexNormal) ? uint16_t{65536 / 5} : kNoCone);
    cluster.material = mesh == 0 ? 0 : kInvalidIndex;
    cluster.page = static_cast<uint32_t>(pack.decoded_pages.size() - 1);
    cluster.page_word = static_cast<uint16_t>(page.size() / 4);
    cluster.group = group;
    cluster.refined_group = refined_group;
    cluster.vertex_count = static_cast<uint16_t>(shape.positions.size());
    cluster.triangle_count = static_cast<uint8_t>(shape.indices.size() / 3);
    cluster.level = static_cast<uint8_t>(pack.groups.back().level);
    pack.clusters.push_back(cluster);

    for (uint32_t word = 0; word < uvBaseWords(layout); ++word)
        appendValue(page, uint32_t{0});
    for (const Float3 position : shape.positions)
        appendVertex(page, position, cluster, layout);
    for (const uint8_t index : shape.indices)
        page.push_back(std::byte{index});
    padTo(page, 4);
    if (pack.meshes.back().morph_target_count > 0)
        appendMorphs(page, shape.positions.size());

    ++pack.groups.back().clusters.count;
    ++pack.pages.back().clusters.count;
}

/// Begin a group in a page of its own.
void beginGroup(PackModel& pack, uint32_t level, Float3 center, float radius, float error)
{
    const auto first_cluster = static_cast<uint32_t>(pack.clusters.size());
    GroupRecord group{};
    group.sphere_center = center;
    group.sphere_radius = radius;
    group.error = error;
    if (std::isfinite(error))
    {
        group.position_error = error / 2;
        group.normal_error = 0.25f;
        group.uv_error = error;
    }
    group.level = level;
    group.clusters = {first_cluster, 0};
    group.page = static_cast<uint32_t>(pack.pages.size());
    pack.groups.push_back(group);

    PageRecord page{};
    page.mesh = static_cast<uint32_t>(pack.meshes.size() - 1);
    page.clusters = {first_cluster, 0};
    page.parents = {static_cast<uint32_t>(pack.page_parents.size()), 0};
    pack.pages.push_back(page);
    pack.decoded_pages.emplace_back();
}

void beginMesh(PackModel& pack, std::string_view name, uint32_t attributes)
{
    MeshRecord mesh{};
    mesh.name = intern(pack, name);
    mesh.attributes = attributes;
    mesh.levels.first = static_cast<uint32_t>(pack.levels.size());
    mesh.groups.first = static_cast<uint32_t>(pack.groups.size());
    mesh.clusters.first = static_cast<uint32_t>(pack.clusters.size());
    mesh.pages.first = static_cast<uint32_t>(pack.pages.size());
    pack.meshes.push_back(mesh);
}

void endMesh(PackModel& pack, uint32_t source_triangles)
{
    MeshRecord& mesh = pack.meshes.back();
    mesh.source_faces = source_triangles;
    mesh.source_triangles = source_triangles;
    mesh.source_vertices = source_triangles * 3;
    mesh.levels.count = static_cast<uint32_t>(pack.levels.size()) - mesh.levels.first;
    mesh.groups.count = static_cast<uint32_t>(pack.groups.size()) - mesh.groups.first;
    mesh.clusters.count = static_cast<uint32_t>(pack.clusters.size()) - mesh.clusters.first;
    mesh.pages.count = static_cast<uint32_t>(pack.pages.size()) - mesh.pages.first;
    mesh.lod_count = mesh.levels.count;
    Box3 box;
    for (uint32_t i = mesh.clusters.first; i < pack.clusters.size(); ++i)
        box.add(clusterBox(pack.clusters[i], kGridStep));
    mesh.grid_step = box.empty() ? 0 : kGridStep;
    mesh.box_min = box.empty() ? Float3{} : box.min;
    mesh.box_max = box.empty() ? Float3{} : box.max;
}

void addStrip(PackModel& pack)
{
    beginMesh(pack, "strip", kStripAttributes);
    beginGroup(pack, 1, {2, 0, 0.5f}, 3, kInfinity);
    addCluster(pack, quad(0, 0, 2, 0), 1);
    addCluster(pack, quad(2, 0, 4, 0), 2);
    for (const float x : {0.0f, 2.0f})
    {
        beginGroup(pack, 0, {x + 1, 0, 0.5f}, 1.5f, kFoldError);
        pack.page_parents.push_back(0);
        pack.pages.back().parents.count = 1;
        addCluster(pack, quad(x, 0, x + 1, kFold), kInvalidIndex);
        addCluster(pack, quad(x + 1, kFold, x + 2, 0), kInvalidIndex);
    }
    pack.levels.push_back({{2, 4}, 8, 0});
    pack.levels.push_back({{0, 2}, 4, kFoldError});
    endMesh(pack, 8);
}

void addTriangle(PackModel& pack)
{
    beginMesh(pack, "triangle", kVertexUv0 | 14u << kVertexUvStepShift | kVertexInfluences);
    pack.meshes.back().skinned = 1;
    pack.meshes.back().morph_target_count = 1;
    const uint32_t first = static_cast<uint32_t>(pack.clusters.size());
    beginGroup(pack, 0, {0, 0, 0}, 2, kInfinity);
    addCluster(pack, {{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {0, 1, 2}}, kInvalidIndex);
    pack.levels.push_back({{first, 1}, 1, 0});
    endMesh(pack, 1);
}

/// Bounds of the triangle, whose two joints never move.
void addBounds(PackModel& pack)
{
    DeformedMeshRecord mesh{};
    mesh.mesh = 2;
    mesh.clusters = {0, 1};
    mesh.box_max = {1.5f, 0.5f, 1};
    pack.deformed_meshes.push_back(mesh);
    DeformedClusterRecord cluster{};
    cluster.joint = 1;
    cluster.box_max = mesh.box_max;
    cluster.cone_cutoff = kNoCone;
    cluster.joints = {0, 2};
    pack.deformed_clusters.push_back(cluster);
    pack.cluster_joints = {1, 0};
    const GroupRecord& group = pack.groups.back();
    pack.deformed_groups.push_back(
        {group.sphere_center, group.sphere_radius, static_cast<uint32_t>(pack.groups.size() - 1)});
}

/// Table that depends only on the aperture.
void addSpecularTable(PackModel& pack)
{
    SpecularTableRecord table{};
    table.aperture_nodes = table.roughness_nodes = table.beta_nodes = shared::kSpecularNodes;
    table.normal_lambda = 0.5f;
    table.min_roughness = shared::kMinSpecularRoughness;
    for (uint32_t i = 0; i < kSpecularTexels; ++i)
        table.values[i] = static_cast<uint8_t>(17 * (i % shared::kSpecularNodes));
    pack.specular_tables.push_back(table);
}

/// Probe of 2 x 2 and one texel a face: each face has another colour.
void addProbe(PackModel& pack)
{
    ProbeRecord probe{};
    probe.face_size = probe.mip_count = 2;
    probe.format = static_cast<uint32_t>(TexelFormat::rgb9e5_float);
    probe.irradiance = {3, 2, 1};
    probe.irradiance_luminance = 2.1403f;
    probe.harmonics[0] = 1.2f;
    probe.harmonics[5] = -0.1f;
    probe.window = 0.01f;
    probe.largest = 1;
    probe.error = 0.001f;
    probe.texels = {0, 30};
    pack.probes = {probe};
    for (uint32_t i = 0; i < probe.texels.count; ++i)
    {
        const uint32_t face = i < 24 ? i / 4 : i - 24;
        pack.probe_texels.push_back(15u << 27 | 64 * (face + 1) << 18 | 400u << 9 | 64 * face);
    }
}

/// Atlas of 6 x 4 texels for two instances: two texels of group 0 and one of group 3, lit by three lamps.
void addReceivers(PackModel& pack)
{
    const auto place = [](uint32_t x, uint32_t y) { return x | y << 14; };
    pack.receiver_lamps = {{0, 0}, {1, 0}, {2, 1}};
    pack.receiver_rects = {{0, 0, 0, 3, 4, 0}, {1, 4, 0, 2, 2, 0}};
    pack.receiver_blocks = {{0, 2, 2, 0, {1u << 16, 0, 0, 0, 0, 0}}, {6, 1, 3, 3, {1u << 16, 2, 0, 0, 0, 0}}};
    pack.receiver_words = {place(0, 0), place(2, 2), 15u << 27 | 256, 15u << 27 | 128, 14u << 27 | 300,
                           0,           place(5, 1), 15u << 27,       16u << 27 | 511, 20u << 27 | 256 << 9};
    pack.receiver_atlases = {{6, 4, 0, 0.5f, 3, 2, 2, 10, 3, {1, 0, 0, 1}, {}}};
}

/// Two proxies: a closed tetrahedron of two sections for the strip, with bindings; an open triangle for
/// the last mesh, without.
void addProxies(PackModel& pack)
{
    uint32_t vertices = 0;
    const Range clusters = pack.levels[pack.meshes[0].levels.first].clusters;
    for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
        vertices += pack.clusters[c].vertex_count;
    pack.proxy_positions = {{0, 0, 0}, {2, 0, 0}, {0, 0, -2}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    pack.proxy_indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 1, 2};
    pack.proxy_sections = {{{0, 1}, 0, 0}, {{1, 3}, kInvalidIndex, 1}, {{0, 1}, kInvalidIndex, 0}};
    for (uint32_t v = 0; v < vertices; ++v)
        pack.proxy_bindings.push_back({v % 4, {16384, 32768}, 0.25f});
    pack.proxies = {{0, 0, 1, 0.5f, 0.25f, {0, 4}, {0, 12}, {0, 2}, {0, vertices}, {}},
                    {static_cast<uint32_t>(pack.meshes.size() - 1),
                     2,
                     0,
                     kInfinity,
                     kInfinity,
                     {4, 3},
                     {12, 3},
                     {2, 1},
                     {vertices, 0},
                     {}}};
}

/// Light of occluders at the last instance; the visibility of others is that of their mesh.
void addSurroundings(PackModel& pack)
{
    pack.surroundings.assign(pack.instances.size(), kPlainSurroundings);
    pack.surroundings.back() = {0, {0x3000, 0, 0xB000, 0x3A00}};
    RadianceTransferRecord transfer{};
    for (uint16_t i = 0; i < kTransferValues; ++i)
        transfer.values[i] = static_cast<uint16_t>(0x3000 + i);
    pack.radiance_transfers.push_back(transfer);
}

/// Two groups along x, three bricks: a row of two voxels in the first, a corner of the grid in the second.
void addBricks(PackModel& pack)
{
    pack.bricks = brickModel({19, 5, 3}, [](uint32_t x, uint32_t y, uint32_t z)
                             { return y == 4 && z == 2 && (x == 2 || x == 3 || x == 7 || x == 18); });
    pack.bricks.grid.origin = {-4, 0, -1};
    pack.bricks.grid.voxel_size = 0.5f;
    pack.bricks.opacity[1] = 51;
    pack.bricks.albedo[2] = shared::encodeAlbedo({1, 0.2f, 0});
    pack.bricks.emission[3] = pack.bricks.lighting[3] = shared::encodeRadiance({4, 2, 0.5f});
    pack.bricks.reflectors = {
        {}, {shared::encodeRadiance({2, 1, 0.5f}), 0x7F, {0xFF, 0x80, 0, 1}, {0xFFFFFFFF, 0xFF, 0, 0}}, {}};
    pack.brick_grids = {pack.bricks.grid};
}

/// Light of the lamps of receivers at three faces of the bricks.
void addFaceReceivers(PackModel& pack)
{
    const auto faces = static_cast<uint32_t>(pack.bricks.albedo.size());
    pack.face_blocks = {{0, 2, 2, 0, {1u << 16, 0, 0, 0, 0, 0}}, {6, 1, 1, 1, {2, 0, 0, 0, 0, 0}}};
    pack.face_words = {0, 2, 15u << 27 | 256, 15u << 27 | 128, 14u << 27 | 300, 0, 1, 16u << 27 | 511};
    pack.face_atlases = {{faces, 1, 0, 2, 3, 0, 2, 8, 3, {1, 1, 0, 0}, {}}};
}

/// Source of everything. The strip reaches from 0 to 4 along x, the triangle's joints to 1.5.
void addAsset(PackModel& pack)
{
    AssetRecord asset{};
    asset.name = intern(pack, "Lager\xC3\xB6");
    asset.instances.count = static_cast<uint32_t>(pack.instances.size());
    asset.meshes.count = static_cast<uint32_t>(pack.meshes.size());
    asset.nodes.count = static_cast<uint32_t>(pack.nodes.size());
    asset.box_max = {4, 0.5f, 1};
    pack.assets.push_back(asset);
}

/// Extras of one object of each kind, and of the asset, the scene and the file.
void addExtras(PackModel& pack)
{
    const auto add = [&](ExtrasOwner owner, uint32_t index, const char* json) {
        pack.extras.push_back({static_cast<uint32_t>(owner), index, intern(pack, json)});
    };
    add(ExtrasOwner::node, 1, R"({"speed":1.50,"tag":"T\u00fcr"})");
    add(ExtrasOwner::mesh, 2, "[1,2]");
    add(ExtrasOwner::material, 0, R"({"sound":"wood"})");
    add(ExtrasOwner::camera, 1, "true");
    add(ExtrasOwner::light, 2, "-0.0");
    add(ExtrasOwner::skin, 0, "null");
    add(ExtrasOwner::animation, 1, R"({"steps":[0.25,0.75]})");
    add(ExtrasOwner::asset, 0,
        R"({"author":"Lager\u00f6 )"
        "\xC3\xB6\"}");
    add(ExtrasOwner::scene, 0, R"({"fog":{"density":1e-3}})");
    add(ExtrasOwner::file, 0, "12345678901234567890");
}

void addNodes(PackModel& pack)
{
    NodeRecord node{};
    node.parent = kInvalidIndex;
    node.mesh = kInvalidIndex;
    node.skin = kInvalidIndex;
    node.has_trs = 1;
    node.rotation = {0, 0, 0, 1};
    node.scale = {1, 1, 1};
    node.parent_from_node = Affine3{};
    node.name =
        intern(pack, "Wurzel \xC3\xA4\xE2\x82\xAC"); // names are UTF-8: two and three bytes a character
    pack.nodes.push_back(node);

    node.name = intern(pack, "strip node");
    node.parent = 2; // a parent may stand after its child
    node.mesh = 0;
    pack.nodes.push_back(node);

    node.name = intern(pack, "between");
    node.parent = 0;
    node.mesh = kInvalidIndex;
    node.has_trs = 0;
    pack.nodes.push_back(node);

    node.name = intern(pack, "skinned");
    node.parent = kInvalidIndex;
    node.mesh = 2;
    node.skin = 0;
    node.morph_weights = {0, 1};
    pack.nodes.push_back(node);
    pack.morph_weights = {0.5f};
}

void addScene(PackModel& pack)
{
    addNodes(pack);
    pack.instances.push_back({Affine3{}, 0, 1, 0, 1});
    Affine3 mirrored;
    mirrored.m[0][0] = -2;
    mirrored.m[0][3] = 5;
    pack.instances.push_back({mirrored, 2, 3, kInstanceMirrored, 2});

    CameraRecord camera{};
    camera.name = intern(pack, "camera");
    camera.y_fov_rad = 1;
    camera.z_near = 0.1f;
    camera.world_from_camera = Affine3{};
    pack.cameras.push_back(camera);
    camera.type = static_cast<uint32_t>(CameraType::orthographic);
    camera.x_magnification = camera.y_magnification = 2;
    camera.z_far = 100;
    pack.cameras.push_back(camera);

    for (const LightType type : {LightType::directional, LightType::point, LightType::spot})
    {
        LightRecord light{};
        light.name = intern(pack, "light");
        light.type = static_cast<uint32_t>(type);
        light.color = {1, 0.9f, 0.8f};
        light.intensity = 10;
        light.outer_cone_rad = 0.5f;
        light.flicker_rate = type == LightType::point ? 8.0f : 0;
        light.flicker_amplitude = type == LightType::point ? 0.25f : 0;
        light.flicker_seed = type == LightType::point ? 7 : 0;
        light.world_from_light = Affine3{};
        pack.lights.push_back(light);
    }
    pack.shadow_spheres.push_back({0, kInvalidIndex, {1, 2, 3}, 4, 0, 0});
    pack.shadow_spheres.push_back({1, 2, {0, 0, 0}, 1, 512, 0});
}

TextureRef texture(uint32_t image)
{
    return {image, 0, 0, 2, 0, {1, 0, 0, 0, 1, 0}};
}

void addMaterials(PackModel& pack)
{
    MaterialRecord material{};
    material.name = intern(pack, "paint");
    material.flags = kMaterialDoubleSided;
    material.alpha_mode = static_cast<uint32_t>(AlphaMode::mask);
    material.base_color = {1, 1, 1, 1};
    material.alpha_cutoff = 0.5f;
    material.roughness = 1;
    material.normal_scale = 1;
    material.occlusion_strength = 1;
    material.base_color_texture = texture(0);
    material.metallic_roughness_texture = texture(kInvalidIndex);
    material.normal_texture = texture(kInvalidIndex);
    material.occlusion_texture = texture(kInvalidIndex);
    material.emissive_texture = texture(1);
    pack.materials.push_back(material);
    MaterialLayersRecord layers = neutralLayers(0);
    layers.clearcoat = 0.5f;
    layers.clearcoat_texture = texture(0);
    pack.material_layers.push_back(layers);

    ImageRecord paint{};
    paint.name = intern(pack, "paint.png");
    paint.width = 4;
    paint.height = 2;
    paint.mip_count = 3;
    paint.format = static_cast<uint32_t>(TexelFormat::rgba8_srgb);
    paint.flags = kImageAlphaTested;
    paint.alpha_cutoff = 0.5f;
    pack.images.push_back(paint);
    pack.image_data.emplace_back((8 + 2 + 1) * 4, std::byte{0x7F});
    ImageRecord glow{};
    glow.name = intern(pack, "glow.exr");
    glow.width = glow.height = 2;
    glow.mip_count = 1;
    glow.format = static_cast<uint32_t>(TexelFormat::rgba16_float);
    pack.images.push_back(glow);
    pack.image_data.emplace_back(4 * 8, std::byte{0x3C});
}

void addAnimation(PackModel& pack)
{
    pack.skins.push_back({intern(pack, "skin"), kInvalidIndex, {0, 2}, 0});
    pack.joints.push_back({0, {}, Affine3{}});
    pack.joints.push_back({2, {}, Affine3{}});

    // times 0 1 2, then three translations, a cubic spline of two rotations, and two steps of one weight
    pack.keys = {0, 1, 2, 0, 0, 0, 1, 0, 0, 2, 0, 0};
    const auto first_rotation = static_cast<uint32_t>(pack.keys.size());
    for (int i = 0; i < 6; ++i)
        pack.keys.insert(pack.keys.end(), {0, 0, 0, i % 3 == 1 ? 1.0f : 0.0f});
    const auto first_packed = static_cast<uint32_t>(pack.keys.size());
    pack.keys.insert(pack.keys.end(), {1, 0, 0, 0.5f, 0, 0, 0, 0});
    const auto first_weight = static_cast<uint32_t>(pack.keys.size());
    pack.keys.insert(pack.keys.end(), {0, 1});
    const auto first_intensity = static_cast<uint32_t>(pack.keys.size());
    pack.keys.insert(pack.keys.end(), {10, 0, 0, 0.5f, 0, 0, 1, 0});
    const auto channel = [](AnimationPath path, Interpolation interpolation)
    {
        AnimationChannelRecord record{};
        record.path = static_cast<uint32_t>(path);
        record.interpolation = static_cast<uint32_t>(interpolation);
        return record;
    };
    AnimationChannelRecord move = channel(AnimationPath::translation, Interpolation::linear);
    move.target = 1;
    move.components = 3;
    move.key_count = 3;
    move.first_value = 3;
    AnimationChannelRecord turn = channel(AnimationPath::rotation, Interpolation::cubic_spline);
    turn.target = 2;
    turn.components = 4;
    turn.key_count = 2;
    turn.first_value = first_rotation;
    AnimationChannelRecord morph = channel(AnimationPath::weights, Interpolation::step);
    morph.target = 3;
    morph.components = 1;
    morph.key_count = 2;
    morph.first_value = first_weight;
    // packed: the times 0 and 2 of the clip above, x from 1 in steps of a half; two half turns, about x and
    // about y
    AnimationChannelRecord packed_move = channel(AnimationPath::translation, Interpolation::linear);
    packed_move.target = 1;
    packed_move.components = 3;
    packed_move.key_count = 2;
    packed_move.first_value = first_packed;
    packed_move.encoding = static_cast<uint32_t>(KeyEncoding::packed);
    packed_move.value_bits[0] = 4;
    packed_move.time_bits = 2;
    AnimationChannelRecord packed_turn = packed_move;
    packed_turn.path = static_cast<uint32_t>(AnimationPath::rotation);
    packed_turn.components = 4;
    packed_turn.first_word = 1;
    packed_turn.first_value = first_packed + 4;
    packed_turn.value_bits[0] = 0;
    packed_turn.time_bits = 0;
    pack.key_bits = {0u | 3u << 2 | 2u << 6 | 15u << 8, 0u | 1u << 2};
    // a lamp that goes out, and a spot whose cone opens: a spline of two angles, tangents 0
    AnimationChannelRecord fade = channel(AnimationPath::light_intensity, Interpolation::linear);
    fade.target = 1;
    fade.components = 1;
    fade.key_count = 2;
    fade.first_value = first_intensity;
    AnimationChannelRecord open = channel(AnimationPath::light_outer_cone, Interpolation::cubic_spline);
    open.target = 2;
    open.components = 1;
    open.key_count = 2;
    open.first_value = first_intensity + 2;
    pack.channels = {move, turn, morph, packed_move, packed_turn, fade, open};
    pack.animations.push_back({intern(pack, "move"), {0, 2}, {2, 0}, 2, 0});
    pack.animations.push_back({intern(pack, "morph"), {2, 1}, {3, 0}, 1, 0});
    pack.animations.push_back({intern(pack, "packed"), {3, 2}, {5, 2}, 2.5f, 0.25f});
}

} // namespace

void PackModel::sealPages()
{
    page_bytes.clear();
    for (size_t i = 0; i < pages.size(); ++i)
    {
        padTo(page_bytes, kChunkAlignment);
        const ChunkImage image =
            i == 1 ? plainChunk(0, 0, 1, decoded_pages[i]) : zstdChunk(0, 0, 1, decoded_pages[i]);
        pages[i].offset = page_bytes.size();
        pages[i].stored_size = static_cast<uint32_t>(image.stored.size());
        pages[i].size = static_cast<uint32_t>(decoded_pages[i].size());
        pages[i].codec = image.entry.codec;
        pages[i].hash = hashBytes(image.stored);
        page_bytes.insert(page_bytes.end(), image.stored.begin(), image.stored.end());
    }
}

void PackModel::sealImages()
{
    texture_pieces.clear();
    for (uint32_t i = 0; i < images.size(); ++i)
    {
        const std::vector<TexturePiece> pieces = listTexturePieces(images[i]);
        images[i].pieces = {static_cast<uint32_t>(texture_pieces.size()),
                            static_cast<uint32_t>(pieces.size())};
        uint64_t offset = 0;
        for (const TexturePiece& piece : pieces)
        {
            const auto texels =
                std::span(image_data[i]).subspan(static_cast<size_t>(piece.offset), piece.size);
            const ChunkImage frame = zstdChunk(0, 0, 1, texels);
            texture_pieces.push_back({.offset = offset,
                                      .stored_size = static_cast<uint32_t>(frame.stored.size()),
                                      .size = piece.size,
                                      .hash = hashBytes(frame.stored)});
            offset += frame.stored.size();
        }
    }
}

/// Return the chunk of an image's texels, in its pieces if it has some.
ChunkImage PackModel::imageChunk(uint32_t image, bool compressed) const
{
    const std::vector<std::byte>& texels = image_data[image];
    if (image < images.size() && images[image].pieces.count > 0)
    {
        std::vector<uint32_t> sizes;
        for (const TexturePiece& piece : listTexturePieces(images[image]))
            sizes.push_back(piece.size);
        return framesChunk(kChunkImageData, image, texels, sizes);
    }
    return compressed ? zstdChunk(kChunkImageData, image, 1, texels)
                      : plainChunk(kChunkImageData, image, 1, texels);
}

std::vector<ChunkImage> PackModel::chunks(bool compressed) const
{
    std::vector<ChunkImage> list;
    const auto bytes =
        [&](uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> content)
    {
        list.push_back(compressed ? zstdChunk(type, index, element_size, content)
                                  : plainChunk(type, index, element_size, content));
    };
    const auto table = [&]<typename T>(uint32_t type, const std::vector<T>& records)
    { bytes(type, 0, sizeof(T), std::as_bytes(std::span(records))); };
    bytes(kChunkMeta, 0, 1, std::as_bytes(std::span(meta)));
    bytes(kChunkStrings, 0, 1, std::as_bytes(std::span(strings)));
    table(kChunkNodes, nodes);
    table(kChunkInstances, instances);
    table(kChunkCameras, cameras);
    table(kChunkLights, lights);
    table(kChunkShadowSpheres, shadow_spheres);
    table(kChunkMaterials, materials);
    table(kChunkMaterialLayers, material_layers);
    table(kChunkImages, images);
    if (!texture_pieces.empty())
        table(kChunkTexturePieces, texture_pieces);
    table(kChunkSkins, skins);
    table(kChunkJoints, joints);
    table(kChunkAnimations, animations);
    table(kChunkChannels, channels);
    table(kChunkKeys, keys);
    table(kChunkKeyBits, key_bits);
    table(kChunkMorphWeights, morph_weights);
    table(kChunkAssets, assets);
    table(kChunkExtras, extras);
    table(kChunkMeshes, meshes);
    table(kChunkLevels, levels);
    table(kChunkGroups, groups);
    table(kChunkClusters, clusters);
    table(kChunkPageTable, pages);
    table(kChunkPageParents, page_parents);
    table(kChunkAuthoredLevels, authored_levels);
    table(kChunkDeformedMeshes, deformed_meshes);
    table(kChunkDeformedClusters, deformed_clusters);
    table(kChunkClusterJoints, cluster_joints);
    table(kChunkProxies, proxies);
    table(kChunkProxySections, proxy_sections);
    table(kChunkProxyPositions, proxy_positions);
    table(kChunkProxyIndices, proxy_indices);
    table(kChunkProxyBindings, proxy_bindings);
    table(kChunkSpecular, specular_tables);
    table(kChunkProbes, probes);
    table(kChunkProbeTexels, probe_texels);
    table(kChunkReceivers, receiver_atlases);
    table(kChunkReceiverLamps, receiver_lamps);
    table(kChunkReceiverRects, receiver_rects);
    table(kChunkReceiverBlocks, receiver_blocks);
    table(kChunkReceiverWords, receiver_words);
    table(kChunkFaceReceivers, face_atlases);
    table(kChunkFaceBlocks, face_blocks);
    table(kChunkFaceWords, face_words);
    table(kChunkSurroundings, surroundings);
    table(kChunkRadianceTransfers, radiance_transfers);
    table(kChunkBrickGrid, brick_grids);
    table(kChunkBrickGroups, bricks.groups);
    table(kChunkBricks, bricks.bricks);
    table(kChunkBrickOpacity, bricks.opacity);
    table(kChunkBrickAlbedo, bricks.albedo);
    table(kChunkBrickNormals, bricks.normals);
    table(kChunkBrickEmission, bricks.emission);
    table(kChunkBrickLighting, bricks.lighting);
    table(kChunkReflectors, bricks.reflectors);
    list.push_back(plainChunk(kChunkPages, 0, 1, page_bytes));
    for (uint32_t i = 0; i < image_data.size(); ++i)
        list.push_back(imageChunk(i, compressed));
    return list;
}

PackModel smallPack()
{
    PackModel pack;
    pack.meta = R"({"schema":"hearth.meta/1"})";
    addScene(pack);
    addMaterials(pack);
    addAnimation(pack);
    addStrip(pack);
    beginMesh(pack, "empty", 0);
    endMesh(pack, 0);
    addTriangle(pack);
    pack.authored_levels.push_back({0, 1, 2, intern(pack, "strip_LOD2.obj")});
    addBounds(pack);
    addSpecularTable(pack);
    addProbe(pack);
    addReceivers(pack);
    addProxies(pack);
    addSurroundings(pack);
    addBricks(pack);
    addFaceReceivers(pack);
    addAsset(pack);
    addExtras(pack);
    pack.sealPages();
    return pack;
}

} // namespace hearth::test
