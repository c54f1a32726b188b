// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/visibility_part.h"

#include "cook/json/json.h"
#include "cook/pages/mesh_copies.h"
#include "cook/pages/rewrite.h"
#include "cook/tools/open_part.h"
#include "cook/visibility/program/instance_copies.h"
#include "cook/visibility/program/instance_light.h"
#include "cook/visibility/program/variation.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "cook/visibility/scene/scene_occluders.h"
#include "cook/visibility/scene/source_normals.h"
#include "formats/container/container_writer.h"
#include "formats/pack/instance_meshes.h"
#include "formats/pack/pack_check.h"

#include <algorithm>
#include <chrono>
#include <deque>

#include <unistd.h>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Rays that compare the instances of all meshes, a thirtieth of those of the default quality.
constexpr double kInstanceRays = 0x1p18;

// Share of the rays on whose levels instances are compared and variation is measured.
constexpr double kMeasuredShare = 0.125;

// Not 0, so that surfaces with only interior samples have a fit.
constexpr float kInteriorWeight = 1e-3f;

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Collect all that occludes a source.
Status collectOccluders(const BakedSource& source, std::span<const PartPaths> neighbours,
                        const BakeSettings& settings, SceneSurfaces& surfaces, Occluders& world)
{
    HEARTH_TRY(source.addOccluders(surfaces, world));
    if (settings.occluders == OccluderScope::pack)
        HEARTH_TRY(source.addNeighbours(neighbours, settings.sampling, settings.rays.distance, world));
    world.finish();
    return success();
}

class Bake
{
public:
    Bake(const BakedSource& source, std::span<const PartPaths> neighbours, const BakeSettings& settings,
         const BakeObserver& observe)
        : source_(source),
          scene_(source.scene),
          part_(source.part),
          neighbours_(neighbours),
          settings_(settings),
          observe_(observe),
          surfaces_(scene_),
          codes_(part_.clusters().size())
    {
    }

    /// returns  nothing if the observer returned false
    Result<std::optional<std::vector<MeshStatistics>>> run()
    {
        surroundings_.assign(scene_.instances().size(), kPlainSurroundings);
        light_.emplace(makeLight());
        HEARTH_ASSIGN_OR_RETURN(poses_, samplePoses(scene_, settings_.poses));
        Occluders world;
        if (settings_.occluders != OccluderScope::mesh)
            HEARTH_TRY(collectOccluders(source_, neighbours_, settings_, surfaces_, world));
        uint64_t triangles = 0;
        for (uint32_t mesh = 0; mesh < part_.meshes().size(); ++mesh)
            triangles += isBaked(scene_, part_, mesh) ? part_.meshes()[mesh].source_triangles : 0;
        std::vector<MeshStatistics> statistics;
        uint64_t done = 0;
        for (uint32_t mesh = 0; mesh < part_.meshes().size(); ++mesh)
        {
            const MeshRecord& record = part_.meshes()[mesh];
            if (!isBaked(scene_, part_, mesh))
                continue;
            share_before_ = static_cast<double>(done) / static_cast<double>(triangles);
            done += record.source_triangles;
            share_of_mesh_ = static_cast<double>(done) / static_cast<double>(triangles) - share_before_;
            HEARTH_ASSIGN_OR_RETURN(std::optional<MeshStatistics> of_mesh, bake(mesh, world));
            if (!of_mesh)
                return std::optional<std::vector<MeshStatistics>>();
            statistics.push_back(std::move(*of_mesh));
        }
        return std::optional(std::move(statistics));
    }

    /// Visibility codes of the vertices of each cluster; empty for a cluster without visibility.
    const std::vector<std::vector<uint32_t>>& codes() const { return codes_; }

    /// Write the surroundings of instances.
    Status writeSurroundings(ContainerWriter& writer) const
    {
        HEARTH_TRY(writer.addRecords<SurroundingsRecord>(kChunkSurroundings, surroundings_));
        return writer.addRecords<RadianceTransferRecord>(kChunkRadianceTransfers, light_->transfers());
    }

private:
    Result<std::optional<MeshStatistics>> bake(uint32_t mesh, const Occluders& world)
    {
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(part_, mesh));
        const std::vector<LevelArrays> levels = extractLevels(pages);
        const MeshSampling& plan = source_.plan[mesh];
        const ProxySurface* const proxy = source_.findSampledProxy(mesh);
        const LevelArrays& sampled = proxy != nullptr ? proxy->arrays : levels[plan.level];
        HEARTH_ASSIGN_OR_RETURN(const SourceNormals normals,
                                SourceNormals::read(scene_, source_.originals[mesh], pages.record()));
        const bool deformed = isDeformed(pages.record());
        const bool alone =
            settings_.occluders == OccluderScope::mesh || deformed || source_.instances[mesh].empty();
        MeshStatistics statistics;
        statistics.mesh = mesh;
        statistics.name = part_.text(pages.record().name);
        statistics.levels = static_cast<uint32_t>(levels.size());
        statistics.sampled_level = plan.level;
        if (source_.originals[mesh] != mesh)
            statistics.copy_of = source_.originals[mesh];

        std::deque<Occluders> itself;
        std::vector<Placement> places;
        if (alone)
        {
            HEARTH_ASSIGN_OR_RETURN(places, placeAlone(pages, sampled, proxy, statistics, itself));
        }
        else
        {
            const std::vector<MeshInstance>& instances = source_.instances[mesh];
            places = placeInstances(world, instances, plan.rays_per_sample);
            statistics.poses = {"rest"};
            statistics.instances = static_cast<uint32_t>(std::min(places.size(), instances.size()));
        }
        const auto start = std::chrono::steady_clock::now();
        std::vector<SurfaceSample> samples =
            createSamples(sampled, plan.samples_per_vertex, settings_.fit.levels.fit_mesh);
        const std::optional<SampledMoments> seen =
            trace(sampled, plan.rays_per_sample, samples, places, statistics);
        if (!seen)
            return std::optional<MeshStatistics>();
        for (size_t s = 0; s < samples.size(); ++s)
            if (seen->interior[s] != 0)
            {
                samples[s].weight = kInteriorWeight;
                ++statistics.interior_samples;
            }
        statistics.ray_seconds = secondsSince(start);
        bakeSurroundings(sampled, samples, *seen, alone, places, statistics);
        const ProxySurface* const fitted = source_.findProxy(mesh);
        if (fitted != nullptr)
            statistics.proxy = proxy != nullptr ? ProxyUse::all : ProxyUse::fit;
        fit({levels, plan.level, fitted != nullptr ? &fitted->arrays : nullptr, proxy != nullptr, samples,
             *seen, normals},
            statistics);
        return std::optional(std::move(statistics));
    }

    InstanceLight makeLight() const
    {
        uint64_t groups = 0;
        for (uint32_t mesh = 0; mesh < source_.instances.size(); ++mesh)
            if (isBaked(scene_, part_, mesh))
                groups += InstanceLight::countGroups(source_.instances[mesh].size());
        return {groups, {.seed = settings_.rays.seed, .distance = settings_.rays.distance}};
    }

    /// Return the rays that compare the instances of a mesh: by the square root of their number, so that a
    /// few among thousands get enough.
    double instanceRays(uint32_t mesh) const
    {
        double roots = 0;
        for (const std::vector<MeshInstance>& instances : source_.instances)
            if (instances.size() > 1)
                roots += std::sqrt(static_cast<double>(instances.size()));
        return kInstanceRays * std::sqrt(static_cast<double>(source_.instances[mesh].size())) / roots;
    }

    /// Bake the surroundings of a mesh's instances, of deformed ones in their first pose.
    void bakeSurroundings(const LevelArrays& level, std::span<const SurfaceSample> samples,
                          const SampledMoments& seen, bool alone, std::span<const Placement> places,
                          MeshStatistics& statistics)
    {
        const auto start = std::chrono::steady_clock::now();
        const std::vector<Float3>& posed = places.front().posed_positions;
        const SampledSurface surface{posed.empty() ? level.positions : posed, level.indices, samples,
                                     seen.moments, seen.interior};
        const std::vector<MeshInstance>& instances = source_.instances[statistics.mesh];
        const Occluders& occluders = *places.front().occluders;
        if (alone)
            light_->bakeAlone(occluders, surface, instances, surroundings_);
        else
            light_->bakeInWorld(occluders, surface, instances, surroundings_);
        statistics.light_seconds = secondsSince(start);
        if (alone || instances.size() < 2)
            return;
        RaySettings rays = settings_.rays;
        rays.seed += statistics.mesh;
        statistics.instance_spread =
            fitInstances(occluders, surface, instances, instanceRays(statistics.mesh), rays, surroundings_);
    }

    /// Create the placements of a mesh alone: one without a pose, or one for each of its poses.
    /// proxy  that occludes in place of the mesh; null: the mesh itself does
    Result<std::vector<Placement>> placeAlone(const MeshPages& pages, const LevelArrays& sampled,
                                              const ProxySurface* proxy, MeshStatistics& statistics,
                                              std::deque<Occluders>& itself)
    {
        std::vector<Placement> places;
        const Affine3 identity;
        const auto add = [&](std::string name, const LevelArrays& level, std::vector<Float3> posed) -> Status
        {
            Occluders& occluders = itself.emplace_back();
            if (proxy != nullptr)
                addProxy(occluders, *proxy, {&identity, 1});
            else
                HEARTH_TRY(addMesh(occluders, surfaces_, pages, level, {&identity, 1}));
            occluders.finish();
            places.push_back({&occluders, identity, std::move(posed)});
            statistics.poses.push_back(std::move(name));
            return success();
        };
        const bool deformed = isDeformed(pages.record());
        if (deformed)
            for (const NamedPose& pose : poses_)
            {
                LevelArrays level = sampled;
                level.positions = posedPositions(scene_, pages, sampled, statistics.mesh, pose.pose);
                if (level.positions.empty())
                    continue;
                std::vector<Float3> posed = level.positions;
                HEARTH_TRY(add(pose.name, level, std::move(posed)));
            }
        if (places.empty())
            HEARTH_TRY(add(deformed ? "bind" : "rest", sampled, {}));
        return places;
    }

    /// Trace the rays. Instances share each sample's rays; poses have all of them each.
    std::optional<SampledMoments> trace(const LevelArrays& level, uint32_t rays_per_sample,
                                        std::span<const SurfaceSample> samples,
                                        std::span<const Placement> places, MeshStatistics& statistics)
    {
        RaySettings rays = settings_.rays;
        rays.rays_per_sample = rays_per_sample;
        if (statistics.instances > 0)
            rays.rays_per_sample /= static_cast<uint32_t>(places.size());
        rays.seed += statistics.mesh; // meshes at the same place have independent noise
        auto seen = sampledMoments(level.mesh().mesh, samples, places, rays, settings_.fit.refine_cones,
                                   [&](size_t place, uint64_t done, uint64_t total)
                                   { return report(place, places.size(), done, total); });
        if (!seen)
            return std::nullopt;
        statistics.samples = samples.size();
        statistics.rays = seen->rays;
        statistics.spread = seen->spread;
        rays_before_ += seen->rays;
        return seen;
    }

    bool report(size_t place, size_t count, uint64_t done, uint64_t total) const
    {
        if (!observe_)
            return true;
        const double part = total == 0 ? 1 : static_cast<double>(done) / static_cast<double>(total);
        const double share = (static_cast<double>(place) + part) / static_cast<double>(count);
        return observe_({share_before_ + share_of_mesh_ * share, rays_before_ + place * total + done});
    }

    void fit(const SampledMesh& mesh, MeshStatistics& statistics)
    {
        const auto start = std::chrono::steady_clock::now();
        MeshFit fitted = fitMesh(mesh, settings_.fit);
        statistics.fit = fitted.statistics;
        for (size_t l = 0; l < mesh.levels.size(); ++l)
        {
            const std::span<const LevelArrays::Part> parts = mesh.levels[l].parts;
            const std::vector<uint32_t>& codes = fitted.codes[l];
            for (size_t i = 0; i < parts.size(); ++i)
            {
                const size_t end = i + 1 < parts.size() ? parts[i + 1].first_vertex : codes.size();
                codes_[parts[i].cluster].assign(codes.begin() + parts[i].first_vertex,
                                                codes.begin() + static_cast<ptrdiff_t>(end));
            }
        }
        statistics.fit_seconds = secondsSince(start);
    }

    const BakedSource& source_;
    const PackView& scene_;
    const PackView& part_;
    const std::span<const PartPaths> neighbours_;
    const BakeSettings& settings_;
    const BakeObserver& observe_;
    SceneSurfaces surfaces_;
    std::vector<SurroundingsRecord> surroundings_; ///< of each instance
    std::optional<InstanceLight> light_;
    std::vector<NamedPose> poses_;
    std::vector<std::vector<uint32_t>> codes_;
    double share_before_ = 0;
    double share_of_mesh_ = 0;
    uint64_t rays_before_ = 0;
};

/// Decisions before a bake.
struct Preparation
{
    MeshCopies copies;
    std::vector<double> weights; ///< of planSampling; empty: the budget holds all rays that are asked for
};

/// Return whether a mesh gets fewer rays than it asks for.
bool isLimited(const BakedSource& source, const SamplingSettings& asked)
{
    return std::ranges::any_of(source.plan,
                               [&](const MeshSampling& sampling)
                               {
                                   return sampling.level != 0 ||
                                          sampling.rays_per_sample != asked.rays_per_sample ||
                                          sampling.samples_per_vertex != asked.samples_per_vertex;
                               });
}

/// Choose the instances of a source that get a copy of their mesh, and where rays are needed. Both are
/// measured on coarser levels than those that are baked.
/// instance_meshes  mesh of each instance
Result<Preparation> prepare(const PackView& scene, const PackView& part,
                            std::vector<uint32_t> instance_meshes, std::span<const PartPaths> neighbours,
                            const BakeSettings& settings)
{
    const BakedSource even = BakedSource::make(scene, part, instance_meshes, settings.sampling);
    SamplingSettings fewer = settings.sampling;
    fewer.max_rays *= kMeasuredShare;
    fewer.max_rays_per_triangle *= kMeasuredShare;
    const BakedSource source = BakedSource::make(scene, part, instance_meshes, fewer);
    const auto max_bytes =
        static_cast<uint64_t>(settings.copies * static_cast<double>(part.pageBytes().size()));
    const bool is_limited = isLimited(even, settings.sampling);
    Preparation preparation{{{}, std::move(instance_meshes)}, {}};
    if (settings.occluders == OccluderScope::mesh || !(is_limited || mayNeedCopies(source, max_bytes)))
        return preparation;
    SceneSurfaces surfaces(scene);
    Occluders world;
    HEARTH_TRY(collectOccluders(source, neighbours, settings, surfaces, world));
    HEARTH_ASSIGN_OR_RETURN(preparation.copies,
                            chooseCopies(source, world, std::move(preparation.copies.instance_meshes),
                                         settings.rays, settings.fit.levels.fit_mesh, max_bytes));
    if (!is_limited)
        return preparation;
    HEARTH_ASSIGN_OR_RETURN(
        const std::vector<std::optional<double>> variation,
        measureVariation(source, world, even.plan, settings.rays, settings.fit.levels.fit_mesh));
    preparation.weights = makeWeights(variation);
    return preparation;
}

/// Bake a source, and write its part.
/// instance_meshes  mesh of each instance
/// returns  nothing if `observe` returned false
Result<std::optional<std::vector<MeshStatistics>>>
bakePart(const BakedSource& source, std::span<const uint32_t> instance_meshes,
         std::span<const PartPaths> neighbours, const std::string& output_path, const BakeSettings& settings,
         const BakeObserver& observe)
{
    Bake bake(source, neighbours, settings, observe);
    HEARTH_ASSIGN_OR_RETURN(std::optional<std::vector<MeshStatistics>> statistics, bake.run());
    if (!statistics)
        return statistics;
    HEARTH_TRY(pages::rewriteVisibility(
        source.part.container(), output_path,
        [&](const pages::PageVertices& page, std::span<uint32_t> codes)
        {
            auto out = codes.begin();
            for (uint32_t c = 0; c < page.clusters.count; ++c)
                out = std::ranges::copy(bake.codes()[page.clusters.first + c], out).out;
        },
        {.types = {kChunkSurroundings, kChunkRadianceTransfers, kChunkInstanceMeshes},
         .write = [&](ContainerWriter& writer) -> Status
         {
             HEARTH_TRY(bake.writeSurroundings(writer));
             const bool has_copies = !std::ranges::equal(instance_meshes, source.scene.instances(), {}, {},
                                                         &InstanceRecord::mesh);
             return has_copies ? writer.addRecords<uint32_t>(kChunkInstanceMeshes, instance_meshes)
                               : success();
         }}));
    return statistics;
}

/// Return null for no spread.
Json spreadJson(const std::optional<InstanceSpread>& spread)
{
    if (!spread)
        return nullptr;
    return {{"of_mean", spread->of_mean},
            {"with_factors", spread->with_factors},
            {"changed_instances", spread->changed_instances},
            {"rays", spread->rays}};
}

Json meshJson(const MeshStatistics& mesh)
{
    Json json{
        {"mesh", mesh.mesh},
        {"name", mesh.name},
        {"copy_of", mesh.copy_of ? Json(*mesh.copy_of) : Json()},
        {"poses", mesh.poses},
        {"instances", mesh.instances},
        {"spread", mesh.spread},
        {"instance_spread", spreadJson(mesh.instance_spread)},
        {"levels", mesh.levels},
        {"sampled_level", mesh.sampled_level},
        {"samples", mesh.samples},
        {"rays", mesh.rays},
        {"seconds", {{"rays", mesh.ray_seconds}, {"fit", mesh.fit_seconds}, {"light", mesh.light_seconds}}},
        {"proxy", proxyUseName(mesh.proxy)},
        {"fit_mesh",
         {{"source_vertices", mesh.fit.fit_mesh.source_vertices},
          {"welded", mesh.fit.fit_mesh.welded},
          {"nearest", mesh.fit.fit_mesh.nearest},
          {"degenerate", mesh.fit.fit_mesh.thin.degenerate},
          {"duplicate", mesh.fit.fit_mesh.thin.duplicate},
          {"collapsed", mesh.fit.fit_mesh.thin.collapsed},
          {"flipped", mesh.fit.fit_mesh.thin.flipped},
          {"dropped", mesh.fit.fit_mesh.thin.dropped}}},
        {"solve",
         {{"iterations", mesh.fit.iterations},
          {"condition", mesh.fit.condition},
          {"converged", mesh.fit.converged}}},
        {"vertices", mesh.fit.vertices},
        {"clamped", mesh.fit.clamped},
        {"unseen", mesh.fit.unseen},
        {"interior_samples", mesh.interior_samples},
    };
    if (mesh.fit.refined)
        json["refined"] = {{"cones", mesh.fit.refined->cones},
                           {"distance_before", mesh.fit.refined->statistics.start_rms},
                           {"distance", mesh.fit.refined->statistics.rms}};
    if (mesh.fit.ao_error)
        json["ao_error"] = *mesh.fit.ao_error;
    return json;
}

} // namespace

Result<std::optional<std::vector<MeshStatistics>>>
writeVisibilityPart(const PackView& import_part, const PackView& clusters_part, const PackView& proxies,
                    std::span<const PartPaths> neighbours, const std::string& output_path,
                    const BakeSettings& settings, const BakeObserver& observe)
{
    HEARTH_TRY(checkHierarchy(clusters_part));
    HEARTH_ASSIGN_OR_RETURN(std::vector<uint32_t> own_meshes, readInstanceMeshes(import_part, clusters_part));
    HEARTH_ASSIGN_OR_RETURN(const Preparation preparation,
                            prepare(import_part, clusters_part, std::move(own_meshes), neighbours, settings));
    MeshProxies mesh_proxies;
    if (settings.proxies != ProxyUse::none)
    {
        HEARTH_ASSIGN_OR_RETURN(mesh_proxies,
                                makeMeshProxies(import_part, clusters_part, proxies, settings.proxies));
    }
    const MeshProxies* const used = settings.proxies != ProxyUse::none ? &mesh_proxies : nullptr;
    const MeshCopies& copies = preparation.copies;
    const auto bake = [&](const PackView& part)
    {
        return bakePart(BakedSource::make(import_part, part, copies.instance_meshes, settings.sampling,
                                          preparation.weights, used),
                        copies.instance_meshes, neighbours, output_path, settings, observe);
    };
    if (copies.meshes.empty())
        return bake(clusters_part);
    const std::string copied_path = output_path + ".copies-" + std::to_string(::getpid());
    HEARTH_TRY(pages::copyMeshes(clusters_part, copies.meshes, copied_path));
    Result<PackView> part = tools::openPart(copied_path);
    ::unlink(copied_path.c_str()); // stays mapped
    if (!part.ok())
        return std::move(part).error();
    return bake(*part);
}

std::string_view occluderScopeName(OccluderScope scope)
{
    switch (scope)
    {
    case OccluderScope::pack:
        return "pack";
    case OccluderScope::source:
        return "source";
    case OccluderScope::mesh:
        break;
    }
    return "mesh";
}

std::string statisticsJson(const std::string& source, const BakeSettings& settings, size_t neighbours,
                           const std::vector<MeshStatistics>& meshes)
{
    Json json{{"source", source},
              {"rays_per_sample", settings.sampling.rays_per_sample},
              {"samples_per_vertex", settings.sampling.samples_per_vertex},
              {"occluders", occluderScopeName(settings.occluders)},
              {"neighbours", neighbours},
              {"meshes", Json::array()}};
    for (const MeshStatistics& mesh : meshes)
        json["meshes"].push_back(meshJson(mesh));
    return json.dump(1) + "\n";
}

} // namespace hearth::visibility
