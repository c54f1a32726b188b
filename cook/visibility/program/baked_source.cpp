// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/baked_source.h"

#include "cook/mesh/weld.h"
#include "cook/tools/open_part.h"
#include "cook/visibility/rays/surface_samples.h"
#include "cook/visibility/scene/neighbour_occluders.h"
#include "formats/base/affine3d.h"
#include "formats/pack/instance_meshes.h"
#include "formats/pack/pack_check.h"
#include "formats/scene/lit_material.h"

#include <algorithm>
#include <bit>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Maximum number of instances of a mesh whose surroundings are averaged.
constexpr size_t kMaxInstances = 8;

// Minimum number of samples around a vertex, relative to the average number per vertex. Each sample counts
// for the three vertices of its triangle, so that three times the average lie around a vertex; a quarter of
// them are distributed by area. See cook/visibility/README.md, "Noise".
constexpr double kMinVertexSamples = 2.25;

/// Count the triangles of the levels of all meshes, none of meshes that are not baked.
std::vector<std::vector<uint64_t>> countTriangles(const PackView& scene, const PackView& part)
{
    std::vector<std::vector<uint64_t>> triangles(part.meshes().size());
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        if (isBaked(scene, part, mesh))
            triangles[mesh] = countLevelTriangles(part, mesh);
    return triangles;
}

/// Return for each mesh of a neighbour the level that it is sampled on in its own bake, but for weights and
/// copies, which take rays to be known.
std::vector<uint32_t> planNeighbourLevels(const PackView& scene, const PackView& part,
                                          const SamplingSettings& settings)
{
    std::vector<uint32_t> levels;
    for (const MeshSampling& sampling : planSampling(countTriangles(scene, part), settings))
        levels.push_back(sampling.level);
    return levels;
}

std::vector<Affine3> collectTransforms(std::span<const MeshInstance> instances)
{
    std::vector<Affine3> transforms;
    for (const MeshInstance& instance : instances)
        transforms.push_back(instance.world_from_mesh);
    return transforms;
}

/// Return the box in world space of all that others can occlude.
Box3 computeReceiverBox(const BakedSource& source)
{
    Box3 box;
    for (uint32_t mesh = 0; mesh < source.part.meshes().size(); ++mesh)
    {
        const MeshRecord& record = source.part.meshes()[mesh];
        if (isBaked(source.scene, source.part, mesh) && !isDeformed(record))
            for (const MeshInstance& instance : source.instances[mesh])
                box.add(transformBox(widened(instance.world_from_mesh), {record.box_min, record.box_max}));
    }
    return box;
}

} // namespace

bool isBaked(const PackView& scene, const PackView& part, uint32_t mesh)
{
    const MeshRecord& record = part.meshes()[mesh];
    const auto isLitCluster = [&](const ClusterRecord& cluster)
    { return cluster.material >= scene.materials().size() || isLit(scene.materials()[cluster.material]); };
    return (record.attributes & kVertexVisibility) != 0 &&
           std::ranges::any_of(recordsInRange(part.clusters(), record.clusters), isLitCluster);
}

Result<MeshProxies> makeMeshProxies(const PackView& scene, const PackView& part, const PackView& proxies,
                                    ProxyUse use)
{
    HEARTH_TRY(checkProxies(proxies));
    for (const ProxyRecord& proxy : proxies.proxies())
        if (proxy.mesh >= part.meshes().size())
            return Error{Issue::meaning_reference, proxies.name(), "",
                         "mesh " + std::to_string(proxy.mesh) + " is not in " + part.name()};
    MeshProxies made{use, std::vector<std::optional<ProxySurface>>(part.meshes().size())};
    SceneSurfaces surfaces(scene);
    for (uint32_t mesh = 0; mesh < part.meshes().size(); ++mesh)
    {
        const MeshRecord& record = part.meshes()[mesh];
        const ProxyRecord* const proxy = findFitProxy(proxies, record, mesh);
        if (proxy == nullptr || !isBaked(scene, part, mesh))
            continue;
        HEARTH_ASSIGN_OR_RETURN(const SourceNormals normals, SourceNormals::read(scene, mesh, record));
        HEARTH_ASSIGN_OR_RETURN(made.surfaces[mesh],
                                makeProxySurface(surfaces, proxies, *proxy, part, normals));
    }
    return made;
}

const ProxySurface* BakedSource::findProxy(uint32_t mesh) const
{
    if (proxies == nullptr || !proxies->surfaces[originals[mesh]])
        return nullptr;
    return &*proxies->surfaces[originals[mesh]];
}

const ProxySurface* BakedSource::findSampledProxy(uint32_t mesh) const
{
    const ProxySurface* const proxy = findProxy(mesh);
    return proxy != nullptr && proxies->use == ProxyUse::all && !isDeformed(part.meshes()[mesh]) ? proxy
                                                                                                 : nullptr;
}

BakedSource BakedSource::make(const PackView& scene, const PackView& part,
                              std::span<const uint32_t> instance_meshes, const SamplingSettings& settings,
                              std::span<const double> weights, const MeshProxies* proxies)
{
    BakedSource source{
        scene,
        part,
        {},
        findOriginalMeshes(scene, instance_meshes, part.meshes().size()),
        std::vector<std::vector<MeshInstance>>(part.meshes().size()),
        proxies,
    };
    std::vector<std::vector<uint64_t>> triangles = countTriangles(scene, part);
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        if (const ProxySurface* const proxy = source.findSampledProxy(mesh); proxy != nullptr)
            triangles[mesh] = {proxy->arrays.indices.size() / 3};
    source.plan = planSampling(triangles, settings, source.originals, weights);
    for (uint32_t i = 0; i < instance_meshes.size(); ++i)
    {
        const Affine3& world_from_object = scene.instances()[i].world_from_object;
        // an instance that is flat in the world has no inverse, which rays need
        if (isInvertible(world_from_object))
            source.instances[instance_meshes[i]].push_back({i, world_from_object});
    }
    return source;
}

Status BakedSource::addOccluders(SceneSurfaces& surfaces, Occluders& world) const
{
    for (uint32_t mesh = 0; mesh < part.meshes().size(); ++mesh)
    {
        const MeshRecord& record = part.meshes()[mesh];
        if (record.clusters.count == 0 || instances[mesh].empty() || isDeformed(record))
            continue;
        const std::vector<Affine3> transforms = collectTransforms(instances[mesh]);
        if (const ProxySurface* const proxy = findSampledProxy(mesh); proxy != nullptr)
        {
            addProxy(world, *proxy, transforms);
            continue;
        }
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::readLevel(part, mesh, plan[mesh].level));
        HEARTH_TRY(addMesh(world, surfaces, pages, extractLevel(pages, plan[mesh].level), transforms));
    }
    return success();
}

Status BakedSource::addNeighbours(std::span<const PartPaths> neighbours, const SamplingSettings& settings,
                                  float distance, Occluders& world) const
{
    const Box3 receivers = computeReceiverBox(*this);
    if (receivers.empty())
        return success();
    for (const PartPaths& paths : neighbours)
    {
        HEARTH_ASSIGN_OR_RETURN(const PackView neighbour_scene, tools::openPart(paths.import_part));
        HEARTH_ASSIGN_OR_RETURN(const PackView neighbour_part, tools::openPart(paths.clusters_part));
        HEARTH_TRY(checkHierarchy(neighbour_part));
        HEARTH_TRY(addNeighbour(world, neighbour_scene, neighbour_part,
                                planNeighbourLevels(neighbour_scene, neighbour_part, settings), receivers,
                                distance));
    }
    return success();
}

std::vector<Placement> placeInstances(const Occluders& world, std::span<const MeshInstance> instances,
                                      uint32_t rays_per_sample)
{
    const size_t most = std::min(kMaxInstances, size_t{rays_per_sample});
    const size_t count = std::min(std::bit_ceil(instances.size()), std::bit_floor(most));
    std::vector<Placement> places;
    for (size_t i = 0; i < count; ++i)
        places.push_back({&world, instances[i * instances.size() / count].world_from_mesh, {}});
    return places;
}

std::vector<SurfaceSample> createSamples(const LevelArrays& level, double samples_per_vertex,
                                         const FitMeshSettings& fit_mesh)
{
    // vertices that clusters share are in the arrays once for each cluster
    const std::vector<uint32_t> first = findMergedVertices(level.mesh().mesh, fit_mesh);
    std::vector<uint32_t> corners;
    corners.reserve(level.indices.size());
    for (const uint32_t corner : level.indices)
        corners.push_back(first[corner]);
    const auto positions = static_cast<double>(mesh::weldPositions(level.positions).position_count);
    SurfaceSampleSettings settings;
    settings.samples_per_vertex =
        samples_per_vertex * positions / static_cast<double>(level.positions.size());
    settings.min_per_vertex = kMinVertexSamples * samples_per_vertex;
    return surfaceSamples(level.positions, corners, settings);
}

double computeArea(const LevelArrays& level)
{
    double area = 0;
    for (size_t c = 0; c + 2 < level.indices.size(); c += 3)
    {
        const Float3 corner = level.positions[level.indices[c]];
        area += 0.5 * double{length(cross(level.positions[level.indices[c + 1]] - corner,
                                          level.positions[level.indices[c + 2]] - corner))};
    }
    return area;
}

std::vector<SurfaceSample> choosePoints(const LevelArrays& level, const FitMeshSettings& fit_mesh,
                                        size_t count)
{
    const std::vector<SurfaceSample> all = createSamples(level, 1, fit_mesh);
    const std::vector<double> rates(all.size(), 1.0);
    std::vector<SurfaceSample> points;
    for (const ChosenSample& chosen :
         chooseSamples({level.positions, level.indices, all, {}, {}}, rates, static_cast<uint32_t>(count)))
        points.push_back(all[chosen.sample]);
    return points;
}

} // namespace hearth::visibility
