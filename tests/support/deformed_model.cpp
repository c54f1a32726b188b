// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/deformed_model.h"

#include "formats/base/assert.h"
#include "formats/base/scale_bound.h"
#include "tests/support/temporary_folder.h"

#include <bit>
#include <cstdlib>
#include <fstream>

namespace hearth::test
{

using namespace formats;

MeshPoses::MeshPoses(const AnimationTables& tables, uint32_t node, uint32_t seed)
    : tables_(tables),
      node_(node),
      random_(seed),
      from_(restPose(tables)),
      to_(from_),
      order_(nodesParentsFirst(tables.nodes)),
      world_from_node_(tables.nodes.size())
{
}

void MeshPoses::sample(ScenePose& pose)
{
    pose = restPose(tables_);
    if (tables_.animations.empty())
        return;
    const AnimationRecord& clip = tables_.animations[random_() % tables_.animations.size()];
    std::uniform_real_distribution<double> time(-0.05, 1.05);
    sampleAnimation(tables_, clip, time(random_) * double{clip.duration}, pose);
}

MeshPose MeshPoses::next()
{
    sample(from_);
    if (random_() % 3 != 0)
        return place(from_);
    sample(to_);
    blendPoses(from_, to_, std::uniform_real_distribution<double>(0, 1)(random_), from_);
    return place(from_);
}

MeshPose MeshPoses::rest()
{
    return place(restPose(tables_));
}

MeshPose MeshPoses::at(uint32_t animation, double time_s)
{
    from_ = restPose(tables_);
    sampleAnimation(tables_, tables_.animations[animation], time_s, from_);
    return place(from_);
}

MeshPose MeshPoses::place(const ScenePose& pose)
{
    poseNodes(tables_, pose, order_, world_from_node_);
    const NodeRecord& node = tables_.nodes[node_];
    MeshPose result;
    result.palette = {world_from_node_[node_]};
    if (node.skin != kInvalidIndex)
    {
        const SkinRecord& skin = tables_.skins[node.skin];
        result.palette.resize(skin.joints.count);
        skinPalette(tables_, skin, world_from_node_, result.palette);
    }
    for (const double weight :
         recordsInRange(std::span<const double>(pose.morph_weights), node.morph_weights))
        result.morph_weights.push_back(weight);
    result.scale = 0;
    for (const Affine3d& matrix : result.palette)
        result.scale = std::max(result.scale, double{scaleBound(*narrowed(matrix))});
    return result;
}

std::vector<Float3> posed(const mesh::SourceMesh& mesh, const MeshPose& pose)
{
    std::vector<Float3> places;
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
    {
        Double3 bound = widen(mesh.positions[v]);
        for (size_t target = 0; target < std::min(mesh.morph_targets.size(), pose.morph_weights.size());
             ++target)
            if (!mesh.morph_targets[target].positions.empty())
                bound = bound + widen(mesh.morph_targets[target].positions[v]) * pose.morph_weights[target];
        if (mesh.joint_sets.empty())
        {
            places.push_back(narrow(transformPoint(pose.palette[0], bound)));
            continue;
        }
        Double3 place;
        for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
        {
            const Float4 w = mesh.weight_sets[set][v];
            const std::array<float, 4> weights{w.x, w.y, w.z, w.w};
            for (size_t i = 0; i < 4; ++i)
                if (weights[i] != 0)
                    place = place + transformPoint(pose.palette[mesh.joint_sets[set][v].joint[i]], bound) *
                                        double{weights[i]};
        }
        places.push_back(narrow(place));
    }
    return places;
}

DeformedClusters::DeformedClusters(const clusters::Hierarchy& hierarchy)
{
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    HEARTH_ASSERT(decoded.ok());
    for (const ClusterRecord& cluster : hierarchy.clusters)
    {
        const auto geometry = ClusterGeometry::at(decoded->pages[cluster.page], cluster, hierarchy.mesh);
        HEARTH_ASSERT(geometry.has_value());
        std::vector<uint32_t> numbers;
        for (uint32_t v = 0; v < geometry->vertexCount(); ++v)
        {
            Vertex vertex{geometry->position(v), {}, {}, {}};
            std::vector<uint32_t> key;
            for (int axis = 0; axis < 3; ++axis)
                key.push_back(std::bit_cast<uint32_t>(vertex.position[axis]));
            if (geometry->influenceCount() > 0)
            {
                vertex.joints = geometry->joints(v);
                vertex.weights = geometry->weightCodes(v);
                key.insert(key.end(), vertex.joints.begin(), vertex.joints.end());
                key.insert(key.end(), vertex.weights.begin(), vertex.weights.end());
            }
            for (uint32_t i = 0; i < geometry->morphCount(); ++i)
            {
                const Float3 delta = geometry->morphPosition(i, v);
                if (delta == Float3{})
                    continue;
                vertex.deltas.push_back({geometry->morphTarget(i), delta});
                key.push_back(geometry->morphTarget(i));
                for (int axis = 0; axis < 3; ++axis)
                    key.push_back(std::bit_cast<uint32_t>(delta[axis]));
            }
            const auto [found, added] = keys_.try_emplace(key, static_cast<uint32_t>(vertices_.size()));
            if (added)
                vertices_.push_back(vertex);
            numbers.push_back(found->second);
        }
        std::vector<uint32_t>& triangles = triangles_.emplace_back();
        for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
            for (const uint32_t corner : geometry->triangle(t))
                triangles.push_back(numbers[corner]);
    }
}

std::vector<uint32_t> DeformedClusters::getTriangles(std::span<const uint32_t> clusters) const
{
    std::vector<uint32_t> triangles;
    for (const uint32_t cluster : clusters)
        triangles.insert(triangles.end(), triangles_[cluster].begin(), triangles_[cluster].end());
    return triangles;
}

std::vector<Float3> DeformedClusters::posed(const MeshPose& pose) const
{
    std::vector<Float3> places;
    for (const Vertex& vertex : vertices_)
    {
        Double3 bound = widen(vertex.position);
        for (const auto& [target, delta] : vertex.deltas)
            if (target < pose.morph_weights.size())
                bound = bound + widen(delta) * pose.morph_weights[target];
        const uint32_t sum = vertex.weights[0];
        Double3 place = sum == 0 ? transformPoint(pose.palette[0], bound) : Double3{};
        for (size_t i = 0; i < vertex.joints.size() && sum != 0; ++i)
            if (vertex.weights[i] != 0)
                place = place +
                        transformPoint(pose.palette[vertex.joints[i]], bound) * (vertex.weights[i] / 65535.0);
        places.push_back(narrow(place));
    }
    return places;
}

std::unique_ptr<DeformedModel> DeformedModel::import(const std::string& source)
{
    return importWith(source, "");
}

std::unique_ptr<DeformedModel> DeformedModel::importExactly(const std::string& source)
{
    return importWith(source, "[animation]\nerror = 0\n");
}

std::unique_ptr<DeformedModel> DeformedModel::importWith(const std::string& source,
                                                         const std::string& profile)
{
    const TemporaryFolder folder;
    const std::string part = folder.file("import.part");
    const std::string profile_file = folder.file("profile.toml");
    std::ofstream(profile_file) << profile;
    const std::string command = std::string(HEARTH_BIN) + "/hearth-import '" + source + "' -o '" + part +
                                "' --profile '" + profile_file + "' 2> /dev/null";
    if (std::system(command.c_str()) != 0)
        return nullptr;
    auto reader = ContainerReader::open(part);
    HEARTH_ASSERT(reader.ok());
    auto model = std::make_unique<DeformedModel>();
    auto motion = clusters::PartMotion::read(*reader);
    auto view = PackView::read(*reader);
    HEARTH_ASSERT(motion.ok() && view.ok());
    model->motion_ = std::make_unique<clusters::PartMotion>(std::move(motion).value());
    model->scene_ = std::make_unique<PackView>(std::move(view).value());
    const auto nodes = model->scene_->nodes();
    for (uint32_t i = 0; reader->find(kChunkSourceMesh, i) != nullptr; ++i)
    {
        auto mesh = mesh::readSourceMesh(*reader, i);
        HEARTH_ASSERT(mesh.ok());
        if (mesh->joint_sets.empty() && mesh->morph_targets.empty())
            continue;
        for (uint32_t node = 0; node < nodes.size(); ++node)
            if (nodes[node].mesh == i)
            {
                model->meshes_.push_back({i, node, std::move(mesh).value()});
                break;
            }
    }
    return model;
}

} // namespace hearth::test
