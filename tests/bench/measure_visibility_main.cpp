// Measures the ray throughput of the visibility cooker against bare loops over the same rays: the cost of
// sampling, summing and task scheduling. Fails below kMinShare. `./dev bench visibility` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/sampling/hemisphere.h"
#include "cook/sampling/owen_sobol.h"
#include "cook/visibility/rays/rays.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <embree3/rtcore.h>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <xmmintrin.h>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace
{

using namespace hearth;
using namespace hearth::visibility;

constexpr uint32_t kRays = 64;        ///< rays of each point
constexpr size_t kRunPoints = 1024;   ///< neighbouring points along the curve
constexpr size_t kRuns = 32;          ///< runs of neighbouring points, all over the mesh
constexpr size_t kTaskRays = 1 << 15; ///< rays of a task, as in the stage
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kMinShare = 0.8; ///< of the fastest bare loop's rays a second of processor time

double processorSeconds()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// A method to trace all rays. The methods take turns round by round, so that other load on the machine
/// affects all of them alike.
struct Way
{
    const char* name;
    std::function<void()> prepare; ///< set-up; not measured
    std::function<void()> trace;
    std::function<uint64_t()> hidden; ///< occluded rays of the last round
    double wall_seconds = std::numeric_limits<double>::infinity(), processor_seconds = wall_seconds;
    uint64_t hidden_rays = 0;
};

void measure(std::vector<Way>& ways, int rounds)
{
    for (int round = 0; round < rounds; ++round)
        for (Way& way : ways)
        {
            way.prepare();
            const double processor = processorSeconds();
            const auto begin = std::chrono::steady_clock::now();
            way.trace();
            const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
            way.wall_seconds = std::min(way.wall_seconds, wall.count());
            way.processor_seconds = std::min(way.processor_seconds, processorSeconds() - processor);
            way.hidden_rays = way.hidden();
        }
}

/// Print the figures; the stage is the last method. Returns whether it reaches kMinShare.
bool print(const std::vector<Way>& ways, uint64_t rays, const char* title)
{
    std::printf("%s\n  %-32s %12s %26s %10s\n", title, "", "Mrays/s", "Mrays/s of processor time", "hidden");
    double least_wall = kInfinity, least_processor = kInfinity;
    for (const Way& way : ways)
    {
        std::printf("  %-32s %12.2f %26.2f %9.4f%%\n", way.name,
                    static_cast<double>(rays) * 1e-6 / way.wall_seconds,
                    static_cast<double>(rays) * 1e-6 / way.processor_seconds,
                    100 * static_cast<double>(way.hidden_rays) / static_cast<double>(rays));
        if (&way != &ways.back())
        {
            least_wall = std::min(least_wall, way.wall_seconds);
            least_processor = std::min(least_processor, way.processor_seconds);
        }
    }
    const double share = least_processor / ways.back().processor_seconds;
    std::printf("  the stage, of the fastest bare loop: %.0f %% by the clock, %.0f %% of processor time (at "
                "least %.0f)\n",
                100 * least_wall / ways.back().wall_seconds, 100 * share, 100 * kMinShare);
    return share >= kMinShare;
}

/// Run in tasks, as the stage does, with the floating-point mode that Embree recommends.
template <typename Trace>
void inTasks(size_t items, size_t rays_per_item, Trace trace)
{
    tbb::parallel_for(tbb::blocked_range<size_t>(0, items, kTaskRays / rays_per_item),
                      [&](const tbb::blocked_range<size_t>& range)
                      {
                          const unsigned before = _mm_getcsr();
                          _mm_setcsr(before | 0x8040); // flush to zero, denormals are zero
                          RTCIntersectContext context;
                          rtcInitIntersectContext(&context);
                          trace(context, range.begin(), range.end());
                          _mm_setcsr(before);
                      });
}

RTCRay makeRay(const SamplePoint& point, float x, float y, float z, float distance)
{
    const Float3 origin = rayOrigin(point);
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = x;
    ray.dir_y = y;
    ray.dir_z = z;
    ray.tfar = distance;
    ray.mask = ~0u;
    return ray;
}

/// The same rays that the stage makes.
std::vector<RTCRay> makeRays(std::span<const SamplePoint> points, float distance)
{
    std::vector<RTCRay> rays;
    rays.reserve(points.size() * kRays);
    std::vector<float> x(kRays), y(kRays), z(kRays);
    for (size_t p = 0; p < points.size(); ++p)
    {
        sampling::hemisphereDirections(0, sampling::deriveSeed(0, p), sampling::frameAround(points[p].normal),
                                       x, y, z);
        for (uint32_t i = 0; i < kRays; ++i)
            rays.push_back(makeRay(points[p], x[i], y[i], z[i], distance));
    }
    return rays;
}

std::vector<RTCRay16> makePackets(std::span<const RTCRay> rays)
{
    std::vector<RTCRay16> packets(rays.size() / 16);
    for (size_t i = 0; i < rays.size(); ++i)
    {
        RTCRay16& packet = packets[i / 16];
        const RTCRay& ray = rays[i];
        const size_t lane = i % 16;
        packet.org_x[lane] = ray.org_x;
        packet.org_y[lane] = ray.org_y;
        packet.org_z[lane] = ray.org_z;
        packet.dir_x[lane] = ray.dir_x;
        packet.dir_y[lane] = ray.dir_y;
        packet.dir_z[lane] = ray.dir_z;
        packet.tfar[lane] = ray.tfar;
        packet.mask[lane] = ~0u;
    }
    return packets;
}

/// The stage itself; it counts occluded rays by its moments.
Way stageWay(const Occluders& occluders, std::span<const SamplePoint> points, const RaySettings& settings)
{
    const auto moments = std::make_shared<std::vector<Moments>>();
    return {"hearth: visibilityMoments", [] {},
            [&occluders, points, settings, moments]
            { *moments = *visibilityMoments(occluders, points, settings); },
            [moments]
            {
                double hidden = 0;
                for (const Moments& m : *moments)
                    hidden += kRays * (1 - double{m.m0} / 6.283185307179586);
                return static_cast<uint64_t>(hidden + 0.5);
            }};
}

bool measureAnyHit(const Occluders& occluders, std::span<const SamplePoint> points, int rounds)
{
    const std::vector<RTCRay> rays = makeRays(points, kInfinity);
    std::vector<RTCRay> traced;
    std::vector<RTCRay16> packets;
    RTCScene scene = occluders.scene();
    const auto copy = [&] { traced = rays; };
    const auto hidden = [&]
    {
        return static_cast<uint64_t>(
            std::count_if(traced.begin(), traced.end(), [](const RTCRay& r) { return r.tfar < 0; }));
    };
    std::vector<Way> ways;
    ways.push_back({"bare rtcOccluded1", copy,
                    [&]
                    {
                        inTasks(traced.size(), 1,
                                [&](RTCIntersectContext& context, size_t begin, size_t end)
                                {
                                    for (size_t i = begin; i < end; ++i)
                                        rtcOccluded1(scene, &context, &traced[i]);
                                });
                    },
                    hidden});
    ways.push_back({"bare rtcOccluded16", [&] { packets = makePackets(rays); },
                    [&]
                    {
                        inTasks(packets.size(), 16,
                                [&](RTCIntersectContext& context, size_t begin, size_t end)
                                {
                                    alignas(64) int valid[16];
                                    std::fill(std::begin(valid), std::end(valid), -1);
                                    for (size_t i = begin; i < end; ++i)
                                        rtcOccluded16(valid, scene, &context, &packets[i]);
                                });
                    },
                    [&]
                    {
                        uint64_t count = 0;
                        for (const RTCRay16& packet : packets)
                            for (const float t : packet.tfar)
                                count += t < 0 ? 1 : 0;
                        return count;
                    }});
    const auto stream = [&](const char* name, size_t length)
    {
        ways.push_back({name, copy,
                        [&, length]
                        {
                            inTasks(traced.size() / length, length,
                                    [&](RTCIntersectContext& context, size_t begin, size_t end)
                                    {
                                        for (size_t i = begin; i < end; ++i)
                                            rtcOccluded1M(scene, &context, &traced[i * length],
                                                          static_cast<unsigned>(length), sizeof(RTCRay));
                                    });
                        },
                        hidden});
    };
    stream("bare rtcOccluded1M of 256", 256);
    stream("bare rtcOccluded1M of 1024", 1024);
    stream("bare rtcOccluded1M of 2048", 2048);
    stream("bare rtcOccluded1M of 4096", 4096);
    ways.push_back(stageWay(occluders, points, {.rays_per_sample = kRays}));
    measure(ways, rounds);
    return print(ways, rays.size(), "any hit (binary visibility)");
}

bool measureNearestHit(const Occluders& occluders, std::span<const SamplePoint> points, int rounds)
{
    constexpr float kDistance = 100; // larger than the mesh
    const std::vector<RTCRay> rays = makeRays(points, kDistance);
    std::vector<RTCRayHit> traced(rays.size());
    RTCScene scene = occluders.scene();
    const auto copy = [&]
    {
        for (size_t i = 0; i < rays.size(); ++i)
        {
            traced[i].ray = rays[i];
            traced[i].hit.geomID = traced[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        }
    };
    const auto hidden = [&]
    {
        return static_cast<uint64_t>(std::count_if(traced.begin(), traced.end(),
                                                   [](const RTCRayHit& r)
                                                   { return r.hit.geomID != RTC_INVALID_GEOMETRY_ID; }));
    };
    std::vector<Way> ways;
    ways.push_back({"bare rtcIntersect1", copy,
                    [&]
                    {
                        inTasks(traced.size(), 1,
                                [&](RTCIntersectContext& context, size_t begin, size_t end)
                                {
                                    for (size_t i = begin; i < end; ++i)
                                        rtcIntersect1(scene, &context, &traced[i]);
                                });
                    },
                    hidden});
    ways.push_back({"bare rtcIntersect1M of 2048", copy,
                    [&]
                    {
                        inTasks(traced.size() / 2048, 2048,
                                [&](RTCIntersectContext& context, size_t begin, size_t end)
                                {
                                    for (size_t i = begin; i < end; ++i)
                                        rtcIntersect1M(scene, &context, &traced[i * 2048], 2048,
                                                       sizeof(RTCRayHit));
                                });
                    },
                    hidden});
    ways.push_back(
        stageWay(occluders, points, {.rays_per_sample = kRays, .distance = kDistance, .power = 1}));
    measure(ways, rounds);
    return print(ways, rays.size(), "nearest hit (attenuated visibility; hidden: weighed)");
}

int run(int argc, char** argv)
{
    cli::CommandLine app{"Rays of the visibility cooker beside bare loops of Embree"};
    uint32_t side = 130;
    int rounds = 5;
    int threads = 2;
    app.addOption("--side", side, "of the six n x n sides of a rock of 12 n^2 triangles").range(10, 1000);
    app.addOption("--rounds", rounds, "of which the fastest counts").range(1, 100);
    app.addOption("--threads", threads, "that trace rays").range(1, 256);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(threads));

    const mesh::SourceMesh rock = shapes::rock(side, 0.6f);
    auto seconds = [begin = std::chrono::steady_clock::now()]() mutable
    {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(begin, now)).count();
    };
    const std::vector<SurfaceSample> samples = surfaceSamples(rock.positions, rock.indices, {});
    const std::vector<SamplePoint> all = samplePoints(rock.positions, rock.indices, samples);
    const double sampling_seconds = seconds();
    Occluders occluders;
    occluders.place(occluders.add({rock.positions, rock.indices}));
    occluders.finish();
    const double build_seconds = seconds();
    std::printf(
        "%zu triangles, %zu vertices; %zu samples in %.2f s; tree of one thread in %.2f s; %d threads\n",
        rock.indices.size() / 3, rock.positions.size(), samples.size(), sampling_seconds, build_seconds,
        threads);

    std::vector<SamplePoint> points;
    for (size_t r = 0; r < kRuns; ++r)
    {
        const size_t first = (all.size() - std::min(all.size(), kRunPoints)) * r / kRuns;
        points.insert(points.end(), all.begin() + static_cast<std::ptrdiff_t>(first),
                      all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), first + kRunPoints)));
    }
    const bool any_hit = measureAnyHit(occluders, points, rounds);
    const bool nearest_hit = measureNearestHit(occluders, points, rounds);
    return any_hit && nearest_hit ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    return run(argc, argv);
}
