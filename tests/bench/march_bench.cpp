// Benchmarks ray marching through bricks on one core: hemisphere rays from the ground of a terrain, one by
// one and in SIMD lanes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/march_lanes.h"
#include "tests/support/brick_model.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace
{

using namespace hearth;
using namespace hearth::shared;

struct Ray
{
    Float3 origin;
    Float3 direction;
};

/// Hills of up to 80 voxels, 512 x 512 across, a voxel or two thick, and 800 rocks and trunks on them.
struct Terrain
{
    static constexpr uint32_t kAcross = 512;
    static constexpr uint32_t kUp = 96;
    test::BrickModel model;
    std::vector<Ray> rays;

    Terrain()
    {
        std::mt19937 random(1);
        std::vector<uint32_t> top(size_t{kAcross} * kAcross), rock(top.size());
        for (uint32_t z = 0; z < kAcross; ++z)
            for (uint32_t x = 0; x < kAcross; ++x)
                top[x + size_t{z} * kAcross] = heightAt(x, z);
        for (int i = 0; i < 800; ++i)
        {
            const auto below = [&](uint32_t most) { return static_cast<uint32_t>(random() % most); };
            const uint32_t x = 4 + below(kAcross - 8), z = 4 + below(kAcross - 8);
            const uint32_t width = 1 + below(4), height = 2 + below(14);
            for (uint32_t dz = 0; dz < width; ++dz)
                for (uint32_t dx = 0; dx < width; ++dx)
                    rock[x + dx + size_t{z + dz} * kAcross] = height;
        }
        model = test::brickModel({kAcross, kUp, kAcross},
                                 [&](uint32_t x, uint32_t y, uint32_t z)
                                 {
                                     const uint32_t ground = top[x + size_t{z} * kAcross];
                                     return y <= ground + rock[x + size_t{z} * kAcross] && y + 2 > ground;
                                 });
        addRays(random, top, rock);
    }

private:
    static uint32_t heightAt(uint32_t x, uint32_t z)
    {
        const double u = x / double{kAcross} * 2 * std::numbers::pi,
                     v = z / double{kAcross} * 2 * std::numbers::pi;
        return static_cast<uint32_t>(45 + 22 * std::sin(2 * u + v) + 9 * std::sin(5 * v - u) +
                                     4 * std::sin(13 * u + 7 * v));
    }

    /// Rays from the centre of every upper face, with cosine-distributed directions.
    void addRays(std::mt19937& random, const std::vector<uint32_t>& top, const std::vector<uint32_t>& rock)
    {
        std::uniform_real_distribution<float> uniform(0, 1);
        for (uint32_t z = 0; z < kAcross; ++z)
            for (uint32_t x = 0; x < kAcross; ++x)
            {
                const size_t at = x + size_t{z} * kAcross;
                const float r2 = uniform(random), angle = uniform(random) * 2 * std::numbers::pi_v<float>;
                const float r = std::sqrt(r2);
                rays.push_back({{static_cast<float>(x) + 0.5f, static_cast<float>(top[at] + rock[at] + 1),
                                 static_cast<float>(z) + 0.5f},
                                {r * std::cos(angle), std::sqrt(1 - r2), r * std::sin(angle)}});
            }
    }
};

const Terrain& terrain()
{
    static const Terrain the_terrain;
    return the_terrain;
}

BrickRay makeRay(const BrickMasks& masks, const Ray& ray)
{
    return brickRayInVoxels(masks.grid, ray.origin, ray.direction, kBrickInfinity);
}

/// Counts what rays found.
struct Count
{
    uint64_t rays = 0;
    uint64_t hits = 0;
    uint64_t steps = 0;

    void add(const BrickRay& end)
    {
        ++rays;
        hits += end.inside;
        steps += end.steps;
    }

    void report(benchmark::State& state) const
    {
        const auto count = static_cast<double>(rays);
        state.SetItemsProcessed(static_cast<int64_t>(rays));
        state.counters["hit"] = static_cast<double>(hits) / count;
        state.counters["steps"] = static_cast<double>(steps) / count;
    }
};

/// March to the first solid voxel, one ray after the other.
void march(benchmark::State& state, const std::vector<Ray>& rays)
{
    const BrickMasks masks = terrain().model.masks();
    Count count;
    for (auto _ : state)
        for (const Ray& ray : rays)
            count.add(brickMarch(masks, makeRay(masks, ray)));
    count.report(state);
}

/// March the same rays in lanes, in batches of 256 as for the lighting of faces.
void marchLanes(benchmark::State& state, const std::vector<Ray>& rays)
{
    const BrickMasks masks = terrain().model.masks();
    const bricks::MarchTable table(masks);
    std::array<BrickRay, 256> some;
    Count count;
    for (auto _ : state)
        for (size_t first = 0; first < rays.size(); first += some.size())
        {
            for (size_t i = 0; i < some.size(); ++i)
                some[i] = makeRay(masks, rays[first + i]);
            bricks::marchRays(table, some);
            for (const BrickRay& end : some)
                count.add(end);
        }
    count.report(state);
}

const std::vector<Ray>& fromFaces()
{
    return terrain().rays;
}

const std::vector<Ray>& fromAnywhere()
{
    static const std::vector<Ray> the_rays = []
    {
        std::vector<Ray> rays = terrain().rays;
        std::shuffle(rays.begin(), rays.end(), std::mt19937(2));
        return rays;
    }();
    return the_rays;
}

/// March from one face to the next, in the order of the lighting; the rays' directions are unrelated.
void marchFromFaces(benchmark::State& state)
{
    march(state, fromFaces());
}
BENCHMARK(marchFromFaces)->Unit(benchmark::kMillisecond);

void marchLanesFromFaces(benchmark::State& state)
{
    marchLanes(state, fromFaces());
}
BENCHMARK(marchLanesFromFaces)->Unit(benchmark::kMillisecond);

/// March between random points: the next ray finds nothing of its bricks in the CPU caches.
void marchFromAnywhere(benchmark::State& state)
{
    march(state, fromAnywhere());
}
BENCHMARK(marchFromAnywhere)->Unit(benchmark::kMillisecond);

void marchLanesFromAnywhere(benchmark::State& state)
{
    marchLanes(state, fromAnywhere());
}
BENCHMARK(marchLanesFromAnywhere)->Unit(benchmark::kMillisecond);

} // namespace
