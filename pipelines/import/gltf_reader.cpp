// The reader of glTF 2.0 files: container, document, data, then the part, section by section.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf_animations.h"
#include "pipelines/import/gltf_materials.h"
#include "pipelines/import/gltf_meshes.h"
#include "pipelines/import/gltf_rest_pose.h"
#include "pipelines/import/gltf_scene.h"
#include "pipelines/import/gltf_skinning.h"
#include "pipelines/import/readers.h"

#include <algorithm>
#include <set>

namespace hearth::import
{

namespace
{

/// Vertices as glTF counts them: over the distinct POSITION accessors of all meshes.
uint64_t sourceVertexCount(const GltfModel& model)
{
    std::set<uint32_t> positions;
    for (const GltfMesh& mesh : model.meshes)
        for (const GltfPrimitive& primitive : mesh.primitives)
            positions.insert(findAttribute(primitive.attributes, "POSITION"));
    positions.erase(formats::kNone);
    uint64_t count = 0;
    for (const uint32_t accessor : positions)
        count += model.accessors[accessor].count;
    return count;
}

/// Put a mesh whose joints move it in different ways in its rest pose, by the first node that has it with a skin.
/// Returns the node, or kNone where the mesh stays as it is. (A skin with too few joints is the scene's to refuse.)
uint32_t poseMesh(mesh::SourceMesh& mesh, uint32_t index, const std::vector<bool>& used_joints,
                  const GltfModel& model, std::span<const InverseBinds> inverse_binds,
                  std::span<const Transform> world_from_node)
{
    const auto node =
        std::find_if(model.nodes.begin(), model.nodes.end(),
                     [&](const GltfNode& n) { return n.mesh == index && n.skin != formats::kNone; });
    if (node == model.nodes.end() || used_joints.size() > model.skins[node->skin].joints.size())
        return formats::kNone;
    const GltfSkin& skin = model.skins[node->skin];
    const auto pose = skinnedRestPose(skin, inverse_binds[node->skin], used_joints, world_from_node);
    if (!pose || pose->rigid || !applyRestPose(mesh, skin, inverse_binds[node->skin], world_from_node))
        return formats::kNone;
    return static_cast<uint32_t>(node - model.nodes.begin());
}

/// Read and write the meshes one by one, so that one at a time is in memory.
Result<std::vector<MeshSummary>> writeMeshes(const GltfModel& model, GltfMeshReader& reader,
                                             std::span<const InverseBinds> inverse_binds,
                                             const GltfContext& context)
{
    const std::vector<Transform> world_from_node = worldTransforms(model);
    std::vector<MeshSummary> summaries;
    for (uint32_t index = 0; index < model.meshes.size(); ++index)
    {
        HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh mesh, reader.read(index, restWeights(model, index)));
        std::vector<bool> used_joints = usedJoints(mesh);
        const uint32_t posed_by = poseMesh(mesh, index, used_joints, model, inverse_binds, world_from_node);
        HEARTH_TRY(context.part.addMesh(mesh));
        context.part.counts.triangles += mesh.triangleCount();
        context.part.counts.faces += mesh.face_count;
        context.part.counts.morph_targets += mesh.morph_targets.size();
        summaries.push_back(
            {mesh.triangleCount() > 0, std::move(used_joints), mesh.morph_targets.size(), posed_by});
    }
    context.part.counts.vertices = sourceVertexCount(model);
    return summaries;
}

} // namespace

Status importGltf(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                  PartBuilder& part)
{
    const AssetFolder folder(path);
    const GltfContext context{path, folder, options, part};
    HEARTH_ASSIGN_OR_RETURN(const GltfContainer container, splitGltf(bytes, path));
    HEARTH_ASSIGN_OR_RETURN(const JsonDocument document, JsonDocument::parse(container.json, path));
    HEARTH_ASSIGN_OR_RETURN(const GltfModel model, readGltfModel(document, path, part));
    HEARTH_ASSIGN_OR_RETURN(const GltfBuffers buffers, GltfBuffers::load(model, container, context));

    GltfTally tally;
    GltfAccessors accessors(model, buffers, context);
    GltfMeshReader meshes(model, buffers, accessors, context, tally);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<InverseBinds> inverse_binds,
                            writeSkins(model, accessors, context));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<MeshSummary> summaries,
                            writeMeshes(model, meshes, inverse_binds, context));
    HEARTH_TRY(writeMaterials(model, buffers, context));
    HEARTH_TRY(writeAnimations(model, accessors, context, tally));
    HEARTH_TRY(writeScene(model, summaries, inverse_binds, accessors, context, tally));
    tally.report(part);
    return success();
}

} // namespace hearth::import
