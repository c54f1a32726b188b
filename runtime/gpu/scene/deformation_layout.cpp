// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/deformation_layout.h"

#include "formats/base/scale_bound.h"
#include "formats/codecs/cluster_bounds.h"
#include "runtime/pack/pose_player.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace hearth::gpu
{

namespace
{

constexpr size_t kRowWords = 4;

// Relative slack of the bounds of skinned vertices. A skinned vertex is a sum of products of floats: about
// eight roundings of numbers as large as the mesh.
constexpr float kSkinningSlack = 2 * shared::kRoundingSlack;

// Slack of morphed positions, which are sums of at most hundreds of rounded terms.
constexpr float kMorphRounding = 1.0001f;

/// Appends records to a table of rows.
class RowWriter
{
public:
    explicit RowWriter(std::vector<uint32_t>& words) : words_(words) {}

    uint32_t nextRow() const { return static_cast<uint32_t>(words_.size() / kRowWords); }
    uint32_t nextWord() const { return static_cast<uint32_t>(words_.size()); }

    template <typename Record>
    void add(const Record& record)
    {
        static_assert(sizeof(Record) % (4 * kRowWords) == 0);
        const size_t first = words_.size();
        words_.resize(first + sizeof(Record) / 4);
        std::memcpy(words_.data() + first, &record, sizeof(Record));
    }

    void addWords(std::span<const uint32_t> words)
    {
        words_.insert(words_.end(), words.begin(), words.end());
    }
    void addRows(uint32_t count) { words_.resize(words_.size() + count * kRowWords, 0); }
    void finishRow() { words_.resize((words_.size() + kRowWords - 1) / kRowWords * kRowWords, 0); }

private:
    std::vector<uint32_t>& words_;
};

float largestCoordinate(const Box3& box)
{
    float largest = 0;
    for (int axis = 0; axis < 3 && !box.empty(); ++axis)
        largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
    return largest;
}

Box3 expandBox(const Box3& box, float margin)
{
    const Float3 all{margin, margin, margin};
    return box.empty() ? box : Box3{box.min - all, box.max + all};
}

/// Culling bounds of the clusters of the meshes of chunk DMSH.
class ClusterTable
{
public:
    ClusterTable(const formats::PackView& pack, const std::vector<shared::MeshBounds>& bounds)
        : pack_(pack), bounds_(bounds)
    {
    }

    /// Bounds in the bind pose, with morph weights from -1 to 1.
    Box3 bindBox(const formats::DeformedMeshRecord& mesh) const
    {
        const shared::MeshBounds& bounds = bounds_[mesh.mesh];
        float reach = 0;
        for (const formats::DeformedClusterRecord& cluster :
             recordsInRange(pack_.deformedClusters(), mesh.clusters))
            reach = std::max(reach, cluster.morph_reach);
        return expandBox({bounds.box_min, bounds.box_max}, reach * kMorphRounding);
    }

    float slack(const formats::DeformedMeshRecord& mesh) const
    {
        const shared::MeshBounds& bind = bounds_[mesh.mesh];
        return kSkinningSlack * std::max(largestCoordinate({mesh.box_min, mesh.box_max}),
                                         largestCoordinate({bind.box_min, bind.box_max}));
    }

    void add(const formats::DeformedMeshRecord& mesh, uint32_t first_joint_word, RowWriter& rows) const
    {
        const formats::MeshRecord& record = pack_.meshes()[mesh.mesh];
        for (uint32_t i = 0; i < record.clusters.count; ++i)
            rows.add(row(mesh, pack_.clusters()[record.clusters.first + i],
                         pack_.deformedClusters()[mesh.clusters.first + i], first_joint_word));
    }

private:
    shared::DeformedCluster row(const formats::DeformedMeshRecord& mesh,
                                const formats::ClusterRecord& cluster,
                                const formats::DeformedClusterRecord& deformed,
                                uint32_t first_joint_word) const
    {
        const formats::MeshRecord& record = pack_.meshes()[mesh.mesh];
        const Box3 box = expandBox({deformed.box_min, deformed.box_max}, slack(mesh));
        const Box3 bind =
            expandBox(formats::clusterBox(cluster, record.grid_step), deformed.morph_reach * kMorphRounding);
        return {.box_min = box.min,
                .joint = deformed.joint,
                .box_max = box.max,
                .cone = uint32_t{deformed.cone_axis} | uint32_t{deformed.cone_cutoff} << 16,
                .bind_min = bind.min,
                .cone_back = deformed.cone_back,
                .bind_max = bind.max,
                .first_joint = first_joint_word + deformed.joints.first,
                .group = cluster.group,
                .refined_group = cluster.refined_group,
                .joint_count = deformed.joints.count,
                .triangle_count = cluster.triangle_count};
    }

    const formats::PackView& pack_;
    const std::vector<shared::MeshBounds>& bounds_;
};

uint32_t scratchWords(const formats::PackView& pack, const formats::DeformedMeshRecord& mesh)
{
    const formats::MeshRecord& record = pack.meshes()[mesh.mesh];
    const uint32_t vectors = 1u + ((record.attributes & formats::kVertexNormal) != 0 ? 1u : 0u) +
                             ((record.attributes & formats::kVertexTangent) != 0 ? 1u : 0u);
    uint32_t words = 0;
    for (const formats::ClusterRecord& cluster : recordsInRange(pack.clusters(), record.clusters))
        words = std::max(words, cluster.vertex_count * 3 * vectors);
    return words;
}

void applyRows(const DeformedInstance& instance, const PoseRows& rows, DeformationLayout& layout,
               std::vector<shared::MeshBounds>& bounds, std::vector<shared::Instance>& instances)
{
    std::copy(rows.words.begin(), rows.words.end(),
              layout.words.begin() + static_cast<std::ptrdiff_t>(instance.pose_row * kRowWords));
    bounds[instance.record.mesh] = rows.bounds;
    instances[instance.instance] = rows.record;
}

/// Return a pose whose numbers fit into floats everywhere.
InstancePose makeUnitPose(const DeformedInstance& instance, std::vector<Affine3d>& palette,
                          std::vector<float>& weights)
{
    palette.assign(instance.joint_count, Affine3d{});
    weights.assign(instance.target_count, 0.0f);
    return {.instance = instance.instance, .world_from_bind = palette, .morph_weights = weights};
}

Float4 matrixRow(const Affine3& t, int row)
{
    return {t.m[row][0], t.m[row][1], t.m[row][2], t.m[row][3]};
}

/// Transform relative to the origin of the instance, where the anchor is.
Affine3d makeRelative(const Affine3d& anchor, Affine3d transform)
{
    for (int row = 0; row < 3; ++row)
        transform.m[row][3] -= anchor.m[row][3];
    return transform;
}

/// Cones tell front from back as the instance's bin does; this fails if a joint mirrors the triangles.
shared::PaletteRow paletteRow(const Affine3& origin_from_bind, bool mirrored)
{
    formats::InstanceRecord joint_instance{};
    joint_instance.world_from_object = origin_from_bind;
    shared::InstanceInverse inverse = shared::makeInstanceInverse(joint_instance);
    if ((determinant(origin_from_bind) < 0) != mirrored)
        inverse.object_from_world_x.w = 0;
    return {.world_from_bind_x = matrixRow(origin_from_bind, 0),
            .world_from_bind_y = matrixRow(origin_from_bind, 1),
            .world_from_bind_z = matrixRow(origin_from_bind, 2),
            .bind_from_world_x = inverse.object_from_world_x,
            .bind_from_world_y = inverse.object_from_world_y,
            .bind_from_world_z = inverse.object_from_world_z};
}

void setTransform(shared::Instance& record, const Affine3& linear, Float3 origin)
{
    record.world_from_object_x = matrixRow(linear, 0);
    record.world_from_object_y = matrixRow(linear, 1);
    record.world_from_object_z = matrixRow(linear, 2);
    record.world_from_object_x.w = origin.x;
    record.world_from_object_y.w = origin.y;
    record.world_from_object_z.w = origin.z;
}

void setFree(const Box3& box, shared::Pose& pose, PoseRows& rows)
{
    constexpr float kRounding = 1.0001f;
    rows.bounds.box_min = box.min;
    rows.bounds.box_max = box.max;
    pose.flags |= shared::kPoseFree;
    pose.free_bounds_center = box.center();
    const float scale = rows.record.scale_max;
    pose.free_bounds_radius = scale > 0 ? kRounding * 0.5f * length(box.max - box.min) / scale : 0.0f;
}

/// Appends the tables one after the other.
class DeformationLayoutBuilder
{
public:
    DeformationLayoutBuilder(const formats::PackView& pack, std::vector<shared::MeshBounds>& bounds,
                             std::vector<shared::Instance>& instances)
        : pack_(pack), clusters_(pack, bounds), bounds_(bounds), instances_(instances)
    {
    }

    DeformationLayout run()
    {
        rows_.add(header_);
        header_.instance_word = rows_.nextWord();
        layout_.words.resize(layout_.words.size() + instances_.size(), 0);
        rows_.finishRow();
        addClusters();
        for (uint32_t i = 0; i < instances_.size(); ++i)
            if (const auto* mesh = pack::findDeformedMesh(pack_, instances_[i].mesh))
                addInstance(i, *mesh);
        std::memcpy(layout_.words.data(), &header_, sizeof(header_));
        const std::vector<PoseRows> poses = makeRestPoses(pack_, layout_);
        for (size_t i = 0; i < poses.size(); ++i)
            applyRows(layout_.instances[i], poses[i], layout_, bounds_, instances_);
        return std::move(layout_);
    }

private:
    void addClusters()
    {
        const uint32_t first_joint_word = rows_.nextWord();
        rows_.addWords(pack_.clusterJoints());
        rows_.finishRow();
        for (const formats::DeformedMeshRecord& mesh : pack_.deformedMeshes())
        {
            const uint32_t first = pack_.meshes()[mesh.mesh].clusters.first;
            cluster_rows_.push_back(rows_.nextRow() - first * shared::kDeformedClusterRows);
            clusters_.add(mesh, first_joint_word, rows_);
            layout_.block_words = std::max(layout_.block_words, scratchWords(pack_, mesh));
        }
    }

    void addInstance(uint32_t number, const formats::DeformedMeshRecord& mesh)
    {
        const formats::MeshRecord& record = pack_.meshes()[mesh.mesh];
        DeformedInstance instance{
            .instance = number,
            .anchor = mesh.anchor,
            .joint_count = mesh.skin == kInvalidIndex ? 1 : pack_.skins()[mesh.skin].joints.count,
            .target_count = record.morph_target_count,
            .pose_row = rows_.nextRow(),
            .cluster_row = cluster_rows_[static_cast<size_t>(&mesh - pack_.deformedMeshes().data())],
            .record = instances_[number],
            .clip_bounds = expandBox({mesh.box_min, mesh.box_max}, clusters_.slack(mesh)),
            .bind_bounds = clusters_.bindBox(mesh)};
        instance.row_count =
            shared::kPoseRows + instance.joint_count * shared::kPaletteRows + (instance.target_count + 3) / 4;
        instance.record.mesh = static_cast<uint32_t>(bounds_.size());
        instance.record.flags |= shared::kInstanceMoved;
        bounds_.push_back(bounds_[mesh.mesh]);
        layout_.words[header_.instance_word + number] = instance.pose_row;
        rows_.addRows(instance.row_count);
        layout_.max_rows = std::max(layout_.max_rows, instance.row_count);
        layout_.instanced_clusters += record.clusters.count;
        layout_.instances.push_back(instance);
    }

    const formats::PackView& pack_;
    ClusterTable clusters_;
    std::vector<shared::MeshBounds>& bounds_;
    std::vector<shared::Instance>& instances_;
    DeformationLayout layout_;
    RowWriter rows_{layout_.words};
    shared::DeformationHeader header_{};
    std::vector<uint32_t> cluster_rows_; ///< per deformed mesh, as shared::Pose
};

} // namespace

DeformationLayout makeDeformationLayout(const formats::PackView& pack,
                                        std::vector<shared::MeshBounds>& bounds,
                                        std::vector<shared::Instance>& instances)
{
    return pack.deformedMeshes().empty() ? DeformationLayout{}
                                         : DeformationLayoutBuilder(pack, bounds, instances).run();
}

void placeScratch(DeformationLayout& layout, uint32_t first_word, uint64_t bytes)
{
    if (layout.words.empty())
        return;
    shared::DeformationHeader header;
    std::memcpy(&header, layout.words.data(), sizeof(header));
    header.scratch_word = first_word;
    header.block_words = layout.block_words;
    const uint64_t fitting = layout.block_words == 0 ? 0 : bytes / (layout.block_words * 4);
    header.block_count = static_cast<uint32_t>(std::min(fitting, layout.instanced_clusters));
    std::memcpy(layout.words.data(), &header, sizeof(header));
}

bool poseInstance(const DeformedInstance& instance, const InstancePose& pose, PoseRows& rows)
{
    HEARTH_ASSERT(pose.world_from_bind.size() == instance.joint_count &&
                  pose.morph_weights.size() == instance.target_count);
    const Affine3d& anchor = pose.world_from_bind[instance.anchor];
    const auto anchored = narrowed(anchor);
    if (!anchored)
        return false;
    rows.words.resize(instance.row_count * kRowWords);
    std::byte* next = reinterpret_cast<std::byte*>(rows.words.data()) + sizeof(shared::Pose);
    const bool mirrored = (instance.record.flags & formats::kInstanceMirrored) != 0;
    rows.record = instance.record;
    rows.record.scale_max = 0;
    shared::TransformedBox free_box = shared::makeEmptyFreeBox(instance.record);
    float stretch = 1;
    for (const float weight : pose.morph_weights)
        stretch = std::max(stretch, std::abs(weight));
    for (const Affine3d& world_from_bind : pose.world_from_bind)
    {
        const auto origin_from_bind = narrowed(makeRelative(anchor, world_from_bind));
        if (!origin_from_bind)
            return false;
        const shared::PaletteRow row = paletteRow(*origin_from_bind, mirrored);
        std::memcpy(next, &row, sizeof(row));
        next += sizeof(row);
        rows.record.scale_max = std::max(rows.record.scale_max, scaleBound(*origin_from_bind));
        free_box =
            shared::growByJoint(free_box, row, instance.bind_bounds.min, instance.bind_bounds.max, stretch);
    }
    const auto weights = std::as_bytes(pose.morph_weights);
    std::copy(weights.begin(), weights.end(), next);
    shared::Pose header{.palette_row = instance.pose_row + shared::kPoseRows,
                        .morph_word = static_cast<uint32_t>((instance.pose_row + shared::kPoseRows +
                                                             instance.joint_count * shared::kPaletteRows) *
                                                            kRowWords),
                        .cluster_row = instance.cluster_row,
                        .flags = 0,
                        .free_bounds_center = {},
                        .free_bounds_radius = 0,
                        .free_box_scale = stretch,
                        .unused_x = 0,
                        .unused_y = 0,
                        .unused_z = 0};
    const Float3 origin{anchored->m[0][3], anchored->m[1][3], anchored->m[2][3]};
    setTransform(rows.record, pose.free ? Affine3{} : *anchored, origin);
    rows.bounds.grid_step = 0; // no grid: nothing of a deformed instance is found by it
    rows.bounds.box_min = instance.clip_bounds.min;
    rows.bounds.box_max = instance.clip_bounds.max;
    if (pose.free)
        setFree({free_box.box_min, free_box.box_max}, header, rows);
    std::memcpy(rows.words.data(), &header, sizeof(header));
    return std::all_of(pose.morph_weights.begin(), pose.morph_weights.end(),
                       [](float weight) { return std::isfinite(weight); });
}

std::optional<Sphere> freeSphere(const PoseRows& rows)
{
    shared::Pose pose;
    std::memcpy(static_cast<void*>(&pose), rows.words.data(), sizeof(pose));
    if ((pose.flags & shared::kPoseFree) == 0)
        return std::nullopt;
    return Sphere{pose.free_bounds_center, pose.free_bounds_radius * rows.record.scale_max};
}

/// Uses the bind pose if the poses of the nodes do not fit into floats.
std::vector<PoseRows> makeRestPoses(const formats::PackView& pack, const DeformationLayout& layout)
{
    const pack::PosePlayer player(pack);
    std::vector<PoseRows> poses(layout.instances.size());
    std::vector<Affine3d> palette;
    std::vector<float> weights;
    for (size_t i = 0; i < poses.size(); ++i)
    {
        const DeformedInstance& instance = layout.instances[i];
        const pack::PosedInstance& posed = player.posed()[i];
        if (!poseInstance(instance,
                          {.instance = instance.instance,
                           .world_from_bind = posed.world_from_bind,
                           .morph_weights = posed.morph_weights},
                          poses[i]))
            poseInstance(instance, makeUnitPose(instance, palette, weights), poses[i]);
    }
    return poses;
}

const DeformedInstance* findDeformed(const DeformationLayout& layout, uint32_t instance)
{
    const auto found = std::lower_bound(layout.instances.begin(), layout.instances.end(), instance,
                                        [](const DeformedInstance& deformed, uint32_t number)
                                        { return deformed.instance < number; });
    return found != layout.instances.end() && found->instance == instance ? &*found : nullptr;
}

} // namespace hearth::gpu
