// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/light/radiance_transfer.h"

#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"
#include "cook/visibility/mesh/matrix4.h"
#include "formats/base/half.h"
#include "formats/scene/radiance_transfer.h"

#include <algorithm>
#include <array>
#include <tbb/parallel_for.h>
#include <tuple>
#include <vector>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Paths from each occluded point, which share its ray.
constexpr uint32_t kPathsPerRay = 2;

// Paths that Russian roulette has not ended by then are in a closed space.
constexpr uint32_t kMaxBounces = 32;

// Surfaces before Russian roulette.
constexpr uint32_t kSureBounces = 2;

// Origins of paths lie off their surface by as many roundings of its position.
constexpr float kLiftRoundings = 64 * 0x1p-24f;

// Ridge of the slopes over the variance of directions all around: few directions say little about slopes.
constexpr double kRidge = 0.02;

static_assert(kDirectionTerms == std::tuple_size_v<Vector4>);

/// Sums of the least squares: of products of terms, and of terms times light.
struct Sums
{
    Matrix4 terms{};
    std::array<std::array<Vector4, 3>, kLightHarmonics> light{}; ///< by harmonic and colour

    void add(const Sums& other)
    {
        for (uint32_t i = 0; i < kDirectionTerms; ++i)
        {
            for (uint32_t j = 0; j < kDirectionTerms; ++j)
                terms[i][j] += other.terms[i][j];
            for (uint32_t harmonic = 0; harmonic < kLightHarmonics; ++harmonic)
                for (uint32_t color = 0; color < 3; ++color)
                    light[harmonic][color][i] += other.light[harmonic][color][i];
        }
    }
};

Vector4 directionTerms(Float3 direction)
{
    return {double{direction.x}, double{direction.y}, double{direction.z}, 1};
}

class PointTracer
{
public:
    PointTracer(const Occluders& occluders, const TransferPoint& point, const TransferSettings& settings,
                uint64_t seed)
        : occluders_(occluders), point_(point), settings_(settings), seed_(seed)
    {
    }

    Sums trace()
    {
        const sampling::Frame frame = sampling::frameAround(point_.point.normal);
        const Float3 origin = point_.point.position + point_.point.normal * point_.point.lift;
        for (uint32_t ray = 0; ray < settings_.rays_per_point; ++ray)
        {
            const Float3 direction = frame.fromLocal(
                sampling::cosineDirection(sampling::unitPoint(sampling::owenSobol(ray, seed_))));
            const std::optional<Occluders::Hit> hit = occluders_.nearest(origin, direction);
            if (!hit || hit->distance >= settings_.distance || hit->is_inside)
                continue;
            addOccluder(direction, origin + direction * hit->distance, *hit, ray);
        }
        return sums_;
    }

private:
    Float3 toWorld(Float3 direction) const
    {
        return normalizeOr(transformVector(point_.world_from_occluders, direction), direction);
    }

    void addOccluder(Float3 direction, Float3 position, const Occluders::Hit& hit, uint32_t ray)
    {
        const auto terms = directionTerms(toWorld(direction));
        std::array<Float3, kLightHarmonics> light{};
        for (uint32_t path = 0; path < kPathsPerRay; ++path)
            followPath(position, hit, ray * kPathsPerRay + path, light);
        addProduct(sums_.terms, terms, double{point_.weight});
        const double weight = double{point_.weight} / kPathsPerRay;
        for (uint32_t harmonic = 0; harmonic < kLightHarmonics; ++harmonic)
            for (uint32_t color = 0; color < 3; ++color)
                for (uint32_t i = 0; i < kDirectionTerms; ++i)
                    sums_.light[harmonic][color][i] +=
                        weight * terms[i] * double{light[harmonic][static_cast<int>(color)]};
    }

    /// Add the harmonics of the direction in which a path leaves the scene, times what its surfaces reflect.
    /// A path inside of a solid, where solids overlap, is in the dark.
    void followPath(Float3 position, Occluders::Hit hit, uint32_t path,
                    std::array<Float3, kLightHarmonics>& light) const
    {
        Float3 reflected{1, 1, 1};
        for (uint32_t bounce = 0; bounce < kMaxBounces; ++bounce)
        {
            reflected = reflected * hit.color;
            // sets of points for each bounce: the first bounces of a point's paths are even in the square
            const uint64_t seed = sampling::deriveSeed(seed_, bounce);
            if (bounce >= kSureBounces)
            {
                const float on = std::min(std::max({reflected.x, reflected.y, reflected.z}), 0.95f);
                if (sampling::unitPoint(sampling::shuffledOwenSobol(path, ~seed)).x >= on)
                    return;
                reflected = reflected / on;
            }
            const Float3 direction = sampling::frameAround(hit.normal)
                                         .fromLocal(sampling::cosineDirection(
                                             sampling::unitPoint(sampling::shuffledOwenSobol(path, seed))));
            const float size = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
            const Float3 origin = position + hit.normal * (size * kLiftRoundings);
            const std::optional<Occluders::Hit> next = occluders_.nearest(origin, direction);
            if (!next)
            {
                const auto harmonics = shared::evaluateHarmonics(toWorld(direction));
                for (uint32_t i = 0; i < kLightHarmonics; ++i)
                    light[i] += reflected * harmonics[i];
                return;
            }
            if (next->is_inside)
                return;
            position = origin + direction * next->distance;
            hit = *next;
        }
    }

    const Occluders& occluders_;
    const TransferPoint& point_;
    const TransferSettings& settings_;
    const uint64_t seed_;
    Sums sums_;
};

RadianceTransferRecord solve(Sums sums)
{
    for (uint32_t axis = 0; axis < 3; ++axis)
        sums.terms[axis][axis] += sums.terms[3][3] * kRidge / 3;
    const Matrix4 solver = inverse(sums.terms);
    RadianceTransferRecord record{};
    for (uint32_t harmonic = 0; harmonic < kLightHarmonics; ++harmonic)
        for (uint32_t color = 0; color < 3; ++color)
        {
            const Vector4 values = product(solver, sums.light[harmonic][color]);
            for (uint32_t term = 0; term < kDirectionTerms; ++term)
                record.values[transferValue(harmonic, term, color)] =
                    halfFromFloat(static_cast<float>(values[term]));
        }
    return record;
}

} // namespace

std::optional<RadianceTransferRecord> estimateTransfer(const Occluders& occluders,
                                                       std::span<const TransferPoint> points,
                                                       const TransferSettings& settings)
{
    std::vector<Sums> sums(points.size());
    tbb::parallel_for(
        size_t{0}, points.size(),
        [&](size_t i) {
            sums[i] =
                PointTracer(occluders, points[i], settings, sampling::deriveSeed(settings.seed, i)).trace();
        });
    Sums total;
    for (const Sums& of_point : sums)
        total.add(of_point);
    if (total.terms[3][3] <= 0)
        return std::nullopt;
    return solve(total);
}

} // namespace hearth::visibility
