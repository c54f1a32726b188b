// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/sample_points.h"

#include "formats/base/affine3d.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

constexpr double kUnitRoundoff = 0x1p-24; ///< maximum relative error of rounding to a float

// The sample's position, the corners that it lies between and the ray's origin are rounded to floats: three
// roundings, and one more for all products of them.
constexpr double kWorldRoundings = 4;

// Embree transforms origins into an instance's space with its own inverse matrix: three products and sums,
// the translation, and the roundings of the inverse itself.
constexpr double kInstanceRoundings = 10;

// Roundings in the distance of a plane from a ray's origin, dot(cross(e1, e2), v0 - origin): by the
// difference, the product, and the cross product, whose terms may cancel (J. R. Shewchuk's bounds, 1997, to
// first order). Includes sqrt 3, from axes to lengths.
constexpr double kPlaneRoundings = 8;
constexpr double kCrossRoundings = 6;

// Thinner triangles have no reliable normal: they would lift their samples out of sight.
constexpr double kMaxThinness = 1000;

Double3 absolute(Double3 a)
{
    return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}

/// Transform of an instance, applied to points, normals and error bounds.
class InstanceTransform
{
public:
    explicit InstanceTransform(const Affine3& world_from_mesh)
        : world_from_mesh_(widened(world_from_mesh)), is_identity_(world_from_mesh == Affine3{})
    {
        const auto inverse = inverted(world_from_mesh_);
        HEARTH_ASSERT(inverse.has_value());
        mesh_from_world_ = *inverse;
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 3; ++column)
            {
                double sum = 0;
                for (size_t k = 0; k < 3; ++k)
                    sum += std::abs(world_from_mesh_.m[row][k] * mesh_from_world_.m[k][column]);
                round_trip_.m[row][column] = sum;
            }
    }

    Double3 point(Double3 p) const { return transformPoint(world_from_mesh_, p); }

    /// Transform a normal, to a length other than 1: planes 1 apart in the mesh are 1 / length apart in the
    /// world.
    Double3 normal(Double3 n) const
    {
        const auto& m = mesh_from_world_.m;
        return {m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z, m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z};
    }

    /// Bound the error of a ray origin along each axis.
    Double3 error(Double3 point) const
    {
        Double3 error = absolute(point) * (kWorldRoundings * kUnitRoundoff);
        if (is_identity_)
            return error;
        const Double3 translation{world_from_mesh_.m[0][3], world_from_mesh_.m[1][3],
                                  world_from_mesh_.m[2][3]};
        // errors of the inverse itself are transformed back and forth once more
        const Double3 once = transformVector(round_trip_, absolute(point) + absolute(translation));
        const Double3 twice = transformVector(round_trip_, once);
        return error + twice * (kInstanceRoundings * kUnitRoundoff);
    }

private:
    Affine3d world_from_mesh_;
    Affine3d mesh_from_world_;
    Affine3d round_trip_; ///< |world_from_mesh| |mesh_from_world|, without translations
    bool is_identity_;
};

/// Bound Embree's error in the distance of a point on a triangle from the triangle's plane.
double planeError(Double3 e1, Double3 e2, double twice_area)
{
    const double a = length(e1), b = length(e2), c = length(e1 - e2);
    const double thinness = std::min(a * b / twice_area, kMaxThinness);
    return kUnitRoundoff * std::max({a, b, c}) * (kPlaneRoundings + kCrossRoundings * thinness);
}

} // namespace

std::vector<SamplePoint> samplePoints(std::span<const Float3> positions, std::span<const uint32_t> corners,
                                      std::span<const SurfaceSample> samples, const Affine3& world_from_mesh)
{
    const InstanceTransform transform(world_from_mesh);
    std::vector<SamplePoint> points(samples.size());
    tbb::parallel_for(
        size_t{0}, samples.size(),
        [&](size_t i)
        {
            const SurfaceSample& sample = samples[i];
            const uint32_t* corner = &corners[size_t{sample.triangle} * 3];
            const Double3 a = widen(positions[corner[0]]);
            const Double3 e1 = widen(positions[corner[1]]) - a, e2 = widen(positions[corner[2]]) - a;
            const Double3 perpendicular = cross(e1, e2);
            const double twice_area = length(perpendicular);
            HEARTH_ASSERT(twice_area > 0);
            const Double3 scaled_normal = transform.normal(perpendicular * (1 / twice_area));
            const double stretch = 1 / length(scaled_normal);
            const Double3 normal = scaled_normal * stretch;
            const Double3 world_position = transform.point(a + e1 * double{sample.u} + e2 * double{sample.v});
            const double lift = dot(absolute(normal), transform.error(world_position)) +
                                planeError(e1, e2, twice_area) * stretch;
            points[i] = {narrow(world_position), narrow(normal),
                         std::nextafter(static_cast<float>(lift), std::numeric_limits<float>::infinity())};
        });
    return points;
}

} // namespace hearth::visibility
