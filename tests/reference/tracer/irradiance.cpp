// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/irradiance.h"

#include "tests/reference/tracer/random_stream.h"
#include "tests/reference/tracer/sky_tracer.h"

#include <algorithm>
#include <vector>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kFar = 1e30;
constexpr uint32_t kMaxBounces = 32;

/// Metres. A lamp has no size in the files, so nearer surfaces could be arbitrarily bright. They count as a
/// part of the lamp, which does not light itself.
constexpr double kLampRadius = 0.1;

/// Metres. Radius around a light that contains its shades and bulbs, which are much brighter than all else.
constexpr double kFixtureRadius = 0.25;

double largest(Double3 v)
{
    return std::max({v.x, v.y, v.z});
}

Double3 lightsAt(const ShadedScene& scene, Double3 position, Double3 start, Double3 normal, double nearest)
{
    Double3 sum;
    for (const SceneLight& light : scene.lighting().lights)
    {
        const Incident incident = light.at(position);
        const double facing = dot(normal, incident.to_light);
        if (facing > 0 && incident.distance >= nearest && !scene.shadowed(start, incident))
            sum += incident.irradiance * (facing / kPi);
    }
    return sum;
}

/// Mixture of directions: half by the cosine, half towards the lamps. Surfaces within kFixtureRadius of a
/// light are so bright that cosine sampling would hit them too rarely. Weighted by the mixture's density, so
/// that the mean is unbiased.
class Directions
{
public:
    Directions(const SceneLighting& lighting, Double3 position, Double3 normal)
        : position_(position), normal_(normal)
    {
        for (const SceneLight& light : lighting.lights)
            if (light.type != formats::LightType::directional)
            {
                const Double3 offset = light.position - position;
                const double sine = kFixtureRadius / std::max(length(offset), 1e-9);
                if (sine < 1 && dot(normal, offset) > -kFixtureRadius)
                    cones_.push_back({offset / length(offset), std::sqrt(1 - sine * sine)});
            }
    }

    struct Sample
    {
        Double3 direction;
        double weight; ///< cosine over pi, divided by the density; 0: below the surface
    };

    Sample sample(double choice, double u, double v) const
    {
        Double3 direction;
        if (cones_.empty() || choice < 0.5)
            direction = cosineDirection(normal_, u, v);
        else
        {
            const auto count = static_cast<double>(cones_.size());
            const Cone& cone = cones_[static_cast<size_t>((choice - 0.5) * 2 * count)];
            const double z = 1 - u * (1 - cone.cosine), r = std::sqrt(std::max(0.0, 1 - z * z));
            const Double3 x = normalize(
                cross(cone.axis, std::abs(cone.axis.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
            direction = cone.axis * z + x * (r * std::cos(2 * kPi * v)) +
                        cross(cone.axis, x) * (r * std::sin(2 * kPi * v));
        }
        const double facing = dot(normal_, direction);
        if (facing <= 0)
            return {direction, 0};
        if (cones_.empty())
            return {direction, 1};
        double density = 0.5 * facing / kPi;
        for (const Cone& cone : cones_)
            if (dot(direction, cone.axis) >= cone.cosine)
                density += 0.5 / (static_cast<double>(cones_.size()) * 2 * kPi * (1 - cone.cosine));
        return {direction, facing / kPi / density};
    }

private:
    struct Cone
    {
        Double3 axis;
        double cosine;
    };
    Double3 position_, normal_;
    std::vector<Cone> cones_;
};

Double3 pathLight(const ShadedScene& scene, Double3 start, Double3 direction, Random& random)
{
    Double3 light, through{1, 1, 1};
    for (uint32_t bounce = 0; bounce < kMaxBounces; ++bounce)
    {
        const auto met = scene.nearest({start, direction, 0, kFar}, 0);
        if (!met)
            return light + through * scene.lighting().radiance(direction);
        if (met->unlit)
            return light;
        light += through * met->coating.emitted;
        // all reflection scatters as by Lambert's law, that of metals, too: mirrored light arrives somewhere
        const Albedo reflects = albedo(met->coating, -direction);
        through = through * (reflects.diffuse + reflects.specular + reflects.sheen);
        start = lifted(*met);
        light += through * lightsAt(scene, met->surface.position, start, met->coating.normal, kLampRadius);
        // Russian roulette from the third bounce on.
        const double on = bounce < 2 ? 1 : std::min(largest(through), 0.95);
        if (random.next() >= on)
            return light;
        through = through / on;
        const Directions directions(scene.lighting(), start, met->coating.normal);
        const double choice = random.next(), u = random.next(), v = random.next();
        const Directions::Sample next = directions.sample(choice, u, v);
        if (next.weight == 0)
            return light;
        direction = next.direction;
        through = through * next.weight;
    }
    return light;
}

} // namespace

Double3 litNormal(const ShadedPoint& point)
{
    return point.hit.front ? point.surface.normal : -point.surface.normal;
}

Double3 directLight(const ShadedScene& scene, const ShadedPoint& point)
{
    return lightsAt(scene, point.surface.position, lifted(point), litNormal(point), 0);
}

SurfaceLight traceSurfaceLight(const ShadedScene& scene, const ShadedPoint& point, uint32_t paths,
                               uint64_t seed)
{
    Random random(seed);
    const double shift_w = random.next(), shift_u = random.next(), shift_v = random.next();
    SurfaceLight light{directLight(scene, point), {}};
    const Directions directions(scene.lighting(), lifted(point), litNormal(point));
    for (uint32_t i = 0; i < paths; ++i)
    {
        // Sequence R3 (M. Roberts, 2018) for the first direction.
        const Directions::Sample first = directions.sample(std::fmod(shift_w + i * 0.8191725133961645, 1.0),
                                                           std::fmod(shift_u + i * 0.6710436067037893, 1.0),
                                                           std::fmod(shift_v + i * 0.5497004779019703, 1.0));
        if (first.weight > 0)
            light.indirect += pathLight(scene, lifted(point), first.direction, random) * first.weight;
    }
    light.indirect = light.indirect / paths;
    return light;
}

} // namespace hearth::reference
