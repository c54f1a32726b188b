// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/test_scene.h"

#include "formats/base/scale_bound.h"
#include "formats/pack/pack_check.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace hearth::test
{

using namespace formats;

namespace
{

uint32_t countRecords(const auto& records)
{
    return static_cast<uint32_t>(records.size());
}

/// Offsets to add to a hierarchy's indices to append it to the pack.
struct Bases
{
    uint32_t mesh, level, group, cluster, page, parent;
    uint64_t page_byte;
};

Range moved(Range range, uint32_t base)
{
    return {range.first + base, range.count};
}

template <typename T, typename Rebase>
void append(std::vector<T>& to, const std::vector<T>& from, const Rebase& rebase)
{
    for (T record : from)
    {
        rebase(record);
        to.push_back(record);
    }
}

void appendHierarchy(PackModel& pack, const clusters::Hierarchy& h)
{
    while (pack.page_bytes.size() % kChunkAlignment != 0)
        pack.page_bytes.push_back(std::byte{0});
    const Bases b{countRecords(pack.meshes),   countRecords(pack.levels), countRecords(pack.groups),
                  countRecords(pack.clusters), countRecords(pack.pages),  countRecords(pack.page_parents),
                  pack.page_bytes.size()};
    append(pack.levels, h.levels, [&](LevelRecord& r) { r.clusters = moved(r.clusters, b.cluster); });
    append(pack.groups, h.groups,
           [&](GroupRecord& r)
           {
               r.clusters = moved(r.clusters, b.cluster);
               r.page += b.page;
           });
    append(pack.clusters, h.clusters,
           [&](ClusterRecord& r)
           {
               r.page += b.page;
               r.group += b.group;
               r.refined_group += r.refined_group == kInvalidIndex ? 0 : b.group;
           });
    append(pack.pages, h.pages,
           [&](PageRecord& r)
           {
               r.offset += b.page_byte;
               r.mesh += b.mesh;
               r.clusters = moved(r.clusters, b.cluster);
               r.parents = moved(r.parents, b.parent);
           });
    append(pack.page_parents, h.page_parents, [&](uint32_t& page) { page += b.page; });
    pack.page_bytes.insert(pack.page_bytes.end(), h.page_bytes.begin(), h.page_bytes.end());

    MeshRecord mesh = h.mesh;
    mesh.levels = moved(mesh.levels, b.level);
    mesh.groups = moved(mesh.groups, b.group);
    mesh.clusters = moved(mesh.clusters, b.cluster);
    mesh.pages = moved(mesh.pages, b.page);
    pack.meshes.push_back(mesh);
}

} // namespace

MaterialRecord plainMaterial()
{
    MaterialRecord material{};
    material.base_color = {1, 1, 1, 1};
    material.alpha_cutoff = 0.5f;
    material.roughness = 1;
    material.normal_scale = 1;
    material.occlusion_strength = 1;
    for (TextureRef* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture})
        *texture = makeTextureRef(kInvalidIndex);
    return material;
}

TextureRef makeTextureRef(uint32_t image)
{
    return {image, 0, 0, 0, 0, {1, 0, 0, 0, 1, 0}};
}

uint32_t TestScene::addMaterial(const MaterialRecord& material)
{
    model_.materials.push_back(material);
    return countRecords(model_.materials) - 1;
}

uint32_t TestScene::addImage(TexelFormat format, uint32_t width, uint32_t height,
                             const std::vector<uint32_t>& texels)
{
    ImageRecord image{};
    image.width = width;
    image.height = height;
    image.mip_count = 1;
    image.format = static_cast<uint32_t>(format);
    while (mipOffset(image, image.mip_count) < texels.size() * 4)
        ++image.mip_count;
    model_.images.push_back(image);
    const auto bytes = std::as_bytes(std::span(texels));
    model_.image_data.emplace_back(bytes.begin(), bytes.end());
    return countRecords(model_.images) - 1;
}

uint32_t TestScene::addImage(const ImageRecord& image, const std::vector<std::byte>& mips)
{
    model_.images.push_back(image);
    model_.image_data.push_back(mips);
    return countRecords(model_.images) - 1;
}

uint32_t TestScene::addMesh(const mesh::SourceMesh& mesh, const clusters::Config& config)
{
    return addHierarchy(clusters::buildHierarchy(mesh, config));
}

uint32_t TestScene::addHierarchy(const clusters::Hierarchy& hierarchy)
{
    appendHierarchy(model_, hierarchy);
    return countRecords(model_.meshes) - 1;
}

uint32_t TestScene::addNode(uint32_t mesh, const Affine3& parent_from_node)
{
    NodeRecord node{};
    node.parent = kInvalidIndex;
    node.mesh = mesh;
    node.skin = kInvalidIndex;
    node.rotation = {0, 0, 0, 1};
    node.scale = {1, 1, 1};
    node.parent_from_node = parent_from_node;
    model_.nodes.push_back(node);
    return countRecords(model_.nodes) - 1;
}

void TestScene::addInstance(uint32_t mesh, const Affine3& world_from_object)
{
    model_.instances.push_back({world_from_object, mesh, addNode(mesh, world_from_object),
                                determinant(world_from_object) < 0 ? uint32_t{kInstanceMirrored} : 0u,
                                scaleBound(world_from_object)});
}

void TestScene::addLight(const LightRecord& light)
{
    model_.lights.push_back(light);
    model_.lights.back().node = addNode(kInvalidIndex, light.world_from_light);
}

void TestScene::setVisibility(const Visibility& visibility)
{
    const PackView view = assemble();
    model_.decoded_pages.resize(view.pages().size());
    for (uint32_t p = 0; p < view.pages().size(); ++p)
    {
        const PageRecord& page = view.pages()[p];
        std::vector<std::byte>& bytes = model_.decoded_pages[p];
        bytes.resize(page.size);
        HEARTH_ASSERT(view.decodePage(p, bytes).ok());
        for (const ClusterRecord& cluster : recordsInRange(view.clusters(), page.clusters))
        {
            const auto geometry = ClusterGeometry::at(bytes, cluster, view.meshes()[page.mesh]);
            HEARTH_ASSERT(geometry);
            if (!geometry->has(kVertexVisibility))
                continue;
            const uint32_t layout = geometry->layout();
            const auto first = static_cast<size_t>(geometry->bytes().data() - bytes.data()) +
                               4 * (uvBaseWords(layout) + attributeWord(layout, kVertexVisibility));
            for (uint32_t v = 0; v < geometry->vertexCount(); ++v)
            {
                const shared::VisibilityMoments moments =
                    visibility(page.mesh, geometry->position(v), geometry->normal(v));
                const uint32_t code = encodeVisibility(moments.m0, moments.m1, geometry->normal(v));
                std::memcpy(bytes.data() + first + size_t{4} * v * vertexWords(layout), &code, sizeof(code));
            }
        }
    }
    model_.sealPages();
}

PackView TestScene::build()
{
    PackView view = assemble();
    const Status status = checkPack(view);
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : formatMessage(status.error()));
    return view;
}

PackView TestScene::assemble()
{
    model_.meta = R"({"schema":"hearth.meta/1"})";
    model_.sealImages();
    bytes_ = model_.bytes();
    auto reader = ContainerReader::fromBytes(bytes_.span(), "test");
    HEARTH_ASSERT(reader.ok());
    auto view = PackView::read(std::move(*reader));
    HEARTH_ASSERT(view.ok());
    return std::move(*view);
}

mesh::SourceMesh makeQuad(float width, float height)
{
    mesh::SourceMesh mesh;
    const float x = width / 2, y = height / 2;
    mesh.positions = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.triangle_materials.assign(2, kInvalidIndex);
    mesh.face_count = 2;
    mesh.source_vertex_count = 4;
    return mesh;
}

mesh::SourceMesh withMaterial(mesh::SourceMesh mesh, uint32_t material)
{
    mesh.triangle_materials.assign(mesh.triangleCount(), material);
    return mesh;
}

Affine3 translated(Float3 offset)
{
    Affine3 t;
    t.m[0][3] = offset.x;
    t.m[1][3] = offset.y;
    t.m[2][3] = offset.z;
    return t;
}

std::vector<shared::LodKnot> randomLodCurve(std::mt19937& random)
{
    std::vector<shared::LodKnot> curve{{uniform(random, 0, 2), uniform(random, 0.5f, 2)}};
    const size_t count = 1 + random() % shared::kMaxLodKnots;
    while (curve.size() < count)
    {
        const shared::LodKnot before = curve.back();
        const float distance = before.distance + uniform(random, 0.1f, 8);
        const float most = before.distance > 0 ? before.factor * (distance / before.distance) : 8.0f;
        const float factor = random() % 3 == 0 ? std::min(most, 8 * before.factor) * 0.999999f
                                               : before.factor * uniform(random, 0.13f, 1);
        curve.push_back({distance, factor});
    }
    return curve;
}

float uniform(std::mt19937& random, float low, float high)
{
    return low + (high - low) * (static_cast<float>(random() >> 8) * 0x1p-24f);
}

Affine3 randomAffine(std::mt19937& random, float reach)
{
    // rotations about the three axes, each followed by a scale along its axis and a shear
    Affine3 t = translated(
        {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)});
    for (int axis = 0; axis < 3; ++axis)
    {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const float angle = uniform(random, 0, 6.2831853f);
        Affine3 step;
        step.m[u][u] = std::cos(angle);
        step.m[u][v] = -std::sin(angle);
        step.m[v][u] = std::sin(angle);
        step.m[v][v] = std::cos(angle);
        Affine3 stretch;
        stretch.m[axis][axis] = uniform(random, 0.3f, 3.0f);
        stretch.m[u][v] = uniform(random, -0.5f, 0.5f);
        t = t * step * stretch;
    }
    Affine3 mirror;
    mirror.m[0][0] = (random() & 1) != 0 ? -1.0f : 1.0f;
    return t * mirror;
}

shared::Camera randomCamera(std::mt19937& random, float reach)
{
    const auto point = [&](float r) {
        return Float3{uniform(random, -r, r), uniform(random, -r, r), uniform(random, -r, r)};
    };
    shared::Camera camera;
    camera.position = point(reach * 1.5f);
    camera.target = point(reach * 0.5f);
    camera.y_fov_rad = uniform(random, 0.2f, 1.8f);
    camera.z_near = uniform(random, 0.001f, 1.0f);
    return camera;
}

shared::Camera randomOrthographicCamera(std::mt19937& random, float reach)
{
    shared::Camera camera = randomCamera(random, reach);
    camera.half_height = uniform(random, 0.1f, 0.5f) * reach;
    camera.z_far = camera.z_near + uniform(random, 1.0f, 4.0f) * reach;
    return camera;
}

} // namespace hearth::test
