// The march through bricks on one core: rays of hemispheres in random order from the ground of a terrain.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/brick_model.h"

#include <benchmark/benchmark.h>

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

/// Hills of up to 80 voxels, 512 x 512 across, two voxels thick, and 800 rocks and trunks on them.
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
            const uint32_t x = 4 + random() % (kAcross - 8), z = 4 + random() % (kAcross - 8);
            const uint32_t width = 1 + random() % 4, height = 2 + random() % 14;
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

    /// From the middles of upper faces, directions by cosine.
    void addRays(std::mt19937& random, const std::vector<uint32_t>& top, const std::vector<uint32_t>& rock)
    {
        std::uniform_real_distribution<float> uniform(0, 1);
        for (int i = 0; i < 1 << 18; ++i)
        {
            const uint32_t x = random() % kAcross, z = random() % kAcross;
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

void report(benchmark::State& state, uint64_t hits, uint64_t steps)
{
    const auto rays = static_cast<double>(state.iterations()) * static_cast<double>(terrain().rays.size());
    state.SetItemsProcessed(static_cast<int64_t>(rays));
    state.counters["hit"] = static_cast<double>(hits) / rays;
    state.counters["steps"] = static_cast<double>(steps) / rays;
}

/// To the first solid voxel.
void march(benchmark::State& state)
{
    const BrickMasks masks = terrain().model.masks();
    uint64_t hits = 0, steps = 0;
    for (auto _ : state)
        for (const Ray& ray : terrain().rays)
        {
            const BrickRay end =
                brickMarch(masks, brickRayInVoxels(masks.grid, ray.origin, ray.direction, kBrickFar));
            hits += end.inside;
            steps += end.steps;
        }
    report(state, hits, steps);
}
BENCHMARK(march)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same with the light of the face: what lighting reads.
void marchToLight(benchmark::State& state)
{
    const test::BrickModel& model = terrain().model;
    const BrickMasks masks = model.masks();
    uint64_t hits = 0, steps = 0, light = 0;
    for (auto _ : state)
        for (const Ray& ray : terrain().rays)
        {
            const BrickRay end =
                brickMarch(masks, brickRayInVoxels(masks.grid, ray.origin, ray.direction, kBrickFar));
            if (end.inside != 0)
                if (const uint32_t face = brickFace(masks.bricks[end.brick], end.bit, end.face);
                    face != kNoFace)
                    light += model.lighting[face];
            hits += end.inside;
            steps += end.steps;
        }
    benchmark::DoNotOptimize(light);
    report(state, hits, steps);
}
BENCHMARK(marchToLight)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

BENCHMARK_MAIN();
