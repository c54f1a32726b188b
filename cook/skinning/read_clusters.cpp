// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/read_clusters.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace hearth::skinning
{

using namespace formats;

namespace
{

// Sum of the weight codes of a vertex.
constexpr double kWeightSum = 65535;

Error makeError(const PackView& part, Issue issue, uint32_t cluster, std::string detail)
{
    return {issue, part.name(), "cluster " + std::to_string(cluster), std::move(detail)};
}

void addInfluences(const ClusterGeometry& geometry, uint32_t vertex, DeformedCluster& cluster)
{
    const std::array<uint32_t, 8> joints = geometry.joints(vertex);
    const std::array<uint32_t, 8> codes = geometry.weightCodes(vertex);
    for (size_t i = 0; i < cluster.influences; ++i)
    {
        cluster.joints.push_back(static_cast<uint16_t>(joints[i]));
        cluster.weights.push_back(codes[i] / kWeightSum);
    }
}

DeformedCluster readCluster(const ClusterGeometry& geometry)
{
    DeformedCluster cluster;
    cluster.influences = geometry.influenceCount();
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
    {
        cluster.positions.push_back(geometry.position(v));
        addInfluences(geometry, v, cluster);
    }
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        for (const uint32_t corner : geometry.triangle(t))
            cluster.indices.push_back(corner);
    for (uint32_t m = 0; m < geometry.morphCount(); ++m)
    {
        MorphDeltas morph{geometry.morphTarget(m), {}};
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            morph.positions.push_back(geometry.morphPosition(m, v));
        cluster.morphs.push_back(std::move(morph));
    }
    return cluster;
}

/// Return the sum of the weights: 1 up to rounding if the codes are valid.
double weightSum(const DeformedCluster& cluster, size_t vertex)
{
    double sum = 0;
    for (size_t i = vertex * cluster.influences; i < (vertex + 1) * cluster.influences; ++i)
        sum += cluster.weights[i] * kWeightSum;
    return std::round(sum) / kWeightSum;
}

Status checkCluster(const PackView& part, uint32_t number, const DeformedCluster& cluster,
                    uint32_t joint_count, uint32_t target_count)
{
    const auto allBelow = [](const auto& values, size_t count)
    { return std::all_of(values.begin(), values.end(), [&](auto value) { return value < count; }); };
    if (!allBelow(cluster.indices, cluster.positions.size()))
        return makeError(part, Issue::meaning_geometry, number, "a triangle points outside of its vertices");
    if ((joint_count > 0) != (cluster.influences > 0))
        return makeError(part, Issue::meaning_geometry, number,
                         "it has influences without a skin, or none with one");
    if (!allBelow(cluster.joints, joint_count))
        return makeError(part, Issue::meaning_reference, number,
                         "a joint is not one of the " + std::to_string(joint_count) + " of its skin");
    for (size_t v = 0; v < cluster.positions.size() && joint_count > 0; ++v)
        if (weightSum(cluster, v) != 1)
            return makeError(part, Issue::meaning_geometry, number,
                             "the weights of a vertex do not sum to 1");
    for (const MorphDeltas& morph : cluster.morphs)
        if (morph.target >= target_count)
            return makeError(part, Issue::meaning_reference, number,
                             "morph target " + std::to_string(morph.target));
    return success();
}

Status readPage(const PackView& part, const MeshRecord& mesh, uint32_t page_number, uint32_t joint_count,
                std::span<DeformedCluster> clusters)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> page, part.decodePage(page_number));
    const Range range = part.pages()[page_number].clusters;
    for (uint32_t number = range.first; number < range.first + range.count; ++number)
    {
        const auto geometry = ClusterGeometry::at(page, part.clusters()[number], mesh);
        if (!geometry)
            return makeError(part, Issue::meaning_geometry, number, "its data does not lie in its page");
        DeformedCluster cluster = readCluster(*geometry);
        HEARTH_TRY(checkCluster(part, number, cluster, joint_count, mesh.morph_target_count));
        clusters[number - mesh.clusters.first] = std::move(cluster);
    }
    return success();
}

/// True if the pages of a mesh contain exactly its clusters.
bool pagesFit(const PackView& part, const MeshRecord& mesh)
{
    if (!isInsideTable(mesh.clusters, part.clusters().size()) ||
        !isInsideTable(mesh.pages, part.pages().size()))
        return false;
    uint32_t next = mesh.clusters.first;
    for (const PageRecord& page : part.pages().subspan(mesh.pages.first, mesh.pages.count))
    {
        if (page.clusters.first != next || page.clusters.count > mesh.clusters.count)
            return false;
        next += page.clusters.count;
    }
    return next == mesh.clusters.first + mesh.clusters.count;
}

} // namespace

Result<std::vector<DeformedCluster>> readClusters(const PackView& part, uint32_t mesh_number,
                                                  uint32_t joint_count)
{
    const MeshRecord& mesh = part.meshes()[mesh_number];
    if (!pagesFit(part, mesh))
        return Error{Issue::meaning_range, part.name(), "mesh " + std::to_string(mesh_number),
                     "its pages do not hold its clusters"};
    std::vector<DeformedCluster> clusters(mesh.clusters.count);
    std::vector<Status> read(mesh.pages.count, success());
    tbb::parallel_for(uint32_t{0}, mesh.pages.count,
                      [&](uint32_t i)
                      { read[i] = readPage(part, mesh, mesh.pages.first + i, joint_count, clusters); });
    for (Status& status : read)
        HEARTH_TRY(std::move(status));
    return clusters;
}

} // namespace hearth::skinning
