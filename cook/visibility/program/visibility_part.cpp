// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/visibility_part.h"

#include "cook/json/json.h"
#include "cook/mesh/weld.h"
#include "cook/pages/rewrite.h"
#include "cook/tools/open_part.h"
#include "cook/visibility/fit/finer_levels.h"
#include "cook/visibility/program/instance_light.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "cook/visibility/scene/neighbour_occluders.h"
#include "cook/visibility/scene/scene_occluders.h"
#include "cook/visibility/scene/source_normals.h"
#include "formats/base/affine3d.h"
#include "formats/container/container_writer.h"
#include "formats/pack/pack_check.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <deque>
#include <numbers>

#include <tbb/parallel_for.h>

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

// Rays that compare the instances of all meshes, a 64th of those of the default quality.
constexpr double kInstanceRays = 0x1p18;

// Not 0, so that surfaces with only interior samples have a fit.
constexpr float kInteriorWeight = 1e-3f;

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool isBaked(const MeshRecord& mesh)
{
    return mesh.clusters.count > 0 && (mesh.attributes & kVertexVisibility) != 0;
}

/// Plan the sampling of all meshes.
std::vector<MeshSampling> planMeshes(const PackView& part, const SamplingSettings& settings)
{
    std::vector<std::vector<uint64_t>> triangles(part.meshes().size());
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        if (isBaked(part.meshes()[mesh]))
            triangles[mesh] = countLevelTriangles(part, mesh);
    return planSampling(triangles, settings);
}

/// Return for each mesh of a neighbour the level that it is sampled on in its own bake.
std::vector<uint32_t> planNeighbourLevels(const PackView& part, const SamplingSettings& settings)
{
    std::vector<uint32_t> levels;
    for (const MeshSampling& sampling : planMeshes(part, settings))
        levels.push_back(sampling.level);
    return levels;
}

/// Collect the instances of each mesh, and check that the two parts belong together.
/// errors: meaning_reference for an instance of a mesh that is not there
Result<std::vector<std::vector<MeshInstance>>> collectInstances(const PackView& scene, const PackView& part)
{
    std::vector<std::vector<MeshInstance>> instances(part.meshes().size());
    for (uint32_t i = 0; i < scene.instances().size(); ++i)
    {
        const InstanceRecord& instance = scene.instances()[i];
        if (instance.mesh >= instances.size())
            return Error{Issue::meaning_reference, scene.name(), "instance " + std::to_string(i),
                         "mesh " + std::to_string(instance.mesh)};
        // an instance that is flat in the world has no inverse, which rays need
        if (isInvertible(instance.world_from_object))
            instances[instance.mesh].push_back({i, instance.world_from_object});
    }
    return instances;
}

std::vector<Affine3> collectTransforms(std::span<const MeshInstance> instances)
{
    std::vector<Affine3> transforms;
    for (const MeshInstance& instance : instances)
        transforms.push_back(instance.world_from_mesh);
    return transforms;
}

class Bake
{
public:
    Bake(const PackView& scene, const PackView& part, std::span<const PartPaths> neighbours,
         const BakeSettings& settings, const BakeObserver& observe)
        : scene_(scene),
          part_(part),
          neighbours_(neighbours),
          settings_(settings),
          observe_(observe),
          surfaces_(scene),
          plan_(planMeshes(part, settings.sampling)),
          codes_(part.clusters().size())
    {
    }

    /// returns  nothing if the observer returned false
    Result<std::optional<std::vector<MeshStatistics>>> run()
    {
        HEARTH_ASSIGN_OR_RETURN(instances_, collectInstances(scene_, part_));
        surroundings_.assign(scene_.instances().size(), kPlainSurroundings);
        light_.emplace(makeLight());
        HEARTH_ASSIGN_OR_RETURN(poses_, samplePoses(scene_, settings_.poses));
        Occluders world;
        if (settings_.occluders != OccluderScope::mesh)
            HEARTH_TRY(collectOccluders(world));
        uint64_t triangles = 0;
        for (const MeshRecord& mesh : part_.meshes())
            triangles += isBaked(mesh) ? mesh.source_triangles : 0;
        std::vector<MeshStatistics> statistics;
        uint64_t done = 0;
        for (uint32_t mesh = 0; mesh < part_.meshes().size(); ++mesh)
        {
            const MeshRecord& record = part_.meshes()[mesh];
            if (!isBaked(record))
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
    /// Collect the occluders of the scene, at the levels that are sampled, so that no sample is inside its
    /// own mesh, and those of the neighbours. Deformed meshes occlude only themselves.
    Status collectOccluders(Occluders& world)
    {
        for (uint32_t mesh = 0; mesh < part_.meshes().size(); ++mesh)
        {
            const MeshRecord& record = part_.meshes()[mesh];
            if (record.clusters.count == 0 || instances_[mesh].empty() || isDeformed(record))
                continue;
            HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(part_, mesh));
            HEARTH_TRY(addMesh(world, surfaces_, pages, extractLevel(pages, plan_[mesh].level),
                               collectTransforms(instances_[mesh])));
        }
        if (settings_.occluders == OccluderScope::pack)
            HEARTH_TRY(collectNeighbours(world));
        world.finish();
        return success();
    }

    Status collectNeighbours(Occluders& world) const
    {
        const Box3 receivers = computeReceiverBox();
        if (receivers.empty())
            return success();
        for (const PartPaths& paths : neighbours_)
        {
            HEARTH_ASSIGN_OR_RETURN(const PackView scene, tools::openPart(paths.import_part));
            HEARTH_ASSIGN_OR_RETURN(const PackView part, tools::openPart(paths.clusters_part));
            HEARTH_TRY(checkHierarchy(part));
            HEARTH_TRY(addNeighbour(world, scene, part, planNeighbourLevels(part, settings_.sampling),
                                    receivers, settings_.rays.distance));
        }
        return success();
    }

    /// Return the box in world space of all that others can occlude.
    Box3 computeReceiverBox() const
    {
        Box3 box;
        for (uint32_t mesh = 0; mesh < part_.meshes().size(); ++mesh)
        {
            const MeshRecord& record = part_.meshes()[mesh];
            if (isBaked(record) && !isDeformed(record))
                for (const MeshInstance& instance : instances_[mesh])
                    box.add(
                        transformBox(widened(instance.world_from_mesh), {record.box_min, record.box_max}));
        }
        return box;
    }

    Result<std::optional<MeshStatistics>> bake(uint32_t mesh, const Occluders& world)
    {
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(part_, mesh));
        std::vector<LevelArrays> levels = extractLevels(pages);
        const MeshSampling& plan = plan_[mesh];
        const LevelArrays& sampled = levels[plan.level];
        HEARTH_ASSIGN_OR_RETURN(const SourceNormals normals,
                                SourceNormals::read(scene_, mesh, pages.record()));
        const bool deformed = isDeformed(pages.record());
        const bool alone = settings_.occluders == OccluderScope::mesh || deformed || instances_[mesh].empty();
        MeshStatistics statistics;
        statistics.mesh = mesh;
        statistics.name = part_.text(pages.record().name);
        statistics.levels = static_cast<uint32_t>(levels.size());
        statistics.sampled_level = plan.level;

        std::deque<Occluders> itself;
        std::vector<Placement> places;
        if (alone)
        {
            HEARTH_ASSIGN_OR_RETURN(places, placeAlone(pages, sampled, statistics, itself));
        }
        else
            places = chooseInstances(world, instances_[mesh], plan, statistics);
        const auto start = std::chrono::steady_clock::now();
        std::vector<SurfaceSample> samples = createSamples(sampled, plan.samples_per_vertex);
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
        fit(levels, samples, *seen, normals, statistics);
        return std::optional(std::move(statistics));
    }

    InstanceLight makeLight() const
    {
        uint64_t groups = 0;
        for (uint32_t mesh = 0; mesh < instances_.size(); ++mesh)
            if (isBaked(part_.meshes()[mesh]))
                groups += InstanceLight::countGroups(instances_[mesh].size());
        return {groups, {.seed = settings_.rays.seed, .distance = settings_.rays.distance}};
    }

    /// Return the rays that compare the instances of a mesh: by the square root of their number, so that a
    /// few among thousands get enough.
    double instanceRays(uint32_t mesh) const
    {
        double roots = 0;
        for (const std::vector<MeshInstance>& instances : instances_)
            if (instances.size() > 1)
                roots += std::sqrt(static_cast<double>(instances.size()));
        return kInstanceRays * std::sqrt(static_cast<double>(instances_[mesh].size())) / roots;
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
        const std::vector<MeshInstance>& instances = instances_[statistics.mesh];
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

    std::vector<SurfaceSample> createSamples(const LevelArrays& level, double samples_per_vertex) const
    {
        // vertices that clusters share are in the arrays once for each cluster
        const std::vector<uint32_t> first = findMergedVertices(level.mesh().mesh, settings_.fit.proxy);
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

    /// Create the placements of a mesh alone: one without a pose, or one for each of its poses.
    Result<std::vector<Placement>> placeAlone(const MeshPages& pages, const LevelArrays& sampled,
                                              MeshStatistics& statistics, std::deque<Occluders>& itself)
    {
        std::vector<Placement> places;
        const Affine3 identity;
        const auto add = [&](std::string name, const LevelArrays& level, std::vector<Float3> posed) -> Status
        {
            Occluders& occluders = itself.emplace_back();
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

    /// Choose a power of two of the instances, so that they can share each sample's rays evenly.
    std::vector<Placement> chooseInstances(const Occluders& world, std::span<const MeshInstance> instances,
                                           const MeshSampling& plan, MeshStatistics& statistics) const
    {
        const size_t most = std::min(kMaxInstances, size_t{plan.rays_per_sample});
        const size_t count = std::min(std::bit_ceil(instances.size()), std::bit_floor(most));
        statistics.poses = {"rest"};
        std::vector<Placement> subset;
        for (size_t i = 0; i < count; ++i)
            subset.push_back({&world, instances[i * instances.size() / count].world_from_mesh, {}});
        statistics.instances = static_cast<uint32_t>(std::min(count, instances.size()));
        return subset;
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
        auto seen = sampledMoments(level.mesh().mesh, samples, places, rays, settings_.refine_cones,
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

    void fit(const std::vector<LevelArrays>& levels, const std::vector<SurfaceSample>& samples,
             const SampledMoments& seen, const SourceNormals& normals, MeshStatistics& statistics)
    {
        const auto start = std::chrono::steady_clock::now();
        const size_t sampled = statistics.sampled_level;
        std::vector<LevelMesh> meshes;
        for (const LevelArrays& level : levels)
            meshes.push_back(level.mesh());
        std::vector<LevelMesh> fitted(meshes.begin() + statistics.sampled_level, meshes.end());
        fitted.front().finer_vertex = {}; // nothing finer is fitted
        std::vector<LevelFit> fits = fitLevels(fitted, samples, seen.moments, settings_.fit);
        if (settings_.refine_cones)
            statistics.refined = refineLevels(fitted, samples, seen.second, settings_.fit, fits);
        std::vector<std::vector<Moments>> moments =
            interpolateFinerLevels(std::span(meshes).first(sampled + 1), fits.front().moments);
        statistics.proxy = fits.front().proxy;
        for (LevelFit& fit : fits)
        {
            const FitStatistics& of_level = fit.statistics;
            statistics.max_iterations_used =
                std::max(statistics.max_iterations_used, of_level.solve.iterations);
            statistics.condition = std::max(statistics.condition, of_level.solve.condition);
            statistics.converged = statistics.converged && of_level.solve.converged;
            statistics.vertices += of_level.vertices;
            statistics.clamped += of_level.clamped;
            statistics.unseen += of_level.unseen;
            moments.push_back(std::move(fit.moments));
        }
        encode(levels, moments, normals);
        statistics.fit_seconds = secondsSince(start);
        if (settings_.estimate_error)
            statistics.ao_error = estimateNoise(levels[sampled], samples, seen.moments);
    }

    /// Encode the moments of all levels. Clusters that several cuts draw have equal codes in all of them.
    void encode(std::span<const LevelArrays> levels, std::span<const std::vector<Moments>> moments,
                const SourceNormals& normals)
    {
        std::vector<uint32_t> finer_codes;
        for (size_t l = 0; l < levels.size(); ++l)
        {
            std::vector<uint32_t> codes = encodeLevel(levels[l], moments[l], normals, finer_codes);
            for (size_t i = 0; i < levels[l].parts.size(); ++i)
            {
                const std::span<const LevelArrays::Part> parts = levels[l].parts;
                const size_t end = i + 1 < parts.size() ? parts[i + 1].first_vertex : codes.size();
                codes_[parts[i].cluster].assign(codes.begin() + parts[i].first_vertex,
                                                codes.begin() + static_cast<ptrdiff_t>(end));
            }
            finer_codes = std::move(codes);
        }
    }

    /// Encode the moments of a level's vertices. Vertices with the moments of another one have its code.
    /// finer_codes  of the next finer level
    static std::vector<uint32_t> encodeLevel(const LevelArrays& level, std::span<const Moments> moments,
                                             const SourceNormals& normals,
                                             std::span<const uint32_t> finer_codes)
    {
        std::vector<uint32_t> codes(level.positions.size());
        const auto encodeVertex = [&](size_t v)
        {
            if (level.first_copy[v] != v)
                return;
            if (!level.finer_vertex.empty() && level.finer_vertex[v] != kInvalidIndex)
            {
                codes[v] = finer_codes[level.finer_vertex[v]];
                return;
            }
            const Float3 normal = level.normals[v];
            const Float3 exact = normals.find(level.positions[v], normal);
            codes[v] = encodeVisibility(moments[v].m0, turnWithNormal(moments[v].m1, exact, normal), normal);
        };
        tbb::parallel_for(size_t{0}, codes.size(), encodeVertex);
        for (size_t v = 0; v < codes.size(); ++v)
            codes[v] = codes[level.first_copy[v]];
        return codes;
    }

    /// Estimate the noise of ambient occlusion. Two fits, each to every other sample, differ by twice the
    /// noise of the fit to both: the noise of their rays, and of the samples' positions.
    double estimateNoise(const LevelArrays& level, std::span<const SurfaceSample> samples,
                         std::span<const Moments> moments) const
    {
        std::array<std::vector<Moments>, 2> fitted;
        for (size_t half = 0; half < 2; ++half)
        {
            std::vector<SurfaceSample> subset;
            std::vector<Moments> values;
            for (size_t s = half; s < samples.size(); s += 2)
            {
                subset.push_back(samples[s]);
                subset.back().area *= 2; // each half represents the whole surface
                values.push_back(moments[s]);
            }
            const LevelMesh mesh = level.mesh();
            fitted[half] = std::move(fitLevels({&mesh, 1}, subset, values, settings_.fit).front().moments);
        }
        double sum = 0;
        for (size_t v = 0; v < level.normals.size(); ++v)
        {
            const double difference =
                dot(level.normals[v], fitted[0][v].m1 - fitted[1][v].m1) / (2 * std::numbers::pi);
            sum += difference * difference;
        }
        return std::sqrt(sum / static_cast<double>(std::max<size_t>(level.normals.size(), 1)));
    }

    const PackView& scene_;
    const PackView& part_;
    const std::span<const PartPaths> neighbours_;
    const BakeSettings& settings_;
    const BakeObserver& observe_;
    SceneSurfaces surfaces_;
    const std::vector<MeshSampling> plan_;             ///< of each mesh
    std::vector<std::vector<MeshInstance>> instances_; ///< of each mesh
    std::vector<SurroundingsRecord> surroundings_;     ///< of each instance
    std::optional<InstanceLight> light_;
    std::vector<NamedPose> poses_;
    std::vector<std::vector<uint32_t>> codes_;
    double share_before_ = 0;
    double share_of_mesh_ = 0;
    uint64_t rays_before_ = 0;
};

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
        {"poses", mesh.poses},
        {"instances", mesh.instances},
        {"spread", mesh.spread},
        {"instance_spread", spreadJson(mesh.instance_spread)},
        {"levels", mesh.levels},
        {"sampled_level", mesh.sampled_level},
        {"samples", mesh.samples},
        {"rays", mesh.rays},
        {"seconds", {{"rays", mesh.ray_seconds}, {"fit", mesh.fit_seconds}, {"light", mesh.light_seconds}}},
        {"proxy",
         {{"source_vertices", mesh.proxy.source_vertices},
          {"welded", mesh.proxy.welded},
          {"nearest", mesh.proxy.nearest},
          {"degenerate", mesh.proxy.thin.degenerate},
          {"duplicate", mesh.proxy.thin.duplicate},
          {"collapsed", mesh.proxy.thin.collapsed},
          {"flipped", mesh.proxy.thin.flipped},
          {"dropped", mesh.proxy.thin.dropped}}},
        {"solve",
         {{"iterations", mesh.max_iterations_used},
          {"condition", mesh.condition},
          {"converged", mesh.converged}}},
        {"vertices", mesh.vertices},
        {"clamped", mesh.clamped},
        {"unseen", mesh.unseen},
        {"interior_samples", mesh.interior_samples},
    };
    if (mesh.refined)
        json["refined"] = {{"cones", mesh.refined->cones},
                           {"distance_before", mesh.refined->statistics.start_rms},
                           {"distance", mesh.refined->statistics.rms}};
    if (mesh.ao_error)
        json["ao_error"] = *mesh.ao_error;
    return json;
}

} // namespace

Result<std::optional<std::vector<MeshStatistics>>>
writeVisibilityPart(const PackView& import_part, const PackView& clusters_part,
                    std::span<const PartPaths> neighbours, const std::string& output_path,
                    const BakeSettings& settings, const BakeObserver& observe)
{
    HEARTH_TRY(checkHierarchy(clusters_part));
    Bake bake(import_part, clusters_part, neighbours, settings, observe);
    HEARTH_ASSIGN_OR_RETURN(std::optional<std::vector<MeshStatistics>> statistics, bake.run());
    if (!statistics)
        return statistics;
    HEARTH_TRY(pages::rewriteVisibility(
        clusters_part.container(), output_path,
        [&](const pages::PageVertices& page, std::span<uint32_t> codes)
        {
            auto out = codes.begin();
            for (uint32_t c = 0; c < page.clusters.count; ++c)
                out = std::ranges::copy(bake.codes()[page.clusters.first + c], out).out;
        },
        {.types = {kChunkSurroundings, kChunkRadianceTransfers},
         .write = [&](ContainerWriter& writer) { return bake.writeSurroundings(writer); }}));
    return statistics;
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
