// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/sampled_moments.h"

#include "cook/visibility/rays/interior_samples.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

/// Rows of a matrix that transforms directions from the world to the space of the mesh.
using DirectionMatrix = std::array<Float3, 3>;

/// Return the transposed matrix, which transforms normals from the world to the mesh.
DirectionMatrix directionMatrix(const Affine3& world_from_mesh)
{
    const auto& m = world_from_mesh.m;
    return {Float3{m[0][0], m[1][0], m[2][0]}, Float3{m[0][1], m[1][1], m[2][1]},
            Float3{m[0][2], m[1][2], m[2][2]}};
}

// Reach of a cover, as a share of the longest edge of a sample's triangle. A nearer cover occludes parts of
// the triangle that its corners cannot distinguish from the rest.
constexpr float kCoverReach = 0.02f;

std::vector<float> coverReach(std::span<const Float3> positions, std::span<const uint32_t> corners,
                              std::span<const SurfaceSample> samples, const Affine3& world_from_mesh)
{
    std::vector<float> reach(samples.size());
    for (size_t s = 0; s < samples.size(); ++s)
    {
        const uint32_t* corner = &corners[size_t{samples[s].triangle} * 3];
        for (size_t k = 0; k < 3; ++k)
            reach[s] = std::max(reach[s], kCoverReach * length(transformVector(
                                                            world_from_mesh, positions[corner[(k + 1) % 3]] -
                                                                                 positions[corner[k]])));
    }
    return reach;
}

std::array<Float3, 3> triangleFrame(std::span<const Float3> positions, const uint32_t* corners)
{
    const Float3 a = positions[corners[0]], along = positions[corners[1]] - a;
    const Float3 first = normalizeOr(along, {1, 0, 0});
    const Float3 normal = normalizeOr(cross(along, positions[corners[2]] - a), {});
    return {first, cross(normal, first), normal};
}

/// Compute the rotation that takes a triangle in a pose to its orientation without a pose.
DirectionMatrix unposeRotation(std::span<const Float3> posed_positions, std::span<const Float3> positions,
                               const uint32_t* corners)
{
    const std::array<Float3, 3> from = triangleFrame(posed_positions, corners),
                                to = triangleFrame(positions, corners);
    DirectionMatrix matrix;
    const auto row = [&](float x, float y, float z) { return from[0] * x + from[1] * y + from[2] * z; };
    matrix[0] = row(to[0].x, to[1].x, to[2].x);
    matrix[1] = row(to[0].y, to[1].y, to[2].y);
    matrix[2] = row(to[0].z, to[1].z, to[2].z);
    return matrix;
}

Float3 transformed(const DirectionMatrix& matrix, Float3 v)
{
    return {matrix[0].x * v.x + matrix[0].y * v.y + matrix[0].z * v.z,
            matrix[1].x * v.x + matrix[1].y * v.y + matrix[1].z * v.z,
            matrix[2].x * v.x + matrix[2].y * v.y + matrix[2].z * v.z};
}

/// Add transformed moments. The length of m1 is preserved, whatever the matrix does to lengths.
void add(Moments& sum, const Moments& seen, const DirectionMatrix& matrix, float share)
{
    const Float3 m1 = transformed(matrix, seen.m1);
    const float size = length(m1);
    sum.m0 += seen.m0 * share;
    if (size > 0)
        sum.m1 = sum.m1 + m1 * (length(seen.m1) / size) * share;
}

/// Add T M T^T with the trace preserved.
void add(SecondMoments& sum, const SecondMoments& seen, const DirectionMatrix& matrix, float share)
{
    const std::array<Float3, 3> rows{Float3{seen.xx, seen.xy, seen.xz}, Float3{seen.xy, seen.yy, seen.yz},
                                     Float3{seen.xz, seen.yz, seen.zz}};
    const auto product = [&](size_t i, size_t j) { return dot(matrix[i], transformed(rows, matrix[j])); };
    const float trace = product(0, 0) + product(1, 1) + product(2, 2);
    const float factor = trace > 0 ? share * (seen.xx + seen.yy + seen.zz) / trace : 0;
    sum.xx += factor * product(0, 0);
    sum.yy += factor * product(1, 1);
    sum.zz += factor * product(2, 2);
    sum.xy += factor * product(0, 1);
    sum.xz += factor * product(0, 2);
    sum.yz += factor * product(1, 2);
}

/// Measures how unlike the places are. With few rays a place, noise exceeds most differences: it leaves the
/// product of the differences at neighbouring samples, whose rays are independent, but not their square.
class PlaceSpread
{
public:
    explicit PlaceSpread(size_t sample_count) : sums_(sample_count, 0), products_(sample_count, 0) {}

    void add(std::span<const SamplePoint> points, std::span<const Moments> moments)
    {
        double before = 0;
        for (size_t s = 0; s < points.size(); ++s)
        {
            const double occlusion = double{dot(points[s].normal, moments[s].m1)} / std::numbers::pi;
            sums_[s] += occlusion;
            products_[s] += occlusion * before; // with the sample before; not used for the first one
            before = occlusion;
        }
        ++places_;
    }

    double rms(std::span<const SurfaceSample> samples) const
    {
        double sum = 0, area = 0;
        for (size_t s = 1; s < samples.size(); ++s)
        {
            sum += double{samples[s].area} * (products_[s] - sums_[s] * sums_[s - 1] / places_) / places_;
            area += double{samples[s].area};
        }
        return places_ > 1 && sum > 0 ? std::sqrt(sum / area) : 0;
    }

private:
    std::vector<double> sums_, products_;
    double places_ = 0;
};

} // namespace

std::optional<SampledMoments> sampledMoments(const MeshView& mesh, std::span<const SurfaceSample> samples,
                                             std::span<const Placement> places, RaySettings settings,
                                             bool with_second, const PlacementProgress& progress)
{
    SampledMoments result;
    result.moments.resize(samples.size());
    result.second.resize(with_second ? samples.size() : 0);
    result.interior.assign(samples.size(), 1);
    const float share = 1 / static_cast<float>(places.size());
    const uint32_t first_ray = settings.first_ray;
    PlaceSpread spread(samples.size());
    for (size_t i = 0; i < places.size(); ++i)
    {
        const Placement& place = places[i];
        settings.first_ray = first_ray + static_cast<uint32_t>(i) * settings.rays_per_sample;
        const std::span<const Float3> positions =
            place.posed_positions.empty() ? mesh.positions : std::span<const Float3>(place.posed_positions);
        const std::vector<SamplePoint> points =
            samplePoints(positions, mesh.indices, samples, place.world_from_mesh);
        const DirectionMatrix placement_matrix = directionMatrix(place.world_from_mesh);
        const auto matrix = [&](size_t s)
        {
            return place.posed_positions.empty()
                       ? placement_matrix
                       : unposeRotation(place.posed_positions, mesh.positions,
                                        &mesh.indices[size_t{samples[s].triangle} * 3]);
        };
        std::vector<Moments> place_moments(samples.size());
        const auto report = [&](uint64_t done, uint64_t total) { return progress(i, done, total); };
        if (with_second)
        {
            const auto seen = visibilityHigherMoments(*place.occluders, points, settings, report);
            if (!seen)
                return std::nullopt;
            tbb::parallel_for(size_t{0}, samples.size(),
                              [&](size_t s)
                              {
                                  place_moments[s] = (*seen)[s].moments;
                                  add(result.moments[s], place_moments[s], matrix(s), share);
                                  add(result.second[s], (*seen)[s].second, matrix(s), share);
                              });
        }
        else
        {
            auto seen = visibilityMoments(*place.occluders, points, settings, report);
            if (!seen)
                return std::nullopt;
            place_moments = std::move(*seen);
            tbb::parallel_for(size_t{0}, samples.size(),
                              [&](size_t s) { add(result.moments[s], place_moments[s], matrix(s), share); });
        }
        spread.add(points, place_moments);
        const std::vector<uint8_t> interior = findInteriorPoints(
            *place.occluders, points, place_moments,
            coverReach(positions, mesh.indices, samples, place.world_from_mesh), settings.seed);
        for (size_t s = 0; s < samples.size(); ++s)
            result.interior[s] &= interior[s];
        result.rays += samples.size() * uint64_t{settings.rays_per_sample};
    }
    result.spread = spread.rms(samples);
    return result;
}

} // namespace hearth::visibility
