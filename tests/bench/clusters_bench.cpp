// Benchmarks building cluster hierarchies and reports their shape. Figures are user CPU time on one thread:
//   hearth_bench_clusters --benchmark_filter=rock2m
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/hierarchy.h"
#include "tests/support/shapes.h"

#include <benchmark/benchmark.h>

#include <sys/resource.h>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;

double peakMegabytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

void build(benchmark::State& state, const mesh::SourceMesh& mesh)
{
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    clusters::Hierarchy hierarchy;
    for (auto _ : state)
        hierarchy = clusters::buildHierarchy(mesh);
    const auto triangles = static_cast<double>(mesh.triangleCount());
    double kept = 0;
    uint64_t decoded = 0;
    for (const auto& level : hierarchy.levels)
        kept += level.triangle_count;
    for (const auto& page : hierarchy.pages)
        decoded += page.size;
    const auto cluster_count = static_cast<double>(hierarchy.clusters.size());
    const auto& source_level = hierarchy.levels.front();
    state.counters["ktri/s"] = benchmark::Counter(triangles * static_cast<double>(state.iterations()) / 1000,
                                                  benchmark::Counter::kIsRate);
    state.counters["levels"] = static_cast<double>(hierarchy.levels.size());
    state.counters["fill0_%"] = 100.0 * source_level.triangle_count / (128.0 * source_level.clusters.count);
    state.counters["fill_%"] = 100.0 * kept / (128.0 * cluster_count);
    state.counters["tris_all/in"] = kept / triangles;
    state.counters["B/tri"] = static_cast<double>(decoded) / triangles;
    state.counters["storedB/tri"] = static_cast<double>(hierarchy.page_bytes.size()) / triangles;
    state.counters["page_fill_%"] =
        100.0 * static_cast<double>(decoded) / (65536.0 * static_cast<double>(hierarchy.pages.size()));
    state.counters["root_tris"] = hierarchy.levels.back().triangle_count;
    state.counters["retried"] = static_cast<double>(hierarchy.counts.retried_groups);
    state.counters["stuck"] = static_cast<double>(hierarchy.counts.stuck_groups);
    state.counters["loose"] = static_cast<double>(hierarchy.counts.loose_pieces);
    state.counters["permissive"] = static_cast<double>(hierarchy.counts.permissive_groups);
    state.counters["pruned"] = static_cast<double>(hierarchy.counts.pruned_groups);
    state.counters["peakMB"] = peakMegabytes();
}

void rock200k(benchmark::State& state)
{
    build(state, shapes::rock(129, 0.4f));
}
void rock2m(benchmark::State& state)
{
    build(state, shapes::rock(408, 0.4f));
}
void terrain1m(benchmark::State& state)
{
    build(state, shapes::terrain(707));
}
void foliage400k(benchmark::State& state)
{
    build(state, shapes::foliage(200000));
}
void seams500k(benchmark::State& state)
{
    build(state, shapes::blocks(190));
}

BENCHMARK(rock200k)->Unit(benchmark::kMillisecond);
BENCHMARK(rock2m)->Unit(benchmark::kMillisecond);
BENCHMARK(terrain1m)->Unit(benchmark::kMillisecond);
BENCHMARK(foliage400k)->Unit(benchmark::kMillisecond);
BENCHMARK(seams500k)->Unit(benchmark::kMillisecond);

} // namespace
