// Tests that cuts through cooked hierarchies are whole surfaces: no crack, no overlap, at any threshold and
// from any camera.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"
#include "tests/reference/culling/cpu_culling.h"
#include "tests/reference/culling/cut_checker.h"
#include "tests/reference/source_triangles.h"
#include "tests/roundtrip/draw_fixture.h"
#include "tests/support/surfaces/boundary.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <tuple>

namespace hearth::roundtrip
{
namespace
{

std::vector<uint32_t> finestClusters(const formats::PackView& pack, uint32_t mesh)
{
    std::vector<uint32_t> clusters;
    const formats::Range range = pack.meshes()[mesh].clusters;
    for (uint32_t c = range.first; c < range.first + range.count; ++c)
        if (pack.clusters()[c].level == 0)
            clusters.push_back(c);
    return clusters;
}

/// Errors at which the cut of a mesh changes, including both ends, thinned to about `count`.
std::vector<float> chooseThresholds(const formats::PackView& pack, uint32_t mesh, size_t count)
{
    std::vector<float> errors{0};
    for (const formats::GroupRecord& group :
         formats::recordsInRange(pack.groups(), pack.meshes()[mesh].groups))
        errors.push_back(group.error);
    std::sort(errors.begin(), errors.end());
    errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
    std::vector<float> thinned;
    for (size_t i = 0; i < count && !errors.empty(); ++i)
        thinned.push_back(errors[i * (errors.size() - 1) / std::max<size_t>(1, count - 1)]);
    return thinned;
}

/// Largest error of the clusters of a cut, object space.
double clusterError(const formats::PackView& pack, std::span<const uint32_t> cut)
{
    double error = 0;
    for (const uint32_t cluster : cut)
        error = std::max(error, double{formats::clusterError(pack.clusters()[cluster], pack.groups())});
    return error;
}

/// Finest level of a mesh, with its boundary.
class FinestLevel
{
public:
    FinestLevel(const CookedSample& sample, uint32_t mesh)
        : triangles_(trianglesOfClusters(sample.geometry(), finestClusters(sample.pack(), mesh))),
          boundary_(weldAndFind(triangles_))
    {
    }

    const reference::Triangles& triangles() const { return triangles_; }

    /// Return what is wrong with the boundary of a cut; empty if nothing is.
    std::string findCrack(const reference::Triangles& cut)
    {
        return hearth::findCrack(boundary_, weldAndFind(cut));
    }

private:
    /// Weld corners by their places: an id for each place, in all cuts.
    Boundary weldAndFind(const reference::Triangles& triangles)
    {
        std::vector<uint32_t> ids;
        for (const auto& triangle : triangles)
            for (const Float3 p : triangle)
                ids.push_back(
                    id_of_place_.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, nextId()).first->second);
        return findBoundary(ids);
    }
    uint32_t nextId() const { return static_cast<uint32_t>(id_of_place_.size()); }

    std::map<std::tuple<float, float, float>, uint32_t> id_of_place_;
    reference::Triangles triangles_;
    Boundary boundary_;
};

void checkCut(const CookedSample& sample, uint32_t mesh, const std::vector<uint32_t>& cut,
              FinestLevel& source, uint64_t& open_edges)
{
    const reference::CoverageReport coverage = reference::checkCoverage(sample.pack(), mesh, cut);
    EXPECT_EQ(coverage.missing, 0u);
    EXPECT_EQ(coverage.overlapping, 0u);
    const double error = clusterError(sample.pack(), cut);
    const reference::Triangles triangles = trianglesOfClusters(sample.geometry(), cut);
    EXPECT_EQ(source.findCrack(triangles), "");
    const reference::EdgeReport edges = reference::checkEdges(triangles, source.triangles(), error * 1.0001);
    EXPECT_EQ(edges.cracks, 0u) << "open edges " << edges.open_edges << ", up to " << edges.worst_distance
                                << " m from the source's, error " << error;
    open_edges += edges.open_edges;
}

TEST(Cut, hasNoCrackAtAnyThreshold)
{
    uint64_t cuts = 0, open_edges = 0;
    for (const SampleSpec& spec : drawnSamples())
    {
        const CookedSample& sample = cookedSample(spec);
        for (uint32_t mesh = 0; mesh < sample.pack().meshes().size(); ++mesh)
        {
            FinestLevel source(sample, mesh);
            for (const float threshold : chooseThresholds(sample.pack(), mesh, 9))
            {
                SCOPED_TRACE(spec.kind + ", mesh " + std::to_string(mesh) + ", error " +
                             std::to_string(threshold));
                checkCut(sample, mesh, pack::selectCut(sample.pack(), mesh, threshold), source, open_edges);
                ++cuts;
            }
        }
    }
    std::printf("%llu cuts, %llu open edges\n", static_cast<unsigned long long>(cuts),
                static_cast<unsigned long long>(open_edges));
    EXPECT_GT(cuts, 50u);
}

TEST(Cut, hasNoCrackFromAnyCamera)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    uint64_t mixed_levels = 0, open_edges = 0;
    for (const SampleSpec& spec : {SampleSpec{"rock", 40000}, {"terrain", 30000}, {"character", 20000}})
    {
        const CookedSample& sample = cookedSample(spec);
        FinestLevel source(sample, 0);
        const float size = length(sample.pack().meshes()[0].box_max - sample.pack().meshes()[0].box_min);
        for (int i = 0; i < 12; ++i)
        {
            SCOPED_TRACE(spec.kind + ", camera " + std::to_string(i));
            shared::Camera camera;
            camera.position = Float3{unit(random), unit(random), unit(random)} * (0.6f * size);
            camera.z_near = 0.001f * size;
            const shared::FrameView frame = shared::makeFrameView(camera, 1920, 1080, 6, 1, 0);
            std::vector<uint32_t> cut;
            uint32_t least = ~0u, greatest = 0;
            for (const reference::DrawnCluster& drawn : reference::cullExhaustively(sample.pack(), frame))
            {
                cut.push_back(drawn.cluster);
                least = std::min<uint32_t>(least, sample.pack().clusters()[drawn.cluster].level);
                greatest = std::max<uint32_t>(greatest, sample.pack().clusters()[drawn.cluster].level);
            }
            mixed_levels += greatest > least;
            checkCut(sample, 0, cut, source, open_edges);
        }
    }
    EXPECT_GT(mixed_levels, 12u) << "a third of the cuts must mix levels, or seams are not tested";
}

TEST(Cut, keepsTheVolumeOfAClosedMesh)
{
    const CookedSample& sample = cookedSample({"rock", 40000});
    const auto source = trianglesOfClusters(sample.geometry(), finestClusters(sample.pack(), 0));
    const double volume = reference::signedVolume6(source);
    double area2 = 0; // twice the area
    for (const auto& t : source)
        area2 += double{length(cross(t[1] - t[0], t[2] - t[0]))};
    for (const float threshold : chooseThresholds(sample.pack(), 0, 9))
    {
        const auto cut = pack::selectCut(sample.pack(), 0, threshold);
        const double of_cut = reference::signedVolume6(trianglesOfClusters(sample.geometry(), cut));
        // A surface that stays within the error changes the volume by at most area times error, on both
        // sides.
        EXPECT_NEAR(of_cut, volume, 3 * area2 * clusterError(sample.pack(), cut) + 1e-6 * volume)
            << threshold;
    }
}

/// Rotate the corners so that the smallest is first: equal results for equal triangles.
std::array<std::array<float, 3>, 3> canonical(const std::array<Float3, 3>& t)
{
    std::array<std::array<float, 3>, 3> corners;
    for (size_t i = 0; i < 3; ++i)
        corners[i] = {t[i].x, t[i].y, t[i].z};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

TEST(FinestLevel, holdsEverySourceTriangleOnce)
{
    for (const SampleSpec& spec : drawnSamples())
    {
        const CookedSample& sample = cookedSample(spec);
        const auto imported = reference::trianglesOfImportPart(sample.importPart());
        ASSERT_TRUE(imported.ok());
        using Key = std::tuple<uint32_t, uint32_t, std::array<std::array<float, 3>, 3>>;
        std::vector<Key> source, finest;
        for (const reference::SceneTriangle& t : *imported)
            source.emplace_back(t.instance, t.material, canonical(t.corners));
        for (const reference::SceneTriangle& t : reference::trianglesOfFinestLevel(sample.geometry()))
            finest.emplace_back(t.instance, t.material, canonical(t.corners));
        std::sort(source.begin(), source.end());
        std::sort(finest.begin(), finest.end());
        EXPECT_TRUE(source == finest) << spec.kind << ": " << source.size() << " and " << finest.size();
    }
}

} // namespace
} // namespace hearth::roundtrip
