// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/deformed_scene.h"

#include "cook/clusters/core/hierarchy.h"
#include "formats/codecs/vertex_codec.h"
#include "tests/support/shapes.h"

#include <cmath>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr float kLength = 2;
constexpr double kTurn = 6.283185307179586;

struct TubeVertex
{
    Float3 position;
    Float3 normal;
};

TubeVertex tubeVertex(float along, float around)
{
    const float c = std::cos(around), s = std::sin(around);
    const float belly = std::sqrt(std::max(0.0f, 1 - (2 * along - 1) * (2 * along - 1)));
    const float radius = 0.02f + 0.22f * belly * (1 + 0.12f * std::sin(5 * around) * std::sin(23 * along));
    return {{radius * c, kLength * along, radius * s},
            normalizeOr({c, 0.8f * (2 * along - 1), s}, {0, 1, 0})};
}

/// A closed tube along y with a seam in its UVs.
mesh::SourceMesh makeTube(uint32_t rings, uint32_t sides)
{
    mesh::SourceMesh mesh;
    for (uint32_t j = 0; j <= rings; ++j)
        for (uint32_t i = 0; i <= sides; ++i)
        {
            const float along = static_cast<float>(j) / static_cast<float>(rings);
            const float around =
                static_cast<float>(kTurn) * static_cast<float>(i % sides) / static_cast<float>(sides);
            const TubeVertex vertex = tubeVertex(along, around);
            mesh.positions.push_back(vertex.position);
            mesh.normals.push_back(vertex.normal);
            mesh.tangents.push_back({-std::sin(around), 0, std::cos(around), 1});
            mesh.uvs[0].push_back({static_cast<float>(i) / static_cast<float>(sides), along});
        }
    const uint32_t row = sides + 1;
    for (uint32_t j = 0; j < rings; ++j)
        for (uint32_t i = 0; i < sides; ++i)
        {
            const uint32_t at = j * row + i;
            for (const uint32_t index : {at, at + row, at + row + 1, at, at + row + 1, at + 1})
                mesh.indices.push_back(index);
        }
    for (const uint32_t j : {0u, rings})
        for (uint32_t i = 1; i + 1 < sides; ++i)
            for (const uint32_t k : {0u, j == 0 ? i : i + 1, j == 0 ? i + 1 : i})
                mesh.indices.push_back(j * row + k);
    mesh.face_count = static_cast<uint32_t>(mesh.triangleCount());
    mesh.source_vertex_count = static_cast<uint32_t>(mesh.vertexCount());
    return mesh;
}

/// Add weights that fall with the distance from the joints, which stand along y; `width` in steps between two
/// joints.
void addInfluences(mesh::SourceMesh& mesh, uint32_t joint_count, float width)
{
    const uint32_t sets = width > 2 ? 2 : 1;
    mesh.joint_sets.assign(sets, {});
    mesh.weight_sets.assign(sets, {});
    for (const Float3& position : mesh.positions)
    {
        std::vector<std::pair<float, uint16_t>> influences;
        float sum = 0;
        for (uint32_t joint = 0; joint < joint_count; ++joint)
        {
            const float at = kLength * static_cast<float>(joint) / static_cast<float>(joint_count - 1);
            const float distance =
                std::abs(position.y - at) * static_cast<float>(joint_count - 1) / (kLength * width);
            const float weight = std::max(0.0f, 1 - distance);
            influences.emplace_back(weight * weight, static_cast<uint16_t>(joint));
        }
        std::sort(influences.rbegin(), influences.rend());
        influences.resize(4 * size_t{sets});
        for (const auto& [weight, joint] : influences)
            sum += weight;
        for (uint32_t set = 0; set < sets; ++set)
        {
            const auto* four = influences.data() + 4 * size_t{set};
            mesh.joint_sets[set].push_back(
                {{four[0].second, four[1].second, four[2].second, four[3].second}});
            mesh.weight_sets[set].push_back(
                {four[0].first / sum, four[1].first / sum, four[2].first / sum, four[3].first / sum});
        }
    }
}

/// Add waves along the normal, each to another part.
void addMorphTargets(mesh::SourceMesh& mesh, uint32_t count)
{
    for (uint32_t target = 0; target < count; ++target)
    {
        mesh::MorphTarget morph;
        for (size_t v = 0; v < mesh.vertexCount(); ++v)
        {
            const float along = mesh.positions[v].y / kLength * static_cast<float>(count);
            const float wave = std::max(0.0f, 1 - std::abs(along - static_cast<float>(target) - 0.5f)) * 0.3f;
            morph.positions.push_back(mesh.normals[v] * wave);
            morph.normals.push_back(Float3{0, 0.4f, 0} * wave);
        }
        mesh.morph_targets.push_back(std::move(morph));
    }
}

std::array<double, 4> randomRotation(std::mt19937& random, double most_rad)
{
    const Float3 axis =
        normalizeOr({uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)}, {0, 0, 1});
    const double angle = static_cast<double>(uniform(random, -1, 1)) * most_rad;
    const double s = std::sin(angle / 2);
    return {axis.x * s, axis.y * s, axis.z * s, std::cos(angle / 2)};
}

Affine3d moved(double y)
{
    Affine3d t;
    t.m[1][3] = y;
    return t;
}

/// A chain of joints along y, each rotated and stretched a little relative to its parent.
std::vector<Affine3d> randomPalette(uint32_t joint_count, double most_rad, std::mt19937& random)
{
    std::vector<Affine3d> palette;
    const double step = joint_count > 1 ? double{kLength} / (joint_count - 1) : 0;
    Affine3d world_from_joint;
    for (uint32_t joint = 0; joint < joint_count; ++joint)
    {
        const double stretch = static_cast<double>(uniform(random, 0.85f, 1.15f));
        world_from_joint = world_from_joint * moved(joint == 0 ? 0 : step) *
                           makeAffineFromTrs({}, randomRotation(random, most_rad), {1, stretch, 1});
        palette.push_back(world_from_joint * moved(-step * joint));
    }
    return palette;
}

std::vector<float> randomWeights(uint32_t count, std::mt19937& random)
{
    std::vector<float> weights;
    for (uint32_t i = 0; i < count; ++i)
        weights.push_back(uniform(random, 0, 1));
    return weights;
}

/// Add the corners of a cluster's triangles in a pose, in the space of a joint or a frame.
void addCarried(const ClusterGeometry& geometry, const TestPose& pose, const Affine3d& world_from_space,
                std::vector<Double3>& corners)
{
    const auto space_from_world = inverted(world_from_space);
    HEARTH_ASSERT(space_from_world);
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        for (const uint32_t vertex : geometry.triangle(t))
            corners.push_back(
                transformPoint(*space_from_world, posedVertex(geometry, vertex, pose).position));
}

/// Give shares of the cluster's frame to the two joints after the main bone.
void shareFrame(std::span<uint32_t> joints)
{
    constexpr uint32_t kShares[] = {20'000, 6'000}; // of 65536
    for (size_t i = 1; i < std::min(joints.size(), std::size(kShares) + 1); ++i)
        joints[i] |= kShares[i - 1] << 16;
}

/// Return the sum of the joints' transforms by their shares.
Affine3d computeFrame(const TestPose& pose, uint32_t main, std::span<const uint32_t> joints)
{
    Affine3d sum{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
    const auto add = [&](uint32_t joint, double share)
    {
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 4; ++column)
                sum.m[row][column] += share * pose.world_from_bind[joint].m[row][column];
    };
    double rest = 1;
    for (const uint32_t entry : joints)
    {
        add(entry & 0xffff, (entry >> 16) / 65536.0);
        rest -= (entry >> 16) / 65536.0;
    }
    add(main, rest);
    return sum;
}

/// Extend the box by the point and a rounding error, so that it contains the point in floats.
void addSurely(Box3& box, Double3 point)
{
    const Float3 p = narrow(point);
    const Float3 slack = Float3{1, 1, 1} * (1e-6f * (1 + length(p)));
    box.add(p - slack);
    box.add(p + slack);
}

Double3 unit(Double3 v)
{
    const double size = length(v);
    return size > 0 ? v * (1 / size) : Double3{};
}

/// Compute the normal cone of the triangles, and its apex.
void setCone(const std::vector<Double3>& corners, DeformedClusterRecord& record)
{
    record.cone_cutoff = kNoCone;
    std::vector<Double3> normals;
    Double3 sum{};
    for (size_t t = 0; t + 2 < corners.size(); t += 3)
    {
        const Double3 normal = cross(corners[t + 1] - corners[t], corners[t + 2] - corners[t]);
        normals.push_back(unit(normal));
        sum = sum + normals.back();
    }
    record.cone_axis = static_cast<uint16_t>(NormalCode<8>::encode(narrow(unit(sum))));
    const Double3 axis = unit(widen(NormalCode<8>::decode(record.cone_axis)));
    double least = 1;
    for (const Double3& normal : normals)
        if (length(normal) > 0)
            least = std::min(least, dot(normal, axis));
    if (least < 0.1)
        return;
    const double cutoff = std::sqrt(1 - least * least) + 1e-4;
    record.cone_cutoff = static_cast<uint16_t>(std::min(65534.0, std::ceil(cutoff * 65536)));
    const Double3 center = widen((record.box_min + record.box_max) * 0.5f);
    double back = 0;
    for (size_t t = 0; t < normals.size(); ++t)
        if (length(normals[t]) > 0)
            back = std::max(back, dot(normals[t], center - corners[3 * t]) / dot(normals[t], axis));
    record.cone_back = static_cast<float>(back * 1.0001 + 1e-6);
}

uint32_t mainJoint(const ClusterGeometry& geometry, std::vector<uint32_t>& joints)
{
    std::vector<uint32_t> sums(256, 0);
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        for (uint32_t i = 0; i < geometry.influenceCount(); ++i)
            sums[geometry.joints(v)[i]] += geometry.weightCodes(v)[i];
    if (geometry.influenceCount() == 0)
        return 0;
    const auto largest = static_cast<uint32_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
    joints.push_back(largest);
    for (uint32_t joint = 0; joint < sums.size(); ++joint)
        if (sums[joint] > 0 && joint != largest)
            joints.push_back(joint);
    return largest;
}

/// Maximum displacement on any axis, over all targets with weights of 1 or -1.
float morphReach(const ClusterGeometry& geometry)
{
    float reach = 0;
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
    {
        Float3 sum;
        for (uint32_t i = 0; i < geometry.morphCount(); ++i)
        {
            const Float3 delta = geometry.morphPosition(i, v);
            sum += {std::abs(delta.x), std::abs(delta.y), std::abs(delta.z)};
        }
        reach = std::max({reach, sum.x, sum.y, sum.z});
    }
    return reach * 1.00001f;
}

} // namespace

std::vector<gpu::InstancePose> makeViews(const std::vector<TestPose>& poses)
{
    std::vector<gpu::InstancePose> views;
    for (const TestPose& pose : poses)
        views.push_back(pose.view());
    return views;
}

PosedVertex posedVertex(const ClusterGeometry& geometry, uint32_t vertex, const TestPose& pose)
{
    Double3 position = widen(geometry.position(vertex));
    Double3 normal = geometry.has(kVertexNormal) ? widen(geometry.normal(vertex)) : Double3{};
    for (uint32_t i = 0; i < geometry.morphCount(); ++i)
    {
        const double weight = static_cast<double>(pose.morph_weights[geometry.morphTarget(i)]);
        position = position + widen(geometry.morphPosition(i, vertex)) * weight;
        normal = normal + widen(geometry.morphNormal(i, vertex)) * weight;
    }
    Affine3d joints = pose.world_from_bind[0];
    if (geometry.influenceCount() > 0)
    {
        for (auto& row : joints.m)
            for (double& value : row)
                value = 0;
        for (uint32_t i = 0; i < geometry.influenceCount(); ++i)
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column)
                    joints.m[row][column] += geometry.weightCodes(vertex)[i] / 65535.0 *
                                             pose.world_from_bind[geometry.joints(vertex)[i]].m[row][column];
    }
    PosedVertex posed{.position = transformPoint(joints, position), .normal = {}, .tangent = {}};
    if (const auto inverse = inverted(joints))
    {
        const auto& m = inverse->m;
        posed.normal = unit({m[0][0] * normal.x + m[1][0] * normal.y + m[2][0] * normal.z,
                             m[0][1] * normal.x + m[1][1] * normal.y + m[2][1] * normal.z,
                             m[0][2] * normal.x + m[1][2] * normal.y + m[2][2] * normal.z});
    }
    if (geometry.has(kVertexTangent))
    {
        const Float4 tangent = geometry.tangent(vertex);
        posed.tangent = transformVector(joints, {tangent.x, tangent.y, tangent.z});
    }
    return posed;
}

DeformedScene::DeformedScene(const DeformedSceneOptions& options, uint32_t seed) : options_(options)
{
    std::mt19937 random(seed);
    clusters::Config config;
    config.visibility = options.visibility != nullptr;
    const uint32_t material = test_.addMaterial(plainMaterial());
    const uint32_t rock = test_.addMesh(withMaterial(shapes::rock(16, 0.3f), material));
    for (uint32_t i = 0; i < options.rocks; ++i)
        test_.addInstance(rock, randomAffine(random, options.reach));

    mesh::SourceMesh limb = withMaterial(makeTube(options.rings, 24), material);
    addInfluences(limb, 6, 1.7f);
    addDeformed(test_.addMesh(limb, config), addSkin(6), 6, options.pose_count, random);
    addInstances(meshes_.back(), options.limbs, random);

    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = kMaterialDoubleSided;
    mesh::SourceMesh tentacle = withMaterial(makeTube(options.rings, 16), test_.addMaterial(two_sided));
    addInfluences(tentacle, 12, 3.6f);
    addMorphTargets(tentacle, 3);
    addDeformed(test_.addMesh(tentacle, config), addSkin(12), 12, options.pose_count, random);
    addInstances(meshes_.back(), options.tentacles, random);

    mesh::SourceMesh blob = withMaterial(makeTube(options.rings / 2, 20), material);
    addMorphTargets(blob, 2);
    addDeformed(test_.addMesh(blob, config), kInvalidIndex, 1, options.pose_count, random);
    addInstances(meshes_.back(), options.blobs, random);

    if (options.visibility)
        test_.setVisibility(options.visibility);
    const PackView unbounded = test_.assemble();
    {
        auto geometry = reference::PackGeometry::decode(unbounded);
        HEARTH_ASSERT(geometry.ok());
        geometry_ = std::move(*geometry);
    }
    for (const Mesh& mesh : meshes_)
        boundMesh(mesh);
    pack_ = test_.build();
    auto geometry = reference::PackGeometry::decode(*pack_);
    HEARTH_ASSERT(geometry.ok());
    geometry_ = std::move(*geometry);
}

/// Add joints along y, each a child of the one before.
uint32_t DeformedScene::addSkin(uint32_t joint_count)
{
    PackModel& model = test_.model();
    const auto first = static_cast<uint32_t>(model.joints.size());
    const float step = kLength / static_cast<float>(joint_count - 1);
    for (uint32_t joint = 0; joint < joint_count; ++joint)
    {
        NodeRecord node{};
        node.parent = joint == 0 ? kInvalidIndex : static_cast<uint32_t>(model.nodes.size()) - 1;
        node.mesh = node.skin = kInvalidIndex;
        node.has_trs = 1;
        node.translation = {0, joint == 0 ? 0.0f : step, 0};
        node.rotation = {0, 0, 0, 1};
        node.scale = {1, 1, 1};
        node.parent_from_node = translated(node.translation);
        model.joints.push_back({static_cast<uint32_t>(model.nodes.size()),
                                {},
                                translated({0, -step * static_cast<float>(joint), 0})});
        model.nodes.push_back(node);
    }
    model.skins.push_back({{}, kInvalidIndex, {first, joint_count}, 0});
    return static_cast<uint32_t>(model.skins.size()) - 1;
}

void DeformedScene::addDeformed(uint32_t mesh, uint32_t skin, uint32_t joint_count, uint32_t pose_count,
                                std::mt19937& random)
{
    PackModel& model = test_.model();
    const uint32_t targets = model.meshes[mesh].morph_target_count;
    Mesh added{mesh, skin, {}};
    added.poses.push_back({0, std::vector<Affine3d>(joint_count), std::vector<float>(targets, 0.0f)});
    while (added.poses.size() < pose_count)
        added.poses.push_back({0, randomPalette(joint_count, 0.7, random), randomWeights(targets, random)});
    meshes_.push_back(std::move(added));
}

void DeformedScene::addInstances(const Mesh& mesh, uint32_t count, std::mt19937& random)
{
    PackModel& model = test_.model();
    for (uint32_t i = 0; i < count; ++i)
    {
        Affine3 place = translated({uniform(random, -1, 1) * options_.reach, 0, 0});
        place.m[0][0] = i % 3 == 2 ? -1.0f : 1.0f;
        deformed_.push_back(static_cast<uint32_t>(model.instances.size()));
        test_.addInstance(mesh.mesh, place);
        NodeRecord& node = model.nodes.back();
        node.skin = mesh.skin;
        const auto targets = static_cast<uint32_t>(mesh.poses[0].morph_weights.size());
        node.morph_weights = {static_cast<uint32_t>(model.morph_weights.size()), targets};
        model.morph_weights.resize(model.morph_weights.size() + targets, 0.0f);
    }
}

void DeformedScene::boundMesh(const Mesh& mesh)
{
    PackModel& model = test_.model();
    const MeshRecord& record = model.meshes[mesh.mesh];
    DeformedMeshRecord deformed{};
    deformed.mesh = mesh.mesh;
    deformed.skin = mesh.skin;
    deformed.anchor = mesh.skin == kInvalidIndex ? 0 : 2;
    deformed.clusters = {static_cast<uint32_t>(model.deformed_clusters.size()), record.clusters.count};
    Box3 all;
    std::vector<Box3> anchored(record.clusters.count);
    for (uint32_t i = 0; i < record.clusters.count; ++i)
    {
        const ClusterGeometry geometry = geometry_->cluster(record.clusters.first + i);
        DeformedClusterRecord cluster{};
        cluster.joints.first = static_cast<uint32_t>(model.cluster_joints.size());
        cluster.joint = static_cast<uint16_t>(mainJoint(geometry, model.cluster_joints));
        cluster.joints.count = static_cast<uint32_t>(model.cluster_joints.size()) - cluster.joints.first;
        const auto joints = std::span(model.cluster_joints).subspan(cluster.joints.first);
        shareFrame(joints);
        std::vector<Double3> corners, in_anchor, in_frame;
        for (const TestPose& pose : mesh.poses)
        {
            addCarried(geometry, pose, pose.world_from_bind[cluster.joint], corners);
            addCarried(geometry, pose, pose.world_from_bind[deformed.anchor], in_anchor);
            addCarried(geometry, pose, computeFrame(pose, cluster.joint, joints), in_frame);
        }
        Box3 box;
        for (const Double3& corner : in_frame)
            addSurely(box, corner);
        for (const Double3& corner : in_anchor)
            addSurely(anchored[i], corner);
        cluster.box_min = box.min;
        cluster.box_max = box.max;
        setCone(corners, cluster);
        cluster.morph_reach = morphReach(geometry);
        all.add(anchored[i]);
        model.deformed_clusters.push_back(cluster);
    }
    deformed.box_min = all.min;
    deformed.box_max = all.max;
    model.deformed_meshes.push_back(deformed);
    boundGroups(mesh, anchored);
}

/// Compute the groups' spheres. Each contains the group's clusters, in the space of the anchor, and the
/// spheres of the groups below.
void DeformedScene::boundGroups(const Mesh& mesh, std::span<const Box3> boxes)
{
    PackModel& model = test_.model();
    const MeshRecord& record = model.meshes[mesh.mesh];
    std::vector<uint32_t> groups;
    for (uint32_t i = 0; i < record.groups.count; ++i)
        groups.push_back(record.groups.first + i);
    std::stable_sort(groups.begin(), groups.end(),
                     [&](uint32_t a, uint32_t b) { return model.groups[a].level < model.groups[b].level; });
    for (const uint32_t number : groups)
    {
        GroupRecord& group = model.groups[number];
        Box3 box;
        for (uint32_t c = 0; c < group.clusters.count; ++c)
            box.add(boxes[group.clusters.first + c - record.clusters.first]);
        group.sphere_center = box.center();
        float radius = 0.5f * length(box.max - box.min);
        for (uint32_t c = 0; c < group.clusters.count; ++c)
            if (const uint32_t refined = model.clusters[group.clusters.first + c].refined_group;
                refined != kInvalidIndex)
                radius = std::max(radius, length(model.groups[refined].sphere_center - group.sphere_center) +
                                              model.groups[refined].sphere_radius);
        group.sphere_radius = radius * 1.00001f;
    }
}

const DeformedScene::Mesh& DeformedScene::getMesh(uint32_t instance) const
{
    const uint32_t mesh = pack_->instances()[instance].mesh;
    return *std::find_if(meshes_.begin(), meshes_.end(), [&](const Mesh& m) { return m.mesh == mesh; });
}

/// Random transform with rotation and scale, mirrored if the instance is.
Affine3d DeformedScene::choosePlace(uint32_t instance, std::mt19937& random) const
{
    const float r = options_.reach;
    const double scale = static_cast<double>(uniform(random, 0.6f, 1.6f));
    const double side = (pack_->instances()[instance].flags & kInstanceMirrored) != 0 ? -1 : 1;
    return makeAffineFromTrs(
        widen(Float3{uniform(random, -r, r), uniform(random, -r, r), uniform(random, -r, r)}),
        randomRotation(random, 3.1), {scale * side, scale, scale});
}

TestPose DeformedScene::randomPose(uint32_t instance, std::mt19937& random) const
{
    const Mesh& mesh = getMesh(instance);
    TestPose pose = mesh.poses[random() % mesh.poses.size()];
    pose.instance = instance;
    const Affine3d place = choosePlace(instance, random);
    for (Affine3d& joint : pose.world_from_bind)
        joint = place * joint;
    return pose;
}

TestPose DeformedScene::freePose(uint32_t instance, std::mt19937& random) const
{
    TestPose pose = randomPose(instance, random);
    const Affine3d place = choosePlace(instance, random);
    pose.world_from_bind = randomPalette(static_cast<uint32_t>(pose.world_from_bind.size()), 2.5, random);
    for (Affine3d& joint : pose.world_from_bind)
        joint = place * joint;
    for (float& weight : pose.morph_weights)
        weight = uniform(random, -2, 2);
    pose.free = true;
    return pose;
}

std::vector<TestPose> DeformedScene::randomPoses(std::mt19937& random) const
{
    std::vector<TestPose> poses;
    for (const uint32_t instance : deformed_)
        if (random() % 3 != 0)
            poses.push_back(randomPose(instance, random));
    return poses;
}

} // namespace hearth::test
