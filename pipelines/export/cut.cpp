// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/cut.h"

#include <fmt/format.h>

namespace hearth::gltf_export
{

using namespace formats;

std::vector<uint32_t> findCutClusters(const PackView& pack, const MeshRecord& mesh, float error)
{
    std::vector<uint32_t> cut;
    for (uint32_t i = 0; i < mesh.clusters.count; ++i)
    {
        const ClusterRecord& cluster = pack.clusters()[mesh.clusters.first + i];
        const bool fine_enough =
            cluster.refined_group == kInvalidIndex || pack.groups()[cluster.refined_group].error <= error;
        if (fine_enough && pack.groups()[cluster.group].error > error)
            cut.push_back(mesh.clusters.first + i);
    }
    return cut;
}

Result<ClusterGeometry> PageCache::clusterGeometry(const ClusterRecord& cluster, const MeshRecord& mesh)
{
    if (cluster.page != page_)
    {
        HEARTH_ASSIGN_OR_RETURN(bytes_, pack_.decodePage(cluster.page));
        page_ = cluster.page;
    }
    const auto geometry = ClusterGeometry::at(bytes_, cluster, mesh);
    if (!geometry)
        return Error{Issue::meaning_geometry, pack_.name(), chunkName(kChunkPages, 0),
                     fmt::format("a cluster lies outside page {}", cluster.page)};
    return *geometry;
}

} // namespace hearth::gltf_export
