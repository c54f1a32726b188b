// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/path_tracer.h"

#include "tests/reference/tracer/bright_triangles.h"
#include "tests/reference/tracer/camera_rays.h"
#include "tests/reference/tracer/microfacets.h"
#include "tests/reference/tracer/random_stream.h"
#include "tests/reference/tracer/sky_tracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kFar = 1e30;
constexpr double kBrightShare = 0.5; ///< of the paths that go on to a bright surface
constexpr double kSkyShare = 0.4;    ///< of the others, to a bright part of the sky
constexpr uint32_t kSureBounces = 3; ///< before Russian roulette

double largest(Double3 v)
{
    return std::max({v.x, v.y, v.z});
}

/// Directions in which a surface scatters light: a mixture of both lobes by their albedos.
class Scattering
{
public:
    Scattering(const Coating& coating, Double3 view)
        : coating_(coating), frame_(coating.normal), alpha_(coating.roughness * coating.roughness)
    {
        seen_ = frame_.local(view);
        seen_.z = std::clamp(std::abs(seen_.z), 1e-4, 1.0); // as in the material model
        seen_ = normalize(seen_);
        const Albedo part = albedo(coating, view);
        const double specular = largest(part.specular), diffuse = largest(part.diffuse);
        specular_share_ = diffuse > 0 ? std::max(0.2, specular / (specular + diffuse)) : 1;
    }

    Double3 sample(Random& random) const
    {
        const bool is_specular = random.next() < specular_share_;
        const double u = random.next(), v = random.next();
        if (!is_specular)
            return cosineDirection(coating_.normal, u, v);
        const Double3 half = visibleNormal(seen_, alpha_, u, v);
        return frame_.world(half * (2 * dot(seen_, half)) - seen_);
    }

    /// Density of sample() over solid angle.
    double density(Double3 direction) const
    {
        const Double3 light = frame_.local(direction);
        if (light.z <= 0)
            return 0;
        const Double3 half = normalize(light + seen_);
        return specular_share_ * visibleDensity(half.z, seen_.z, alpha_) +
               (1 - specular_share_) * light.z / kPi;
    }

private:
    const Coating& coating_;
    Frame frame_;
    Double3 seen_;
    double alpha_, specular_share_;
};

class PathTracer
{
public:
    PathTracer(const ShadedScene& scene, const PathTracing& tracing)
        : scene_(scene), tracing_(tracing), rays_(tracing.camera, tracing.width, tracing.height)
    {
        if (tracing.occlusion == Occlusion::full)
            bright_.emplace(scene);
    }

    Double3 pixel(uint32_t x, uint32_t y) const
    {
        Random random((uint64_t{y} * tracing_.width + x) * 0x9E3779B9u + tracing_.seed);
        Double3 sum;
        for (uint32_t i = 0; i < tracing_.samples; ++i)
        {
            const double across = random.next(), down = random.next();
            const Ray ray = tracing_.through_centers ? rays_.through(x + 0.5, y + 0.5)
                                                     : rays_.through(x + across, y + down);
            sum += tracing_.occlusion == Occlusion::full ? pathLight(ray, random) : openLight(ray);
        }
        return sum / tracing_.samples;
    }

private:
    static Double3 unlitRadiance(const ShadedPoint& point)
    {
        const Double3 shown = point.coating.base;
        return {invertFilmic(shown.x), invertFilmic(shown.y), invertFilmic(shown.z)};
    }

    /// Light without that of other surfaces.
    Double3 openLight(const Ray& ray) const
    {
        const bool has_sky = tracing_.occlusion == Occlusion::none;
        const auto met = scene_.nearest(ray, rays_.pixelAngle(), tracing_.filter);
        if (!met)
            return has_sky ? scene_.lighting().radiance(ray.direction) : Double3{};
        if (met->unlit)
            return unlitRadiance(*met);
        const Double3 lit = met->coating.emitted + underLights(scene_, *met, -ray.direction, !has_sky);
        return has_sky ? lit + tracedSky(scene_, *met, -ray.direction, {}, 0) : lit;
    }

    /// Nearest surface that takes part in lighting: bounced light does not see unlit ones.
    std::optional<ShadedPoint> nearestLit(Ray ray) const
    {
        for (;;)
        {
            const auto met = scene_.nearest(ray, rays_.pixelAngle());
            if (!met || !met->unlit)
                return met;
            ray.least = met->hit.distance * (1 + 1e-6);
        }
    }

    /// Add light that arrives over a path.
    void add(Double3& sum, Double3 light, uint32_t bounce) const
    {
        const double peak = largest(light);
        sum += bounce > 1 && peak > tracing_.max_indirect ? light * (tracing_.max_indirect / peak) : light;
    }

    /// Next part of a path.
    struct Step
    {
        Double3 direction;
        std::optional<ShadedPoint> met; ///< nothing: the sky
        double density = 0;             ///< of the direction over solid angle; 0: the path ends
    };

    /// Take a direction that a surface scatters light to, one to a bright surface, or one to a bright part of
    /// the sky. The density is that of all ways together.
    Step takeStep(const ShadedPoint& point, const Scattering& scattering, Random& random) const
    {
        const double bright_share = bright_->empty() ? 0 : kBrightShare;
        const SkyMap* const sky = scene_.lighting().sky_map.get();
        const double sky_share = sky == nullptr ? 0 : kSkyShare * (1 - bright_share);
        const Double3 start = lifted(point);
        std::optional<BrightTriangles::Pick> pick;
        Step step;
        const double way = random.next();
        if (way < bright_share)
        {
            const double choice = random.next(), u = random.next(), v = random.next();
            pick = bright_->pick(start, choice, u, v);
            step.direction = pick->direction;
        }
        else if (way < bright_share + sky_share)
        {
            const double choice = random.next(), u = random.next(), v = random.next();
            step.direction = sky->pick(choice, u, v);
        }
        else
            step.direction = scattering.sample(random);
        const double scattered = scattering.density(step.direction);
        if (scattered <= 0)
            return step; // below the surface
        step.met = nearestLit({start, step.direction, 0, kFar});
        if (pick && !(step.met && pick->isMetAt(*step.met)))
            return step; // something is in the way
        const double bright = step.met ? bright_->density(*step.met, step.direction) : 0;
        step.density = bright_share * bright + (1 - bright_share - sky_share) * scattered;
        if (sky != nullptr)
            step.density += sky_share * sky->density(step.direction);
        return step;
    }

    Double3 pathLight(const Ray& ray, Random& random) const
    {
        Double3 sum, through{1, 1, 1}, direction = ray.direction;
        std::optional<ShadedPoint> met = scene_.nearest(ray, rays_.pixelAngle(), tracing_.filter);
        for (uint32_t bounce = 0;; ++bounce)
        {
            if (!met)
            {
                add(sum, through * scene_.lighting().radiance(direction), bounce);
                return sum;
            }
            if (met->unlit)
                return unlitRadiance(*met);
            const Coating& coating = met->coating;
            add(sum, through * coating.emitted, bounce);
            if (bounce == tracing_.max_bounces)
                return sum;
            const Double3 view = -direction;
            add(sum, through * underLights(scene_, *met, view, true), bounce + 1);
            const Step step = takeStep(*met, Scattering(coating, view), random);
            if (step.density <= 0)
                return sum;
            through = through * reflected(coating, view, step.direction) / step.density;
            const double on = bounce < kSureBounces ? 1 : std::min(largest(through), 0.95);
            if (random.next() >= on)
                return sum;
            through = through / on;
            direction = step.direction;
            met = step.met;
        }
    }

    const ShadedScene& scene_;
    PathTracing tracing_;
    std::optional<BrightTriangles> bright_; ///< of paths
    CameraRays rays_;
};

} // namespace

std::vector<Double3> tracePaths(const ShadedScene& scene, const PathTracing& tracing)
{
    const PathTracer tracer(scene, tracing);
    std::vector<Double3> radiance(size_t{tracing.width} * tracing.height);
    tbb::parallel_for(0u, tracing.height,
                      [&](uint32_t y)
                      {
                          for (uint32_t x = 0; x < tracing.width; ++x)
                              radiance[size_t{y} * tracing.width + x] = tracer.pixel(x, y);
                      });
    return radiance;
}

} // namespace hearth::reference
