// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/export_gltf.h"

#include "pipelines/export/animations.h"
#include "pipelines/export/cameras.h"
#include "pipelines/export/extras.h"
#include "pipelines/export/lights.h"
#include "pipelines/export/materials.h"
#include "pipelines/export/meshes.h"
#include "pipelines/export/omissions.h"
#include "pipelines/export/proxies.h"
#include "pipelines/export/skins.h"
#include "pipelines/export/tinygltf_writer.h"

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

ExportSummary summarize(const GltfDocument& document, const Omissions& omissions)
{
    ExportSummary summary;
    summary.nodes = document.nodes.size();
    summary.meshes = document.meshes.size();
    for (const Mesh& mesh : document.meshes)
        for (const Primitive& primitive : mesh.primitives)
            summary.triangles += document.accessors[primitive.indices].count / 3;
    summary.materials = document.materials.size();
    summary.images = document.images.size();
    summary.skins = document.skins.size();
    summary.animations = document.animations.size();
    summary.lights = document.lights.size();
    summary.cameras = document.cameras.size();
    summary.omissions = omissions.lines();
    return summary;
}

} // namespace

Result<ExportSummary> exportGltf(const PackView& pack, const ExportOptions& options, const std::string& path)
{
    HEARTH_ASSERT(options.error >= 0 && (!options.mesh || *options.mesh < pack.meshes().size()));
    GltfDocument document;
    document.generator = "hearth " HEARTH_VERSION;
    Omissions omissions;
    const bool is_lone = options.mesh && !isDeformed(pack.meshes()[*options.mesh]);
    HEARTH_TRY(addMaterials(document, pack, omissions));
    HEARTH_ASSIGN_OR_RETURN(const ExportedMeshes meshes, is_lone ? addLoneMesh(document, pack, options)
                                                                 : addScene(document, pack, options));
    std::vector<uint32_t> clips;
    if (!is_lone)
    {
        addSkins(document, pack);
        if (!options.mesh)
        {
            addCameras(document, pack);
            addLights(document, pack);
        }
        clips = addAnimations(document, pack, omissions);
    }
    addExtras(document, pack, {meshes, clips});
    addProxies(document, pack, meshes, omissions);
    addPackOmissions(pack, options.has_lods, omissions);
    HEARTH_TRY(writeGlb(document, path));
    return summarize(document, omissions);
}

} // namespace hearth::gltf_export
