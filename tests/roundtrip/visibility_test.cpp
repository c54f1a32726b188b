// Tests the GPU's visible clusters and pixels against the CPU references.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cpu_culling.h"
#include "tests/reference/culling/cpu_rasteriser.h"
#include "tests/reference/source_triangles.h"
#include "tests/roundtrip/draw_fixture.h"

#include <cstdio>
#include <map>

namespace hearth::roundtrip
{
namespace
{

using reference::DrawnCluster;

/// Covered pixels for each one that may differ from the reference, and only where it is excused: 0.002 %. The
/// reference rounds vertices to sub-pixels and interpolates depths by other operations than the device, which
/// shows at samples beside an edge.
constexpr uint64_t kPixelsPerDifference = 50000;

struct Sums
{
    reference::CullingComparison culling;
    reference::RasterComparison raster;
    uint64_t triangles = 0;
    uint64_t frames = 0;

    void add(const reference::RasterComparison& one)
    {
        raster.pixels += one.pixels;
        raster.covered += one.covered;
        raster.excused += one.excused;
        raster.different += one.different;
        raster.different_unexcused += one.different_unexcused;
        raster.masked += one.masked;
        ++frames;
    }
    void print(const char* what) const
    {
        const auto count = [](uint64_t value) { return static_cast<unsigned long long>(value); };
        std::printf(
            "%s: %llu frames, %llu triangles, %llu pixels (%llu covered), %llu different, %llu of them not "
            "excused; %llu excused in all\n",
            what, count(frames), count(triangles), count(raster.pixels), count(raster.covered),
            count(raster.different), count(raster.different_unexcused), count(raster.excused));
    }
};

/// Keep rigid instances only. tests/runtime/gpu/deformation_twin_test.cpp compares the deformed ones with the
/// device.
std::vector<DrawnCluster> rigidOnes(const formats::PackView& pack, std::vector<DrawnCluster> clusters)
{
    std::erase_if(clusters,
                  [&](const DrawnCluster& drawn) { return reference::isDeformed(pack, drawn.instance); });
    return clusters;
}

using VisibilityTest = DrawTest;

TEST_F(VisibilityTest, drawsExactlyTheClustersThatExhaustiveCullingKeeps)
{
    reference::CullingComparison sum;
    uint64_t unjust = 0;
    for (const SampleSpec& spec : drawnSamples())
    {
        const CookedSample& sample = cookedSample(spec);
        const GpuScene scene = device().upload(sample.pack());
        for (NamedView named : makeViews(sample.pack()))
            for (const uint32_t flags :
                 {uint32_t{shared::kCullEverything}, 0u, uint32_t{shared::kCullInstances},
                  uint32_t{shared::kCullFrustum}, uint32_t{shared::kCullCone}})
            {
                SCOPED_TRACE(spec.kind + ", " + named.name + ", flags " + std::to_string(flags));
                named.view.flags = flags;
                const shared::FrameView frame = named.frame(sample.pack());
                const std::vector<DrawnCluster> drawn = scene.draw(frame).sortedSlots();
                EXPECT_EQ(rigidOnes(sample.pack(), drawn),
                          rigidOnes(sample.pack(), reference::cullExhaustively(sample.pack(), frame)));
                const auto one = reference::compareWithOracle(sample.pack(), named.view, drawn);
                EXPECT_EQ(one.wrongly_drawn, 0u);
                EXPECT_EQ(one.wrongly_culled, 0u);
                unjust += reference::countUnjustlyCulled(sample.geometry(), named.view, drawn);
                sum.pairs += one.pairs;
                sum.drawn += one.drawn;
                sum.outside_frustum += one.outside_frustum;
                sum.facing_away += one.facing_away;
            }
    }
    EXPECT_EQ(unjust, 0u) << "clusters with a triangle that could be seen were culled";
    EXPECT_GT(sum.outside_frustum, 1000u) << "the views must give culling something to do";
    EXPECT_GT(sum.facing_away, 500u);
    std::printf("culling: %llu pairs, %llu drawn, %llu outside, %llu facing away\n",
                static_cast<unsigned long long>(sum.pairs), static_cast<unsigned long long>(sum.drawn),
                static_cast<unsigned long long>(sum.outside_frustum),
                static_cast<unsigned long long>(sum.facing_away));
}

TEST_F(VisibilityTest, equalsTheReferenceRasteriserPixelForPixel)
{
    Sums sums;
    for (const SampleSpec& spec : drawnSamples())
    {
        const CookedSample& sample = cookedSample(spec);
        const GpuScene scene = device().upload(sample.pack());
        for (const NamedView& named : makeViews(sample.pack()))
        {
            SCOPED_TRACE(spec.kind + ", " + named.name);
            const shared::FrameView frame = named.frame(sample.pack());
            const DrawnFrame drawn = scene.draw(frame);
            const auto triangles = reference::trianglesOfSlots(sample.geometry(), drawn.slots);
            ASSERT_LE(triangles.size(), 200000u);
            const auto expected =
                reference::rasterise(triangles, reference::readTables(sample.pack()), frame);
            const auto one =
                reference::compareIds(expected, drawn.ids, [](uint32_t a, uint32_t b) { return a == b; });
            EXPECT_EQ(one.different_unexcused, 0u);
            EXPECT_EQ(one.coverage_unexcused, 0u);
            EXPECT_EQ(one.impossible, 0u);
            sums.triangles += triangles.size();
            sums.add(one);
        }
    }
    sums.print("visibility buffer");
    EXPECT_GT(sums.raster.covered, 500000u);
    EXPECT_LE(sums.raster.different * kPixelsPerDifference, sums.raster.covered);
}

TEST_F(VisibilityTest, showsTheSourceTrianglesAtErrorZero)
{
    Sums sums;
    for (const SampleSpec& spec : drawnSamples())
    {
        const CookedSample& sample = cookedSample(spec);
        const auto source = reference::trianglesOfImportPart(sample.importPart());
        ASSERT_TRUE(source.ok()) << formatMessage(source.error());
        const GpuScene scene = device().upload(sample.pack());
        for (NamedView named : makeViews(sample.pack()))
        {
            SCOPED_TRACE(spec.kind + ", " + named.name);
            named.view.error_pixels = 0;
            const shared::FrameView frame = named.frame(sample.pack());
            const DrawnFrame drawn = scene.draw(frame);
            const auto triangles = reference::trianglesOfSlots(sample.geometry(), drawn.slots);
            std::map<uint32_t, const reference::SceneTriangle*> triangle_of_id;
            for (const reference::SceneTriangle& triangle : triangles)
                triangle_of_id[triangle.id] = &triangle;
            const auto expected =
                reference::rasterise(*source, reference::readTables(sample.importPart()), frame);
            const auto one = reference::compareIds(
                expected, drawn.ids,
                [&](uint32_t of_source, uint32_t of_gpu)
                { return reference::sameTriangle(source->at(of_source), *triangle_of_id.at(of_gpu)); });
            EXPECT_EQ(one.different_unexcused, 0u);
            EXPECT_EQ(one.coverage_unexcused, 0u);
            EXPECT_EQ(one.impossible, 0u);
            sums.triangles += source->size();
            sums.add(one);
        }
    }
    sums.print("source triangles");
    EXPECT_GT(sums.raster.covered, 500000u);
    EXPECT_LE(sums.raster.different * kPixelsPerDifference, sums.raster.covered);
}

TEST_F(VisibilityTest, isTheSameImageWithAndWithoutCulling)
{
    uint64_t with = 0, without = 0;
    for (const SampleSpec& spec : drawnSamples())
    {
        const CookedSample& sample = cookedSample(spec);
        const GpuScene scene = device().upload(sample.pack());
        for (NamedView named : makeViews(sample.pack()))
        {
            const DrawnFrame culled = scene.draw(named.frame(sample.pack()));
            named.view.flags = 0;
            const DrawnFrame everything = scene.draw(named.frame(sample.pack()));
            EXPECT_EQ(culled.image.rgb, everything.image.rgb) << spec.kind << ", " << named.name;
            with += culled.slots.size();
            without += everything.slots.size();
        }
    }
    EXPECT_LT(with, without * 9 / 10) << "culling that culls nothing is not tested";
    std::printf("culling: %llu of %llu clusters of the cuts drawn\n", static_cast<unsigned long long>(with),
                static_cast<unsigned long long>(without));
}

TEST_F(VisibilityTest, isTheSameEveryTime)
{
    const CookedSample& sample = cookedSample({"room"});
    const GpuScene scene = device().upload(sample.pack());
    const NamedView named = makeViews(sample.pack())[3];
    const DrawnFrame first = scene.draw(named.frame(sample.pack()));
    for (int i = 0; i < 5; ++i)
    {
        const DrawnFrame again = scene.draw(named.frame(sample.pack()));
        EXPECT_EQ(again.slots, first.slots) << "also in order";
        EXPECT_EQ(again.ids, first.ids);
        EXPECT_EQ(again.image.rgb, first.image.rgb);
    }
}

} // namespace
} // namespace hearth::roundtrip
