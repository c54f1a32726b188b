// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/emission.h"

#include "cook/bricks/light/emission_fit.h"
#include "cook/bricks/light/emission_paths.h"
#include "formats/gpu_shared/brick_rays.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

using namespace shared;

namespace
{

/// Paths of an emissive surface, for each side area of a voxel. Fewer for large surfaces: kMaxPaths.
constexpr double kPathsPerVoxelArea = 256;
constexpr double kMaxPaths = 4e6;

/// Voxels around emissive clusters in which paths meet the real geometry.
constexpr double kGeometryReach = 4;

/// Groups of voxels near emissive clusters.
class NearGroups
{
public:
    NearGroups(const GridFrame& frame) : count_(frame.groups()), marked_(frame.groupCount()) {}

    void mark(const VoxelBox& box)
    {
        forEach(box, [&](size_t group) { marked_[group] = true; });
    }

    bool reaches(const VoxelBox& box) const
    {
        bool is_near = false;
        forEach(box, [&](size_t group) { is_near = is_near || marked_[group]; });
        return is_near;
    }

private:
    template <typename Visit>
    void forEach(const VoxelBox& box, const Visit& visit) const
    {
        Cell first, last;
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto a = static_cast<size_t>(axis);
            if (!(coordinate(box.max, axis) >= coordinate(box.min, axis)))
                return; // not finite
            const auto group = [&](double voxel)
            { return static_cast<uint32_t>(std::clamp(voxel / kGroupVoxels, 0.0, count_[a] - 1.0)); };
            first[a] = group(coordinate(box.min, axis) - kGeometryReach);
            last[a] = group(coordinate(box.max, axis) + kGeometryReach);
        }
        for (uint32_t z = first[2]; z <= last[2]; ++z)
            for (uint32_t y = first[1]; y <= last[1]; ++y)
                for (uint32_t x = first[0]; x <= last[0]; ++x)
                    visit(x + count_[0] * (y + size_t{count_[1]} * z));
    }

    Cell count_;
    std::vector<bool> marked_;
};

struct Clusters
{
    std::vector<InstancedCluster> emissive;
    std::vector<InstancedCluster> nearby; ///< all clusters that paths may meet, sorted
};

bool isEmissive(const SurfaceMaterial& material)
{
    const Float3 e = material.record.emissive;
    return e.x > 0 || e.y > 0 || e.z > 0;
}

bool hasEmissiveMaterial(const StaticScene& scene)
{
    for (const std::vector<SurfaceMaterial>& materials : scene.materials)
        if (std::ranges::any_of(materials, isEmissive))
            return true;
    return false;
}

Clusters findClusters(const StaticScene& scene, const GridFrame& frame, double error)
{
    Clusters clusters;
    NearGroups near(frame);
    const std::vector<InstancedCluster> placed = findCutClusters(scene, static_cast<float>(error));
    const auto box = [&](const InstancedCluster& at)
    {
        return computeVoxelBox(scene, at,
                               voxelsFromObject(frame, scene.instances[at.instance].world_from_object));
    };
    for (const InstancedCluster& at : placed)
        if (isEmissive(
                scene.material(at.source, scene.sources[at.source].clusters.clusters()[at.cluster].material)))
        {
            clusters.emissive.push_back(at);
            near.mark(box(at));
        }
    if (!clusters.emissive.empty())
        for (const InstancedCluster& at : placed)
            if (near.reaches(box(at)))
                clusters.nearby.push_back(at);
    return clusters;
}

/// Light of one cluster.
struct SentLight
{
    Double3 flux;
    LeavingLights lights;
};

Result<SentLight> sendFrom(const StaticScene& scene, const InstancedCluster& at, const GridFrame& frame,
                           const EmissionPaths& paths)
{
    const formats::PackView& part = scene.sources[at.source].clusters;
    const formats::ClusterRecord& record = part.clusters()[at.cluster];
    const StaticInstance& instance = scene.instances[at.instance];
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> page, part.decodePage(at.page));
    const auto geometry = formats::ClusterGeometry::at(page, record, part.meshes()[instance.mesh]);
    if (!geometry)
        return Error{Issue::meaning_geometry, part.name(), "cluster " + std::to_string(at.cluster),
                     "lies outside its page"};
    SentLight sent;
    sent.flux = paths.sendFrom(*geometry, scene.material(at.source, record.material),
                               voxelsFromObject(frame, instance.world_from_object), instance.mirrored,
                               brickHash(at.cluster + brickHash(at.instance)), sent.lights);
    return sent;
}

/// Return about the area of the emissive surfaces, in sides of voxels: that of the boxes of their clusters.
double estimateEmissiveArea(const StaticScene& scene, const Clusters& clusters, const GridFrame& frame)
{
    double area = 0;
    for (const InstancedCluster& at : clusters.emissive)
    {
        const VoxelBox box = computeVoxelBox(
            scene, at, voxelsFromObject(frame, scene.instances[at.instance].world_from_object));
        const Double3 size = box.max - box.min;
        area += 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    }
    return area;
}

/// Light of all emissive clusters.
struct SentLights
{
    Clusters clusters;
    RayScene rays;
    std::vector<SentLight> sent; ///< [clusters.emissive]
};

/// error  metres in world space: LOD error allowed for the clusters
Result<std::optional<SentLights>> sendLights(const StaticScene& scene, const GridFrame& frame, double error,
                                             const BrickMasks& masks)
{
    if (!hasEmissiveMaterial(scene))
        return std::optional<SentLights>();
    Clusters clusters = findClusters(scene, frame, error);
    if (clusters.emissive.empty())
        return std::optional<SentLights>();
    HEARTH_ASSIGN_OR_RETURN(RayScene rays, RayScene::build(scene, clusters.nearby, frame));
    const double area = estimateEmissiveArea(scene, clusters, frame);
    const EmissionPaths paths(rays, masks, std::min(kPathsPerVoxelArea, kMaxPaths / std::max(area, 1.0)));
    std::vector<std::optional<Result<SentLight>>> results(clusters.emissive.size());
    tbb::parallel_for(size_t{0}, results.size(),
                      [&](size_t i) { results[i] = sendFrom(scene, clusters.emissive[i], frame, paths); });
    std::vector<SentLight> sent;
    for (std::optional<Result<SentLight>>& result : results)
    {
        if (!result->ok())
            return result->error();
        sent.push_back(std::move(**result));
    }
    return std::optional<SentLights>(std::in_place, std::move(clusters), std::move(rays), std::move(sent));
}

/// Light that an instance sends out by a voxel.
struct InstanceFlux
{
    uint32_t instance;
    Double3 flux;
};

/// Sum the light that leaves each voxel by instance. Instances of a voxel are in the order of their clusters.
std::map<std::pair<uint32_t, uint32_t>, std::vector<InstanceFlux>> sumByVoxel(const SentLights& lights)
{
    std::map<std::pair<uint32_t, uint32_t>, std::vector<InstanceFlux>> voxels;
    for (size_t i = 0; i < lights.sent.size(); ++i)
        for (const LeavingLight& leaving : lights.sent[i].lights.lights())
        {
            std::vector<InstanceFlux>& fluxes = voxels[{leaving.voxel.brick, leaving.voxel.bit}];
            const uint32_t instance = lights.clusters.emissive[i].instance;
            auto at = std::ranges::find(fluxes, instance, &InstanceFlux::instance);
            if (at == fluxes.end())
                at = fluxes.insert(fluxes.end(), {instance, {}});
            at->flux = at->flux + leaving.flux;
        }
    return voxels;
}

Float3 divideChannels(Double3 part, Double3 whole)
{
    const auto ratio = [](double a, double b) { return b > 0 ? static_cast<float>(a / b) : 0.0f; };
    return {ratio(part.x, whole.x), ratio(part.y, whole.y), ratio(part.z, whole.z)};
}

} // namespace

Result<EmittedFlux> traceEmission(const StaticScene& scene, CookedGrid& grid)
{
    EmittedFlux total;
    BrickTables& tables = grid.tables;
    HEARTH_ASSIGN_OR_RETURN(const std::optional<SentLights> emitted,
                            sendLights(scene, grid.statistics.frame, grid.statistics.error, tables.masks()));
    if (!emitted)
        return total;
    LeavingLights lights;
    for (const SentLight& light : emitted->sent)
    {
        total.sent = total.sent + light.flux;
        for (const LeavingLight& leaving : light.lights.lights())
        {
            lights.add(leaving);
            total.credited = total.credited + leaving.flux;
        }
    }
    const EmissionFit fit(emitted->rays, lights, tables);
    tbb::parallel_for(size_t{0}, lights.lights().size(),
                      [&](size_t i) { fit.setEmission(lights.lights()[i]); });
    tables.lighting = tables.emission;
    return total;
}

Result<std::vector<EmissionShare>> findEmissionShares(const StaticScene& scene, const BrickView& bricks)
{
    const BrickGrid& grid = bricks.masks.grid;
    const GridFrame frame{grid.origin, grid.voxel_size, {grid.voxels_x, grid.voxels_y, grid.voxels_z}};
    HEARTH_ASSIGN_OR_RETURN(
        const std::optional<SentLights> emitted,
        sendLights(scene, frame, GridSettings{}.error_share * double{grid.voxel_size}, bricks.masks));
    std::vector<EmissionShare> shares;
    if (!emitted)
        return shares;
    for (const auto& [voxel, fluxes] : sumByVoxel(*emitted))
    {
        Double3 sum{};
        for (const InstanceFlux& flux : fluxes)
            sum = sum + flux.flux;
        for (uint32_t side = 0; side < kFaces; ++side)
            if (const uint32_t face = brickFace(bricks.masks.bricks[voxel.first], voxel.second, side);
                face != kNoFace)
                for (const InstanceFlux& flux : fluxes)
                    shares.push_back({face, flux.instance, divideChannels(flux.flux, sum)});
    }
    std::ranges::sort(shares, {}, [](const EmissionShare& s) { return std::pair(s.face, s.instance); });
    return shares;
}

} // namespace hearth::bricks
