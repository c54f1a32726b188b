// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/rays.h"

#include "cook/sampling/hemisphere.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <embree3/rtcore.h>
#include <mutex>
#include <numbers>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

namespace hearth::visibility
{

namespace
{

// Rays passed to Embree at once. Among single rays, packets of 16 and streams of 64 to 16384, streams of 1024
// and more were fastest, 1.6 times as fast as single rays (hearth_measure_visibility); this size takes 96
// KiB.
constexpr uint32_t kStreamRays = 2048;

constexpr double kHemisphere = 2 * std::numbers::pi; ///< steradians

// Rays between two progress reports: some milliseconds.
constexpr uint64_t kTaskRays = 32768;

/// Flushes denormals to zero on this thread during its lifetime, as Embree wants it for speed.
class FlushToZero
{
public:
    FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlush | kDenormalsAreZero); }
    ~FlushToZero() { _mm_setcsr(before_); }
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;

private:
    static constexpr unsigned kFlush = 0x8000, kDenormalsAreZero = 0x0040;
    unsigned before_;
};

/// Query for any hit, for binary visibility.
struct AnyHit
{
    using Ray = RTCRay;
    explicit AnyHit(const RaySettings&) {}
    static RTCRay& embreeRay(Ray& ray) { return ray; }
    static void reset(Ray&) {}
    static void trace(RTCScene scene, RTCIntersectContext& context, std::span<Ray> rays)
    {
        rtcOccluded1M(scene, &context, rays.data(), static_cast<unsigned>(rays.size()), sizeof(Ray));
    }
    double occluded(const Ray& ray) const { return ray.tfar < 0 ? 1 : 0; }
};

/// Query for the nearest hit, for visibility that depends on distance.
struct NearestHit
{
    using Ray = RTCRayHit;
    explicit NearestHit(const RaySettings& settings)
        : distance(double{settings.distance}), power(double{settings.power})
    {
    }
    static RTCRay& embreeRay(Ray& ray) { return ray.ray; }
    static void reset(Ray& ray)
    {
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    static void trace(RTCScene scene, RTCIntersectContext& context, std::span<Ray> rays)
    {
        rtcIntersect1M(scene, &context, rays.data(), static_cast<unsigned>(rays.size()), sizeof(Ray));
    }
    double occluded(const Ray& ray) const
    {
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return 0;
        const double share = std::min(double{ray.ray.tfar} / distance, 1.0);
        return 1 - (power == 1 ? share : power == 2 ? share * share : std::pow(share, power));
    }
    double distance, power;
};

/// Estimate the integral of V times a function over the hemisphere. Estimates the occluded part and corrects
/// the open part by the known error of this ray pattern: cook/visibility/README.md, "Exact constants".
/// occluded, all  sums of the function over the rays: times 1 - V, and unweighted
/// whole        exact integral of the function over the hemisphere
double estimateIntegral(double occluded, double all, double whole, double occluded_share, double per_ray)
{
    return (all * occluded_share - occluded) * per_ray + whole * (1 - occluded_share);
}

/// Sums over the rays w of one point: 1 - V, (1 - V) w and w.
struct FirstSums
{
    using Result = Moments;

    void add(Double3 direction, double occlusion)
    {
        occluded += occlusion;
        occluded_directions = occluded_directions + direction * occlusion;
        directions = directions + direction;
    }

    Moments result(Float3 normal, uint32_t rays) const
    {
        const double share = occluded / rays, per_ray = kHemisphere / rays;
        const auto axis = [&](double occluded_sum, double sum, float n)
        {
            return static_cast<float>(
                estimateIntegral(occluded_sum, sum, double{n} * kHemisphere / 2, share, per_ray));
        };
        return {static_cast<float>(kHemisphere * (1 - share)),
                {axis(occluded_directions.x, directions.x, normal.x),
                 axis(occluded_directions.y, directions.y, normal.y),
                 axis(occluded_directions.z, directions.z, normal.z)}};
    }

    double occluded = 0;
    Double3 occluded_directions;
    Double3 directions;
};

/// FirstSums, and the sums of (1 - V) w w^T and w w^T.
struct SecondSums
{
    using Result = HigherMoments;

    void add(Double3 w, double occlusion)
    {
        first.add(w, occlusion);
        const std::array<double, 6> products{w.x * w.x, w.y * w.y, w.z * w.z,
                                             w.x * w.y, w.x * w.z, w.y * w.z};
        for (size_t i = 0; i < products.size(); ++i)
        {
            occluded_products[i] += products[i] * occlusion;
            all_products[i] += products[i];
        }
    }

    HigherMoments result(Float3 normal, uint32_t rays) const
    {
        const auto product = [&](size_t i)
        {
            return static_cast<float>(estimateIntegral(occluded_products[i], all_products[i],
                                                       i < 3 ? kHemisphere / 3 : 0, first.occluded / rays,
                                                       kHemisphere / rays));
        };
        return {first.result(normal, rays),
                {product(0), product(1), product(2), product(3), product(4), product(5)}};
    }

    FirstSums first;
    std::array<double, 6> occluded_products{}, all_products{};
};

/// Traces the rays of some points, one stream at a time.
template <typename Query, typename Sums>
class Tracer
{
public:
    Tracer(const Occluders& occluders, const RaySettings& settings)
        : scene_(occluders.scene()), settings_(settings), query_(settings), rays_(kStreamRays)
    {
        rtcInitIntersectContext(&context_);
        context_.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }

    /// first  index of points[0] among all points
    void trace(std::span<const SamplePoint> points, uint64_t first, std::span<typename Sums::Result> moments)
    {
        sums_.assign(points.size(), {});
        for (uint32_t p = 0; p < points.size(); ++p)
        {
            const uint64_t seed = sampling::deriveSeed(settings_.seed, first + p);
            for (uint32_t ray = 0; ray < settings_.rays_per_sample;)
            {
                const uint32_t count = std::min(settings_.rays_per_sample - ray, kStreamRays - filled_);
                addRays(p, points[p], settings_.first_ray + ray, count, seed);
                ray += count;
                if (filled_ == kStreamRays)
                    flush();
            }
        }
        flush();
        for (size_t p = 0; p < points.size(); ++p)
            moments[p] = sums_[p].result(points[p].normal, settings_.rays_per_sample);
    }

private:
    using Ray = typename Query::Ray;

    /// Rays of one point in the stream.
    struct PointRays
    {
        uint32_t point, first, count;
    };

    void addRays(uint32_t point, const SamplePoint& from, uint32_t first_ray, uint32_t count, uint64_t seed)
    {
        const auto part = [&](auto& all) { return std::span<float>(all).subspan(filled_, count); };
        sampling::hemisphereDirections(first_ray, seed, sampling::frameAround(from.normal), part(x_),
                                       part(y_), part(z_));
        const Float3 origin = rayOrigin(from);
        for (uint32_t i = filled_; i < filled_ + count; ++i)
        {
            RTCRay& ray = Query::embreeRay(rays_[i]);
            ray.org_x = origin.x;
            ray.org_y = origin.y;
            ray.org_z = origin.z;
            ray.tnear = settings_.nearest;
            ray.dir_x = x_[i];
            ray.dir_y = y_[i];
            ray.dir_z = z_[i];
            ray.time = 0;
            ray.tfar = settings_.distance;
            ray.mask = ~0u;
            ray.id = 0;
            ray.flags = 0;
            Query::reset(rays_[i]);
        }
        point_rays_.push_back({point, filled_, count});
        filled_ += count;
    }

    void flush()
    {
        Query::trace(scene_, context_, std::span(rays_).first(filled_));
        for (const PointRays& point_rays : point_rays_)
        {
            Sums sums = sums_[point_rays.point];
            for (uint32_t i = point_rays.first; i < point_rays.first + point_rays.count; ++i)
            {
                const Double3 direction{double{x_[i]}, double{y_[i]}, double{z_[i]}};
                sums.add(direction, query_.occluded(rays_[i]));
            }
            sums_[point_rays.point] = sums;
        }
        point_rays_.clear();
        filled_ = 0;
    }

    RTCScene scene_;
    const RaySettings& settings_;
    Query query_;
    RTCIntersectContext context_;
    std::vector<Ray> rays_;
    std::array<float, kStreamRays> x_, y_, z_;
    std::vector<PointRays> point_rays_;
    std::vector<Sums> sums_;
    uint32_t filled_ = 0; ///< rays in the stream
};

/// Counts the rays of all threads and reports progress.
class RayCounter
{
public:
    RayCounter(const RayProgress& progress, uint64_t total) : progress_(progress), total_(total) {}

    bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

    void add(uint64_t rays)
    {
        const uint64_t done = done_.fetch_add(rays) + rays;
        if (!progress_)
            return;
        // skip the report while another thread reports, except for the last one
        std::unique_lock lock(mutex_, std::defer_lock);
        if (done == total_)
            lock.lock();
        else if (!lock.try_lock())
            return;
        if (!stopped() && !progress_(done_.load(), total_))
            stopped_ = true;
    }

private:
    const RayProgress& progress_;
    const uint64_t total_;
    std::atomic<uint64_t> done_{0};
    std::atomic<bool> stopped_{false};
    std::mutex mutex_;
};

template <typename Query, typename Sums>
bool traceAll(const Occluders& occluders, std::span<const SamplePoint> points, const RaySettings& settings,
              const RayProgress& progress, std::span<typename Sums::Result> moments)
{
    RayCounter counter(progress, uint64_t{points.size()} * settings.rays_per_sample);
    // whole streams, if both are powers of two
    const size_t points_per_task = std::max<uint64_t>(1, kTaskRays / settings.rays_per_sample);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size(), points_per_task),
                      [&](const tbb::blocked_range<size_t>& range)
                      {
                          const FlushToZero mode;
                          const auto tracer = std::make_unique<Tracer<Query, Sums>>(occluders, settings);
                          for (size_t p = range.begin(); p < range.end() && !counter.stopped();
                               p += points_per_task)
                          {
                              const size_t count = std::min(points_per_task, range.end() - p);
                              tracer->trace(points.subspan(p, count), p, moments.subspan(p, count));
                              counter.add(uint64_t{count} * settings.rays_per_sample);
                          }
                      });
    return !counter.stopped();
}

template <typename Sums>
std::optional<std::vector<typename Sums::Result>>
traceMoments(const Occluders& occluders, std::span<const SamplePoint> points, const RaySettings& settings,
             const RayProgress& progress)
{
    HEARTH_ASSERT(settings.rays_per_sample > 0);
    HEARTH_ASSERT(settings.nearest >= 0 && settings.nearest < settings.distance);
    HEARTH_ASSERT(settings.power == 0 || (settings.power > 0 && std::isfinite(settings.distance)));
    std::vector<typename Sums::Result> moments(points.size());
    const bool done = settings.power == 0
                          ? traceAll<AnyHit, Sums>(occluders, points, settings, progress, moments)
                          : traceAll<NearestHit, Sums>(occluders, points, settings, progress, moments);
    if (!done)
        return std::nullopt;
    return moments;
}

} // namespace

std::optional<std::vector<Moments>> visibilityMoments(const Occluders& occluders,
                                                      std::span<const SamplePoint> points,
                                                      const RaySettings& settings,
                                                      const RayProgress& progress)
{
    return traceMoments<FirstSums>(occluders, points, settings, progress);
}

std::optional<std::vector<HigherMoments>> visibilityHigherMoments(const Occluders& occluders,
                                                                  std::span<const SamplePoint> points,
                                                                  const RaySettings& settings,
                                                                  const RayProgress& progress)
{
    return traceMoments<SecondSums>(occluders, points, settings, progress);
}

} // namespace hearth::visibility
