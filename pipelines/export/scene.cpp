// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/scene.h"

#include "formats/scene/animation.h"
#include "pipelines/export/levels.h"
#include "pipelines/export/meshes.h"

#include <fmt/format.h>

#include <algorithm>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

/// Return a matrix column by column.
std::array<double, 16> toMatrix(const Affine3d& t)
{
    std::array<double, 16> matrix{};
    for (size_t column = 0; column < 4; ++column)
        for (size_t row = 0; row < 3; ++row)
            matrix[column * 4 + row] = t.m[row][column];
    matrix[15] = 1;
    return matrix;
}

Node convert(const PackView& pack, const NodeRecord& record)
{
    Node node;
    node.name = pack.text(record.name);
    if (record.has_trs != 0)
    {
        node.translation = {double{record.translation.x}, double{record.translation.y},
                            double{record.translation.z}};
        node.rotation = {double{record.rotation.x}, double{record.rotation.y}, double{record.rotation.z},
                         double{record.rotation.w}};
        node.scale = {double{record.scale.x}, double{record.scale.y}, double{record.scale.z}};
    }
    else if (record.parent_from_node != Affine3{})
        node.matrix = toMatrix(widened(record.parent_from_node));
    return node;
}

/// Give a node a mesh, and what belongs to it: the skin and the weights of its morph targets.
void setMesh(const PackView& pack, const NodeRecord& record, uint32_t mesh, Node& node)
{
    node.mesh = mesh;
    node.skin = record.skin;
    for (const float weight : recordsInRange(pack.morphWeights(), record.morph_weights))
        node.weights.push_back(double{weight});
}

/// Adds the meshes that instances draw.
class InstanceWriter
{
public:
    InstanceWriter(GltfDocument& document, const PackView& pack, const ExportOptions& options)
        : document_(document), pack_(pack), options_(options), meshes_(pack.meshes().size(), kInvalidIndex)
    {
        const AnimationTables tables = animationTables(pack);
        world_from_node_.resize(pack.nodes().size());
        poseNodes(tables, restPose(tables), nodesParentsFirst(pack.nodes()), world_from_node_);
    }

    Status write();
    ExportedMeshes meshes() { return std::move(meshes_); }

private:
    Result<uint32_t> addOnce(uint32_t mesh)
    {
        if (meshes_[mesh] == kInvalidIndex)
        {
            HEARTH_ASSIGN_OR_RETURN(meshes_[mesh], addMesh(document_, pack_, mesh, options_.error));
        }
        return meshes_[mesh];
    }
    void addCopy(const InstanceRecord& instance, uint32_t mesh);

    GltfDocument& document_;
    const PackView& pack_;
    const ExportOptions& options_;
    ExportedMeshes meshes_;
    std::vector<Affine3d> world_from_node_;
};

/// Add a node below that of the instance, for one of several copies.
void InstanceWriter::addCopy(const InstanceRecord& instance, uint32_t mesh)
{
    const NodeRecord& record = pack_.nodes()[instance.node];
    Node copy;
    auto& siblings = document_.nodes[instance.node].children;
    copy.name = fmt::format("{} copy {}", pack_.text(record.name), siblings.size());
    setMesh(pack_, record, mesh, copy);
    const Affine3d node_from_copy =
        nodeFromObject(world_from_node_[instance.node], instance.world_from_object);
    if (node_from_copy != Affine3d{})
        copy.matrix = toMatrix(node_from_copy);
    siblings.push_back(static_cast<uint32_t>(document_.nodes.size()));
    document_.nodes.push_back(std::move(copy));
}

Status InstanceWriter::write()
{
    std::vector<uint32_t> copies(pack_.nodes().size());
    for (const InstanceRecord& instance : pack_.instances())
        ++copies[instance.node];
    for (const InstanceRecord& instance : pack_.instances())
    {
        if (options_.mesh && (instance.mesh != *options_.mesh || meshes_[instance.mesh] != kInvalidIndex))
            continue;
        HEARTH_ASSIGN_OR_RETURN(const uint32_t mesh, addOnce(instance.mesh));
        if (mesh == kInvalidIndex)
            continue;
        const NodeRecord& record = pack_.nodes()[instance.node];
        if (copies[instance.node] > 1 && record.skin == kInvalidIndex)
            addCopy(instance, mesh);
        else
            setMesh(pack_, record, mesh, document_.nodes[instance.node]);
    }
    return success();
}

} // namespace

Result<ExportedMeshes> addScene(GltfDocument& document, const PackView& pack, const ExportOptions& options)
{
    for (const NodeRecord& record : pack.nodes())
        document.nodes.push_back(convert(pack, record));
    for (uint32_t node = 0; node < pack.nodes().size(); ++node)
    {
        const uint32_t parent = pack.nodes()[node].parent;
        auto& siblings = parent == kInvalidIndex ? document.scene_nodes : document.nodes[parent].children;
        siblings.push_back(node);
    }
    InstanceWriter instances(document, pack, options);
    HEARTH_TRY(instances.write());
    ExportedMeshes meshes = instances.meshes();
    if (options.has_lods)
        HEARTH_TRY(addLevels(document, pack, meshes, options.error));
    return meshes;
}

Result<ExportedMeshes> addLoneMesh(GltfDocument& document, const PackView& pack, const ExportOptions& options)
{
    ExportedMeshes meshes(pack.meshes().size(), kInvalidIndex);
    uint32_t& mesh = meshes[*options.mesh];
    HEARTH_ASSIGN_OR_RETURN(mesh, addMesh(document, pack, *options.mesh, options.error));
    Node node;
    node.name = pack.text(pack.meshes()[*options.mesh].name);
    node.mesh = mesh;
    document.nodes.push_back(std::move(node));
    document.scene_nodes.push_back(0);
    if (options.has_lods)
        HEARTH_TRY(addLevels(document, pack, meshes, options.error));
    return meshes;
}

} // namespace hearth::gltf_export
