// Tests the detection of interior samples (samples that other geometry covers closely), and their low weight.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/vertex_fit.h"
#include "cook/visibility/rays/interior_samples.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/cook/visibility/ray_scenes.h"

#include <gtest/gtest.h>

namespace hearth::visibility
{

namespace
{

/// True if a point of a floor is interior below a sheet of 2 x 2 m at a height.
bool isBuried(float height, Float3 position, float reach)
{
    Mesh sheet;
    sheet.addQuad({-1, -1, height}, {1, -1, height}, {1, 1, height}, {-1, 1, height});
    const Occluders occluders = makeOccluders({sheet.occluder()});
    const SamplePoint point{position, kUp, 1e-6f};
    const auto moments = visibilityMoments(occluders, {&point, 1}, {});
    return findInteriorPoints(occluders, {&point, 1}, *moments, {&reach, 1}, 0)[0] != 0;
}

} // namespace

TEST(BuriedPoints, areThoseThatSomethingCoversClosely)
{
    EXPECT_TRUE(isBuried(0.005f, {0.2f, -0.3f, 0}, 0.1f));
    EXPECT_FALSE(isBuried(0.005f, {1.1f, 0, 0}, 0.1f)) << "beside it";
    EXPECT_FALSE(isBuried(0.005f, {0.2f, -0.3f, 0}, 0.004f)) << "as seen by a fine mesh";
    EXPECT_FALSE(isBuried(0.3f, {0, 0, 0}, 0.1f)) << "a ceiling";
}

TEST(BuriedPoints, areNotThoseInTheDark)
{
    // inside a closed box of two metres, where no sky is visible
    Mesh box;
    box.addQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    box.addQuad({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2});
    box.addQuad({-1, -1, 0}, {-1, -1, 2}, {1, -1, 2}, {1, -1, 0});
    box.addQuad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2});
    box.addQuad({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2});
    box.addQuad({1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {1, 1, 0});
    const Occluders occluders = makeOccluders({box.occluder()});
    const SamplePoint points[] = {{{0, 0, 0}, kUp, 1e-6f}, {{0.9f, 0.9f, 0}, kUp, 1e-6f}};
    const auto moments = visibilityMoments(occluders, points, {});
    EXPECT_EQ((*moments)[0].m0, 0);
    const float reach[] = {0.06f, 0.06f};
    for (const uint8_t is_interior : findInteriorPoints(occluders, points, *moments, reach, 0))
        EXPECT_EQ(is_interior, 0);
}

TEST(FitVertices, doesNotChangeWhereAllSamplesCountAsLittle)
{
    const mesh::SourceMesh rock = shapes::rock(8, 0.4f);
    const FitMesh fit_mesh = makeFitMesh(test::makeMeshView(rock));
    std::vector<SurfaceSample> samples = test::makeSamples(fit_mesh.view(), 2);
    std::vector<Moments> values;
    for (const SurfaceSample& sample : samples)
        values.push_back({3 + test::getPoint(fit_mesh.view(), sample).x, {0, 0.1f, 0.2f}});
    const FitResult whole = fitVertices(fit_mesh, samples, values);
    for (SurfaceSample& sample : samples)
        sample.weight = 1e-3f;
    const FitResult little = fitVertices(fit_mesh, samples, values);
    for (size_t v = 0; v < whole.moments.size(); ++v)
        EXPECT_NEAR(whole.moments[v].m0, little.moments[v].m0, 1e-5);
}

TEST(FitVertices, isRightBesideWhatIsBuriedInFewIterations)
{
    // one half of a plane has hardly any weight and is dark: neither the other half nor the solver is
    // affected
    mesh::SourceMesh grid = shapes::grid(40);
    grid.normals.assign(grid.vertexCount(), {});
    const FitMesh fit_mesh = makeFitMesh(test::makeMeshView(grid));
    Box3 box;
    for (const Float3 p : fit_mesh.positions)
        box.add(p);
    const float middle = box.center().x;
    std::vector<SurfaceSample> samples = test::makeSamples(fit_mesh.view(), 3);
    std::vector<Moments> values;
    for (SurfaceSample& sample : samples)
    {
        const bool is_interior = test::getPoint(fit_mesh.view(), sample).x > middle + 0.01f;
        sample.weight = is_interior ? 1e-3f : 1;
        values.push_back({is_interior ? 0.0f : 6.0f, {}});
    }
    const FitResult fit = fitVertices(fit_mesh, samples, values);
    EXPECT_LE(fit.statistics.solve.iterations, 25u);
    const float step = (box.max.x - box.min.x) / 40;
    for (size_t v = 0; v < fit_mesh.positions.size(); ++v)
    {
        const float x = fit_mesh.positions[v].x;
        if (x < middle || x > middle + 3 * step)
        {
            EXPECT_NEAR(fit.moments[v].m0, x < middle ? 6 : 0, 0.05);
        }
    }
}

} // namespace hearth::visibility
