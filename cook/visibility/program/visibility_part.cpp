// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/visibility_part.h"

#include "cook/json/json.h"
#include "cook/mesh/weld.h"
#include "cook/pages/rewrite.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "cook/visibility/scene/scene_occluders.h"
#include "cook/visibility/scene/source_normals.h"
#include "formats/base/affine3d.h"
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

// Not 0, so that surfaces with only interior samples have a fit.
constexpr float kInteriorWeight = 1e-3f;

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool isDeformed(const MeshRecord& mesh)
{
    return mesh.skinned != 0 || mesh.morph_target_count != 0;
}

bool isBaked(const MeshRecord& mesh)
{
    return mesh.clusters.count > 0 && (mesh.attributes & kVertexVisibility) != 0;
}

/// Collect the world transforms of each mesh's instances, and check that the two parts belong together.
/// errors: meaning_reference for an instance of a mesh that is not there
Result<std::vector<std::vector<Affine3>>> collectTransforms(const PackView& scene, const PackView& part)
{
    std::vector<std::vector<Affine3>> transforms(part.meshes().size());
    for (size_t i = 0; i < scene.instances().size(); ++i)
    {
        const InstanceRecord& instance = scene.instances()[i];
        if (instance.mesh >= transforms.size())
            return Error{Issue::meaning_reference, scene.name(), "instance " + std::to_string(i),
                         "mesh " + std::to_string(instance.mesh)};
        // an instance that is flat in the world has no inverse, which rays need
        if (inverted(widened(instance.world_from_object)))
            transforms[instance.mesh].push_back(instance.world_from_object);
    }
    return transforms;
}

class Bake
{
public:
    Bake(const PackView& scene, const PackView& part, const BakeSettings& settings,
         const BakeObserver& observe)
        : scene_(scene), part_(part), settings_(settings), observe_(observe), masks_(scene)
    {
        codes_.resize(part.clusters().size());
    }

    /// returns  nothing if the observer returned false
    Result<std::optional<std::vector<MeshStatistics>>> run()
    {
        HEARTH_ASSIGN_OR_RETURN(transforms_, collectTransforms(scene_, part_));
        HEARTH_ASSIGN_OR_RETURN(poses_, samplePoses(scene_, settings_.poses));
        Occluders world;
        if (!settings_.alone)
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

private:
    /// Collect the occluders of the scene. Deformed meshes occlude only themselves.
    Status collectOccluders(Occluders& world)
    {
        for (uint32_t mesh = 0; mesh < part_.meshes().size(); ++mesh)
        {
            const MeshRecord& record = part_.meshes()[mesh];
            if (record.clusters.count == 0 || transforms_[mesh].empty() || isDeformed(record))
                continue;
            HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(part_, mesh));
            HEARTH_TRY(addMesh(world, masks_, pages, extractFinestLevel(pages), transforms_[mesh]));
        }
        world.finish();
        return success();
    }

    Result<std::optional<MeshStatistics>> bake(uint32_t mesh, const Occluders& world)
    {
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(part_, mesh));
        std::vector<LevelArrays> levels = extractLevels(pages);
        const LevelArrays& finest = levels.front();
        HEARTH_ASSIGN_OR_RETURN(const SourceNormals normals,
                                SourceNormals::read(scene_, mesh, pages.record()));
        const bool deformed = isDeformed(pages.record());
        const bool alone = settings_.alone || deformed || transforms_[mesh].empty();
        MeshStatistics statistics;
        statistics.mesh = mesh;
        statistics.name = part_.text(pages.record().name);
        statistics.levels = static_cast<uint32_t>(levels.size());

        std::deque<Occluders> itself;
        std::vector<Placement> places;
        if (alone)
        {
            HEARTH_ASSIGN_OR_RETURN(places, placeAlone(pages, finest, statistics, itself));
        }
        else
            places = chooseInstances(world, transforms_[mesh], statistics);
        const auto start = std::chrono::steady_clock::now();
        std::vector<SurfaceSample> samples = createSamples(finest);
        const std::optional<SampledMoments> seen = trace(finest, samples, places, statistics);
        if (!seen)
            return std::optional<MeshStatistics>();
        for (size_t s = 0; s < samples.size(); ++s)
            if (seen->interior[s] != 0)
            {
                samples[s].weight = kInteriorWeight;
                ++statistics.interior_samples;
            }
        statistics.ray_seconds = secondsSince(start);
        fit(levels, samples, *seen, normals, statistics);
        return std::optional(std::move(statistics));
    }

    std::vector<SurfaceSample> createSamples(const LevelArrays& finest) const
    {
        // vertices that clusters share are in the arrays once for each cluster
        const std::vector<uint32_t> first = findMergedVertices(finest.mesh().mesh, settings_.fit.proxy);
        std::vector<uint32_t> corners;
        corners.reserve(finest.indices.size());
        for (const uint32_t corner : finest.indices)
            corners.push_back(first[corner]);
        const auto positions = static_cast<double>(mesh::weldPositions(finest.positions).position_count);
        SurfaceSampleSettings settings;
        settings.samples_per_vertex =
            settings_.samples_per_vertex * positions / static_cast<double>(finest.positions.size());
        settings.min_per_vertex = kMinVertexSamples * settings_.samples_per_vertex;
        return surfaceSamples(finest.positions, corners, settings);
    }

    /// Create the placements of a mesh alone: one without a pose, or one for each of its poses.
    Result<std::vector<Placement>> placeAlone(const MeshPages& pages, const LevelArrays& finest,
                                              MeshStatistics& statistics, std::deque<Occluders>& itself)
    {
        std::vector<Placement> places;
        const Affine3 identity;
        const auto add = [&](std::string name, const LevelArrays& level, std::vector<Float3> posed) -> Status
        {
            Occluders& occluders = itself.emplace_back();
            HEARTH_TRY(addMesh(occluders, masks_, pages, level, {&identity, 1}));
            occluders.finish();
            places.push_back({&occluders, identity, std::move(posed)});
            statistics.poses.push_back(std::move(name));
            return success();
        };
        const bool deformed = isDeformed(pages.record());
        if (deformed)
            for (const NamedPose& pose : poses_)
            {
                LevelArrays level = finest;
                level.positions = posedPositions(scene_, pages, finest, statistics.mesh, pose.pose);
                if (level.positions.empty())
                    continue;
                std::vector<Float3> posed = level.positions;
                HEARTH_TRY(add(pose.name, level, std::move(posed)));
            }
        if (places.empty())
            HEARTH_TRY(add(deformed ? "bind" : "rest", finest, {}));
        return places;
    }

    /// Choose a power of two of the instances, so that they can share each sample's rays evenly.
    std::vector<Placement> chooseInstances(const Occluders& world, const std::vector<Affine3>& transforms,
                                           MeshStatistics& statistics) const
    {
        const size_t most = std::min(kMaxInstances, size_t{settings_.rays.rays_per_sample});
        const size_t count = std::min(std::bit_ceil(transforms.size()), std::bit_floor(most));
        statistics.poses = {"rest"};
        std::vector<Placement> subset;
        for (size_t i = 0; i < count; ++i)
            subset.push_back({&world, transforms[i * transforms.size() / count], {}});
        statistics.instances = static_cast<uint32_t>(std::min(count, transforms.size()));
        return subset;
    }

    /// Trace the rays. Instances share each sample's rays; poses have all of them each.
    std::optional<SampledMoments> trace(const LevelArrays& finest, std::span<const SurfaceSample> samples,
                                        std::span<const Placement> places, MeshStatistics& statistics)
    {
        RaySettings rays = settings_.rays;
        if (statistics.instances > 0)
            rays.rays_per_sample /= static_cast<uint32_t>(places.size());
        rays.seed += statistics.mesh; // meshes at the same place have independent noise
        auto seen = sampledMoments(finest.mesh().mesh, samples, places, rays, settings_.refine_cones,
                                   [&](size_t place, uint64_t done, uint64_t total)
                                   { return report(place, places.size(), done, total); });
        if (!seen)
            return std::nullopt;
        statistics.samples = samples.size();
        statistics.rays = seen->rays;
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
        std::vector<LevelMesh> meshes;
        for (const LevelArrays& level : levels)
            meshes.push_back(level.mesh());
        std::vector<LevelFit> fits = fitLevels(meshes, samples, seen.moments, settings_.fit);
        if (settings_.refine_cones)
            statistics.refined = refineLevels(meshes, samples, seen.second, settings_.fit, fits);
        statistics.proxy = fits.front().proxy;
        for (size_t l = 0; l < levels.size(); ++l)
        {
            const FitStatistics& of_level = fits[l].statistics;
            statistics.max_iterations_used =
                std::max(statistics.max_iterations_used, of_level.solve.iterations);
            statistics.condition = std::max(statistics.condition, of_level.solve.condition);
            statistics.converged = statistics.converged && of_level.solve.converged;
            statistics.vertices += of_level.vertices;
            statistics.clamped += of_level.clamped;
            statistics.unseen += of_level.unseen;
            encode(levels[l], fits[l].moments, normals);
        }
        statistics.fit_seconds = secondsSince(start);
        if (settings_.estimate_error)
            statistics.ao_error = estimateNoise(levels.front(), samples, seen.moments);
    }

    /// Encode the moments of a level. Clusters that several cuts draw have equal codes in all of them.
    void encode(const LevelArrays& level, std::span<const Moments> moments, const SourceNormals& normals)
    {
        const auto encodeCluster = [&](size_t i)
        {
            const LevelArrays::Part& part = level.parts[i];
            const size_t end =
                i + 1 < level.parts.size() ? level.parts[i + 1].first_vertex : level.positions.size();
            std::vector<uint32_t>& codes = codes_[part.cluster];
            codes.clear();
            for (size_t v = part.first_vertex; v < end; ++v)
            {
                const Float3 exact = normals.find(level.positions[v], level.normals[v]);
                codes.push_back(encodeVisibility(
                    moments[v].m0, turnWithNormal(moments[v].m1, exact, level.normals[v]), level.normals[v]));
            }
        };
        tbb::parallel_for(size_t{0}, level.parts.size(), encodeCluster);
    }

    /// Estimate the noise of ambient occlusion. Two fits, each to every other sample, differ by twice the
    /// noise of the fit to both: the noise of their rays, and of the samples' positions.
    double estimateNoise(const LevelArrays& finest, std::span<const SurfaceSample> samples,
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
            const LevelMesh mesh = finest.mesh();
            fitted[half] = std::move(fitLevels({&mesh, 1}, subset, values, settings_.fit).front().moments);
        }
        double sum = 0;
        for (size_t v = 0; v < finest.normals.size(); ++v)
        {
            const double difference =
                dot(finest.normals[v], fitted[0][v].m1 - fitted[1][v].m1) / (2 * std::numbers::pi);
            sum += difference * difference;
        }
        return std::sqrt(sum / static_cast<double>(std::max<size_t>(finest.normals.size(), 1)));
    }

    const PackView& scene_;
    const PackView& part_;
    const BakeSettings& settings_;
    const BakeObserver& observe_;
    SceneMasks masks_;
    std::vector<std::vector<Affine3>> transforms_;
    std::vector<NamedPose> poses_;
    std::vector<std::vector<uint32_t>> codes_;
    double share_before_ = 0;
    double share_of_mesh_ = 0;
    uint64_t rays_before_ = 0;
};

Json meshJson(const MeshStatistics& mesh)
{
    Json json{
        {"mesh", mesh.mesh},
        {"name", mesh.name},
        {"poses", mesh.poses},
        {"instances", mesh.instances},
        {"levels", mesh.levels},
        {"samples", mesh.samples},
        {"rays", mesh.rays},
        {"seconds", {{"rays", mesh.ray_seconds}, {"fit", mesh.fit_seconds}}},
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
                    const std::string& output_path, const BakeSettings& settings, const BakeObserver& observe)
{
    HEARTH_TRY(checkHierarchy(clusters_part));
    Bake bake(import_part, clusters_part, settings, observe);
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
        }));
    return statistics;
}

std::string statisticsJson(const std::string& source, const BakeSettings& settings,
                           const std::vector<MeshStatistics>& meshes)
{
    Json json{{"source", source},
              {"rays_per_sample", settings.rays.rays_per_sample},
              {"samples_per_vertex", settings.samples_per_vertex},
              {"occluders", settings.alone ? "asset" : "scene"},
              {"meshes", Json::array()}};
    for (const MeshStatistics& mesh : meshes)
        json["meshes"].push_back(meshJson(mesh));
    return json.dump(1) + "\n";
}

} // namespace hearth::visibility
