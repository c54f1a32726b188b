// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/opaque_clusters.h"

namespace hearth::bricks
{

using namespace formats;

Status visitOpaqueClusters(const StaticScene& scene, std::span<const InstancedCluster> placed,
                           const ClusterVisitor& visit)
{
    std::vector<std::byte> page;
    uint32_t page_source = kInvalidIndex, page_number = kInvalidIndex;
    for (const InstancedCluster& at : placed)
    {
        const PackView& part = scene.sources[at.source].clusters;
        const ClusterRecord& record = part.clusters()[at.cluster];
        const SurfaceMaterial& material = scene.material(at.source, record.material);
        if (material.hasHoles())
            continue;
        if (at.source != page_source || at.page != page_number)
        {
            HEARTH_ASSIGN_OR_RETURN(page, part.decodePage(at.page));
            page_source = at.source;
            page_number = at.page;
        }
        const StaticInstance& instance = scene.instances[at.instance];
        const auto geometry = ClusterGeometry::at(page, record, part.meshes()[instance.mesh]);
        if (!geometry)
            return Error{Issue::meaning_geometry, part.name(), "cluster " + std::to_string(at.cluster),
                         "lies outside its page"};
        visit(instance, *geometry, material);
    }
    return success();
}

} // namespace hearth::bricks
