// Tests cuts by the runtime's own decisions, for random camera, error, distance curve, transform and
// residency at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/lod_curve.h"
#include "runtime/pack/cut.h"
#include "tests/runtime/gpu/cooked_mesh.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr uint32_t kCasesPerMesh = kSanitized ? 24 : 250;

std::vector<shared::Group> groupsWith(const PackView& view, const std::vector<uint8_t>& resident_groups)
{
    std::vector<shared::Group> groups;
    for (size_t i = 0; i < view.groups().size(); ++i)
    {
        groups.push_back(std::bit_cast<shared::Group>(view.groups()[i]));
        groups.back().absent = resident_groups[i] != 0 ? 0 : 1;
    }
    return groups;
}

shared::Instance instanceAt(const Affine3& place)
{
    TestScene scene;
    scene.addInstance(0, place);
    return std::bit_cast<shared::Instance>(scene.model().instances.front());
}

/// Clusters that the culling pass finds in the cut.
std::vector<uint32_t> cutSeenBy(const PackView& view, const shared::FrameView& frame,
                                const shared::Instance& instance, const std::vector<shared::Group>& groups)
{
    std::vector<uint32_t> cut;
    for (uint32_t c = 0; c < view.clusters().size(); ++c)
    {
        const ClusterRecord& cluster = view.clusters()[c];
        const bool has_refined = cluster.refined_group != kInvalidIndex;
        const shared::Group& refined = groups[has_refined ? cluster.refined_group : cluster.group];
        if (shared::clusterInCut(frame, instance, groups[cluster.group], has_refined, refined))
            cut.push_back(c);
    }
    return cut;
}

void expectWholeWhateverIsSeen(const CookedMesh& mesh, bool watertight, uint32_t seed)
{
    const PackView& view = mesh.view();
    const pack::PageGraph graph = pack::PageGraph::of(view);
    const float size = length(view.meshes()[0].box_max - view.meshes()[0].box_min);
    const std::vector<shared::Group> all = groupsWith(view, std::vector<uint8_t>(view.groups().size(), 1));
    std::mt19937 random(seed);
    uint32_t mixed = 0, lacking = 0;
    for (uint32_t i = 0; i < kCasesPerMesh && !testing::Test::HasFailure(); ++i)
    {
        SCOPED_TRACE("case " + std::to_string(i));
        const auto resident = randomClosedSet(graph, 0.4 + 0.7 * i / kCasesPerMesh, random);
        const shared::Instance instance = instanceAt(randomAffine(random, size));
        shared::FrameView frame =
            shared::makeFrameView(randomCamera(random, size), 1920, 1080,
                                  i % 16 == 0 ? 0.0f : std::exp2(uniform(random, -1.0f, 7.0f)), 1, 0);
        ASSERT_TRUE(shared::setLodCurve(frame, randomLodCurve(random)).ok());
        const auto cut =
            cutSeenBy(view, frame, instance, groupsWith(view, pack::residentGroups(view, resident)));
        mesh.expectWhole(cut, watertight);
        for (const uint32_t cluster : cut)
            ASSERT_NE(resident[view.clusters()[cluster].page], 0) << "what is drawn is resident";
        mixed += mixesLevels(view, cut);
        lacking += cut != cutSeenBy(view, frame, instance, all);
    }
    EXPECT_GT(mixed, kCasesPerMesh / 4) << "or seams between levels are not tested";
    EXPECT_GT(lacking, kCasesPerMesh / 4) << "or residency is not tested";
}

} // namespace

TEST(CutFuzz, closedMeshesStayClosed)
{
    expectWholeWhateverIsSeen(CookedMesh(plain(shapes::rock(72, 0.3f))), true, 1);
}

TEST(CutFuzz, openMeshesOpenNowhereElse)
{
    expectWholeWhateverIsSeen(CookedMesh(plain(shapes::terrain(160))), true, 2);
}

TEST(CutFuzz, hardEdgesAndChartsStayTogether)
{
    expectWholeWhateverIsSeen(CookedMesh(plain(shapes::blocks(64))), true, 3);
}

TEST(CutFuzz, authoredLevelsAreDrawnOnce)
{
    // an authored LOD is another surface: its border is its own
    expectWholeWhateverIsSeen(rockWithAuthoredLevels(), false, 4);
}

} // namespace hearth::test
