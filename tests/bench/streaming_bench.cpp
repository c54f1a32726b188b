// Benchmarks the CPU cost of the streaming policy per frame: 28,000 pages (1.7 GiB) and a view that wanders
// over them.
//   hearth_bench_streaming
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/residency.h"

#include <benchmark/benchmark.h>

namespace
{

using namespace hearth;
using pack::PageNode;

constexpr uint32_t kPageCount = 28000;
constexpr uint32_t kPageBytes = 64 * 1024;
constexpr uint64_t kWantedPages = 2000;

/// Make twelve levels, each with twice the pages of the one before. A page needs the two pages at its
/// location one level up and the two beside them, as pages of real meshes do (2 to 4).
std::vector<PageNode> makePages()
{
    std::vector<PageNode> nodes;
    uint32_t coarser_first = 0, coarser_count = 0;
    for (uint32_t count = 7; nodes.size() < kPageCount; count *= 2)
    {
        const auto first = static_cast<uint32_t>(nodes.size());
        for (uint32_t i = 0; i < count && nodes.size() < kPageCount; ++i)
        {
            PageNode node{kPageBytes, coarser_count == 0, {}, {}};
            for (uint32_t n = i / 2; coarser_count > 0 && n < i / 2 + 3 && n < coarser_count; ++n)
                node.needs.push_back(coarser_first + n);
            nodes.push_back(node);
        }
        coarser_first = first;
        coarser_count = count;
    }
    return nodes;
}

/// Run one frame; all its loads end in it. The view requests consecutive finest pages.
void frame(pack::Residency& residency, uint64_t serial, uint32_t first_page)
{
    residency.beginFrame(serial, serial < 3 ? 0 : serial - 3);
    for (uint32_t i = 0; i < kWantedPages; ++i)
        residency.request(first_page + i, 1 + static_cast<float>(i % 64));
    for (const uint32_t page : residency.schedule())
        residency.completed(page, true);
}

/// range(0): pages that the view advances in each frame; range(1): pages in the budget.
void wander(benchmark::State& state)
{
    const auto moved = static_cast<uint32_t>(state.range(0));
    auto residency = pack::Residency::create(
        pack::PageGraph(makePages()), {.budget_bytes = static_cast<uint64_t>(state.range(1)) * kPageBytes});
    constexpr uint32_t kFirstFine = 15000;
    uint64_t serial = 0;
    uint32_t at = 0;
    const auto next = [&]
    {
        frame(*residency, ++serial, kFirstFine + at);
        at = (at + moved) % (kPageCount - kFirstFine - static_cast<uint32_t>(kWantedPages));
    };
    for (int warm_up = 0; warm_up < 500; ++warm_up)
        next();
    for (auto _ : state)
        next();
    state.counters["scale"] = static_cast<double>(residency->errorScale());
}

BENCHMARK(wander)
    ->ArgNames({"moved", "held"})
    ->Args({0, 8000})
    ->Args({8, 8000})
    ->Args({8, 3000})
    ->Unit(benchmark::kMicrosecond);

} // namespace
