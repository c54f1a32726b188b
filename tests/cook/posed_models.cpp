// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/posed_models.h"

#include "formats/vertex_codec.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <tbb/parallel_for.h>

namespace hearth::test
{

using namespace formats;
using motion::Box3d;
using motion::Interval;
using skinning::DeformedCluster;

namespace
{

constexpr size_t kTriangles = 128;

Float3 bindPosition(const mesh::SourceMesh& mesh, uint32_t vertex)
{
    return mesh.bind_pose.positions.empty() ? mesh.positions[vertex] : mesh.bind_pose.positions[vertex];
}

DeformedCluster clusterOf(const mesh::SourceMesh& mesh, std::span<const uint32_t> triangles)
{
    DeformedCluster cluster;
    std::map<uint32_t, uint32_t> numbers;
    std::vector<uint32_t> vertices;
    for (const uint32_t triangle : triangles)
        for (uint32_t corner = 0; corner < 3; ++corner)
        {
            const uint32_t vertex = mesh.indices[triangle * 3 + corner];
            const auto [at, is_new] = numbers.emplace(vertex, static_cast<uint32_t>(vertices.size()));
            if (is_new)
                vertices.push_back(vertex);
            cluster.indices.push_back(at->second);
        }
    cluster.influences = static_cast<uint32_t>(mesh.joint_sets.size() * 4);
    for (const uint32_t vertex : vertices)
    {
        cluster.positions.push_back(bindPosition(mesh, vertex));
        double sum = 0;
        for (const auto& set : mesh.weight_sets)
            sum +=
                double{set[vertex].x} + double{set[vertex].y} + double{set[vertex].z} + double{set[vertex].w};
        for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
        {
            const Float4 w = mesh.weight_sets[set][vertex];
            for (const uint16_t joint : mesh.joint_sets[set][vertex].joint)
                cluster.joints.push_back(joint);
            for (const float weight : {w.x, w.y, w.z, w.w})
                cluster.weights.push_back(double{weight} / sum);
        }
    }
    for (uint32_t target = 0; target < mesh.morph_targets.size(); ++target)
    {
        const std::vector<Float3>& deltas = mesh.morph_targets[target].positions;
        if (deltas.empty() ||
            std::all_of(vertices.begin(), vertices.end(), [&](uint32_t v) { return deltas[v] == Float3{}; }))
            continue;
        skinning::MorphDeltas morph{target, {}};
        for (const uint32_t vertex : vertices)
            morph.positions.push_back(deltas[vertex]);
        cluster.morphs.push_back(std::move(morph));
    }
    return cluster;
}

void split(const mesh::SourceMesh& mesh, std::span<uint32_t> triangles,
           std::vector<DeformedCluster>& clusters)
{
    if (triangles.size() <= kTriangles)
    {
        clusters.push_back(clusterOf(mesh, triangles));
        return;
    }
    const auto center = [&](uint32_t t)
    {
        return bindPosition(mesh, mesh.indices[t * 3]) + bindPosition(mesh, mesh.indices[t * 3 + 1]) +
               bindPosition(mesh, mesh.indices[t * 3 + 2]);
    };
    Box3 box;
    for (const uint32_t t : triangles)
        box.add(center(t));
    const Float3 size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto half = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::nth_element(triangles.begin(), half, triangles.end(),
                     [&](uint32_t a, uint32_t b) { return center(a)[axis] < center(b)[axis]; });
    split(mesh, triangles.first(triangles.size() / 2), clusters);
    split(mesh, triangles.subspan(triangles.size() / 2), clusters);
}

struct Vertex
{
    Double3 bound;
};

/// A cluster with its bounds, and how far its vertices have come.
struct Watched
{
    const DeformedCluster* cluster;
    skinning::DeformedBounds bounds;
    Box3d tight;
    size_t violations = 0;
    double worst = 0;
    size_t facing_wrong = 0;
};

Double3 placeOf(const DeformedCluster& cluster, size_t v, std::span<const Affine3d> main_from_bind,
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

/// Eyes from which the cone says that nothing is to be seen: right at its border.
void lookAtCone(Watched& watched, std::span<const Double3> places, double angle)
{
    const DeformedClusterRecord& record = watched.bounds.record;
    if (record.cone_cutoff == kNoCone)
        return;
    const Double3 axis = widen(NormalCode<8>::decode(record.cone_axis));
    const Double3 middle = (widen(record.box_min) + widen(record.box_max)) * 0.5;
    const Double3 apex = middle - axis * double{record.cone_back};
    // the direction from eye to apex is just as far from the axis as the cutoff allows
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

void watch(Watched& watched, std::span<const Affine3d> main_from_bind, const std::vector<double>& weights,
           double angle)
{
    const Box3 box{watched.bounds.record.box_min, watched.bounds.record.box_max};
    std::vector<Double3> places;
    for (size_t v = 0; v < watched.cluster->positions.size(); ++v)
    {
        const Double3 place = placeOf(*watched.cluster, v, main_from_bind, weights);
        add(watched.tight, place);
        const Double3 below = widen(box.min) - place, above = place - widen(box.max);
        const double out = std::max({below.x, below.y, below.z, above.x, above.y, above.z});
        if (!(out <= 0))
        {
            ++watched.violations;
            watched.worst = std::max(watched.worst, out);
        }
        places.push_back(place);
    }
    lookAtCone(watched, places, angle);
}

/// All joints as one of them sees them; nothing where it is flat in this pose.
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

double volumeRatio(const Watched& watched)
{
    // flat clusters: a thousandth of their size counts as thick
    const Double3 loose = widen(watched.bounds.record.box_max) - widen(watched.bounds.record.box_min);
    const double least = 1e-3 * std::max({loose.x, loose.y, loose.z});
    const auto side = [&](const Interval& axis) { return std::max(2 * axis.half(), least); };
    return std::max(loose.x, least) * std::max(loose.y, least) * std::max(loose.z, least) /
           (side(watched.tight[0]) * side(watched.tight[1]) * side(watched.tight[2]));
}

} // namespace

std::vector<DeformedCluster> clustersOf(const mesh::SourceMesh& mesh)
{
    std::vector<uint32_t> triangles(mesh.triangleCount());
    std::iota(triangles.begin(), triangles.end(), 0u);
    std::vector<DeformedCluster> clusters;
    split(mesh, triangles, clusters);
    return clusters;
}

std::vector<Box3d> reachOf(std::span<const DeformedCluster> clusters, uint32_t joints)
{
    std::vector<Box3d> reach(joints);
    for (const DeformedCluster& cluster : clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            if (cluster.weights[i] > 0)
                add(reach[cluster.joints[i]], widen(cluster.positions[i / cluster.influences]));
    return reach;
}

PoseSource::PoseSource(const MotionTables& tables, uint32_t seed)
    : tables_(tables),
      random_(seed),
      from_(restPose(tables)),
      to_(from_),
      blend_(from_),
      parents_first_(parentsFirst(tables.nodes)),
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
    // one in eight at a key: extremes stand there
    double time = std::uniform_real_distribution<double>(-0.1, 1.1)(random_) * double{animation.duration};
    if (random_() % 8 == 0 && animation.channels.count > 0)
    {
        const AnimationChannelRecord& channel =
            tables_.channels[animation.channels.first + random_() % animation.channels.count];
        time = tables_.keys[channel.first_time + random_() % channel.key_count];
    }
    sampleAnimation(tables_, animation, time, pose);
}

const ScenePose& PoseSource::next()
{
    sample(from_);
    sample(to_);
    // half of the poses are those of one clip alone
    const double weight = random_() % 2 == 0 ? 0.0 : std::uniform_real_distribution<double>(0, 1)(random_);
    blendPoses(from_, to_, weight, blend_);
    return place();
}

std::vector<Affine3d> PoseSource::palette(uint32_t skin, uint32_t node) const
{
    if (skin == kNone)
        return {world_from_node_[node]};
    std::vector<Affine3d> palette(tables_.skins[skin].joints.count);
    skinPalette(tables_, tables_.skins[skin], world_from_node_, palette);
    return palette;
}

BoundsFigures checkBounds(const MotionTables& tables, const PosedMesh& mesh, size_t poses, uint32_t seed)
{
    const std::vector<motion::NodeMotion> nodes = motion::nodeMotions(tables);
    std::optional<motion::SkinMotion> skin;
    if (mesh.skin != kNone)
        skin.emplace(tables, nodes, mesh.skin, mesh.reach);
    const skinning::Deformation deformation{skin ? &*skin : nullptr, mesh.morph_weights};
    std::vector<Watched> watched(mesh.clusters.size());
    tbb::parallel_for(size_t{0}, watched.size(),
                      [&](size_t i)
                      {
                          watched[i].cluster = &mesh.clusters[i];
                          watched[i].bounds = boundsOf(mesh.clusters[i], deformation);
                      });
    PoseSource source(tables, seed);
    std::mt19937 random(seed + 1);
    for (size_t p = 0; p < poses; ++p)
    {
        const ScenePose& pose = p == 0 ? source.rest() : source.next();
        const std::vector<Affine3d> palette = source.palette(mesh.skin, mesh.node);
        std::vector<std::optional<std::vector<Affine3d>>> seen(palette.size());
        for (const Watched& w : watched)
            if (const uint32_t main = w.bounds.record.joint; !seen[main])
                seen[main] = seenFrom(palette, main);
        const Range range = tables.nodes[mesh.node].morph_weights;
        const std::vector<double> weights(pose.morph_weights.begin() + range.first,
                                          pose.morph_weights.begin() + range.first + range.count);
        const double angle = std::uniform_real_distribution<double>(0, 6.283)(random);
        tbb::parallel_for(size_t{0}, watched.size(),
                          [&](size_t i)
                          {
                              if (const auto& matrices = seen[watched[i].bounds.record.joint])
                                  watch(watched[i], *matrices, weights, angle);
                          });
    }
    BoundsFigures figures;
    for (const Watched& w : watched)
    {
        figures.violations += w.violations;
        figures.worst = std::max(figures.worst, w.worst);
        if (getenv("DBG")) { auto&r=w.bounds.record; printf("  main %d joints", r.joint); for (auto j: w.bounds.joints) { double sum=0; for(size_t i=0;i<w.cluster->joints.size();++i) if(w.cluster->joints[i]==j) sum+=w.cluster->weights[i]; printf(" %u(%.0f)", j,sum);} printf(" ratio %.2f  axes", volumeRatio(w)); for(int a=0;a<3;++a) printf(" %.3f/%.3f", r.box_max[a]-r.box_min[a], 2*w.tight[size_t(a)].half()); printf("\n"); }
        figures.volume_ratio += volumeRatio(w) / static_cast<double>(watched.size());
        figures.facing_wrong += w.facing_wrong;
        figures.cones += w.bounds.record.cone_cutoff != kNoCone ? 1 : 0;
    }
    figures.clusters = watched.size();
    return figures;
}

} // namespace hearth::test
