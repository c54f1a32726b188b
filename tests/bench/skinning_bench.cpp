// Benchmarks the bounds of characters of 60 joints: 100,000 vertices with 20 clips, and 1,573 vertices with 4
// clips and 8 influences.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_bounds.h"
#include "cook/skinning/group_spheres.h"
#include "tests/cook/animation/limb_character.h"

#include <benchmark/benchmark.h>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using namespace hearth::formats;
using skinning::DeformedCluster;

std::vector<animation_bounds::Box3d> computeReach(const test::Character& character)
{
    std::vector<animation_bounds::Box3d> reach(character.joints.size());
    for (const DeformedCluster& cluster : character.mesh.clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            animation_bounds::add(reach[cluster.joints[i]], widen(cluster.positions[i / cluster.influences]));
    return reach;
}

/// Bound one level of clusters in groups of 16, like the source level of a hierarchy.
void measureBounds(benchmark::State& state, const test::LimbCharacterSize& size)
{
    const tbb::global_control two_cores(tbb::global_control::max_allowed_parallelism, 2);
    const test::Character character = test::limbCharacter(size);
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters(character.mesh.clusters.size());
    for (uint32_t i = 0; i < clusters.size(); ++i)
    {
        clusters[i].refined_group = kInvalidIndex;
        if (i % 16 == 0)
            groups.push_back({});
        groups.back().clusters = {i - i % 16, i % 16 + 1};
    }
    for (auto _ : state)
    {
        const AnimationTables tables = character.tables();
        const std::vector<animation_bounds::NodeMotion> nodes = animation_bounds::nodeMotions(tables);
        const std::vector<animation_bounds::Box3d> reach = computeReach(character);
        const animation_bounds::SkinMotion skin(tables, nodes, 0, reach);
        const animation_bounds::PoseRegions regions(tables, nodes);
        const skinning::Deformation deformation{&skin, {}, &regions};
        benchmark::DoNotOptimize(computeClusterBounds(character.mesh.clusters, deformation));
        benchmark::DoNotOptimize(
            computeAnchoredBounds({groups, clusters, 0, 0}, character.mesh.clusters, deformation, reach));
    }
    state.counters["vertices"] = size.vertices;
    state.counters["joints"] = static_cast<double>(character.joints.size());
    state.counters["clips"] = size.clips;
}

void characterBounds(benchmark::State& state)
{
    measureBounds(state, {100'000, 4, 20});
}
BENCHMARK(characterBounds)->Unit(benchmark::kMillisecond)->UseRealTime();

void tightenedBounds(benchmark::State& state)
{
    measureBounds(state, {1573, 8, 4});
}
BENCHMARK(tightenedBounds)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
