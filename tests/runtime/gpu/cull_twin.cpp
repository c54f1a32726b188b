// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/cull_twin.h"

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

uint32_t getCount(const WorkResult& result)
{
    return static_cast<uint32_t>(std::popcount(result.mask_low) + std::popcount(result.mask_high));
}

bool getBit(uint32_t low, uint32_t high, uint32_t lane)
{
    return ((lane < 32 ? low : high) >> (lane % 32) & 1) != 0;
}

void setBit(uint32_t& low, uint32_t& high, uint32_t lane)
{
    (lane < 32 ? low : high) |= 1u << (lane % 32);
}

/// Poses of a layout, read like in the shaders.
class PoseTable
{
public:
    explicit PoseTable(const gpu::SceneLayout& layout) : words_(layout.deformation.words) {}

    bool isDeformed(uint32_t instance) const
    {
        return !words_.empty() && words_[readHeader().instance_word + instance] != 0;
    }
    Pose pose(uint32_t instance) const { return at<Pose>(words_[readHeader().instance_word + instance]); }
    PaletteRow joint(const Pose& pose, uint32_t joint) const
    {
        return at<PaletteRow>(pose.palette_row + joint * kPaletteRows);
    }
    DeformedCluster cluster(const Pose& pose, uint32_t cluster) const
    {
        return at<DeformedCluster>(pose.cluster_row + cluster * kDeformedClusterRows);
    }
    TransformedBox box(const Instance& instance, const Pose& pose, const DeformedCluster& cluster) const
    {
        if ((pose.flags & kPoseFree) == 0)
        {
            TransformedBox framed = boxInClips(instance, joint(pose, cluster.joint), cluster);
            for (uint32_t i = 1; i < cluster.joint_count; ++i)
                if (const uint32_t word = words_[cluster.first_joint + i]; frameShare(word) > 0)
                    framed = shareFrame(framed, joint(pose, cluster.joint), joint(pose, listedJoint(word)),
                                        frameShare(word));
            return framed;
        }
        TransformedBox box = growByJoint(makeEmptyFreeBox(instance), joint(pose, cluster.joint),
                                         cluster.bind_min, cluster.bind_max, pose.free_box_scale);
        for (uint32_t i = 1; i < cluster.joint_count; ++i)
            box = growByJoint(box, joint(pose, listedJoint(words_[cluster.first_joint + i])),
                              cluster.bind_min, cluster.bind_max, pose.free_box_scale);
        return box;
    }

private:
    DeformationHeader readHeader() const { return at<DeformationHeader>(0); }

    template <typename Record>
    Record at(uint32_t row) const
    {
        Record record;
        HEARTH_ASSERT(size_t{row} * 4 + sizeof(Record) / 4 <= words_.size());
        std::memcpy(static_cast<void*>(&record), words_.data() + size_t{row} * 4, sizeof(record));
        return record;
    }

    const std::vector<uint32_t>& words_;
};

class TwinMaker
{
public:
    TwinMaker(const formats::PackView& pack, const gpu::SceneLayout& layout, const FrameView& view,
              const Pyramid& last, const Pyramid& current, std::span<const uint8_t> resident_groups)
        : layout_(layout),
          view_(view),
          last_(last),
          current_(current),
          poses_(layout),
          instances_(layout.instances),
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
                countCluster(item, layout_.order[item.first + lane]);
        return std::move(twin_);
    }

private:
    void phase(uint32_t which)
    {
        for (uint32_t i = 0; i < instances_.size(); ++i)
            twin_.states[i] = getState(i, which);
        for (uint32_t i = 0; i < layout_.items.size(); ++i)
            twin_.results[i] = getResult(i, which);
        emit(which);
        if (which != kPhaseLate)
            twin_.early_clusters = static_cast<uint32_t>(twin_.visible.size());
    }

    InstanceState getState(uint32_t i, uint32_t which) const
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

    WorkResult getResult(uint32_t i, uint32_t which) const
    {
        const WorkItem& item = layout_.items[i];
        const InstanceState& state = twin_.states[item.instance];
        const WorkResult& before = twin_.results[i];
        WorkResult result{};
        if (state.visible != kInstanceVisible && state.visible != kInstanceLate)
            return result;
        for (uint32_t lane = 0; lane < item.count; ++lane)
        {
            const uint32_t cluster = layout_.order[item.first + lane];
            const bool asked_before = which == kPhaseLate && state.visible == kInstanceVisible;
            if (!(asked_before ? getBit(before.later_low, before.later_high, lane)
                               : decides(item, state, cluster)))
                continue;
            const bool hidden = which != kPhaseWhole &&
                                isBehind(which == kPhaseLate ? current_ : last_, item, state, cluster);
            if (!hidden)
                setBit(result.mask_low, result.mask_high, lane);
            else if (which == kPhaseEarly)
                setBit(result.later_low, result.later_high, lane);
        }
        return result;
    }

    bool isBehind(const Pyramid& pyramid, const WorkItem& item, const InstanceState& state,
                  uint32_t number) const
    {
        const Instance& instance = instances_[item.instance];
        if (!poses_.isDeformed(item.instance))
            return isHidden(pyramid, instance, clusterBoxMin(clusters_[number], state.grid_step),
                            clusterBoxMax(clusters_[number], state.grid_step));
        const Pose pose = poses_.pose(item.instance);
        const TransformedBox box = poses_.box(instance, pose, poses_.cluster(pose, number));
        return isHidden({occlusionFromOrigin(pyramid.view, instance), pyramid.texels}, box.joint_instance,
                        box.box_min, box.box_max);
    }

    bool decides(const WorkItem& item, const InstanceState& state, uint32_t number) const
    {
        if (poses_.isDeformed(item.instance))
            return getOutcome(item, number) >= kOutcomeCandidate;
        const Cluster& cluster = clusters_[number];
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

    void countCluster(const WorkItem& item, uint32_t number)
    {
        const Cluster& cluster = clusters_[number];
        const uint32_t outcome = getOutcome(item, number);
        CullStatistics& counts = twin_.statistics;
        ++counts.clusters[outcome];
        const uint64_t triangles =
            (uint64_t{counts.triangles_high[outcome]} << 32 | counts.triangles_low[outcome]) +
            (cluster.counts & 0xFF);
        counts.triangles_low[outcome] = static_cast<uint32_t>(triangles);
        counts.triangles_high[outcome] = static_cast<uint32_t>(triangles >> 32);
    }

    /// Apply the tests one after the other.
    uint32_t getOutcome(const WorkItem& item, uint32_t number) const
    {
        const InstanceState& state = twin_.states[item.instance];
        if (state.visible == kInstanceHidden)
            return kOutcomeInstance;
        const uint32_t failed = poses_.isDeformed(item.instance)
                                    ? deformedFailure(item, number)
                                    : rigidFailure(item, state, clusters_[number]);
        return failed != kOutcomeCandidate      ? failed
               : state.visible == kInstanceLate ? kOutcomeLateCandidate
                                                : kOutcomeCandidate;
    }

    /// First test that the cluster fails, or kOutcomeCandidate.
    uint32_t deformedFailure(const WorkItem& item, uint32_t number) const
    {
        const Instance& instance = instances_[item.instance];
        const Pose pose = poses_.pose(item.instance);
        const DeformedCluster cluster = poses_.cluster(pose, number);
        const Group& refined =
            groups_[cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group];
        if (!deformedInCut(view_, instance, pose, cluster, groups_[cluster.group], refined))
            return kOutcomeLod;
        if (!deformedInFrustum(view_, instance, poses_.box(instance, pose, cluster)))
            return kOutcomeFrustum;
        if ((item.flags & kItemDoubleSided) == 0 &&
            deformedFacesAway(view_, instance, pose, poses_.joint(pose, cluster.joint), cluster))
            return kOutcomeCone;
        return kOutcomeCandidate;
    }

    uint32_t rigidFailure(const WorkItem& item, const InstanceState& state, const Cluster& cluster) const
    {
        const Instance& instance = instances_[item.instance];
        const bool has_refined = cluster.refined_group != kNoGroup;
        const Group& refined = groups_[has_refined ? cluster.refined_group : cluster.group];
        if (!clusterInCut(view_, instance, groups_[cluster.group], has_refined, refined))
            return kOutcomeLod;
        if ((view_.flags & kCullFrustum) != 0 &&
            boxOutsideFrustum(view_, instance, clusterBoxMin(cluster, state.grid_step),
                              clusterBoxMax(cluster, state.grid_step)))
            return kOutcomeFrustum;
        if ((view_.flags & kCullCone) != 0 && (item.flags & kItemDoubleSided) == 0 && state.cone_valid != 0 &&
            coneFacesAway(view_, state, cluster))
            return kOutcomeCone;
        return kOutcomeCandidate;
    }

    /// Compute offsets, totals, the list and the draws from the masks.
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
            slot += getCount(result);
            const WorkItem& item = layout_.items[i];
            for (uint32_t lane = 0; lane < item.count; ++lane)
                if (getBit(result.mask_low, result.mask_high, lane))
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
    PoseTable poses_;
    std::vector<Instance> instances_;
    std::vector<Cluster> clusters_;
    std::vector<Group> groups_;
    Twin twin_;
};

} // namespace

Twin makeTwin(const formats::PackView& pack, const gpu::SceneLayout& layout, const FrameView& view,
              const Pyramid& last, const Pyramid& current, std::span<const uint8_t> resident_groups)
{
    return TwinMaker(pack, layout, view, last, current, resident_groups).run();
}

std::vector<uint32_t> makeRequestTwin(const formats::PackView& pack, const gpu::SceneLayout& layout,
                                      const FrameView& view)
{
    const auto clusters = recordsAs<Cluster>(pack.clusters());
    const auto groups = recordsAs<Group>(pack.groups());
    const PoseTable poses(layout);
    const auto pages = static_cast<uint32_t>(pack.pages().size());
    const auto materials = static_cast<uint32_t>(pack.materials().size());
    std::vector<uint32_t> requests(pages + materials + 1, 0);
    for (uint32_t i = 0; i < layout.instances.size(); ++i)
    {
        const Instance& instance = layout.instances[i];
        const InstanceState state =
            decideInstance(view, instance, layout.inverses[i], layout.bounds[instance.mesh]);
        if (state.visible == kInstanceHidden)
            continue;
        const bool deformed = poses.isDeformed(i);
        const Pose pose = deformed ? poses.pose(i) : Pose{};
        const auto in_frustum = [&](uint32_t c)
        {
            return deformed
                       ? deformedInFrustum(view, instance, poses.box(instance, pose, poses.cluster(pose, c)))
                       : clusterInFrustum(view, instance, state, clusters[c]);
        };
        const auto ask = [&](uint32_t group)
        {
            uint32_t& request = requests[groups[group - groups[group].set_offset].page];
            request = std::max(request, groupPriority(view, instance, groupInPose(groups[group], pose)));
        };
        const auto reach = [&](uint32_t c)
        {
            return deformed ? deformedReach(view, instance, poses.box(instance, pose, poses.cluster(pose, c)))
                            : clusterReach(view, instance, state, clusters[c]);
        };
        const auto refines = [&](uint32_t group)
        {
            return groups[group].error > kMaxFiniteError ||
                   groupPriority(view, instance, groupInPose(groups[group], pose)) != 0;
        };
        const formats::Range range = pack.meshes()[pack.instances()[i].mesh].clusters;
        for (uint32_t c = range.first; c < range.first + range.count; ++c)
        {
            if (!in_frustum(c))
                continue;
            const uint32_t refined = clusters[c].refined_group;
            ask(clusters[c].group);
            if (refined != kNoGroup)
                ask(refined);
            if (!refines(clusters[c].group) || (refined != kNoGroup && refines(refined)))
                continue;
            const uint32_t row = clusters[c].material == kNoGroup ? materials : clusters[c].material;
            uint32_t& request = requests[pages + row];
            request = std::max(request, texelRequest(view, instance, uvDensityCode(clusters[c]), reach(c)));
        }
    }
    return requests;
}

void applyPoses(std::span<const gpu::InstancePose> poses, gpu::SceneLayout& layout)
{
    for (const gpu::InstancePose& pose : poses)
    {
        const gpu::DeformedInstance* instance = gpu::findDeformed(layout.deformation, pose.instance);
        gpu::PoseRows rows;
        HEARTH_ASSERT(instance != nullptr && gpu::poseInstance(*instance, pose, rows));
        layout.instances[pose.instance] = rows.record;
        layout.bounds[rows.record.mesh] = rows.bounds;
        std::copy(rows.words.begin(), rows.words.end(),
                  layout.deformation.words.begin() + static_cast<std::ptrdiff_t>(instance->pose_row) * 4);
    }
}

} // namespace hearth::test
