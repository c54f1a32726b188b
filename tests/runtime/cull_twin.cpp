// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/cull_twin.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hearth::test
{

namespace
{

using namespace shared;

template <typename T>
std::vector<T> recordsAs(const auto& records)
{
    std::vector<T> result(records.size());
    if (!result.empty())
        std::memcpy(static_cast<void*>(result.data()), records.data(), records.size_bytes());
    return result;
}

uint32_t countOf(const WorkResult& result)
{
    return static_cast<uint32_t>(std::popcount(result.mask_low) + std::popcount(result.mask_high));
}

bool bitOf(uint32_t low, uint32_t high, uint32_t lane)
{
    return ((lane < 32 ? low : high) >> (lane % 32) & 1) != 0;
}

void setBit(uint32_t& low, uint32_t& high, uint32_t lane)
{
    (lane < 32 ? low : high) |= 1u << (lane % 32);
}

bool isHidden(const Pyramid& pyramid, const Instance& instance, Float3 box_min, Float3 box_max)
{
    const PyramidBox box = pyramidBox(pyramid.view, instance, box_min, box_max);
    if (box.known == 0)
        return false;
    for (uint32_t y = box.y0; y <= box.y1; ++y)
        for (uint32_t x = box.x0; x <= box.x1; ++x)
            if (box.depth >= pyramid.texels.at(box.offset + y * box.stride + x))
                return false;
    return true;
}

class TwinMaker
{
public:
    TwinMaker(const formats::PackView& pack, const gpu::SceneLayout& layout, const FrameView& view,
              const Pyramid& last, const Pyramid& current, std::span<const uint8_t> resident_groups)
        : layout_(layout),
          view_(view),
          last_(last),
          current_(current),
          instances_(recordsAs<Instance>(pack.instances())),
          clusters_(recordsAs<Cluster>(pack.clusters())),
          groups_(recordsAs<Group>(pack.groups()))
    {
        for (size_t group = 0; group < resident_groups.size(); ++group)
            groups_[group].absent = resident_groups[group] == 0 ? 1 : 0;
    }

    Twin run()
    {
        twin_.states.resize(instances_.size());
        twin_.results.resize(layout_.items.size());
        twin_.material_draws.assign((size_t{layout_.material_rows} + 1) * 4, 0);
        if ((view_.flags & kCullOcclusion) == 0)
        {
            phase(kPhaseWhole);
            twin_.bin_draws.resize(2 * layout_.bins.size(), BinDraw{}); // no late ones
        }
        else
        {
            phase(kPhaseEarly);
            phase(kPhaseLate);
        }
        countInstances();
        for (const WorkItem& item : layout_.items)
            for (uint32_t lane = 0; lane < item.count; ++lane)
                countCluster(item, clusters_[layout_.order[item.first + lane]]);
        return std::move(twin_);
    }

private:
    void phase(uint32_t which)
    {
        for (uint32_t i = 0; i < instances_.size(); ++i)
            twin_.states[i] = stateOf(i, which);
        for (uint32_t i = 0; i < layout_.items.size(); ++i)
            twin_.results[i] = resultOf(i, which);
        emit(which);
        if (which != kPhaseLate)
            twin_.early_clusters = static_cast<uint32_t>(twin_.visible.size());
    }

    InstanceState stateOf(uint32_t i, uint32_t which) const
    {
        const MeshBounds& mesh = layout_.bounds[instances_[i].mesh];
        if (which == kPhaseLate)
        {
            InstanceState state = twin_.states[i];
            if (state.visible == kInstanceDeferred)
                state.visible = isHidden(current_, instances_[i], mesh.box_min, mesh.box_max)
                                    ? kInstanceHidden
                                    : kInstanceLate;
            return state;
        }
        InstanceState state = decideInstance(view_, instances_[i], layout_.inverses[i], mesh);
        if (which == kPhaseEarly && state.visible == kInstanceVisible &&
            isHidden(last_, instances_[i], mesh.box_min, mesh.box_max))
            state.visible = kInstanceDeferred;
        return state;
    }

    WorkResult resultOf(uint32_t i, uint32_t which) const
    {
        const WorkItem& item = layout_.items[i];
        const InstanceState& state = twin_.states[item.instance];
        const WorkResult& before = twin_.results[i];
        WorkResult result{};
        if (state.visible != kInstanceVisible && state.visible != kInstanceLate)
            return result;
        for (uint32_t lane = 0; lane < item.count; ++lane)
        {
            const Cluster& cluster = clusters_[layout_.order[item.first + lane]];
            const bool asked_before = which == kPhaseLate && state.visible == kInstanceVisible;
            if (!(asked_before ? bitOf(before.later_low, before.later_high, lane)
                               : decides(item, state, cluster)))
                continue;
            const bool hidden =
                which != kPhaseWhole &&
                isHidden(which == kPhaseLate ? current_ : last_, instances_[item.instance],
                         clusterBoxMin(cluster, state.grid_step), clusterBoxMax(cluster, state.grid_step));
            if (!hidden)
                setBit(result.mask_low, result.mask_high, lane);
            else if (which == kPhaseEarly)
                setBit(result.later_low, result.later_high, lane);
        }
        return result;
    }

    bool decides(const WorkItem& item, const InstanceState& state, const Cluster& cluster) const
    {
        const Group& refined =
            groups_[cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group];
        return decideCluster(view_, instances_[item.instance], state, cluster, groups_[cluster.group],
                             refined, (item.flags & kItemDoubleSided) != 0);
    }

    void countInstances()
    {
        CullStatistics& counts = twin_.statistics;
        for (uint32_t i = 0; i < instances_.size(); ++i)
        {
            const MeshBounds& mesh = layout_.bounds[instances_[i].mesh];
            const bool hidden_at_once =
                decideInstance(view_, instances_[i], layout_.inverses[i], mesh).visible == kInstanceHidden;
            const uint32_t visible = twin_.states[i].visible;
            ++(hidden_at_once
                   ? mesh.box_min.x > mesh.box_max.x ? counts.empty_instances : counts.outside_instances
               : visible == kInstanceVisible ? counts.visible_instances
               : visible == kInstanceLate    ? counts.late_instances
                                             : counts.occluded_instances);
        }
    }

    void countCluster(const WorkItem& item, const Cluster& cluster)
    {
        const uint32_t outcome = outcomeOf(item, cluster);
        CullStatistics& counts = twin_.statistics;
        ++counts.clusters[outcome];
        const uint64_t triangles =
            (uint64_t{counts.triangles_high[outcome]} << 32 | counts.triangles_low[outcome]) +
            (cluster.counts & 0xFFFF);
        counts.triangles_low[outcome] = static_cast<uint32_t>(triangles);
        counts.triangles_high[outcome] = static_cast<uint32_t>(triangles >> 32);
    }

    /// The tests one after the other.
    uint32_t outcomeOf(const WorkItem& item, const Cluster& cluster) const
    {
        const InstanceState& state = twin_.states[item.instance];
        const Instance& instance = instances_[item.instance];
        if (state.visible == kInstanceHidden)
            return kOutcomeInstance;
        const bool has_refined = cluster.refined_group != kNoGroup;
        const Group& refined = groups_[has_refined ? cluster.refined_group : cluster.group];
        if (!clusterInCut(view_, instance, groups_[cluster.group], has_refined, refined))
            return kOutcomeLod;
        if ((view_.flags & kCullFrustum) != 0 &&
            boxOutsideFrustum(view_, instance, clusterBoxMin(cluster, state.grid_step),
                              clusterBoxMax(cluster, state.grid_step)))
            return kOutcomeFrustum;
        if ((view_.flags & kCullCone) != 0 && (item.flags & kItemDoubleSided) == 0 && state.cone_valid != 0 &&
            coneFacesAway(state, cluster))
            return kOutcomeCone;
        return state.visible == kInstanceLate ? kOutcomeLateCandidate : kOutcomeCandidate;
    }

    /// Offsets, totals, the list and the draws, from the masks.
    void emit(uint32_t which)
    {
        auto slot = static_cast<uint32_t>(twin_.visible.size());
        uint32_t block_start = slot;
        std::vector<uint32_t> slot_of_item;
        twin_.totals.clear();
        for (uint32_t i = 0; i < layout_.items.size(); ++i)
        {
            if (i % kScanBlockItems == 0)
                twin_.totals.push_back(block_start = slot);
            WorkResult& result = twin_.results[i];
            result.offset = slot - block_start;
            slot_of_item.push_back(slot);
            slot += countOf(result);
            const WorkItem& item = layout_.items[i];
            for (uint32_t lane = 0; lane < item.count; ++lane)
                if (bitOf(result.mask_low, result.mask_high, lane))
                    addVisible(item.instance, layout_.order[item.first + lane]);
        }
        twin_.totals.push_back(slot);
        slot_of_item.push_back(slot);
        if (which != kPhaseLate)
            twin_.bin_draws.clear();
        for (const gpu::SceneBin& bin : layout_.bins)
        {
            const uint32_t first = slot_of_item[bin.items.first_item];
            const uint32_t end = slot_of_item[bin.items.first_item + bin.items.item_count];
            twin_.bin_draws.push_back({kClusterVertices, end - first, 0, 0, first, 0, 0, 0});
        }
    }

    void addVisible(uint32_t instance, uint32_t cluster)
    {
        twin_.visible.push_back({instance, cluster});
        const size_t draw = size_t{layout_.draws[cluster].material} * 4;
        twin_.material_draws[draw] = 3;
        twin_.material_draws[draw + 1] = 1;
    }

    const gpu::SceneLayout& layout_;
    const FrameView& view_;
    const Pyramid& last_;
    const Pyramid& current_;
    std::vector<Instance> instances_;
    std::vector<Cluster> clusters_;
    std::vector<Group> groups_;
    Twin twin_;
};

} // namespace

std::vector<float> makePyramid(const std::vector<float>& depth, uint32_t width, uint32_t height)
{
    std::vector<float> texels;
    for (uint32_t level = 1; level <= pyramidLevels(width, height); ++level)
        for (uint32_t y = 0; y < pyramidSize(height, level); ++y)
            for (uint32_t x = 0; x < pyramidSize(width, level); ++x)
            {
                float farthest = 1;
                for (uint32_t py = y << level; py < std::min((y + 1) << level, height); ++py)
                    for (uint32_t px = x << level; px < std::min((x + 1) << level, width); ++px)
                        farthest = std::min(farthest, depth[size_t{py} * width + px]);
                texels.push_back(farthest);
            }
    return texels;
}

Twin makeTwin(const formats::PackView& pack, const gpu::SceneLayout& layout, const FrameView& view,
              const Pyramid& last, const Pyramid& current, std::span<const uint8_t> resident_groups)
{
    return TwinMaker(pack, layout, view, last, current, resident_groups).run();
}

std::vector<uint32_t> makeRequestTwin(const formats::PackView& pack, const FrameView& view)
{
    const auto instances = recordsAs<Instance>(pack.instances());
    const auto clusters = recordsAs<Cluster>(pack.clusters());
    const auto groups = recordsAs<Group>(pack.groups());
    const std::vector<MeshBounds> bounds = makeMeshBounds(pack.meshes(), pack.clusters());
    std::vector<uint32_t> requests(pack.pages().size(), 0);
    for (size_t i = 0; i < instances.size(); ++i)
    {
        const InstanceState state = decideInstance(
            view, instances[i], makeInstanceInverse(pack.instances()[i]), bounds[instances[i].mesh]);
        if (state.visible == kInstanceHidden)
            continue;
        const auto ask = [&](uint32_t group)
        {
            uint32_t& request = requests[groups[group - groups[group].set_offset].page];
            request = std::max(request, groupRequest(view, instances[i], groups[group]));
        };
        const formats::Range range = pack.meshes()[instances[i].mesh].clusters;
        for (uint32_t c = range.first; c < range.first + range.count; ++c)
            if (clusterInFrustum(view, instances[i], state, clusters[c]))
            {
                ask(clusters[c].group);
                if (clusters[c].refined_group != kNoGroup)
                    ask(clusters[c].refined_group);
            }
    }
    return requests;
}

} // namespace hearth::test
