// Tests the checker of hierarchies: it finds every guarantee that a test breaks on purpose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/validate.h"
#include "formats/codecs/cluster_bounds.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"
#include "tests/support/soundness.h"

#include <gtest/gtest.h>

#include <functional>

namespace
{

using namespace hearth;
using clusters::Hierarchy;

class Validate : public testing::Test
{
protected:
    /// Return the issue that the checker reports after `change`.
    Issue after(const std::function<void(Hierarchy&)>& change)
    {
        Hierarchy hierarchy = hierarchy_;
        change(hierarchy);
        const Status status = clusters::validateHierarchy(mesh_, hierarchy);
        EXPECT_FALSE(status.ok());
        return status.ok() ? Issue::usage : status.error().issue;
    }

    uint32_t firstOfLevel(const Hierarchy& h, uint32_t level) const { return h.levels[level].clusters.first; }

    const mesh::SourceMesh mesh_ = shapes::rock(24, 0.3f);
    const Hierarchy hierarchy_ = clusters::buildHierarchy(mesh_);
};

TEST_F(Validate, acceptsWhatTheBuilderMakes)
{
    EXPECT_EQ(cuts::unsoundness(mesh_, hierarchy_), "");
    EXPECT_GE(hierarchy_.levels.size(), 4u);
}

TEST_F(Validate, findsErrorsThatFall)
{
    EXPECT_EQ(after([&](Hierarchy& h) { h.groups[h.clusters[firstOfLevel(h, 2)].group].error = 0; }),
              Issue::meaning_monotone);
}

TEST_F(Validate, findsPartsOfErrorsThatFall)
{
    const auto finer = [this](Hierarchy& h) -> formats::GroupRecord&
    { return h.groups[h.clusters[firstOfLevel(h, 1)].refined_group]; };
    ASSERT_TRUE(
        std::isfinite(hierarchy_.groups[hierarchy_.clusters[firstOfLevel(hierarchy_, 1)].group].error));
    EXPECT_EQ(after([&](Hierarchy& h) { finer(h).normal_error = 3; }), Issue::meaning_monotone);
    EXPECT_EQ(after([&](Hierarchy& h) { finer(h).uv_error = 1e9f; }), Issue::meaning_monotone);
    EXPECT_EQ(after([&](Hierarchy& h) { finer(h).position_error = 1e9f; }), Issue::meaning_monotone);
}

TEST_F(Validate, findsSpheresThatAreLeft)
{
    EXPECT_EQ(
        after([&](Hierarchy& h) { h.groups[h.clusters[firstOfLevel(h, 1)].group].sphere_radius *= 0.9f; }),
        Issue::meaning_monotone);
}

TEST_F(Validate, findsBoxesAndConesThatAreLeft)
{
    EXPECT_EQ(after([&](Hierarchy& h) { --h.clusters[5].extent[0]; }), Issue::meaning_bounds);
    EXPECT_EQ(after(
                  [&](Hierarchy& h)
                  {
                      for (auto& cluster : h.clusters)
                          cluster.cone_axis = static_cast<uint16_t>(
                              formats::NormalCode<8>::encode(-formats::coneAxis(cluster)));
                  }),
              Issue::meaning_bounds);
    EXPECT_EQ(after(
                  [&](Hierarchy& h)
                  {
                      for (auto& cluster : h.clusters)
                          cluster.cone_back = 0;
                  }),
              Issue::meaning_bounds);
}

TEST_F(Validate, findsPagesThatDoNotFit)
{
    EXPECT_EQ(after([&](Hierarchy& h) { h.page_bytes[10] ^= std::byte{1}; }), Issue::page_hash);
    EXPECT_EQ(after([&](Hierarchy& h) { h.pages.back().parents.count = 0; }), Issue::meaning_reference);
    EXPECT_EQ(after([&](Hierarchy& h) { h.clusters.back().page = 0; }), Issue::meaning_reference);
}

TEST_F(Validate, findsTrianglesThatAreMissing)
{
    EXPECT_EQ(after(
                  [&](Hierarchy& h)
                  {
                      --h.clusters.back().triangle_count;
                      --h.levels[0].triangle_count;
                  }),
              Issue::chunk_codec)
        << "the page tells";
    EXPECT_EQ(after([&](Hierarchy& h) { h.clusters.back().material = 7; }), Issue::meaning_geometry);
}

TEST_F(Validate, findsRootsThatAreReplaced)
{
    const auto replace = [](formats::GroupRecord& group)
    {
        group.error = group.position_error = group.uv_error = 1e9f;
        group.normal_error = 3;
    };
    EXPECT_EQ(after([&](Hierarchy& h) { replace(h.groups.front()); }), Issue::meaning_tree);
}

TEST_F(Validate, seesTheCracksOfACutThatIsNotClosed)
{
    const auto decoded = clusters::decodeHierarchy(hierarchy_);
    ASSERT_TRUE(decoded.ok());
    const Boundary source = cuts::findSourceBoundary(hierarchy_, *decoded);
    ASSERT_TRUE(source.loops.empty());
    auto triangles = cuts::trianglesOfCut(hierarchy_, *decoded, cuts::cutAtError(hierarchy_, 0.01));
    EXPECT_EQ(findCrack(source, findBoundary(triangles)), "");
    triangles.resize(triangles.size() - 3);
    EXPECT_NE(findCrack(source, findBoundary(triangles)), "");
}

} // namespace
