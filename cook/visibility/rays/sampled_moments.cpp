// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/sampled_moments.h"

#include "cook/visibility/rays/interior_samples.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

/// Rows of a matrix that transforms directions from the world to the space of the mesh.
using Turn = std::array<Float3, 3>;

/// Return the transposed matrix, which transforms normals from the world to the mesh.
Turn turnOf(const Affine3& world_from_mesh)
{
    const auto& m = world_from_mesh.m;
    return {Float3{m[0][0], m[1][0], m[2][0]}, Float3{m[0][1], m[1][1], m[2][1]},
            Float3{m[0][2], m[1][2], m[2][2]}};
}

// Reach of a cover, as a share of the longest edge of a sample's triangle. A nearer cover occludes parts of
// the triangle that its corners cannot distinguish from the rest.
constexpr float kClose = 0.02f;

std::vector<float> reachOf(std::span<const Float3> positions, std::span<const uint32_t> corners,
                           std::span<const SurfaceSample> samples, const Affine3& world_from_mesh)
{
    std::vector<float> reach(samples.size());
    for (size_t s = 0; s < samples.size(); ++s)
    {
        const uint32_t* corner = &corners[size_t{samples[s].triangle} * 3];
        for (size_t k = 0; k < 3; ++k)
            reach[s] = std::max(
                reach[s], kClose * length(transformVector(world_from_mesh, positions[corner[(k + 1) % 3]] -
                                                                               positions[corner[k]])));
    }
    return reach;
}

std::array<Float3, 3> frameOf(std::span<const Float3> positions, const uint32_t* corners)
{
    const Float3 a = positions[corners[0]], along = positions[corners[1]] - a;
    const Float3 first = normalizeOr(along, {1, 0, 0});
    const Float3 normal = normalizeOr(cross(along, positions[corners[2]] - a), {});
    return {first, cross(normal, first), normal};
}

/// Compute the rotation that takes a triangle in a pose to its orientation without a pose.
Turn turnBack(std::span<const Float3> posed, std::span<const Float3> positions, const uint32_t* corners)
{
    const std::array<Float3, 3> from = frameOf(posed, corners), to = frameOf(positions, corners);
    Turn turn;
    const auto row = [&](float x, float y, float z) { return from[0] * x + from[1] * y + from[2] * z; };
    turn[0] = row(to[0].x, to[1].x, to[2].x);
    turn[1] = row(to[0].y, to[1].y, to[2].y);
    turn[2] = row(to[0].z, to[1].z, to[2].z);
    return turn;
}

Float3 turned(const Turn& turn, Float3 v)
{
    return {turn[0].x * v.x + turn[0].y * v.y + turn[0].z * v.z,
            turn[1].x * v.x + turn[1].y * v.y + turn[1].z * v.z,
            turn[2].x * v.x + turn[2].y * v.y + turn[2].z * v.z};
}

/// Add transformed moments. The length of m1 is preserved, whatever the matrix does to lengths.
void add(Moments& sum, const Moments& seen, const Turn& turn, float share)
{
    const Float3 m1 = turned(turn, seen.m1);
    const float size = length(m1);
    sum.m0 += seen.m0 * share;
    if (size > 0)
        sum.m1 = sum.m1 + m1 * (length(seen.m1) / size) * share;
}

/// Add T M T^T with the trace preserved.
void add(SecondMoments& sum, const SecondMoments& seen, const Turn& turn, float share)
{
    const std::array<Float3, 3> rows{Float3{seen.xx, seen.xy, seen.xz}, Float3{seen.xy, seen.yy, seen.yz},
                                     Float3{seen.xz, seen.yz, seen.zz}};
    const auto product = [&](size_t i, size_t j) { return dot(turn[i], turned(rows, turn[j])); };
    const float trace = product(0, 0) + product(1, 1) + product(2, 2);
    const float factor = trace > 0 ? share * (seen.xx + seen.yy + seen.zz) / trace : 0;
    sum.xx += factor * product(0, 0);
    sum.yy += factor * product(1, 1);
    sum.zz += factor * product(2, 2);
    sum.xy += factor * product(0, 1);
    sum.xz += factor * product(0, 2);
    sum.yz += factor * product(1, 2);
}

} // namespace

std::optional<SampledMoments> sampledMoments(const MeshView& mesh, std::span<const SurfaceSample> samples,
                                             std::span<const Place> places, RaySettings settings,
                                             bool with_second, const PlaceProgress& progress)
{
    SampledMoments result;
    result.moments.resize(samples.size());
    result.second.resize(with_second ? samples.size() : 0);
    result.buried.assign(samples.size(), 1);
    const float share = 1 / static_cast<float>(places.size());
    const uint32_t first_ray = settings.first_ray;
    for (size_t i = 0; i < places.size(); ++i)
    {
        const Place& place = places[i];
        settings.first_ray = first_ray + static_cast<uint32_t>(i) * settings.rays_per_sample;
        const std::span<const Float3> positions =
            place.posed.empty() ? mesh.positions : std::span<const Float3>(place.posed);
        const std::vector<SamplePoint> points =
            samplePoints(positions, mesh.indices, samples, place.world_from_mesh);
        const Turn of_place = turnOf(place.world_from_mesh);
        const auto turn = [&](size_t s)
        {
            return place.posed.empty() ? of_place
                                       : turnBack(place.posed, mesh.positions,
                                                  &mesh.indices[size_t{samples[s].triangle} * 3]);
        };
        std::vector<Moments> here(samples.size());
        const auto tell = [&](uint64_t done, uint64_t total) { return progress(i, done, total); };
        if (with_second)
        {
            const auto seen = visibilityHigherMoments(*place.occluders, points, settings, tell);
            if (!seen)
                return std::nullopt;
            tbb::parallel_for(size_t{0}, samples.size(),
                              [&](size_t s)
                              {
                                  here[s] = (*seen)[s].moments;
                                  add(result.moments[s], here[s], turn(s), share);
                                  add(result.second[s], (*seen)[s].second, turn(s), share);
                              });
        }
        else
        {
            auto seen = visibilityMoments(*place.occluders, points, settings, tell);
            if (!seen)
                return std::nullopt;
            here = std::move(*seen);
            tbb::parallel_for(size_t{0}, samples.size(),
                              [&](size_t s) { add(result.moments[s], here[s], turn(s), share); });
        }
        const std::vector<uint8_t> buried =
            buriedPoints(*place.occluders, points, here,
                         reachOf(positions, mesh.indices, samples, place.world_from_mesh), settings.seed);
        for (size_t s = 0; s < samples.size(); ++s)
            result.buried[s] &= buried[s];
        result.rays += samples.size() * uint64_t{settings.rays_per_sample};
    }
    return result;
}

} // namespace hearth::visibility
