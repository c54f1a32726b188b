// Reads glTF 2.0 files: container, document, data, then the part, section by section.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/import_gltf.h"

#include "pipelines/import/gltf/animations.h"
#include "pipelines/import/gltf/extras.h"
#include "pipelines/import/gltf/image_light.h"
#include "pipelines/import/gltf/lods.h"
#include "pipelines/import/gltf/materials.h"
#include "pipelines/import/gltf/mesh_writer.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/source/file_bytes.h"

#include <set>

namespace hearth::import
{

namespace
{

/// Return the vertex count as glTF counts: over the distinct POSITION accessors of all meshes.
uint64_t sourceVertexCount(const GltfModel& model)
{
    std::set<uint32_t> positions;
    for (const GltfMesh& mesh : model.meshes)
        for (const GltfPrimitive& primitive : mesh.primitives)
            positions.insert(findAttribute(primitive.attributes, "POSITION"));
    positions.erase(kInvalidIndex);
    uint64_t count = 0;
    for (const uint32_t accessor : positions)
        count += model.accessors[accessor].count;
    return count;
}

/// Return the nodes that are not drawn, for they are levels of detail or proxies.
std::vector<bool> joinHidden(const GltfLods& lods, const GltfProxies& proxies)
{
    std::vector<bool> hidden = lods.hidden;
    for (size_t node = 0; node < hidden.size(); ++node)
        hidden[node] = hidden[node] || proxies.hidden[node];
    return hidden;
}

} // namespace

Status importGltf(const std::string& path, const FileBytes& file, const ImportOptions& options,
                  PartBuilder& part)
{
    const AssetFolder folder(path, options.reads);
    const GltfContext context{path, folder, options, part};
    HEARTH_ASSIGN_OR_RETURN(const GltfContainer container, splitGltf(file.bytes(), path));
    HEARTH_ASSIGN_OR_RETURN(const JsonDocument document, JsonDocument::parse(container.json, path));
    HEARTH_ASSIGN_OR_RETURN(const GltfModel model, readGltfModel(document, path, part));
    HEARTH_ASSIGN_OR_RETURN(const GltfBuffers buffers, GltfBuffers::load(model, file, container, context));

    GltfTally tally;
    GltfAccessors accessors(model, buffers, context);
    GltfMeshReader meshes(model, buffers, accessors, context, tally);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<InverseBinds> inverse_binds,
                            writeSkins(model, accessors, context));
    const GltfLods lods = findLods(model, context);
    HEARTH_ASSIGN_OR_RETURN(const GltfProxies proxies, findProxies(model, lods, context));
    const MeshUses uses = findMeshUses(model);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<MeshSummary> summaries,
                            writeMeshes(model, uses, lods, proxies, meshes, inverse_binds, context));
    context.part.counts.vertices = sourceVertexCount(model);
    HEARTH_TRY(writeMaterials(model, buffers, context));
    HEARTH_TRY(readSky(model, buffers, context));
    HEARTH_TRY(writeScene(model, uses, summaries, joinHidden(lods, proxies), accessors, context, tally));
    HEARTH_TRY(writeAnimations(model, accessors, context, tally));
    HEARTH_TRY(writeExtras(document, container.json, model, uses, context));
    tally.report(part);
    if (part.counts.triangles == 0)
        part.warn(Issue::nothing_drawn, "/meshes", "no mesh has a triangle");
    return buffers.checkUnchanged();
}

} // namespace hearth::import
