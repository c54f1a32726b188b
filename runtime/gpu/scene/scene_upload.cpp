// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/material_tiles.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/gpu/scene/texture_upload.h"
#include "runtime/gpu/textures/streamed_textures.h"
#include "runtime/pack/cut.h"
#include "runtime/pack/memory_shares.h"
#include "runtime/pack/scene_boxes.h"

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
              VkBufferUsageFlags usage, MemoryKind kind = MemoryKind::device)
    {
        if (!fits(what, count * element_size, usage))
            return;
        auto buffer = scene_.arena.createBuffer(count * element_size, usage, kind);
        if (buffer.ok())
            target = std::move(*buffer);
        else
            status_ = buffer.error();
        if (buffer.ok() && kind == MemoryKind::upload)
            std::memset(target.mapped, 0, static_cast<size_t>(target.size));
    }

    /// Make a table with a copy for each frame in flight.
    void makeMirrored(MirroredTable& target, const char* what, uint64_t bytes, uint64_t spare,
                      VkBufferUsageFlags usage, bool keeps_earlier = false)
    {
        if (!fits(what, (keeps_earlier ? 2 : 1) * bytes + spare, usage))
            return;
        auto table = MirroredTable::create(scene_.arena, static_cast<uint32_t>(scene_.frames.size()), bytes,
                                           spare, usage, keeps_earlier);
        if (table.ok())
            target = std::move(*table);
        else
            status_ = table.error();
    }

    Status take() { return std::move(status_); }

private:
    bool fits(const char* what, uint64_t bytes, VkBufferUsageFlags usage)
    {
        if (!status_.ok())
            return false;
        const bool uniform = (usage & VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT) != 0;
        const uint64_t limit = uniform ? ~uint64_t{0} : device_.limits.maxStorageBufferRange;
        if (bytes > limit)
            status_ = Error{Issue::device_limit, pack_.name(), "",
                            std::string("the ") + what + " take " + std::to_string(bytes) +
                                " bytes, the device binds " + std::to_string(limit)};
        return status_.ok();
    }

    const Device& device_;
    const formats::PackView& pack_;
    Scene& scene_;
    Status status_ = success();
};

/// Words of the scratch behind the deformation table.
uint64_t scratchWords(const DeformationLayout& layout)
{
    shared::DeformationHeader header;
    std::memcpy(&header, layout.words.data(), sizeof(header));
    return uint64_t{header.block_count} * header.block_words;
}

// tests and tools copy the work buffers out
constexpr VkBufferUsageFlags kWorkUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
constexpr VkBufferUsageFlags kIndirectUsage = kWorkUsage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;

void createView(const Scene& scene, const SceneLayout& layout, BufferFactory& f, SceneView& view)
{
    f.make(view.frame, "frame constants", 1, sizeof(shared::FrameView),
           VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::upload);
    f.make(view.counters, "counters", 1, sizeof(shared::FrameCounters), kWorkUsage);
    f.make(view.visible, "visible clusters", scene.slot_capacity, sizeof(shared::VisibleCluster), kWorkUsage);
    f.make(view.bin_draws, "bin draws", 2 * layout.bins.size(), sizeof(shared::BinDraw), kIndirectUsage);
    f.make(view.material_draws, "material draws", uint64_t{layout.material_rows} + 1,
           sizeof(VkDrawIndirectCommand), kIndirectUsage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
           MemoryKind::upload);
}

/// Create what a shadow map has beside the view of a frame.
void createProxyList(const SceneLayout& layout, BufferFactory& f, SceneView& view)
{
    f.make(view.proxy_draw, "proxies", 1, sizeof(shared::ProxyDraw),
           kIndirectUsage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::upload);
    f.make(view.proxy_chunks, "proxies", layout.proxy_chunks, sizeof(shared::ProxyChunk), kWorkUsage);
}

/// Number of shadow maps that are culled side by side: as many as a few megabytes of visible lists hold.
uint32_t countCasterViews(const Scene& scene, const ShadowOptions& shadows)
{
    constexpr uint64_t kMaxBytes = uint64_t{16} << 20;
    constexpr uint64_t kMaxViews = 8;
    const uint64_t list_bytes = uint64_t{scene.slot_capacity} * sizeof(shared::VisibleCluster);
    const uint64_t views = kMaxBytes / std::max<uint64_t>(list_bytes * scene.frames.size(), 1);
    return static_cast<uint32_t>(
        std::min<uint64_t>(shadows.max_maps, std::clamp<uint64_t>(views, 1, kMaxViews)));
}

void createFrame(const formats::PackView& pack, const SceneLayout& layout, const SceneOptions& options,
                 const Scene& scene, BufferFactory& f, SceneFrame& frame)
{
    createView(scene, layout, f, frame.main);
    frame.casters.resize(countCasterViews(scene, options.shadows));
    for (SceneView& view : frame.casters)
    {
        createView(scene, layout, f, view);
        if (scene.proxies_cast)
            createProxyList(layout, f, view);
    }
    f.make(frame.tile_draws, "material draws", uint64_t{layout.material_rows} + 1, sizeof(shared::TileDraw),
           kIndirectUsage, MemoryKind::upload);
    uint64_t regions = 1 + WordCopies::countRegions(maxFreshLightWords(pack, options.bricks));
    if (scene.stream != nullptr)
    {
        f.make(frame.page_requests, "page requests", pack.pages().size() + pack.materials().size() + 1,
               sizeof(uint32_t), kWorkUsage, MemoryKind::readback);
        regions += scene.stream->maxCopyRegions();
    }
    f.make(frame.copy_regions, "changes", regions, sizeof(shared::CopyRegion),
           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload);
    f.make(frame.shadow_block, "shadows", 1, sizeof(shared::ShadowBlock), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
           MemoryKind::upload);
    f.make(frame.brick_view, "brick constants", 1, sizeof(shared::BrickView),
           VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload);
}

Status createBuffers(const Device& device, const formats::PackView& pack, const SceneLayout& layout,
                     const SceneOptions& options, Scene& scene)
{
    constexpr VkBufferUsageFlags kTable =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    SceneBuffers& b = scene.buffers;
    SceneTables& t = *scene.tables;
    BufferFactory f(device, pack, scene);
    const LightBufferLayout& lights = scene.lights->layout();
    f.makeMirrored(t.lighting, "lights", lights.lists, lights.end - lights.lists, kWorkUsage);
    f.makeMirrored(t.instances, "instances", pack.instances().size() * sizeof(shared::Instance), 0,
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, options.keeps_motion);
    f.makeMirrored(t.inverses, "instances", pack.instances().size() * sizeof(shared::InstanceInverse), 0,
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    f.makeMirrored(t.bounds, "mesh bounds", layout.bounds.size() * sizeof(shared::MeshBounds), 0,
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    f.make(b.items, "work items", layout.items.size(), sizeof(shared::WorkItem), kTable);
    f.make(b.order, "cluster numbers", layout.order.size(), sizeof(uint32_t), kTable);
    f.make(b.clusters, "clusters", pack.clusters().size(), sizeof(shared::Cluster), kTable);
    f.make(b.groups, "groups", pack.groups().size(), sizeof(shared::Group), kTable);
    f.make(b.cluster_draws, "clusters", pack.clusters().size(), sizeof(shared::ClusterDraw), kTable,
           MemoryKind::upload);
    f.make(b.bins, "bins", layout.bins.size(), sizeof(shared::Bin), kTable);
    if (scene.proxies_cast)
    {
        f.make(b.proxies, "proxies", layout.proxies.size(), sizeof(shared::ProxyCaster), kTable);
        f.make(b.proxy_positions, "proxies", pack.proxyPositions().size(), sizeof(Float3), kTable);
        f.make(b.proxy_indices, "proxies", pack.proxyIndices().size(), sizeof(uint32_t), kTable);
    }
    f.make(b.states, "instance states", pack.instances().size(), sizeof(shared::InstanceState), kWorkUsage);
    f.make(b.results, "work results", layout.items.size(), sizeof(shared::WorkResult), kWorkUsage);
    f.make(b.totals, "scan totals", uint64_t{blockCount(scene)} + 1, sizeof(uint32_t), kWorkUsage);
    if (scene.deformation != nullptr)
        f.makeMirrored(scene.deformation->table, "poses of deformed meshes",
                       layout.deformation.words.size() * sizeof(uint32_t),
                       scratchWords(layout.deformation) * sizeof(uint32_t), kIndirectUsage,
                       options.keeps_motion);
    if (scene.stream != nullptr)
        f.make(b.group_items, "group items", scene.group_item_count, sizeof(shared::GroupItem), kTable);
    for (SceneFrame& frame : scene.frames)
        createFrame(pack, layout, options, scene, f, frame);
    HEARTH_TRY(f.take());
    for (const SceneFrame& frame : scene.frames)
        prepareCopyRegions(frame.copy_regions);
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        if (const uint64_t words = layout.pool.slice_words[slice]; slice == 0 || words > 0)
            HEARTH_TRY(b.pool.open(device, slice, words * sizeof(uint32_t)));
    if (scene.stream != nullptr)
        scene.stream->setFrames(scene.frames, b.pool);
    return success();
}

/// Groups of the pack; groups of pages without a place are absent.
std::vector<shared::Group> makeGroups(const formats::PackView& pack, const PoolLayout& pool,
                                      const VertexMotions& motions)
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
    for (size_t mesh = 0; mesh < motions.reaches.size(); ++mesh)
    {
        const formats::Range range = pack.meshes()[mesh].groups;
        for (uint32_t group = range.first; group < range.first + range.count; ++group)
            groups[group].sphere_radius += motions.reaches[mesh];
    }
    return groups;
}

Status uploadTables(const formats::PackView& pack, const SceneLayout& layout, Uploader& uploader,
                    Scene& scene)
{
    const SceneBuffers& b = scene.buffers;
    SceneTables& tables = *scene.tables;
    tables.instances.fill(std::as_bytes(std::span(layout.instances)));
    tables.inverses.fill(std::as_bytes(std::span(layout.inverses)));
    tables.bounds.fill(std::as_bytes(std::span(layout.bounds)));
    HEARTH_TRY(uploader.uploadRecords(b.items, layout.items));
    HEARTH_TRY(uploader.uploadRecords(b.order, layout.order));
    const std::span<const formats::ClusterRecord> moved = layout.motions.clusters;
    HEARTH_TRY(uploader.uploadRecords(b.clusters, moved.empty() ? pack.clusters() : moved));
    HEARTH_TRY(uploader.uploadRecords(b.groups, makeGroups(pack, layout.pool, layout.motions)));
    if (!layout.draws.empty())
        std::memcpy(b.cluster_draws.mapped, layout.draws.data(),
                    layout.draws.size() * sizeof(layout.draws[0]));
    std::vector<shared::Bin> bins;
    for (const SceneBin& bin : layout.bins)
        bins.push_back(bin.items);
    HEARTH_TRY(uploader.uploadRecords(b.bins, bins));
    if (scene.proxies_cast)
    {
        HEARTH_TRY(uploader.uploadRecords(b.proxies, layout.proxies));
        HEARTH_TRY(uploader.uploadRecords(b.proxy_positions, pack.proxyPositions()));
        HEARTH_TRY(uploader.uploadRecords(b.proxy_indices, pack.proxyIndices()));
    }
    if (scene.deformation != nullptr)
        scene.deformation->table.fill(std::as_bytes(std::span(layout.deformation.words)));

    std::vector<SceneSurroundings::Row> rows;
    if (!pack.surroundings().empty())
    {
        scene.surroundings = std::make_unique<SceneSurroundings>(pack, makeLighting(pack));
        rows = scene.surroundings->makeRows();
    }
    std::span<const std::byte> receivers;
    if (!pack.receivers().lamps.empty())
    {
        scene.receivers =
            std::make_unique<SceneReceivers>(pack, scene.lights->loaded(), scene.lights->localProbes());
        receivers = std::as_bytes(scene.receivers->rows());
        scene.lights->setAtlas(pack.receivers().atlas);
    }
    scene.lights->fill(tables.lighting, std::as_bytes(std::span(rows)),
                       SceneSurroundings::countTransferRows(pack), !rows.empty(), receivers);
    for (uint32_t slot = 0; slot < scene.lights->loaded().size() && scene.receivers != nullptr; ++slot)
        scene.lights->setBaked(tables.lighting, slot,
                               scene.receivers->takeLight(slot, scene.lights->loaded()[slot]));
    return success();
}

/// Decode every page that has a place straight into staging memory.
Status uploadGeometry(const formats::PackView& pack, const SceneLayout& layout, Uploader& uploader,
                      Scene& scene)
{
    std::array<std::span<std::byte>, shared::kPoolSlices> slices;
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        if (layout.pool.slice_words[slice] > 0 && slice < layout.pool.first_movable_slice)
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

/// Create the sets of a view that no pass has for itself.
Status createViewSets(const Device& device, const DrawLayouts& layouts, const Scene& scene, uint32_t number,
                      SceneView& view)
{
    HEARTH_ASSIGN_OR_RETURN(view.draw_set, allocateSet(device, scene.pool.get(), layouts.scene.get()));
    const SceneTables& t = *scene.tables;
    DescriptorWriter writer(view.draw_set);
    writer.uniform(shared::kSceneFrame, view.frame)
        .storage(shared::kSceneInstances, t.instances.copy(number))
        .storage(shared::kSceneVisible, view.visible)
        .storage(shared::kSceneDraws, scene.buffers.cluster_draws)
        .storage(shared::kSceneLighting, t.lighting.copy(number));
    writePool(scene, number, writer);
    writer.write(device);
    HEARTH_ASSIGN_OR_RETURN(view.bins_set, allocateSet(device, scene.pool.get(), layouts.bins.get()));
    DescriptorWriter(view.bins_set).storage(shared::kBinsDraws, view.bin_draws).write(device);
    return success();
}

Status createSets(const Device& device, const DrawLayouts& layouts, Scene& scene, uint32_t material_rows)
{
    // a view has sets for drawing, bins and proxies, and eight of the culling pass; a frame one each for
    // cluster views, lights, tiles, page requests of both kinds, skinning and bricks, and six for copies;
    // bricks one more
    const auto frames = static_cast<uint32_t>(scene.frames.size());
    const uint32_t material_sets = material_rows * (scene.textures == nullptr ? 1 : frames);
    const uint32_t views = frames * (1 + static_cast<uint32_t>(scene.frames.front().casters.size()));
    const DescriptorPoolSizes sizes{.uniforms = 7 * views + 9 * frames + 2 * material_sets,
                                    .storages = 66 * views + 71 * frames + 2,
                                    .textures = material_sets * shared::kTextureCount + 5 * views};
    HEARTH_ASSIGN_OR_RETURN(
        scene.pool, createDescriptorPool(device, 11 * views + 14 * frames + 1 + material_sets, sizes));
    for (uint32_t number = 0; number < frames; ++number)
    {
        SceneFrame& frame = scene.frames[number];
        HEARTH_TRY(createViewSets(device, layouts, scene, number, frame.main));
        for (SceneView& view : frame.casters)
            HEARTH_TRY(createViewSets(device, layouts, scene, number, view));
        HEARTH_ASSIGN_OR_RETURN(frame.cluster_view_set,
                                allocateSet(device, scene.pool.get(), layouts.cluster_view.get()));
        writeTables(device, mainView(scene, number), frame.cluster_view_set, kClusterViewTables);
        HEARTH_ASSIGN_OR_RETURN(frame.light_set, allocateSet(device, scene.pool.get(), layouts.lights.get()));
        DescriptorWriter(frame.light_set)
            .storage(shared::kLightsBuffer, scene.tables->lighting.copy(number))
            .write(device);
    }
    return success();
}

/// Create the deformation buffer. Its scratch is the smallest of the option, the demand and the device's
/// binding limit.
std::unique_ptr<SceneDeformation> makeDeformation(const Device& device, const SceneOptions& options,
                                                  SceneLayout& layout, uint32_t rigid_group_items)
{
    auto deformation = std::make_unique<SceneDeformation>();
    const uint64_t table_words = (options.keeps_motion ? 2 : 1) * layout.deformation.words.size();
    const uint64_t max_bytes = device.limits.maxStorageBufferRange;
    placeScratch(
        layout.deformation, static_cast<uint32_t>(table_words),
        std::min(options.deformation.scratch_bytes, max_bytes - std::min(max_bytes, table_words * 4)));
    const auto first = std::find_if(layout.bins.begin(), layout.bins.end(),
                                    [](const SceneBin& bin) { return bin.deformed; });
    deformation->first_bin = static_cast<uint32_t>(first - layout.bins.begin());
    deformation->rigid_items = layout.rigid_items;
    deformation->rigid_group_items = rigid_group_items;
    return deformation;
}

/// Return for each material how it reads the images that are streamed.
std::vector<std::vector<pack::TextureUse>> listTextureUses(const formats::PackView& pack,
                                                           const TextureSizes& sizes)
{
    std::vector<std::vector<pack::TextureUse>> uses;
    for (const LayeredMaterial& material : readMaterials(pack))
    {
        uses.emplace_back();
        for (const formats::TextureRef& texture : materialTextures(material))
            if (texture.image != kInvalidIndex && !sizes[texture.image].empty())
                uses.back().push_back(pack::makeTextureUse(pack, texture));
    }
    return uses;
}

/// Create the streams of a scene, which divide its budget: for good where it holds all pages and mips that
/// can be streamed, or all of one kind; else memory moves between both.
Result<PoolLayout> createStreams(const Device& device, const formats::PackView& pack,
                                 const SceneOptions& options, Scene& scene)
{
    const pack::PageGraph graph = pack::PageGraph::of(pack);
    const pack::PageGraph pages = graph.withSlotSize(findPoolSlotBytes(graph));
    HEARTH_ASSIGN_OR_RETURN(const TextureSizes sizes,
                            measureTextures(device, pack, findUsedImages(pack), options.decode_textures));
    const pack::TextureGraph texture_graph(sizes);
    const pack::PageGraph& textures = texture_graph.nodes();
    const uint64_t budget = options.memory_budget;
    std::optional<pack::ExchangeLayout> exchange = pack::planExchange(
        budget, pages, findPoolSlotBytes(graph), textures, movableParts(pack, graph, budget));
    const pack::MemoryShares shares = pack::divideMemory(budget, pages, textures);
    HEARTH_ASSIGN_OR_RETURN(PoolLayout pool, exchange ? placeExchange(pack, graph, *exchange)
                                                      : placePinnedPages(pack, graph, shares.geometry));
    HEARTH_ASSIGN_OR_RETURN(scene.stream,
                            SceneStream::create(device, pack, graph, pool, exchange, options.stream));
    if (shares.textures == 0)
        return pool;
    HEARTH_ASSIGN_OR_RETURN(
        scene.textures,
        StreamedTextures::create(
            device, pack,
            {.sizes = sizes,
             .uses = listTextureUses(pack, sizes),
             .frame_count = options.frames_in_flight,
             .budget_bytes = exchange ? pack::MemoryExchange(*exchange).textureBytes() : shares.textures,
             .max_budget_bytes = exchange ? exchange->maxTextureBytes() : shares.textures,
             .max_loads = options.stream.max_loads,
             .read = options.stream.read}));
    scene.stream->setTextures(*scene.textures);
    return pool;
}

/// Mark the materials that are used by meshes with sky visibility.
void findSkyVisibility(const formats::PackView& pack, Scene& scene)
{
    for (const formats::MeshRecord& mesh : pack.meshes())
        if ((mesh.attributes & formats::kVertexVisibility) != 0)
            for (const formats::ClusterRecord& cluster : recordsInRange(pack.clusters(), mesh.clusters))
                scene.materials[materialRow(pack, cluster.material)].variant.sky_visibility = 1;
}

/// Mark all materials of a scene with local probes.
void findLocalProbes(const formats::PackView& pack, Scene& scene)
{
    if (std::ranges::any_of(pack.probes(), formats::isLocalProbe))
        for (SceneMaterial& material : scene.materials)
            material.variant.local_probes = 1;
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

/// Bind placeholders. In scenes without shadows, table or receivers no shader reads their bindings, but
/// lavapipe (Mesa 22.3) reads the descriptors, so they must be valid.
void fillSpareBindings(const Device& device, Scene& scene)
{
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .uniform(shared::kSceneShadows, view.frame)
                        .texture(shared::kSceneShadowMaps, scene.images.back().view.get(),
                                 scene.samplers.front().get())
                        .texture(shared::kSceneSpecularTable, scene.images.back().view.get(),
                                 scene.samplers.front().get())
                        .texture(shared::kSceneReceivers, scene.images.back().view.get(),
                                 scene.samplers.front().get())
                        .write(device);
                });
}

} // namespace

Scene::Scene(const Device& device) : arena(device) {}
Scene::~Scene() = default;

Result<std::unique_ptr<Scene>> uploadScene(const Device& device, const DrawLayouts& layouts,
                                           const formats::PackView& pack, VkCommandBuffer commands,
                                           const SceneOptions& options)
{
    HEARTH_ASSERT(options.frames_in_flight >= 1 && options.frames_in_flight <= kMaxFramesInFlight);
    auto scene = std::make_unique<Scene>(device);
    scene->tables = std::make_unique<SceneTables>();
    scene->tables->keeps_motion = options.keeps_motion;
    scene->frames.resize(options.frames_in_flight);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<MaterialBinding> bindings,
                            bindMaterials(pack, options.material_shaders));
    PoolLayout pool;
    if (options.memory_budget > 0)
    {
        HEARTH_ASSIGN_OR_RETURN(pool, createStreams(device, pack, options, *scene));
    }
    else
    {
        HEARTH_ASSIGN_OR_RETURN(pool, placeAllPages(pack));
    }
    HEARTH_ASSIGN_OR_RETURN(SceneLayout layout, makeSceneLayout(pack, std::move(pool), bindings));
    if (options.shadows.max_maps > 0 && options.shadows.casters == Casters::proxies)
        addProxyCasters(pack, layout);
    scene->proxies_cast = layout.proxy_chunks > 0;
    const GroupItems group_items = options.memory_budget > 0 ? makeGroupItems(pack) : GroupItems{};
    scene->staging = std::make_unique<Uploader>(device, commands);
    scene->instances.assign(pack.instances().begin(), pack.instances().end());
    scene->instance_count = static_cast<uint32_t>(pack.instances().size());
    scene->item_count = static_cast<uint32_t>(layout.items.size());
    scene->group_item_count = static_cast<uint32_t>(group_items.items.size());
    scene->decodes_textures = options.decode_textures;
    scene->slot_capacity = static_cast<uint32_t>(std::min<uint64_t>(
        layout.instanced_clusters, std::min(options.max_visible_clusters, shared::kMaxSlots)));
    const bool has_one_slice =
        layout.pool.slice_words[1] == 0 && layout.pool.first_movable_slice == shared::kPoolSlices;
    scene->used_slices = has_one_slice ? 1 : shared::kPoolSlices;
    scene->bounds = pack::sceneBounds(pack);

    shared::SceneLighting lighting = makeLighting(pack);
    scene->dropped_lights = static_cast<uint32_t>(pack.lights().size() -
                                                  std::min<size_t>(pack.lights().size(), shared::kMaxLights));
    const auto slots = static_cast<uint32_t>(
        std::clamp<size_t>(options.max_lights, lighting.lights.size(), shared::kMaxLights));
    scene->lights = std::make_unique<SceneLights>(
        LightBufferLayout::make(slots, lighting, SceneSurroundings::countRows(pack),
                                pack.receivers().lamps.empty() ? 0 : pack.instances().size()),
        std::move(lighting));
    if (!layout.deformation.words.empty())
        scene->deformation = makeDeformation(device, options, layout, group_items.rigid_items);
    HEARTH_TRY(createBuffers(device, pack, layout, options, *scene));
    HEARTH_TRY(createSets(device, layouts, *scene, layout.material_rows));
    HEARTH_TRY(uploadTables(pack, layout, *scene->staging, *scene));
    HEARTH_TRY(scene->staging->uploadRecords(scene->buffers.group_items, group_items.items));
    HEARTH_TRY(uploadGeometry(pack, layout, *scene->staging, *scene));
    HEARTH_TRY(uploadMaterials(device, layouts, pack, bindings, *scene->staging, *scene));
    findSkyVisibility(pack, *scene);
    findLocalProbes(pack, *scene);
    fillSpareBindings(device, *scene);
    HEARTH_TRY(uploadShadingTables(device, pack, *scene->staging, *scene));
    HEARTH_TRY(uploadBricks(device, layouts, pack, options.bricks, *scene->staging, *scene));
    scene->staging->finish();
    scene->bins = std::move(layout.bins);
    scene->motions = std::move(layout.motions);
    scene->motions.clusters = {};
    float reach = 0; // in the world
    for (const uint32_t instance : scene->motions.instances)
        reach = std::max(reach, scene->motions.reaches[scene->instances[instance].mesh] *
                                    scene->instances[instance].scale_max);
    if (reach > 0)
        scene->bounds = {scene->bounds.min - Float3{reach, reach, reach},
                         scene->bounds.max + Float3{reach, reach, reach}};
    if (scene->deformation != nullptr)
        storeDeformation(pack, std::move(layout.deformation), *scene);
    return scene;
}

} // namespace hearth::gpu
