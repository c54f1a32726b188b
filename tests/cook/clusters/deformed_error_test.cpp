// Tests that the stored error of a deformed mesh bounds its distance in every pose, and that its cuts have no
// cracks in any pose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/cuts.h"
#include "tests/support/deformed_model.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace hearth::test
{

namespace
{

using clusters::Hierarchy;
using namespace formats;

constexpr size_t kSamples = kSanitized ? 500 : 4000; // per direction and pose
constexpr size_t kPoses = kSanitized ? 1 : 5;

/// Measurements of one mesh, for the log.
struct Figures
{
    size_t clusters = 0;
    double least_ratio = 1; ///< minimum over the levels of measured deviation / bound
};

double getPositionError(const Hierarchy& hierarchy, uint32_t cluster)
{
    const uint32_t refined = hierarchy.clusters[cluster].refined_group;
    return refined == kInvalidIndex ? 0 : double{hierarchy.groups[refined].position_error};
}

/// Sample points of the triangles: corners, edge midpoints and centres.
std::vector<Float3> getPoints(std::span<const Float3> places, std::span<const uint32_t> triangles)
{
    std::vector<Float3> points;
    for (size_t t = 0; t < triangles.size(); t += 3)
    {
        const Float3 a = places[triangles[t]], b = places[triangles[t + 1]], c = places[triangles[t + 2]];
        for (const Float3 p : {a, b, c, (a + b) * 0.5f, (b + c) * 0.5f, (c + a) * 0.5f, (a + b + c) / 3})
            points.push_back(p);
    }
    return points;
}

/// Check every coarse cluster, and every level in both directions, in one pose.
void expectBounded(const mesh::SourceMesh& source, const Hierarchy& hierarchy,
                   const DeformedClusters& decoded, const MeshPose& pose, Figures& figures)
{
    const std::vector<Float3> source_places = posed(source, pose);
    const std::vector<Float3> places = decoded.posed(pose);
    const SurfaceDistance to_source(source_places, source.indices);
    Box3 box;
    for (const Float3 p : source_places)
        box.add(p);
    // quantized weights are off by 2^-17: the resulting error grows with the distance between joints
    const double rounding = 1e-5 * double{length(box.max - box.min)};
    const double grid = double{hierarchy.mesh.grid_error} * pose.scale;
    for (uint32_t c = 0; c < hierarchy.clusters.size(); ++c)
    {
        const double bound = getPositionError(hierarchy, c) * pose.scale + grid + rounding;
        double worst = 0;
        for (const Float3 point : getPoints(places, decoded.getTriangles(c)))
            worst = std::max(worst, to_source.to(point));
        EXPECT_LE(worst, bound) << "cluster " << c << " of level " << int{hierarchy.clusters[c].level};
    }
    for (size_t l = 1; l < hierarchy.levels.size(); ++l)
    {
        const auto cut = clusters::findCutClusters(
            hierarchy, cuts::cutAtError(hierarchy, double{hierarchy.levels[l].max_error}));
        double bound = 0;
        for (const uint32_t c : cut)
            bound = std::max(bound, getPositionError(hierarchy, c) * pose.scale);
        const std::vector<uint32_t> triangles = decoded.getTriangles(cut);
        const SurfaceDistance to_cut(places, triangles);
        const double far = std::max(largestDistance(source_places, source.indices, kSamples, to_cut),
                                    largestDistance(places, triangles, kSamples, to_source));
        EXPECT_LE(far, bound + grid + rounding) << "level " << l;
        if (bound > 0)
            figures.least_ratio = std::min(figures.least_ratio, far / bound);
    }
}

/// Check random cuts for cracks. Vertices with equal position and deformation data are one; cuts are closed
/// wherever the source is.
void expectNoCracks(const Hierarchy& hierarchy, const DeformedClusters& decoded)
{
    std::vector<uint32_t> finest;
    for (uint32_t c = 0; c < hierarchy.clusters.size(); ++c)
        if (hierarchy.clusters[c].level == 0)
            finest.push_back(c);
    const Boundary source = findBoundary(decoded.getTriangles(finest));
    std::mt19937 random(5);
    for (int i = 0; i < 20; ++i)
    {
        const auto cut = clusters::findCutClusters(hierarchy, cuts::randomCut(hierarchy, 0.7, random));
        EXPECT_EQ(findCrack(source, findBoundary(decoded.getTriangles(cut))), "") << "cut " << i;
    }
}

/// Build an authored LOD of a character: move all vertices of a cell to the first one's position; that vertex
/// keeps its joints and weights.
mesh::SourceMesh madeByHand(const mesh::SourceMesh& source, float cell)
{
    std::map<std::array<int, 3>, uint32_t> vertex_of_cell;
    mesh::SourceMesh level = source;
    level.indices.clear();
    level.triangle_materials.clear();
    std::vector<uint32_t> moved;
    for (uint32_t v = 0; v < source.vertexCount(); ++v)
    {
        const Float3 p = source.positions[v] * (1 / cell);
        const std::array<int, 3> key{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                                     static_cast<int>(std::floor(p.z))};
        moved.push_back(vertex_of_cell.emplace(key, v).first->second);
    }
    for (size_t t = 0; t < source.triangleCount(); ++t)
    {
        const uint32_t a = moved[source.indices[t * 3]], b = moved[source.indices[t * 3 + 1]],
                       c = moved[source.indices[t * 3 + 2]];
        if (a == b || b == c || c == a)
            continue;
        level.indices.insert(level.indices.end(), {a, b, c});
        level.triangle_materials.push_back(source.triangle_materials[t]);
    }
    return level;
}

void expectSound(const std::string& source)
{
    const auto model = DeformedModel::import(source);
    ASSERT_NE(model, nullptr) << source;
    ASSERT_FALSE(model->meshes().empty());
    for (const DeformedModel::Mesh& mesh : model->meshes())
    {
        SCOPED_TRACE("mesh " + std::to_string(mesh.index));
        const auto owned = model->motion().meshMotion(mesh.index, mesh.source);
        ASSERT_TRUE(owned.ok());
        const Hierarchy hierarchy = clusters::buildHierarchy(mesh.source, {}, &owned->motion);
        const Status valid = clusters::validateHierarchy(mesh.source, hierarchy);
        EXPECT_TRUE(valid.ok()) << formatMessage(valid.error());
        const DeformedClusters decoded(hierarchy);
        expectNoCracks(hierarchy, decoded);
        Figures figures;
        MeshPoses poses(animationTables(model->scene()), mesh.node, mesh.index);
        expectBounded(mesh.source, hierarchy, decoded, poses.rest(), figures);
        for (size_t i = 0; i < kPoses; ++i)
            expectBounded(mesh.source, hierarchy, decoded, poses.next(), figures);
        const double size = double{length(hierarchy.mesh.box_max - hierarchy.mesh.box_min)};
        std::printf("mesh %u: %zu triangles, %zu levels, coarsest %u triangles at %.4f of its size; measured "
                    "at least %.2f of a level's bound\n",
                    mesh.index, mesh.source.triangleCount(), hierarchy.levels.size(),
                    hierarchy.levels.back().triangle_count, double{hierarchy.levels.back().max_error} / size,
                    figures.least_ratio);
    }
}

void makeCharacter(const std::string& file, size_t triangles)
{
    const std::string command = std::string(HEARTH_BIN) + "/hearth-samples character --triangles " +
                                std::to_string(triangles) + " -o '" + file + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
}

/// Return the path of a file of the asset corpus; empty if it is not installed.
std::string asset(const char* file)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    return assets == nullptr ? "" : std::string(assets) + "/good/" + file;
}

class DeformedErrorOf : public ::testing::TestWithParam<const char*>
{
};

} // namespace

TEST(DeformedError, ofTheCharacterHoldsInEveryPose)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("character.glb");
    makeCharacter(file, kSanitized ? 4000 : 20000);
    expectSound(file);
}

TEST(DeformedError, ofLevelsMadeByHandHoldsInEveryPose)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("character.glb");
    makeCharacter(file, kSanitized ? 4000 : 8000);
    const auto model = DeformedModel::import(file);
    ASSERT_NE(model, nullptr);
    const DeformedModel::Mesh& mesh = model->meshes().at(0);
    const auto owned = model->motion().meshMotion(mesh.index, mesh.source);
    ASSERT_TRUE(owned.ok());
    const mesh::SourceMesh levels[] = {madeByHand(mesh.source, 0.04f), madeByHand(mesh.source, 0.12f)};
    ASSERT_LT(levels[1].triangleCount() * 2, levels[0].triangleCount());
    const Hierarchy hierarchy = clusters::buildHierarchy(mesh.source, levels, {}, &owned->motion);
    const Status valid = clusters::validateHierarchy(mesh.source, hierarchy, levels);
    EXPECT_TRUE(valid.ok()) << formatMessage(valid.error());
    for (size_t i = 0; i < 2; ++i)
    {
        const uint32_t level = hierarchy.authored_levels[i];
        ASSERT_NE(level, kInvalidIndex) << "level " << i << " by hand is not used";
        EXPECT_EQ(hierarchy.levels[level].triangle_count, levels[i].triangleCount());
        EXPECT_GT(hierarchy.levels[level].max_error, 0);
    }
    const DeformedClusters decoded(hierarchy);
    Figures figures;
    MeshPoses poses(animationTables(model->scene()), mesh.node, 11);
    expectBounded(mesh.source, hierarchy, decoded, poses.rest(), figures);
    for (size_t i = 0; i < kPoses; ++i)
        expectBounded(mesh.source, hierarchy, decoded, poses.next(), figures);
    std::printf("levels by hand of %zu and %zu triangles: measured at least %.2f of a level's bound\n",
                levels[0].triangleCount(), levels[1].triangleCount(), figures.least_ratio);
}

TEST(DeformedPages, holdAsManyTargetsAsAFaceHas)
{
    // each target moves all vertices, so no cluster can omit a target
    constexpr size_t kTargets = kSanitized ? 40 : 150;
    mesh::SourceMesh mesh = shapes::terrain(24);
    std::mt19937 random(1);
    std::normal_distribution<float> normal(0, 0.01f);
    mesh.morph_targets.resize(kTargets);
    for (mesh::MorphTarget& target : mesh.morph_targets)
        for (size_t v = 0; v < mesh.vertexCount(); ++v)
            target.positions.push_back({normal(random), normal(random), normal(random)});
    const Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    const Status valid = clusters::validateHierarchy(mesh, hierarchy);
    EXPECT_TRUE(valid.ok()) << formatMessage(valid.error());
    for (const PageRecord& page : hierarchy.pages)
        EXPECT_LE(page.size, kMaxPageBytes);
    expectNoCracks(hierarchy, DeformedClusters(hierarchy));
}

TEST_P(DeformedErrorOf, holdsInEveryPose)
{
    const std::string file = asset(GetParam());
    if (file.empty())
        GTEST_SKIP() << "HEARTH_ASSETS does not name a folder of assets";
    if (kSanitized && std::filesystem::file_size(file) > 2 * kLargeFile)
        GTEST_SKIP() << "too large for a sanitizer";
    expectSound(file);
}

INSTANTIATE_TEST_SUITE_P(Assets, DeformedErrorOf,
                         ::testing::Values("skinned/fox/Fox.glb", "skinned/kaykit_mage/Mage.glb",
                                           "skinned/tube_300joints/tube_300joints.glb",
                                           "morph/morph_24_dense/morph_24_dense.glb",
                                           "morph/animated_morph_sphere/AnimatedMorphSphere.glb"));

} // namespace hearth::test
