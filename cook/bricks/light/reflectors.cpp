// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/reflectors.h"

#include "cook/bricks/light/ray_scene.h"
#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "formats/gpu_shared/reflector.h"
#include "formats/scene/scene_lighting.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

using namespace formats;

namespace
{

constexpr double kPi = std::numbers::pi;

// Paths of all lamps together, and bounds of each lamp's. With the most, samples next to the axis, which have
// the smallest solid angles, are off by a few hundredths.
constexpr size_t kTotalLampPaths = size_t{1} << 20;
constexpr size_t kMinLampPaths = size_t{1} << 14, kMaxLampPaths = size_t{1} << 17;

// Reflections after which next to no light is left in a shade that is open at all.
constexpr uint32_t kMaxReflections = 16;

// Surfaces that are nearer to a lamp hold it, as bulbs and flames do: they reflect its light, but do not stop
// it; metres.
constexpr double kHolderRadius = 0.05;

// Origins of rays lie off their surface by so many voxels, and by so many parts of their coordinates.
constexpr float kLift = 1e-3f, kRelativeLift = 0x1p-20f;

// Surfaces of what holds a lamp that its light passes.
constexpr uint32_t kMaxHolderSurfaces = 64;

// Flux over the lamp's intensity from which a reflector is kept: a hundredth of the light of a lamp that
// shines all around.
constexpr float kMinFlux = static_cast<float>(0.04 * kPi);

float luminance(Float3 color)
{
    return dot(color, {0.2126f, 0.7152f, 0.0722f});
}

/// Lamp in voxels.
struct Lamp
{
    shared::Light light;
    Float3 position;
};

/// Return the lights as they are drawn; nothing for suns and for lights that move.
std::vector<std::optional<Lamp>> findLamps(const StaticScene& scene, const GridFrame& frame)
{
    std::vector<std::optional<Lamp>> lamps;
    const Affine3d voxels_from_world = voxelsFromObject(frame, {});
    for (const SourceParts& source : scene.sources)
    {
        const std::vector<bool> moved = findAnimatedNodes(source.scene);
        for (const LightRecord& record : source.scene.lights())
        {
            if (lamps.size() == shared::kMaxLights)
                return lamps;
            const bool is_lamp = record.type != static_cast<uint32_t>(LightType::directional);
            const bool moves = record.node < moved.size() && moved[record.node];
            lamps.emplace_back();
            if (!is_lamp || moves)
                continue;
            const shared::Light light = shared::lightFromRecord(record);
            lamps.back() = {light, narrow(transformPoint(voxels_from_world, widen(light.position)))};
        }
    }
    return lamps;
}

/// Return the clusters that lie within a number of voxels of a lamp.
std::vector<InstancedCluster> findNearClusters(const StaticScene& scene, const GridFrame& frame, double error,
                                               std::span<const std::optional<Lamp>> lamps, double reach)
{
    std::vector<InstancedCluster> found;
    for (const InstancedCluster& at : findCutClusters(scene, static_cast<float>(error)))
    {
        const VoxelBox box = computeVoxelBox(
            scene, at, voxelsFromObject(frame, scene.instances[at.instance].world_from_object));
        const auto isNear = [&](const std::optional<Lamp>& lamp)
        {
            if (!lamp)
                return false;
            const Double3 p = widen(lamp->position);
            const auto off = [&](double low, double at_lamp, double high) {
                return std::max({low - at_lamp, at_lamp - high, 0.0});
            };
            return std::hypot(off(box.min.x, p.x, box.max.x), off(box.min.y, p.y, box.max.y),
                              off(box.min.z, p.z, box.max.z)) <= reach;
        };
        if (std::ranges::any_of(lamps, isNear))
            found.push_back(at);
    }
    return found;
}

/// Return a position off a surface.
Float3 lift(Float3 position, Float3 direction)
{
    const float size = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    return position + direction * (kLift + size * kRelativeLift);
}

/// Choose how a surface scatters: metals about the mirrored direction, by the distribution of their
/// microfacets (B. Walter et al., "Microfacet models for refraction", 2007, 5.2); others, and those whose
/// metal is in a texture, by the cosine.
/// flat, smooth  normals of the triangle and of the surface that it stands for
Float3 scatter(const SurfaceMaterial& material, Float3 flat, Float3 smooth, Float3 direction, Float2 u)
{
    if (material.record.metallic >= 0.5f && material.metallic_roughness == nullptr)
    {
        const float roughness = material.record.roughness;
        const float alpha = std::max(roughness * roughness, 0.002f);
        const float cosine = std::sqrt((1 - u.x) / (1 + (alpha * alpha - 1) * u.x));
        const Float3 half =
            sampling::frameAround(smooth).fromLocal(sampling::hemisphereDirection({cosine, u.y}));
        const Float3 mirrored = normalizeOr(direction - half * (2 * dot(direction, half)), flat);
        if (dot(mirrored, flat) > 0)
            return mirrored;
    }
    return sampling::frameAround(flat).fromLocal(sampling::cosineDirection(u));
}

/// Light that goes in one direction, over the lamp's intensity.
struct DirectedLight
{
    Float3 direction; ///< unit
    Float3 flux;      ///< steradians
};

/// Light of a lamp and what becomes of it right around the lamp.
struct LampLight
{
    std::vector<DirectedLight> sent, passed, reflected;
};

constexpr uint32_t kLast = shared::kReflectorSamples - 1;
using Samples = std::array<double, shared::kReflectorSamples>;

/// Sum light over the angle to an axis, by hats about the samples.
Samples sumSamples(std::span<const DirectedLight> lights, Float3 axis)
{
    Samples samples{};
    for (const DirectedLight& light : lights)
    {
        const double half_sine =
            std::sqrt(std::clamp((1 - double{dot(axis, light.direction)}) / 2, 0.0, 1.0));
        const auto before = std::min(static_cast<uint32_t>(half_sine * kLast), kLast - 1);
        const double after = half_sine * kLast - before, value = luminance(light.flux);
        samples[before] += value * (1 - after);
        samples[before + 1] += value * after;
    }
    return samples;
}

/// Return the integral over all directions of the hat about a sample. With x = kLast sin(t / 2), a solid
/// angle is 8 pi / kLast^2 x dx.
double integrateHat(uint32_t number)
{
    const double hat = number == 0 ? 1.0 / 6 : number == kLast ? kLast / 2.0 - 1.0 / 6 : 1.0 * number;
    return 8 * kPi / (kLast * kLast) * hat;
}

/// Code samples of which 1 is the largest value.
void encodeSamples(const Samples& samples, uint32_t (&words)[shared::kReflectorSamples / 4])
{
    for (uint32_t i = 0; i <= kLast; ++i)
        words[i / 4] |= static_cast<uint32_t>(std::lround(255 * std::clamp(samples[i], 0.0, 1.0)))
                        << (8 * (i % 4));
}

/// Fit the samples of a reflector: the intensity over all directions is the flux.
ReflectorRecord fitReflector(const LampLight& light)
{
    Float3 flux, moment;
    for (const DirectedLight& reflected : light.reflected)
    {
        flux += reflected.flux;
        moment += reflected.direction * luminance(reflected.flux);
    }
    if (!(luminance(flux) >= kMinFlux))
        return {};
    ReflectorRecord record{};
    record.axis = static_cast<uint32_t>(NormalCode<8>::encode(normalizeOr(moment, {0, -1, 0})));
    const Float3 axis = shared::decodeFaceNormal(record.axis);
    Samples reflected = sumSamples(light.reflected, axis), passed = sumSamples(light.passed, axis);
    const Samples sent = sumSamples(light.sent, axis);
    // a profile is flat at its axis, where few paths go
    const double at_axis = (reflected[0] + reflected[1]) / (integrateHat(0) + integrateHat(1));
    for (uint32_t i = 0; i <= kLast; ++i)
    {
        reflected[i] = i == 0 ? at_axis : reflected[i] / integrateHat(i);
        passed[i] = sent[i] > 0 ? passed[i] / sent[i] : 1;
    }
    const double brightest = *std::ranges::max_element(reflected);
    record.gain = shared::encodeRadiance(flux * static_cast<float>(brightest / luminance(flux)));
    for (double& sample : reflected)
        sample /= brightest;
    encodeSamples(reflected, record.reflected);
    encodeSamples(passed, record.passed);
    return record;
}

/// Follows the paths of one lamp.
class LampPaths
{
public:
    LampPaths(const RayScene& rays, const Lamp& lamp, float reach, double voxel_size, uint32_t paths,
              uint64_t seed)
        : rays_(rays),
          lamp_(lamp),
          reach_(reach),
          holder_radius_(static_cast<float>(kHolderRadius / voxel_size)),
          paths_(paths),
          seed_(seed)
    {
    }

    LampLight follow()
    {
        for (uint32_t path = 0; path < paths_; ++path)
            follow(path);
        return std::move(light_);
    }

private:
    void follow(uint32_t path)
    {
        const Float2 u = sampling::unitPoint(sampling::owenSobol(path, seed_));
        Float3 direction = sampling::hemisphereDirection({std::abs(2 * u.x - 1), u.y});
        direction.z = u.x < 0.5f ? -direction.z : direction.z;
        const Float3 flux = Float3{1, 1, 1} * (coneShare(direction) * static_cast<float>(4 * kPi / paths_));
        light_.sent.push_back({direction, flux});
        Float3 position = lamp_.position;
        for (uint32_t surface = 0; surface < kMaxHolderSurfaces; ++surface)
        {
            const auto hit = rays_.nearest(position, direction);
            if (!hit || distance(*hit) >= reach_)
            {
                light_.passed.push_back({direction, flux});
                return;
            }
            if (hit->is_front)
                reflect(*hit, direction, flux, path);
            if (distance(*hit) > holder_radius_)
                return;
            position = lift(hit->position, direction);
        }
    }

    /// Follow a path from its first surface to where it leaves the lamp's surroundings.
    void reflect(RayScene::Hit hit, Float3 direction, Float3 flux, uint32_t path)
    {
        for (uint32_t bounce = 0; bounce < kMaxReflections; ++bounce)
        {
            flux = flux * rays_.albedo(hit);
            const uint64_t seed = sampling::deriveSeed(seed_, bounce + 1);
            direction = scatter(rays_.material(hit), hit.normal, rays_.smoothNormal(hit), direction,
                                sampling::unitPoint(sampling::shuffledOwenSobol(path, seed)));
            const auto next = rays_.nearest(lift(hit.position, hit.normal), direction);
            if (!next || distance(*next) >= reach_)
            {
                light_.reflected.push_back({direction, flux});
                return;
            }
            hit = *next;
        }
    }

    float distance(const RayScene::Hit& hit) const { return length(hit.position - lamp_.position); }

    float coneShare(Float3 direction) const
    {
        if (lamp_.light.type != static_cast<uint32_t>(LightType::spot))
            return 1;
        const float cone = std::clamp(dot(lamp_.light.direction, direction) * lamp_.light.cone_scale +
                                          lamp_.light.cone_offset,
                                      0.0f, 1.0f);
        return cone * cone;
    }

    const RayScene& rays_;
    const Lamp& lamp_;
    float reach_, holder_radius_; ///< voxels
    uint32_t paths_;
    uint64_t seed_;
    LampLight light_;
};

} // namespace

Result<std::vector<ReflectorRecord>> findReflectors(const StaticScene& scene, const GridFrame& frame,
                                                    double error)
{
    const std::vector<std::optional<Lamp>> lamps = findLamps(scene, frame);
    const auto voxel_size = static_cast<float>(frame.voxel_size);
    const float reach = shared::brickLampReach(~shared::kNoReflector, voxel_size) / voxel_size;
    const std::vector<InstancedCluster> near = findNearClusters(scene, frame, error, lamps, double{reach});
    if (near.empty())
        return std::vector<ReflectorRecord>();
    HEARTH_ASSIGN_OR_RETURN(const RayScene rays,
                            RayScene::build(scene, near, frame, RayScene::Normals::smooth));
    const auto path_count =
        static_cast<uint32_t>(std::clamp(kTotalLampPaths / lamps.size(), kMinLampPaths, kMaxLampPaths));
    std::vector<ReflectorRecord> records(lamps.size());
    tbb::parallel_for(size_t{0}, lamps.size(),
                      [&](size_t i)
                      {
                          if (!lamps[i])
                              return;
                          LampPaths paths(rays, *lamps[i], reach, frame.voxel_size, path_count, i);
                          records[i] = fitReflector(paths.follow());
                      });
    if (std::ranges::all_of(records, [](const ReflectorRecord& r) { return r.gain == shared::kNoReflector; }))
        records.clear();
    return records;
}

} // namespace hearth::bricks
