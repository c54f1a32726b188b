// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/animation/posed_models.h"

#include "cook/skinning/group_spheres.h"
#include "cook/skinning/read_clusters.h"
#include "formats/codecs/channel_keys.h"
#include "formats/codecs/vertex_codec.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace hearth::test
{

using namespace formats;
using animation_bounds::Box3d;
using animation_bounds::Interval;
using skinning::DeformedCluster;

namespace
{

/// Cluster with its bounds, and the extremes that its vertices reach.
struct Watched
{
    const DeformedCluster* cluster;
    const DeformedClusterRecord* bounds;
    std::span<const uint32_t> joints; ///< entries of chunk DJNT
    Sphere sphere;
    Box3d tight; ///< in the cluster's frame
    size_t violations = 0;
    double worst = 0;
    size_t facing_wrong = 0;
};

Double3 computePlace(const DeformedCluster& cluster, size_t v, std::span<const Affine3d> main_from_bind,
                     const std::vector<double>& weights)
{
    Double3 bound = widen(cluster.positions[v]);
    for (const skinning::MorphDeltas& morph : cluster.morphs)
        bound = bound + widen(morph.positions[v]) * weights[morph.target];
    if (cluster.influences == 0)
        return bound;
    Double3 place;
    for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
        if (cluster.weights[i] > 0)
            place = place + transformPoint(main_from_bind[cluster.joints[i]], bound) * cluster.weights[i];
    return place;
}

/// Eye positions for which the cone just culls the cluster.
void lookAtCone(Watched& watched, std::span<const Double3> places, double angle)
{
    const DeformedClusterRecord& record = *watched.bounds;
    if (record.cone_cutoff == kNoCone)
        return;
    const Double3 axis = widen(NormalCode<8>::decode(record.cone_axis));
    const Double3 middle = (widen(record.box_min) + widen(record.box_max)) * 0.5;
    const Double3 apex = middle - axis * double{record.cone_back};
    // the direction from eye to apex deviates from the axis by exactly the cutoff angle
    const double sine = record.cone_cutoff / 65536.0;
    const Double3 other = std::abs(axis.x) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    Double3 side = cross(axis, other);
    side = side * (1 / length(side));
    const Double3 up = cross(axis, side);
    const Double3 across = side * std::cos(angle) + up * std::sin(angle);
    const Double3 direction = axis * sine + across * std::sqrt(1 - sine * sine);
    const double size = length(widen(record.box_max) - middle);
    for (const double distance : {0.01, 1.0, 100.0})
    {
        const Double3 eye = apex - direction * (distance * size);
        for (size_t i = 0; i < watched.cluster->indices.size(); i += 3)
        {
            const Double3 a = places[watched.cluster->indices[i]];
            const Double3 normal = cross(places[watched.cluster->indices[i + 1]] - a,
                                         places[watched.cluster->indices[i + 2]] - a);
            if (dot(eye - a, normal) > 1e-9 * length(eye - a) * length(normal))
                ++watched.facing_wrong;
        }
    }
}

void note(Watched& watched, double out)
{
    if (out <= 0)
        return;
    ++watched.violations;
    watched.worst = std::max(watched.worst, out);
}

double outside(const Box3& box, Double3 place)
{
    const Double3 below = widen(box.min) - place, above = place - widen(box.max);
    return std::max({below.x, below.y, below.z, above.x, above.y, above.z});
}

/// frame_from_main   to the space of the cluster's box
/// anchor_from_main  empty if the anchor's matrix is singular in this pose
void watch(Watched& watched, const Box3& mesh_box, std::span<const Affine3d> main_from_bind,
           const Affine3d& frame_from_main, const std::optional<Affine3d>& anchor_from_main,
           const std::vector<double>& weights, double angle)
{
    const Box3 box{watched.bounds->box_min, watched.bounds->box_max};
    std::vector<Double3> places;
    for (size_t v = 0; v < watched.cluster->positions.size(); ++v)
    {
        const Double3 place = computePlace(*watched.cluster, v, main_from_bind, weights);
        const Double3 framed = transformPoint(frame_from_main, place);
        add(watched.tight, framed);
        note(watched, outside(box, framed));
        places.push_back(place);
        if (!anchor_from_main)
            continue;
        const Double3 anchored = transformPoint(*anchor_from_main, place);
        note(watched, length(anchored - widen(watched.sphere.center)) - double{watched.sphere.radius});
        note(watched, outside(mesh_box, anchored));
    }
    lookAtCone(watched, places, angle);
}

/// Return the transform from the main bone to the cluster's frame. Not the function of formats/scene, which
/// is part of what is tested.
/// main_from_bind  transforms of all joints relative to the main bone
std::optional<Affine3d> frameFromMain(std::span<const Affine3d> main_from_bind,
                                      std::span<const uint32_t> joints)
{
    Affine3d main_from_frame;
    for (const uint32_t entry : joints)
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 4; ++column)
                main_from_frame.m[row][column] +=
                    (entry >> 16) / 65536.0 *
                    (main_from_bind[entry & 0xffff].m[row][column] - (row == column ? 1 : 0));
    return inverted(main_from_frame);
}

/// Transforms of all joints relative to one joint; empty if its matrix is singular in this pose.
std::optional<std::vector<Affine3d>> seenFrom(std::span<const Affine3d> palette, uint32_t main)
{
    const std::optional<Affine3d> inverse = inverted(palette[main]);
    if (!inverse)
        return std::nullopt;
    std::vector<Affine3d> seen;
    for (const Affine3d& matrix : palette)
        seen.push_back(*inverse * matrix);
    return seen;
}

/// Volumes of a cluster's box and of the smallest box around the vertices in all poses.
struct Volumes
{
    double box;
    double tightest;
};

Volumes volumesFrom(const Watched& watched)
{
    // flat clusters: count a thousandth of their size as their thickness
    const Double3 loose = widen(watched.bounds->box_max) - widen(watched.bounds->box_min);
    const double least = 1e-3 * std::max({loose.x, loose.y, loose.z});
    const auto side = [&](const Interval& axis) { return std::max(2 * axis.half(), least); };
    return {std::max(loose.x, least) * std::max(loose.y, least) * std::max(loose.z, least),
            side(watched.tight[0]) * side(watched.tight[1]) * side(watched.tight[2])};
}

/// For each joint, the bounding box of the positions that it moves.
std::vector<Box3d> computeReach(std::span<const DeformedCluster> clusters, uint32_t joints)
{
    std::vector<Box3d> reach(joints);
    for (const DeformedCluster& cluster : clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            if (cluster.weights[i] > 0)
                add(reach[cluster.joints[i]], widen(cluster.positions[i / cluster.influences]));
    return reach;
}

size_t countTargets(std::span<const DeformedCluster> clusters)
{
    size_t count = 0;
    for (const DeformedCluster& cluster : clusters)
        for (const skinning::MorphDeltas& morph : cluster.morphs)
            count = std::max(count, size_t{morph.target} + 1);
    return count;
}

} // namespace

Result<std::vector<PosedMesh>> posedMeshes(const PackView& pack)
{
    std::vector<PosedMesh> meshes;
    for (const DeformedMeshRecord& record : pack.deformedMeshes())
    {
        const uint32_t joints = record.skin == kInvalidIndex ? 0 : pack.skins()[record.skin].joints.count;
        PosedMesh mesh;
        mesh.skin = record.skin;
        mesh.anchor = record.anchor;
        mesh.box = {record.box_min, record.box_max};
        HEARTH_ASSIGN_OR_RETURN(mesh.clusters, skinning::readClusters(pack, record.mesh, joints));
        const std::span<const DeformedClusterRecord> bounds =
            pack.deformedClusters().subspan(record.clusters.first, record.clusters.count);
        mesh.bounds.assign(bounds.begin(), bounds.end());
        for (const DeformedClusterRecord& cluster : bounds)
        {
            const auto entries = recordsInRange(pack.clusterJoints(), cluster.joints);
            mesh.joints.emplace_back(entries.begin(), entries.end());
        }
        const Range clusters = pack.meshes()[record.mesh].clusters;
        for (const ClusterRecord& cluster : pack.clusters().subspan(clusters.first, clusters.count))
        {
            const GroupRecord& group = pack.groups()[cluster.group];
            mesh.spheres.push_back({group.sphere_center, group.sphere_radius});
            mesh.levels.push_back(cluster.level);
        }
        for (uint32_t node = 0; node < pack.nodes().size(); ++node)
            if (pack.nodes()[node].mesh == record.mesh)
            {
                mesh.node = node;
                meshes.push_back(mesh);
            }
    }
    return meshes;
}

void computeBounds(const AnimationTables& tables, PosedMesh& mesh)
{
    const std::vector<animation_bounds::NodeMotion> nodes = animation_bounds::nodeMotions(tables);
    const std::vector<Interval> morph_weights =
        animation_bounds::morphWeightRanges(tables, mesh.node, countTargets(mesh.clusters));
    const uint32_t joints = mesh.skin == kInvalidIndex ? 0 : tables.skins[mesh.skin].joints.count;
    const std::vector<Box3d> reach = computeReach(mesh.clusters, joints);
    std::optional<animation_bounds::SkinMotion> skin;
    if (mesh.skin != kInvalidIndex)
        skin.emplace(tables, nodes, mesh.skin, reach);
    const animation_bounds::PoseRegions regions(tables, nodes);
    const skinning::Deformation deformation{skin ? &*skin : nullptr, morph_weights, &regions};
    for (const skinning::DeformedBounds& bounds : computeClusterBounds(mesh.clusters, deformation))
    {
        mesh.bounds.push_back(bounds.record);
        mesh.joints.push_back(bounds.joints);
    }
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters;
    for (uint32_t i = 0; i < mesh.clusters.size(); ++i)
    {
        GroupRecord group{};
        group.clusters = {i, 1};
        groups.push_back(group);
        ClusterRecord cluster{};
        cluster.group = i;
        cluster.refined_group = kInvalidIndex;
        clusters.push_back(cluster);
    }
    const skinning::AnchoredBounds anchored =
        skinning::computeAnchoredBounds({groups, clusters, 0, 0}, mesh.clusters, deformation, reach);
    mesh.levels.assign(mesh.clusters.size(), 0);
    mesh.anchor = anchored.anchor;
    mesh.box = anchored.box;
    mesh.spheres = anchored.spheres;
}

PoseSource::PoseSource(const AnimationTables& tables, uint32_t seed)
    : tables_(tables),
      random_(seed),
      from_(restPose(tables)),
      to_(from_),
      blend_(from_),
      parents_first_(nodesParentsFirst(tables.nodes)),
      world_from_node_(tables.nodes.size())
{
}

const ScenePose& PoseSource::place()
{
    poseNodes(tables_, blend_, parents_first_, world_from_node_);
    return blend_;
}

const ScenePose& PoseSource::rest()
{
    blend_ = restPose(tables_);
    return place();
}

void PoseSource::sample(ScenePose& pose)
{
    pose = restPose(tables_);
    if (tables_.animations.empty())
        return;
    const AnimationRecord& animation =
        tables_.animations[std::uniform_int_distribution<size_t>(0, tables_.animations.size() - 1)(random_)];
    // one in eight times is a key, since extremes lie there
    double time = std::uniform_real_distribution<double>(-0.1, 1.1)(random_) * double{animation.duration};
    if (random_() % 8 == 0 && animation.channels.count > 0)
    {
        const AnimationChannelRecord& channel =
            tables_.channels[animation.channels.first + random_() % animation.channels.count];
        time = double{ChannelKeys(tables_.keys, tables_.key_bits, channel)
                          .time(static_cast<uint32_t>(random_() % channel.key_count))};
    }
    sampleAnimation(tables_, animation, time, pose);
}

const ScenePose& PoseSource::next()
{
    sample(from_);
    sample(to_);
    // half of the poses are of a single clip
    const double weight = random_() % 2 == 0 ? 0.0 : std::uniform_real_distribution<double>(0, 1)(random_);
    blendPoses(from_, to_, weight, blend_);
    if (random_() % 2 == 0)
        for (double& morph_weight : blend_.morph_weights)
            morph_weight = std::clamp(std::uniform_real_distribution<double>(-0.5, 1.5)(random_), 0.0, 1.0);
    return place();
}

std::vector<Affine3d> PoseSource::palette(uint32_t skin, uint32_t node) const
{
    if (skin == kInvalidIndex)
        return {world_from_node_[node]};
    std::vector<Affine3d> palette(tables_.skins[skin].joints.count);
    skinPalette(tables_, tables_.skins[skin], world_from_node_, palette);
    return palette;
}

BoundsFigures& operator+=(BoundsFigures& a, const BoundsFigures& b)
{
    a.clusters += b.clusters;
    a.poses += b.poses;
    a.violations += b.violations;
    a.worst = std::max(a.worst, b.worst);
    a.volume_ratio += b.volume_ratio;
    a.volume += b.volume;
    a.tightest_volume += b.tightest_volume;
    a.finest_clusters += b.finest_clusters;
    a.finest_volume_ratio += b.finest_volume_ratio;
    a.cones += b.cones;
    a.facing_wrong += b.facing_wrong;
    return a;
}

BoundsFigures checkBounds(const AnimationTables& tables, const PosedMesh& mesh, size_t poses, uint32_t seed)
{
    std::vector<Watched> watched;
    for (size_t i = 0; i < mesh.clusters.size(); ++i)
        watched.push_back({&mesh.clusters[i], &mesh.bounds[i], mesh.joints[i], mesh.spheres[i], {}});
    PoseSource source(tables, seed);
    std::mt19937 random(seed + 1);
    const size_t targets = countTargets(mesh.clusters);
    for (size_t p = 0; p < poses; ++p)
    {
        const ScenePose& pose = p == 0 ? source.rest() : source.next();
        const std::vector<Affine3d> palette = source.palette(mesh.skin, mesh.node);
        std::vector<std::optional<std::vector<Affine3d>>> seen(palette.size());
        const auto see = [&](uint32_t main)
        {
            if (!seen[main])
                seen[main] = seenFrom(palette, main);
        };
        for (const Watched& w : watched)
            see(w.bounds->joint);
        const std::optional<Affine3d> anchor_from_world = inverted(palette[mesh.anchor]);
        const Range range = tables.nodes[mesh.node].morph_weights;
        std::vector<double> weights(pose.morph_weights.begin() + range.first,
                                    pose.morph_weights.begin() + range.first + range.count);
        weights.resize(std::max(weights.size(), targets));
        const double angle = std::uniform_real_distribution<double>(0, 6.283)(random);
        tbb::parallel_for(
            size_t{0}, watched.size(),
            [&](size_t i)
            {
                const uint32_t main = watched[i].bounds->joint;
                if (!seen[main])
                    return;
                std::optional<Affine3d> anchor_from_main;
                if (anchor_from_world)
                    anchor_from_main = *anchor_from_world * palette[main];
                const std::optional<Affine3d> frame = frameFromMain(*seen[main], watched[i].joints);
                if (!frame)
                    return note(watched[i], std::numeric_limits<double>::infinity());
                watch(watched[i], mesh.box, *seen[main], *frame, anchor_from_main, weights, angle);
            });
    }
    BoundsFigures figures;
    figures.clusters = watched.size();
    figures.poses = poses;
    for (size_t i = 0; i < watched.size(); ++i)
    {
        const Watched& w = watched[i];
        const Volumes volumes = volumesFrom(w);
        figures.volume += volumes.box;
        figures.tightest_volume += volumes.tightest;
        if (mesh.levels[i] == 0)
        {
            ++figures.finest_clusters;
            figures.finest_volume_ratio += volumes.box / volumes.tightest;
        }
        figures.violations += w.violations;
        figures.worst = std::max(figures.worst, w.worst);
        figures.volume_ratio += volumes.box / volumes.tightest;
        figures.facing_wrong += w.facing_wrong;
        figures.cones += w.bounds->cone_cutoff != kNoCone ? 1 : 0;
    }
    return figures;
}

} // namespace hearth::test
