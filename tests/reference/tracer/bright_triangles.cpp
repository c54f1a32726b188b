// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/bright_triangles.h"

#include <algorithm>

namespace hearth::reference
{

using namespace formats;

namespace
{

constexpr double kPi = 3.14159265358979323846;

// Luminance from which lit surfaces are bright: white paper in the light that exposure sets has about 1.
constexpr double kBright = 1;

double luminance(Double3 color)
{
    return dot(color, {0.2126, 0.7152, 0.0722});
}

uint64_t triangleKey(const SurfaceHit& hit)
{
    return (uint64_t{hit.instance} << 40) + (uint64_t{hit.cluster} << 8) + hit.triangle;
}

/// Estimate the luminance that lamps give a point of a triangle on the side on which they are.
double litLuminance(const ShadedScene& scene, const MaterialRecord& material, Double3 position,
                    Double3 normal)
{
    const Double3 base{double{material.base_color.x}, double{material.base_color.y},
                       double{material.base_color.z}};
    double sum = 0;
    for (const SceneLight& light : scene.lighting().lights)
    {
        if (light.type == LightType::directional)
            continue;
        const Incident incident = light.at(position);
        const double facing = dot(normal, incident.to_light);
        const double lit = luminance(incident.irradiance * base) * std::abs(facing) / kPi;
        const Double3 start = position + normal * ((facing > 0 ? 1e-4 : -1e-4) * length(position));
        if (lit > kBright && !scene.shadowed(start, incident))
            sum += lit;
    }
    return sum;
}

} // namespace

BrightTriangles::BrightTriangles(const ShadedScene& scene)
{
    const Placement& placement = scene.placement();
    const PackView& view = placement.geometry().view();
    for (uint32_t instance = 0; instance < view.instances().size(); ++instance)
    {
        const Range clusters = view.meshes()[view.instances()[instance].mesh].clusters;
        for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
        {
            const MaterialRecord& material = scene.getMaterial({.instance = instance, .cluster = c});
            if (view.clusters()[c].level != 0 || (material.flags & kMaterialUnlit) != 0)
                continue;
            const double emitted = luminance(Double3(material.emissive)) * scene.lighting().exposure;
            const ClusterGeometry cluster = placement.geometry().cluster(c);
            for (uint32_t t = 0; t < cluster.triangleCount(); ++t)
            {
                Triangle triangle{{.instance = instance, .cluster = c, .triangle = t}, {}, 0};
                const auto vertices = cluster.triangle(t);
                Double3 sum;
                for (size_t i = 0; i < 3; ++i)
                {
                    triangle.corners[i] = placement.vertex(instance, cluster, vertices[i]).position;
                    sum += triangle.corners[i];
                }
                const Double3 normal = normalize(cross(triangle.corners[1] - triangle.corners[0],
                                                       triangle.corners[2] - triangle.corners[0]));
                double lit = 0;
                for (const Double3 corner : triangle.corners)
                    lit += litLuminance(scene, material, sum / 6 + corner / 2, normal) / 3;
                add(triangle, emitted + lit);
            }
        }
    }
}

void BrightTriangles::add(const Triangle& triangle, double luminance)
{
    const Double3 area =
        cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
    if (luminance <= 0 || !(length(area) > 0))
        return;
    weight_ += 0.5 * length(area) * luminance;
    triangles_.push_back(triangle);
    triangles_.back().cumulated = weight_;
    luminances_.emplace(triangleKey(triangle.hit), luminance);
}

bool BrightTriangles::Pick::isMetAt(const ShadedPoint& point) const
{
    return triangleKey(point.hit) == triangleKey(hit);
}

BrightTriangles::Pick BrightTriangles::pick(Double3 position, double choice, double u, double v) const
{
    const auto picked =
        std::upper_bound(triangles_.begin(), std::prev(triangles_.end()), choice * weight_,
                         [](double weight, const Triangle& t) { return weight < t.cumulated; });
    // uniform in the triangle
    const double root = std::sqrt(u), a = 1 - root, b = root * (1 - v), c = root * v;
    const Double3 target = picked->corners[0] * a + picked->corners[1] * b + picked->corners[2] * c;
    return {normalize(target - position), picked->hit};
}

double BrightTriangles::density(const ShadedPoint& point, Double3 direction) const
{
    const auto found = luminances_.find(triangleKey(point.hit));
    const double facing = std::abs(dot(point.surface.geometric_normal, direction));
    if (found == luminances_.end() || facing <= 0)
        return 0;
    return found->second / weight_ * point.hit.distance * point.hit.distance / facing;
}

} // namespace hearth::reference
