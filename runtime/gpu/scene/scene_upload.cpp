// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/material_tiles.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_boxes.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/pack/cut.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace hearth::gpu
{

namespace
{

/// Creates the buffers of a scene and remembers the first error, so the calls below need no error checks.
class BufferFactory
{
public:
    BufferFactory(const Device& device, const formats::PackView& pack, Scene& scene)
        : device_(device), pack_(pack), scene_(scene)
    {
    }

    void make(Buffer& target, const char* what, uint64_t count, uint64_t element_size,
              VkBufferUsageFlags usage)
    {
        if (!status_.ok())
            return;
        const bool uniform = (usage & VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT) != 0;
        const uint64_t limit = uniform ? ~uint64_t{0} : device_.limits.maxStorageBufferRange;
        if (count * element_size > limit)
        {
            status_ = Error{Issue::device_limit, pack_.name(), "",
                            std::string("the ") + what + " take " + std::to_string(count * element_size) +
                                " bytes, the device binds " + std::to_string(limit)};
            return;
        }
        auto buffer = scene_.arena.createBuffer(count * element_size, usage, MemoryKind::device);
        if (buffer.ok())
            target = std::move(*buffer);
        else
            status_ = buffer.error();
    }

    Status take() { return std::move(status_); }

private:
    const Device& device_;
    const formats::PackView& pack_;
    Scene& scene_;
    Status status_ = success();
};

/// Words of the deformation buffer, with the scratch.
uint64_t deformationWords(const DeformationLayout& layout)
{
    shared::DeformationHeader header;
    std::memcpy(&header, layout.words.data(), sizeof(header));
    return layout.words.size() + uint64_t{header.block_count} * header.block_words;
}

Status createBuffers(const Device& device, const formats::PackView& pack, const SceneLayout& layout,
                     Scene& scene)
{
    constexpr VkBufferUsageFlags kUniform =
        VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    constexpr VkBufferUsageFlags kTable =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    // tests and tools copy the work buffers out
    constexpr VkBufferUsageFlags kWork =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    constexpr VkBufferUsageFlags kIndirect =
        kWork | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

    SceneBuffers& b = scene.buffers;
    BufferFactory f(device, pack, scene);
    f.make(b.frame, "frame constants", 1, sizeof(shared::FrameView), kUniform);
    f.make(b.lighting, "lights",
           sizeof(shared::Lighting) + SceneSurroundings::countRows(pack) * sizeof(SceneSurroundings::Row), 1,
           kTable);
    f.make(b.instances, "instances", pack.instances().size(), sizeof(shared::Instance), kTable);
    f.make(b.inverses, "instances", pack.instances().size(), sizeof(shared::InstanceInverse), kTable);
    f.make(b.bounds, "mesh bounds", layout.bounds.size(), sizeof(shared::MeshBounds), kTable);
    f.make(b.items, "work items", layout.items.size(), sizeof(shared::WorkItem), kTable);
    f.make(b.order, "cluster numbers", layout.order.size(), sizeof(uint32_t), kTable);
    f.make(b.clusters, "clusters", pack.clusters().size(), sizeof(shared::Cluster), kTable);
    f.make(b.groups, "groups", pack.groups().size(), sizeof(shared::Group), kTable);
    f.make(b.cluster_draws, "clusters", pack.clusters().size(), sizeof(shared::ClusterDraw), kTable);
    f.make(b.bins, "bins", layout.bins.size(), sizeof(shared::Bin), kTable);
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        f.make(b.pool[slice], "geometry", layout.pool.slice_words[slice], sizeof(uint32_t), kTable);
    f.make(b.states, "instance states", pack.instances().size(), sizeof(shared::InstanceState), kWork);
    f.make(b.results, "work results", layout.items.size(), sizeof(shared::WorkResult), kWork);
    f.make(b.totals, "scan totals", uint64_t{blockCount(scene)} + 1, sizeof(uint32_t), kWork);
    f.make(b.counters, "counters", 1, sizeof(shared::FrameCounters), kWork);
    f.make(b.visible, "visible clusters", scene.slot_capacity, sizeof(shared::VisibleCluster), kWork);
    f.make(b.bin_draws, "bin draws", 2 * layout.bins.size(), sizeof(shared::BinDraw), kIndirect);
    f.make(b.material_draws, "material draws", uint64_t{layout.material_rows} + 1,
           sizeof(VkDrawIndirectCommand), kIndirect);
    f.make(b.tile_draws, "material draws", uint64_t{layout.material_rows} + 1, sizeof(shared::TileDraw),
           kIndirect);
    if (scene.deformation != nullptr)
        f.make(scene.deformation->buffer, "poses of deformed meshes", deformationWords(layout.deformation),
               sizeof(uint32_t), kIndirect);
    if (scene.stream != nullptr)
    {
        f.make(b.group_items, "group items", scene.group_item_count, sizeof(shared::GroupItem), kTable);
        f.make(b.page_requests, "page requests", pack.pages().size(), sizeof(uint32_t),
               kWork | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    }
    return f.take();
}

/// Groups of the pack; groups of pages without a place are absent.
std::vector<shared::Group> makeGroups(const formats::PackView& pack, const PoolLayout& pool)
{
    std::vector<uint8_t> resident_pages;
    for (const uint32_t address : pool.page_addresses)
        resident_pages.push_back(address == kNoAddress ? 0 : 1);
    const std::vector<uint8_t> resident = pack::residentGroups(pack, resident_pages);
    std::vector<shared::Group> groups(pack.groups().size());
    if (!groups.empty())
        std::memcpy(static_cast<void*>(groups.data()), pack.groups().data(), pack.groups().size_bytes());
    for (size_t group = 0; group < groups.size(); ++group)
        groups[group].absent = resident[group] == 0 ? 1 : 0;
    return groups;
}

Status uploadTables(const formats::PackView& pack, const SceneLayout& layout, Uploader& uploader,
                    Scene& scene)
{
    const SceneBuffers& b = scene.buffers;
    HEARTH_TRY(uploader.uploadRecords(b.instances, layout.instances));
    HEARTH_TRY(uploader.uploadRecords(b.inverses, layout.inverses));
    HEARTH_TRY(uploader.uploadRecords(b.bounds, layout.bounds));
    HEARTH_TRY(uploader.uploadRecords(b.items, layout.items));
    HEARTH_TRY(uploader.uploadRecords(b.order, layout.order));
    HEARTH_TRY(uploader.uploadRecords(b.clusters, pack.clusters()));
    HEARTH_TRY(uploader.uploadRecords(b.groups, makeGroups(pack, layout.pool)));
    HEARTH_TRY(uploader.uploadRecords(b.cluster_draws, layout.draws));
    std::vector<shared::Bin> bins;
    for (const SceneBin& bin : layout.bins)
        bins.push_back(bin.items);
    HEARTH_TRY(uploader.uploadRecords(b.bins, bins));
    if (scene.deformation != nullptr)
        HEARTH_TRY(uploader.uploadRecords(scene.deformation->buffer, layout.deformation.words));

    shared::Lighting lighting = makeLighting(pack);
    lighting.surroundings_row = SceneSurroundings::firstInstanceRow(pack);
    scene.lights.assign(lighting.lights, lighting.lights + lighting.light_count);
    scene.exposure = lighting.exposure;
    scene.dropped_lights = static_cast<uint32_t>(pack.lights().size() -
                                                 std::min<size_t>(pack.lights().size(), shared::kMaxLights));
    std::vector<SceneSurroundings::Row> rows;
    if (!pack.surroundings().empty())
    {
        scene.surroundings = std::make_unique<SceneSurroundings>(pack, lighting);
        rows = scene.surroundings->makeRows();
    }
    HEARTH_ASSIGN_OR_RETURN(const std::span<std::byte> staged,
                            uploader.stage(b.lighting, sizeof(lighting) + rows.size() * sizeof(rows[0])));
    std::memcpy(staged.data(), &lighting, sizeof(lighting));
    if (!rows.empty())
        std::memcpy(staged.data() + sizeof(lighting), rows.data(), rows.size() * sizeof(rows[0]));
    return success();
}

/// Decode every page that has a place straight into staging memory.
Status uploadGeometry(const formats::PackView& pack, const SceneLayout& layout, Uploader& uploader,
                      Scene& scene)
{
    std::array<std::span<std::byte>, shared::kPoolSlices> slices;
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        if (layout.pool.slice_words[slice] > 0)
        {
            HEARTH_ASSIGN_OR_RETURN(
                slices[slice],
                uploader.stage(scene.buffers.pool[slice], VkDeviceSize{layout.pool.slice_words[slice]} * 4));
        }
    for (uint32_t page = 0; page < pack.pages().size(); ++page)
    {
        const uint32_t address = layout.pool.page_addresses[page];
        if (address == kNoAddress)
            continue;
        const size_t offset = size_t{address & ((1u << shared::kPoolSliceAddressBits) - 1)} * 4;
        HEARTH_TRY(pack.decodePage(
            page, slices[address >> shared::kPoolSliceAddressBits].subspan(offset, pack.pages()[page].size)));
    }
    return success();
}

Status createSets(const Device& device, const DrawLayouts& layouts, Scene& scene, uint32_t material_rows)
{
    // three sets for drawing (one with the shadow maps), six of the culling pass, one each for material tiles
    // and page requests; three more with deformed meshes, two with bricks
    const DescriptorPoolSizes sizes{.uniforms = 20 + 2 * material_rows,
                                    .storages = 104,
                                    .textures = material_rows * shared::kTextureCount + 4};
    HEARTH_ASSIGN_OR_RETURN(scene.pool, createDescriptorPool(device, 16 + material_rows, sizes));
    HEARTH_ASSIGN_OR_RETURN(scene.draw_set, allocateSet(device, scene.pool.get(), layouts.scene.get()));
    const SceneBuffers& b = scene.buffers;
    DescriptorWriter writer(scene.draw_set);
    writer.uniform(shared::kSceneFrame, b.frame)
        .storage(shared::kSceneInstances, b.instances)
        .storage(shared::kSceneVisible, b.visible)
        .storage(shared::kSceneDraws, b.cluster_draws)
        .storage(shared::kSceneLighting, b.lighting);
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        writer.storage(shared::kScenePool + slice,
                       scene.deformation != nullptr && slice == shared::kDeformationSlice
                           ? scene.deformation->buffer
                           : b.pool[slice]);
    writer.write(device);
    HEARTH_ASSIGN_OR_RETURN(scene.bins_set, allocateSet(device, scene.pool.get(), layouts.bins.get()));
    DescriptorWriter(scene.bins_set).storage(shared::kBinsDraws, b.bin_draws).write(device);
    HEARTH_ASSIGN_OR_RETURN(scene.cluster_view_set,
                            allocateSet(device, scene.pool.get(), layouts.cluster_view.get()));
    writeTables(device, scene, scene.cluster_view_set, kClusterViewTables);
    return success();
}

/// Create the deformation buffer. Its scratch is the smallest of the option, the demand and the device's
/// binding limit.
std::unique_ptr<SceneDeformation> makeDeformation(const Device& device, const DeformationOptions& options,
                                                  SceneLayout& layout, uint32_t rigid_group_items)
{
    auto deformation = std::make_unique<SceneDeformation>();
    const uint64_t table_bytes = layout.deformation.words.size() * 4;
    const uint64_t max_bytes = device.limits.maxStorageBufferRange;
    placeScratch(layout.deformation,
                 std::min(options.scratch_bytes, max_bytes - std::min(max_bytes, table_bytes)));
    const auto first = std::find_if(layout.bins.begin(), layout.bins.end(),
                                    [](const SceneBin& bin) { return bin.deformed; });
    deformation->first_bin = static_cast<uint32_t>(first - layout.bins.begin());
    deformation->rigid_items = layout.rigid_items;
    deformation->rigid_group_items = rigid_group_items;
    return deformation;
}

/// Mark the materials that are used by meshes with sky visibility.
void findSkyVisibility(const formats::PackView& pack, Scene& scene)
{
    for (const formats::MeshRecord& mesh : pack.meshes())
        if ((mesh.attributes & formats::kVertexVisibility) != 0)
            for (const formats::ClusterRecord& cluster : recordsInRange(pack.clusters(), mesh.clusters))
                scene.materials[materialRow(pack, cluster.material)].variant.sky_visibility = 1;
}

/// Keep the parts of the layout that frames need, and mark the materials that deformed meshes use.
void storeDeformation(const formats::PackView& pack, DeformationLayout layout, Scene& scene)
{
    for (const formats::DeformedMeshRecord& mesh : pack.deformedMeshes())
        for (const formats::ClusterRecord& cluster :
             recordsInRange(pack.clusters(), pack.meshes()[mesh.mesh].clusters))
            scene.materials[materialRow(pack, cluster.material)].variant.deformed = 1;
    SceneDeformation& deformation = *scene.deformation;
    deformation.rows.words.reserve(size_t{layout.max_rows} * 4);
    deformation.layout = std::move(layout);
    deformation.layout.words = {};
}

/// Bind placeholders. In scenes without shadows or table no shader reads their bindings, but lavapipe (Mesa
/// 22.3) reads the descriptors, so they must be valid.
void fillSpareBindings(const Device& device, const Scene& scene)
{
    DescriptorWriter(scene.draw_set)
        .uniform(shared::kSceneShadows, scene.buffers.frame)
        .texture(shared::kSceneShadowMaps, scene.images.back().view.get(), scene.samplers.front().get())
        .texture(shared::kSceneSpecularTable, scene.images.back().view.get(), scene.samplers.front().get())
        .write(device);
}

} // namespace

Scene::Scene(const Device& device) : arena(device) {}
Scene::~Scene() = default;

Result<std::unique_ptr<Scene>> uploadScene(const Device& device, const DrawLayouts& layouts,
                                           const formats::PackView& pack, VkCommandBuffer commands,
                                           const SceneOptions& options)
{
    auto scene = std::make_unique<Scene>(device);
    PoolLayout pool;
    if (options.geometry_budget > 0)
    {
        const pack::PageGraph graph = pack::PageGraph::of(pack);
        HEARTH_ASSIGN_OR_RETURN(pool, placePinnedPages(pack, graph, options.geometry_budget));
        HEARTH_ASSIGN_OR_RETURN(scene->stream,
                                SceneStream::create(device, pack, graph, pool, options.stream));
    }
    else
    {
        HEARTH_ASSIGN_OR_RETURN(pool, placeAllPages(pack));
    }
    HEARTH_ASSIGN_OR_RETURN(SceneLayout layout, makeSceneLayout(pack, std::move(pool)));
    const GroupItems group_items = options.geometry_budget > 0 ? makeGroupItems(pack) : GroupItems{};
    scene->staging = std::make_unique<Uploader>(device, commands);
    scene->instances.assign(pack.instances().begin(), pack.instances().end());
    scene->instance_count = static_cast<uint32_t>(pack.instances().size());
    scene->item_count = static_cast<uint32_t>(layout.items.size());
    scene->group_item_count = static_cast<uint32_t>(group_items.items.size());
    scene->slot_capacity = static_cast<uint32_t>(std::min<uint64_t>(
        layout.instanced_clusters, std::min(options.max_visible_clusters, shared::kMaxSlots)));
    scene->used_slices = layout.pool.slice_words[1] == 0 ? 1 : shared::kPoolSlices;
    scene->bounds = sceneBounds(pack);

    if (!layout.deformation.words.empty())
        scene->deformation = makeDeformation(device, options.deformation, layout, group_items.rigid_items);
    HEARTH_TRY(createBuffers(device, pack, layout, *scene));
    HEARTH_TRY(createSets(device, layouts, *scene, layout.material_rows));
    HEARTH_TRY(uploadTables(pack, layout, *scene->staging, *scene));
    HEARTH_TRY(scene->staging->uploadRecords(scene->buffers.group_items, group_items.items));
    HEARTH_TRY(uploadGeometry(pack, layout, *scene->staging, *scene));
    HEARTH_TRY(uploadMaterials(device, layouts, pack, *scene->staging, *scene));
    findSkyVisibility(pack, *scene);
    fillSpareBindings(device, *scene);
    HEARTH_TRY(uploadShadingTables(device, pack, *scene->staging, *scene));
    HEARTH_TRY(uploadBricks(device, layouts, pack, options.bricks, *scene->staging, *scene));
    scene->staging->finish();
    scene->bins = std::move(layout.bins);
    if (scene->deformation != nullptr)
        storeDeformation(pack, std::move(layout.deformation), *scene);
    return scene;
}

} // namespace hearth::gpu
