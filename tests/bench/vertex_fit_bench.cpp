// Benchmarks fitting visibility to 100,000 vertices on one core, stage by stage.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/level_fit.h"
#include "cook/visibility/fit/normal_equations.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/support/shapes.h"

#include <benchmark/benchmark.h>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using namespace hearth::visibility;

/// A rock of 199,692 triangles with four samples on each; the values are smooth plus some noise.
struct Scene
{
    mesh::SourceMesh rock = shapes::rock(129, 0.5f);
    std::vector<SurfaceSample> samples = test::makeSamples(test::makeMeshView(rock), 4);
    std::vector<Moments> values;

    Scene()
    {
        for (size_t i = 0; i < samples.size(); ++i)
        {
            const Float3 p = test::getPoint(test::makeMeshView(rock), samples[i]);
            const float noise = static_cast<float>(i * 2654435761u % 1024) / 5120 - 0.1f;
            values.push_back({4 + p.x + noise, {0.5f * p.y, p.z + noise, 1 + noise}});
        }
    }
};

const Scene& scene()
{
    static const Scene the_scene;
    return the_scene;
}

using OneCore = tbb::global_control;
constexpr auto kParallelism = tbb::global_control::max_allowed_parallelism;

void fitMesh(benchmark::State& state)
{
    const OneCore one(kParallelism, 1);
    for (auto _ : state)
        benchmark::DoNotOptimize(makeFitMesh(test::makeMeshView(scene().rock)));
}
BENCHMARK(fitMesh)->Unit(benchmark::kMillisecond)->UseRealTime();

void assembly(benchmark::State& state)
{
    const OneCore one(kParallelism, 1);
    const FitMesh fit_mesh = makeFitMesh(test::makeMeshView(scene().rock));
    const std::vector<SurfaceSample> samples =
        mapSamplesToFitMesh(fit_mesh, test::makeMeshView(scene().rock), scene().samples);
    for (auto _ : state)
        benchmark::DoNotOptimize(assemble(fit_mesh, samples, scene().values, {}));
}
BENCHMARK(assembly)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Solve four right-hand sides, starting from zero.
void solution(benchmark::State& state)
{
    const OneCore one(kParallelism, 1);
    const FitMesh fit_mesh = makeFitMesh(test::makeMeshView(scene().rock));
    const std::vector<SurfaceSample> samples =
        mapSamplesToFitMesh(fit_mesh, test::makeMeshView(scene().rock), scene().samples);
    const NormalEquations system = assemble(fit_mesh, samples, scene().values, {});
    SolveStatistics statistics;
    for (auto _ : state)
    {
        std::vector<Block4> x(fit_mesh.positions.size());
        statistics = solve(system.matrix, system.right, x, 1e-8, 500);
        benchmark::DoNotOptimize(x);
    }
    state.counters["vertices"] = static_cast<double>(fit_mesh.positions.size());
    state.counters["iterations"] = statistics.iterations;
    state.counters["condition"] = statistics.condition;
}
BENCHMARK(solution)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Fit ten levels, each with half the triangles of the one before, by meshes of the same shape.
void levels(benchmark::State& state)
{
    const OneCore cores(kParallelism, static_cast<size_t>(state.range(0)));
    std::vector<mesh::SourceMesh> meshes;
    for (const uint32_t n : {91u, 64u, 45u, 32u, 23u, 16u, 11u, 8u, 6u})
        meshes.push_back(shapes::rock(n, 0.5f));
    std::vector<LevelMesh> views{{test::makeMeshView(scene().rock), {}, 0}};
    for (const mesh::SourceMesh& mesh : meshes)
        views.push_back({test::makeMeshView(mesh), {}, 0});
    for (auto _ : state)
        benchmark::DoNotOptimize(fitLevels(views, scene().samples, scene().values));
}
BENCHMARK(levels)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
