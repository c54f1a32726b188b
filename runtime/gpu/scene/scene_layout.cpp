// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_layout.h"

#include "formats/scene/lit_material.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <tuple>

namespace hearth::gpu
{

namespace
{

// a 16-bit depth buffer tells material ids apart, and 0 is the sky
constexpr uint32_t kMaxMaterialRows = 65535;

/// Part of a bin's key that follows from the mesh and the material.
struct BinKey
{
    bool deformed; // first member: bins of deformed instances are the last
    bool alpha_tested;
    uint32_t motion;
    uint32_t material_row;
    Facing facing;
    bool unlit;
    friend auto operator<=>(const BinKey&, const BinKey&) = default;
};

/// Clusters of a mesh that share a key: order[first .. first + count).
struct ClusterRun
{
    BinKey key;
    uint32_t first;
    uint32_t count;
};

Error limitError(const formats::PackView& pack, const std::string& detail)
{
    return {Issue::device_limit, pack.name(), "", detail};
}

BinKey makeBinKey(const formats::PackView& pack, std::span<const MaterialBinding> bindings, bool deformed,
                  uint32_t material)
{
    if (material == kInvalidIndex)
        return {deformed, false, 0, 0, Facing::culled, false};
    const formats::MaterialRecord& record = pack.materials()[material];
    const bool tested = record.alpha_mode != static_cast<uint32_t>(formats::AlphaMode::opaque);
    const bool two_sided = (record.flags & formats::kMaterialDoubleSided) != 0;
    const uint32_t motion = bindings.empty() ? 0 : bindings[material].motion;
    return {deformed,
            tested,
            motion,
            tested || motion != 0 ? materialRow(pack, material) : 0,
            two_sided ? Facing::doubleSided : Facing::culled,
            !formats::isLit(record)};
}

/// Per mesh: 1 if the chunk DMSH describes it.
std::vector<uint8_t> findDeformedMeshes(const formats::PackView& pack)
{
    std::vector<uint8_t> deformed(pack.meshes().size(), 0);
    for (const formats::DeformedMeshRecord& mesh : pack.deformedMeshes())
        deformed[mesh.mesh] = 1;
    return deformed;
}

/// Append the clusters of a mesh to the order, stably sorted by key.
std::vector<ClusterRun> orderMesh(const formats::PackView& pack, std::span<const MaterialBinding> bindings,
                                  const formats::MeshRecord& mesh, bool deformed,
                                  std::vector<uint32_t>& order)
{
    std::vector<std::pair<BinKey, uint32_t>> clusters;
    clusters.reserve(mesh.clusters.count);
    for (uint32_t c = mesh.clusters.first; c < mesh.clusters.first + mesh.clusters.count; ++c)
        clusters.emplace_back(makeBinKey(pack, bindings, deformed, pack.clusters()[c].material), c);
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });

    std::vector<ClusterRun> runs;
    for (const auto& [key, cluster] : clusters)
    {
        if (runs.empty() || runs.back().key != key)
            runs.push_back({key, static_cast<uint32_t>(order.size()), 0});
        runs.back().count += 1;
        order.push_back(cluster);
    }
    return runs;
}

void appendItems(uint32_t instance, const ClusterRun& run, std::vector<shared::WorkItem>& items)
{
    // motions turn triangles: a normal cone says nothing
    const uint32_t flags =
        run.key.facing == Facing::doubleSided || run.key.motion != 0 ? shared::kItemDoubleSided : 0;
    for (uint32_t done = 0; done < run.count; done += shared::kWorkItemClusters)
        items.push_back({.instance = instance,
                         .first = run.first + done,
                         .count = std::min(run.count - done, shared::kWorkItemClusters),
                         .flags = flags});
}

/// Cut the clusters of every instance into work items and gather the items bin by bin.
Status makeWorkList(const formats::PackView& pack, std::span<const MaterialBinding> bindings,
                    SceneLayout& layout)
{
    std::vector<std::vector<ClusterRun>> runs_of_mesh;
    runs_of_mesh.reserve(pack.meshes().size());
    const std::vector<uint8_t> deformed = findDeformedMeshes(pack);
    for (size_t mesh = 0; mesh < deformed.size(); ++mesh)
        runs_of_mesh.push_back(
            orderMesh(pack, bindings, pack.meshes()[mesh], deformed[mesh] != 0, layout.order));

    // an item and its result are 16 and 20 bytes, and every device can bind 128 MiB
    constexpr uint64_t kMaxItems = uint64_t{6} << 20;
    uint64_t item_count = 0;
    std::map<BinKey, std::vector<shared::WorkItem>> items_of_bin;
    for (uint32_t i = 0; i < pack.instances().size(); ++i)
    {
        const formats::InstanceRecord& instance = pack.instances()[i];
        for (const ClusterRun& run : runs_of_mesh[instance.mesh])
        {
            item_count += (run.count + shared::kWorkItemClusters - 1) / shared::kWorkItemClusters;
            if (item_count > kMaxItems)
                return limitError(pack,
                                  "the instances have too many clusters to cull one by one: more than " +
                                      std::to_string(kMaxItems) + " work items");
            BinKey key = run.key;
            if (key.facing == Facing::culled && (instance.flags & formats::kInstanceMirrored) != 0)
                key.facing = Facing::mirrored;
            appendItems(i, run, items_of_bin[key]);
            layout.instanced_clusters += run.count;
        }
    }
    layout.items.reserve(static_cast<size_t>(item_count));
    for (const auto& [key, items] : items_of_bin)
    {
        layout.bins.push_back(
            {key.alpha_tested,
             key.motion,
             key.material_row,
             key.facing,
             key.unlit,
             key.deformed,
             {static_cast<uint32_t>(layout.items.size()), static_cast<uint32_t>(items.size())}});
        layout.rigid_items += key.deformed ? 0 : static_cast<uint32_t>(items.size());
        layout.items.insert(layout.items.end(), items.begin(), items.end());
    }
    return success();
}

/// Grow the box of a cluster by steps of its grid to each side.
void growBox(formats::ClusterRecord& cluster, uint32_t steps)
{
    uint64_t sizes[3];
    for (size_t axis = 0; axis < 3; ++axis)
    {
        cluster.base[axis] -= static_cast<int32_t>(steps);
        sizes[axis] = (uint64_t{cluster.extent[axis]} << cluster.extent_shift) + 2 * uint64_t{steps};
    }
    while ((std::max({sizes[0], sizes[1], sizes[2]}) + (uint64_t{1} << cluster.extent_shift) - 1) >>
           cluster.extent_shift > 0xFFFF)
        cluster.extent_shift += 1;
    for (size_t axis = 0; axis < 3; ++axis)
        cluster.extent[axis] = static_cast<uint16_t>(
            (sizes[axis] + (uint64_t{1} << cluster.extent_shift) - 1) >> cluster.extent_shift);
}

/// Let the bounds of meshes hold what their materials move, and find the instances that move. The bounds of a
/// mesh grow as one, so that the spheres of its groups still contain those of finer ones.
Status addMotions(const formats::PackView& pack, std::span<const MaterialBinding> bindings,
                  SceneLayout& layout)
{
    const std::vector<uint8_t> deformed = findDeformedMeshes(pack);
    std::vector<float> reaches(pack.meshes().size(), 0);
    bool moves = false;
    for (size_t mesh = 0; mesh < reaches.size(); ++mesh)
    {
        const formats::Range clusters = pack.meshes()[mesh].clusters;
        for (const formats::ClusterRecord& cluster : formats::recordsInRange(pack.clusters(), clusters))
        {
            if (cluster.material == kInvalidIndex || bindings[cluster.material].motion == 0)
                continue;
            if (deformed[mesh] != 0)
                return Error{Issue::usage, pack.name(),
                             "material \"" + std::string(pack.text(pack.materials()[cluster.material].name)) +
                                 "\"",
                             "has the extra hearth_motion, and a mesh that clips or poses deform uses it"};
            reaches[mesh] = std::max(reaches[mesh], bindings[cluster.material].motion_bound);
            moves = true;
        }
    }
    if (!moves)
        return success();
    VertexMotions& motions = layout.motions;
    motions.reaches = std::move(reaches);
    motions.clusters.assign(pack.clusters().begin(), pack.clusters().end());
    for (size_t mesh = 0; mesh < motions.reaches.size(); ++mesh)
        if (const float reach = motions.reaches[mesh]; reach > 0)
        {
            const formats::MeshRecord& record = pack.meshes()[mesh];
            const double steps = std::ceil(double{reach} / double{record.grid_step}) + 1;
            constexpr double kMaxSteps = 1 << 24; // as far as a grid reaches
            if (steps > kMaxSteps)
                return Error{Issue::usage, pack.name(),
                             "mesh \"" + std::string(pack.text(record.name)) + "\"",
                             "is too small for the extra hearth_motion_bound of its materials"};
            for (uint32_t c = record.clusters.first; c < record.clusters.first + record.clusters.count; ++c)
                growBox(motions.clusters[c], static_cast<uint32_t>(steps));
            const Float3 grown = Float3{1, 1, 1} * static_cast<float>(steps * double{record.grid_step});
            layout.bounds[mesh].box_min = layout.bounds[mesh].box_min - grown;
            layout.bounds[mesh].box_max = layout.bounds[mesh].box_max + grown;
        }
    for (uint32_t i = 0; i < pack.instances().size(); ++i)
        if (motions.reaches[pack.instances()[i].mesh] > 0)
        {
            layout.instances[i].flags |= shared::kInstanceMoved; // casters that move
            motions.instances.push_back(i);
        }
    return success();
}

} // namespace

uint32_t materialRow(const formats::PackView& pack, uint32_t material)
{
    return material == kInvalidIndex ? static_cast<uint32_t>(pack.materials().size()) : material;
}

shared::ClusterDraw makeClusterDraw(const formats::PackView& pack, uint32_t cluster, uint32_t page_address)
{
    const formats::ClusterRecord& record = pack.clusters()[cluster];
    const formats::MeshRecord& mesh = pack.meshes()[pack.pages()[record.page].mesh];
    return {.address = page_address + record.page_word + formats::uvBaseWords(mesh.attributes),
            .counts = shared::packDrawCounts(record.vertex_count, record.triangle_count, record.level) |
                      (mesh.morph_target_count > 0 ? shared::kDrawMorphs : 0u),
            .vertex_layout = formats::clusterVertexLayout(record, mesh.attributes),
            .material = 1 + materialRow(pack, record.material),
            .base_x = record.base[0],
            .base_y = record.base[1],
            .base_z = record.base[2],
            .grid_step = mesh.grid_step,
            .position_error = record.refined_group == kInvalidIndex
                                  ? 0
                                  : pack.groups()[record.refined_group].position_error};
}

GroupItems makeGroupItems(const formats::PackView& pack)
{
    GroupItems result;
    const std::vector<uint8_t> deformed = findDeformedMeshes(pack);
    for (const uint8_t which : {uint8_t{0}, uint8_t{1}})
    {
        for (uint32_t i = 0; i < pack.instances().size(); ++i)
        {
            const uint32_t mesh = pack.instances()[i].mesh;
            const formats::Range groups = pack.meshes()[mesh].groups;
            for (uint32_t done = 0; done < groups.count && deformed[mesh] == which;
                 done += shared::kWorkItemClusters)
                result.items.push_back({.instance = i,
                                        .first = groups.first + done,
                                        .count = std::min(groups.count - done, shared::kWorkItemClusters)});
        }
        if (which == 0)
            result.rigid_items = static_cast<uint32_t>(result.items.size());
    }
    return result;
}

void addProxyCasters(const formats::PackView& pack, SceneLayout& layout)
{
    shared::ProxyCasters casters = shared::findProxyCasters(pack);
    for (size_t mesh = 0; mesh < casters.boxes.size(); ++mesh)
        if (const Box3& box = casters.boxes[mesh]; !box.empty())
        {
            shared::MeshBounds& bounds = layout.bounds[mesh];
            bounds.box_min = min(bounds.box_min, box.min);
            bounds.box_max = max(bounds.box_max, box.max);
        }
    for (const formats::InstanceRecord& instance : pack.instances())
        layout.proxy_chunks += shared::countProxyChunks(casters.rows[instance.mesh]);
    layout.proxies = std::move(casters.rows);
    layout.proxies.resize(layout.bounds.size());
}

Result<SceneLayout> makeSceneLayout(const formats::PackView& pack)
{
    HEARTH_ASSIGN_OR_RETURN(PoolLayout pool, placeAllPages(pack));
    return makeSceneLayout(pack, std::move(pool));
}

Result<SceneLayout> makeSceneLayout(const formats::PackView& pack, PoolLayout pool,
                                    std::span<const MaterialBinding> bindings)
{
    SceneLayout layout;
    layout.pool = std::move(pool);
    layout.material_rows = static_cast<uint32_t>(pack.materials().size()) + 1;
    if (layout.material_rows > kMaxMaterialRows)
        return limitError(pack, std::to_string(pack.materials().size()) + " materials are more than 65534");
    layout.draws.reserve(pack.clusters().size());
    for (uint32_t c = 0; c < pack.clusters().size(); ++c)
        layout.draws.push_back(makeClusterDraw(pack, c, layout.pool.page_addresses[pack.clusters()[c].page]));
    HEARTH_TRY(makeWorkList(pack, bindings, layout));
    layout.bounds = shared::makeMeshBounds(pack.meshes(), pack.clusters());
    layout.instances.resize(pack.instances().size());
    if (!layout.instances.empty())
        std::memcpy(static_cast<void*>(layout.instances.data()), pack.instances().data(),
                    pack.instances().size_bytes());
    if (!bindings.empty())
        HEARTH_TRY(addMotions(pack, bindings, layout));
    layout.deformation = makeDeformationLayout(pack, layout.bounds, layout.instances);
    layout.inverses.reserve(pack.instances().size());
    for (const formats::InstanceRecord& instance : pack.instances())
        layout.inverses.push_back(shared::makeInstanceInverse(instance));
    // deformed instances have an inverse per joint instead
    for (const DeformedInstance& deformed : layout.deformation.instances)
        layout.inverses[deformed.instance] = {};
    return layout;
}

} // namespace hearth::gpu
