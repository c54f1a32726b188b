// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf_mesh_writer.h"

#include "pipelines/import/bake_transform.h"
#include "pipelines/import/gltf_rest_pose.h"
#include "pipelines/import/gltf_skinning.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::import
{

using formats::kNone;

namespace
{

/// Put a mesh whose joints move it in different ways in its rest pose, by the first node that has it with a skin.
/// Returns the node, or kNone where the mesh stays as it is. (A skin with too few joints is the scene's to refuse.)
uint32_t poseMesh(mesh::SourceMesh& mesh, uint32_t index, const std::vector<bool>& used_joints,
                  const GltfModel& model, std::span<const InverseBinds> inverse_binds,
                  std::span<const Transform> world_from_node)
{
    const auto node = std::find_if(model.nodes.begin(), model.nodes.end(),
                                   [&](const GltfNode& n) { return n.mesh == index && n.skin != kNone; });
    if (node == model.nodes.end() || used_joints.size() > model.skins[node->skin].joints.size())
        return kNone;
    const GltfSkin& skin = model.skins[node->skin];
    const auto pose = skinnedRestPose(skin, inverse_binds[node->skin], used_joints, world_from_node);
    if (!pose || pose->rigid || !applyRestPose(mesh, skin, inverse_binds[node->skin], world_from_node))
        return kNone;
    return static_cast<uint32_t>(node - model.nodes.begin());
}

class MeshWriter
{
public:
    MeshWriter(const GltfModel& model, const GltfLods& lods, GltfMeshReader& reader,
               std::span<const InverseBinds> inverse_binds, const GltfContext& context)
        : model_(model),
          lods_(lods),
          reader_(reader),
          inverse_binds_(inverse_binds),
          context_(context),
          world_from_node_(worldTransforms(model)),
          counted_(model.meshes.size())
    {
    }

    Status writeMesh(uint32_t index);
    Status writeLods(const GltfLodChain& chain);
    std::vector<MeshSummary> summaries() { return std::move(summaries_); }

private:
    struct Posed
    {
        mesh::SourceMesh mesh;
        MeshSummary summary;
    };
    Result<Posed> readPosed(uint32_t index);
    Transform standsAt(uint32_t node, const MeshSummary& summary) const;
    std::optional<Transform> objectFromLod(const GltfLodChain& chain, const GltfLod& lod,
                                           const MeshSummary& summary) const;

    const GltfModel& model_;
    const GltfLods& lods_;
    GltfMeshReader& reader_;
    std::span<const InverseBinds> inverse_binds_;
    const GltfContext& context_;
    std::vector<Transform> world_from_node_;
    std::vector<bool> counted_; ///< meshes that are in the counts: a level may be one of several meshes
    std::vector<MeshSummary> summaries_;
};

Result<MeshWriter::Posed> MeshWriter::readPosed(uint32_t index)
{
    HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh mesh, reader_.read(index, restWeights(model_, index)));
    std::vector<bool> used_joints = usedJoints(mesh);
    const uint32_t posed_by = poseMesh(mesh, index, used_joints, model_, inverse_binds_, world_from_node_);
    if (!counted_[index])
    {
        counted_[index] = true;
        context_.part.counts.triangles += mesh.triangleCount();
        context_.part.counts.faces += mesh.face_count;
        context_.part.counts.morph_targets += mesh.morph_targets.size();
    }
    MeshSummary summary{mesh.triangleCount() > 0, std::move(used_joints), mesh.morph_targets.size(),
                        posed_by};
    return Posed{std::move(mesh), std::move(summary)};
}

Status MeshWriter::writeMesh(uint32_t index)
{
    if (lods_.lod_only[index])
    {
        mesh::SourceMesh empty;
        empty.name = model_.meshes[index].name;
        summaries_.emplace_back();
        return context_.part.addMesh(empty);
    }
    HEARTH_ASSIGN_OR_RETURN(Posed posed, readPosed(index));
    summaries_.push_back(std::move(posed.summary));
    return context_.part.addMesh(posed.mesh);
}

/// Where the vertices of a node's mesh stand, as SceneWriter draws them.
Transform MeshWriter::standsAt(uint32_t node, const MeshSummary& summary) const
{
    const GltfNode& n = model_.nodes[node];
    if (summary.posed_by != kNone)
        return {};
    if (n.skin == kNone || summary.used_joints.size() > model_.skins[n.skin].joints.size())
        return lods_.world_from_node[node];
    const auto pose =
        skinnedRestPose(model_.skins[n.skin], inverse_binds_[n.skin], summary.used_joints, world_from_node_);
    return pose ? pose->world_from_object : lods_.world_from_node[node];
}

std::optional<Transform> MeshWriter::objectFromLod(const GltfLodChain& chain, const GltfLod& lod,
                                                   const MeshSummary& summary) const
{
    if (lod.node == kNone)
        return Transform{};
    const Transform world_from_object = standsAt(chain.node, summaries_[chain.mesh]);
    const Transform world_from_lod = standsAt(lod.node, summary);
    if (distance(world_from_object, world_from_lod) == 0)
        return Transform{};
    const std::optional<Transform> object_from_world = inverted(world_from_object);
    return object_from_world ? std::optional(*object_from_world * world_from_lod) : std::nullopt;
}

Status MeshWriter::writeLods(const GltfLodChain& chain)
{
    if (!summaries_[chain.mesh].has_triangles)
        return success();
    for (const GltfLod& lod : chain.lods)
    {
        HEARTH_ASSIGN_OR_RETURN(Posed posed, readPosed(lod.mesh));
        const std::string where = fmt::format("/meshes/{}", lod.mesh);
        const auto drop = [&](const char* why)
        {
            context_.part.warn(
                Issue::dropped, where,
                fmt::format("a level of detail of mesh {} {}: it is not kept", chain.mesh, why));
        };
        const std::optional<Transform> object_from_lod = objectFromLod(chain, lod, posed.summary);
        if (!posed.summary.has_triangles)
            drop("has no triangles");
        else if (!object_from_lod || !bakeTransform(posed.mesh, *object_from_lod))
            drop("cannot be moved to where that stands");
        else
            HEARTH_TRY(context_.part.addLod(chain.mesh, std::move(posed.mesh)));
    }
    return success();
}

} // namespace

Result<std::vector<MeshSummary>> writeMeshes(const GltfModel& model, const GltfLods& lods,
                                             GltfMeshReader& reader,
                                             std::span<const InverseBinds> inverse_binds,
                                             const GltfContext& context)
{
    MeshWriter writer(model, lods, reader, inverse_binds, context);
    for (uint32_t index = 0; index < model.meshes.size(); ++index)
        HEARTH_TRY(writer.writeMesh(index));
    for (const GltfLodChain& chain : lods.chains)
        HEARTH_TRY(writer.writeLods(chain));
    return writer.summaries();
}

} // namespace hearth::import
