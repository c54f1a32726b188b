// Tests cuts through hierarchies with partial residency: whole surfaces, for any set of pages that the policy
// has loaded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"
#include "runtime/pack/residency.h"
#include "tests/runtime/gpu/cooked_mesh.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace formats;
using testing::ElementsAreArray;

/// Error of a random group, or 0.
float randomThreshold(const PackView& view, std::mt19937& random)
{
    const float error = view.groups()[random() % view.groups().size()].error;
    return std::isfinite(error) && random() % 2 != 0 ? error : 0;
}

uint64_t countResident(const std::vector<uint8_t>& resident)
{
    return static_cast<uint64_t>(std::count(resident.begin(), resident.end(), uint8_t{1}));
}

void expectWholeAtRandomSets(const CookedMesh& mesh, bool watertight, uint32_t seed)
{
    const pack::PageGraph graph = pack::PageGraph::of(mesh.view());
    std::mt19937 random(seed);
    uint32_t mixed = 0, partly_resident = 0;
    const uint32_t step = kSanitized ? 4 : 1;
    for (uint32_t i = 0; i < 100 && !testing::Test::HasFailure(); i += step)
    {
        const auto resident = randomClosedSet(graph, 0.3 + 0.007 * i, random);
        partly_resident += countResident(resident) < graph.pageCount();
        const auto cut = pack::selectCut(mesh.view(), 0, randomThreshold(mesh.view(), random),
                                         pack::residentGroups(mesh.view(), resident));
        for (const uint32_t cluster : cut)
            ASSERT_NE(resident[mesh.view().clusters()[cluster].page], 0) << "what is drawn is resident";
        mesh.expectWhole(cut, watertight);
        mixed += mixesLevels(mesh.view(), cut);
    }
    EXPECT_GT(partly_resident * step, 80u);
    EXPECT_TRUE(mixed * step > 30 || !watertight) << "or seams are not tested: " << mixed;
}

TEST(ResidentCut, coversTheSurfaceOnceForEveryClosedSet)
{
    expectWholeAtRandomSets(CookedMesh(plain(shapes::rock(72, 0.3f))), true, 1);
    expectWholeAtRandomSets(CookedMesh(plain(shapes::terrain(160))), true, 2);
}

TEST(ResidentCut, drawsASetOfGroupsOnlyWhereAllItsPagesAreResident)
{
    const CookedMesh mesh = rockWithAuthoredLevels();
    const pack::PageGraph graph = pack::PageGraph::of(mesh.view());
    uint64_t companions = 0;
    for (uint32_t page = 0; page < graph.pageCount(); ++page)
        companions += graph.companions(page).size();
    EXPECT_GT(companions, 2u) << "sets must span pages, or nothing is tested";
    // an authored LOD is another surface: its border is its own
    expectWholeAtRandomSets(mesh, false, 3);
}

TEST(PageGraph, isThatOfThePackWhereNoSetSpansPages)
{
    const CookedMesh mesh(plain(shapes::rock(72, 0.3f)));
    const PackView& view = mesh.view();
    const pack::PageGraph graph = pack::PageGraph::of(view);
    ASSERT_EQ(graph.pageCount(), view.pages().size());
    for (uint32_t page = 0; page < graph.pageCount(); ++page)
    {
        EXPECT_EQ(graph.sizeBytes(page), view.pages()[page].size);
        EXPECT_THAT(graph.needs(page),
                    ElementsAreArray(recordsInRange(view.pageParents(), view.pages()[page].parents)));
        EXPECT_TRUE(graph.companions(page).empty());
    }
    EXPECT_THAT(graph.pinned(), testing::ElementsAre(0)) << "the coarsest level ends in one cluster";
}

/// Request pages like a cull pass: the finer group of each cluster that is too coarse.
void requestFiner(const PackView& view, pack::Residency& residency, float threshold)
{
    for (const ClusterRecord& cluster : view.clusters())
        if (cluster.refined_group != kInvalidIndex && view.groups()[cluster.refined_group].error > threshold)
            residency.request(view.groups()[cluster.refined_group].page,
                              view.groups()[cluster.refined_group].error / threshold);
}

std::vector<uint32_t> findCut(const PackView& view, const pack::Residency& residency, float threshold)
{
    std::vector<uint8_t> resident(view.pages().size());
    for (uint32_t page = 0; page < resident.size(); ++page)
        resident[page] = residency.isResident(page) ? 1 : 0;
    return pack::selectCut(view, 0, threshold, pack::residentGroups(view, resident));
}

/// Stream with a budget of `share` of all pages until all frames have been drawn; expects a whole surface in
/// each.
void streamFrames(const CookedMesh& mesh, float threshold, double share, bool watertight)
{
    const PackView& view = mesh.view();
    uint64_t bytes = 0;
    for (const PageRecord& page : view.pages())
        bytes += page.size;
    auto created = pack::Residency::create(
        pack::PageGraph::of(view),
        {.budget_bytes = static_cast<uint64_t>(share * static_cast<double>(bytes)), .max_loads = 2});
    ASSERT_TRUE(created.ok());
    pack::Residency& residency = *created;
    std::vector<uint32_t> loading, cut, drawn_before;
    float scale = 1;
    for (uint64_t serial = 1; serial < 150; ++serial)
    {
        residency.beginFrame(serial, serial < 3 ? 0 : serial - 3);
        scale = residency.errorScale();
        requestFiner(view, residency, threshold * scale);
        const auto started = residency.schedule();
        for (const uint32_t page : loading)
            residency.completed(page, true);
        loading.assign(started.begin(), started.end());
        cut = findCut(view, residency, threshold * scale);
        if (cut != drawn_before)
            mesh.expectWhole(cut, watertight);
        drawn_before = cut;
    }
    EXPECT_EQ(cut, pack::selectCut(view, 0, threshold * scale)) << "as if all were resident";
    EXPECT_EQ(scale > 1, share < 1);
}

float thresholdOfLevel(const PackView& view, uint32_t level)
{
    return view.levels()[level].max_error;
}

TEST(ResidentCut, isWholeInEveryFrameAndEndsAsIfAllWereResident)
{
    const CookedMesh rock(plain(shapes::rock(72, 0.3f)));
    streamFrames(rock, 0.5f * thresholdOfLevel(rock.view(), 1), 1.0, true);
    streamFrames(rock, 0.5f * thresholdOfLevel(rock.view(), 1), 0.3, true);
    const CookedMesh authored = rockWithAuthoredLevels();
    streamFrames(authored, 0.5f * thresholdOfLevel(authored.view(), 1), 1.0, false);
    streamFrames(authored, 0.5f * thresholdOfLevel(authored.view(), 1), 0.5, false);
}

} // namespace
} // namespace hearth::test
