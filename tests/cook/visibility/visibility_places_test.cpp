// Tests moments by rays for meshes that are far away, tiny, huge, instanced or masked, with any number of
// threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/sampling/hemisphere.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/double3.h"
#include "tests/cook/visibility/ray_scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>

#include <tbb/global_control.h>

namespace hearth::visibility
{
namespace
{

/// Check a convex mesh: each point sees everything, provided that its rays miss the surface they start from.
void expectOpen(const Mesh& mesh, const Affine3& world_from_mesh, const char* what)
{
    const Mesh baked = transformed(mesh, world_from_mesh);
    Occluders instanced;
    instanced.place(instanced.add(mesh.occluder()), world_from_mesh);
    instanced.finish();
    const auto shareOpen = [](const Occluders& occluders, const std::vector<SamplePoint>& points)
    {
        size_t open = 0;
        const auto moments = visibilityMoments(occluders, points, {});
        for (const Moments& m : *moments)
            open += m.m0 == static_cast<float>(2 * kPi) ? 1 : 0;
        return static_cast<double>(open) / static_cast<double>(points.size());
    };
    EXPECT_EQ(shareOpen(makeOccluders({baked.occluder()}), makePoints(baked, 8)), 1) << what;
    EXPECT_EQ(shareOpen(instanced, makePoints(mesh, 8, world_from_mesh)), 1) << what << ", as an instance";
}

TEST(VisibilityMoments, haveNoSpecksAtAnyScaleAndPlace)
{
    // two pyramids: float rounding far from the origin must not make them concave
    const Mesh gem =
        transformed(makeSphere(2, 7, 1, false), {{{0.8f, 0.6f, 0, 0}, {-0.6f, 0.8f, 0, 0}, {0, 0, 1, 0}}});
    expectOpen(gem, {}, "as it is");
    expectOpen(gem, scaledAndMoved(1, {1e4f, -7e3f, 333.3f}), "far away");
    expectOpen(gem, scaledAndMoved(1e-4f, {}), "tiny");
    expectOpen(gem, scaledAndMoved(1e-3f, {3, 5, 7}), "tiny, and off");
    expectOpen(gem, scaledAndMoved(1e5f, {1e5f, 0, 0}), "huge");
    expectOpen(gem, {{{-0.3f, 0.1f, 0.2f, 500.1f}, {0, 2.2f, 0.7f, -800.2f}, {0.1f, 0.4f, 7, 77.7f}}},
               "mirrored, skewed");
    // world and mesh are both small, but the transform between them is not
    expectOpen(transformed(gem, scaledAndMoved(1, {1e4f, 0, 2e4f})),
               Affine3{{{0.6f, 0.8f, 0, 0}, {-0.8f, 0.6f, 0, 0}, {0, 0, 1, 0}}} *
                   scaledAndMoved(1, {-1e4f, 0, -2e4f}),
               "there and back");
    // slivers of a fan exactly in the plane x + y + z = 0: integers whose products floats have to round
    Mesh fan;
    const auto inPlane = [](int i, int j) {
        return Float3{static_cast<float>(i), static_cast<float>(j - i), static_cast<float>(-j)};
    };
    for (int i = 0; i < 200; ++i)
    {
        const int a = 7 + 1013 * i, b = a + 1013, c = 1048573;
        const auto first = static_cast<uint32_t>(fan.positions.size());
        fan.positions.insert(fan.positions.end(), {inPlane(0, 3), inPlane(c, a), inPlane(c, b)});
        fan.corners.insert(fan.corners.end(), {first, first + 1, first + 2});
    }
    expectOpen(fan, {}, "slivers");
    expectOpen(fan, scaledAndMoved(0x1p-20f, {}), "small slivers");
}

TEST(VisibilityMoments, areNotDarkenedByFlatSurfacesOfManyTrianglesInSlantedPlanes)
{
    // rounding moves corners out of the plane by 1e-7 of its size: occlusion must not exceed that
    const Affine3 slanted{{{0.36f, 0.48f, -0.8f, 3}, {-0.8f, 0.6f, 0, 1}, {0.48f, 0.64f, 0.6f, -2}}};
    const Mesh plane = transformed(makeMesh(shapes::grid(40)), slanted);
    const std::vector<SamplePoint> points = makePoints(plane, 2);
    const auto moments = visibilityMoments(makeOccluders({plane.occluder()}), points, {});
    for (size_t i = 0; i < points.size(); ++i)
        EXPECT_GT(computeOcclusion((*moments)[i], points[i].normal), 1 - 1e-4);
}

/// Return the mean difference of two sets of moments, as a share of the hemisphere.
double meanDifference(const std::vector<Moments>& a, const std::vector<Moments>& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum +=
            std::abs(double{a[i].m0} - double{b[i].m0}) / (2 * kPi) + double{length(a[i].m1 - b[i].m1)} / kPi;
    return sum / static_cast<double>(a.size());
}

TEST(VisibilityMoments, ofInstancesAreThoseOfMeshesInTheirPlaces)
{
    const Mesh rock = makeMesh(shapes::rock(10, 0.6f));
    const Affine3 places[] = {{{{2, 0, 0, 3}, {0, 2, 0, 0}, {0, 0, 2, 0}}},
                              {{{-1, 0, 0, 1}, {0, 0, 1, 1}, {0, 1, 0, 0.5f}}},
                              {{{1, 0.5f, 0, 0}, {0.25f, -1, 0, -1.5f}, {0, 0.125f, 1.5f, 0}}}};
    Occluders instanced, baked;
    const Occluders::Mesh mesh = instanced.add(rock.occluder());
    for (const Affine3& place : places)
    {
        instanced.place(mesh, place);
        baked.place(baked.add(transformed(rock, place).occluder()));
    }
    instanced.place(mesh);
    baked.place(baked.add(rock.occluder()));
    instanced.finish();
    baked.finish();
    for (const Affine3& place : places)
    {
        const std::vector<SamplePoint> points = makePoints(rock, 1, place);
        const auto a = visibilityMoments(instanced, points, {}), b = visibilityMoments(baked, points, {});
        EXPECT_LT(meanDifference(*a, *b), 2e-4);
        // check that the instances do occlude each other
        const auto alone =
            visibilityMoments(makeOccluders({transformed(rock, place).occluder()}), points, {});
        EXPECT_GT(meanDifference(*a, *alone), 1e-2);
    }
}

TEST(VisibilityMoments, letRaysThroughMasks)
{
    Mesh ceiling; // facing down, a metre above
    ceiling.addQuad({-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1});
    const SamplePoint point{{0.2f, -0.1f, 0}, kUp, 1e-6f};
    const auto momentsWith = [&](const Mask& mask, const Mesh& mesh, const RaySettings& settings)
    {
        OccluderMesh occluder = mesh.occluder();
        occluder.mask = mask;
        Occluders occluders; // once in place, once as an instance below the floor, where no ray reaches it
        const Occluders::Mesh added = occluders.add(occluder);
        occluders.place(added);
        occluders.place(added, scaledAndMoved(1, {0, 0, -5}));
        occluders.finish();
        return visibilityMoments(occluders, {&point, 1}, settings).value()[0];
    };
    for (const RaySettings& settings : {RaySettings{.rays_per_sample = 4096},
                                        RaySettings{.rays_per_sample = 4096, .distance = 9, .power = 1}})
    {
        const Moments whole = momentsWith({}, ceiling, settings);
        const auto always = [](bool there) { return [there](uint32_t, float, float) { return there; }; };
        EXPECT_EQ(momentsWith(always(true), ceiling, settings).m1, whole.m1);
        EXPECT_EQ(momentsWith(always(false), ceiling, settings).m0, static_cast<float>(2 * kPi));
        Mesh first{ceiling.positions, {0, 1, 2}};
        EXPECT_EQ(
            momentsWith([](uint32_t triangle, float, float) { return triangle == 0; }, ceiling, settings).m1,
            momentsWith({}, first, settings).m1);
        // u is the weight of corner 1, v of corner 2
        const Float3 a = ceiling.positions[0], b = ceiling.positions[1], c = ceiling.positions[2];
        Mesh half;
        half.addQuad(a, (a + b) * 0.5f, (b + c) * 0.5f, c);
        const Moments masked = momentsWith(
            [](uint32_t triangle, float u, float) { return triangle == 0 && u < 0.5f; }, ceiling, settings);
        EXPECT_NEAR(masked.m0, momentsWith({}, half, settings).m0, 2e-3);
        EXPECT_LT(masked.m0, 2 * kPi - 0.1);
    }
}

TEST(VisibilityMoments, ofManyInstancesAreThoseOfTheirTriangles)
{
    // A field of masked triangles that are merged into one mesh, beside the triangles that remain.
    Mesh pair;
    pair.addQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    OccluderMesh masked = pair.occluder();
    masked.mask = [](uint32_t triangle, float, float) { return triangle == 1; };
    Occluders merged;
    const Occluders::Mesh added = merged.add(masked);
    Mesh remaining;
    for (int i = 0; i < 100; ++i)
    {
        // every other one mirrored
        const auto x = static_cast<float>(i % 10 - 5) * 0.7f, y = static_cast<float>(i / 10 - 5) * 0.7f;
        const Affine3 place{{{i % 2 == 0 ? 0.2f : -0.2f, 0, 0, x}, {0, 0.3f, 0.1f, y}, {0, 0.1f, 1, 2}}};
        merged.place(added, place);
        for (size_t c = 3; c < 6; ++c)
        {
            remaining.corners.push_back(static_cast<uint32_t>(remaining.positions.size()));
            remaining.positions.push_back(transformPoint(place, pair.positions[pair.corners[c]]));
        }
    }
    merged.finish();
    const std::vector<SamplePoint> points{{{0, 0, 0}, kUp, 1e-6f}, {{1.3f, 0.4f, 1}, kUp, 1e-6f}};
    const auto moments = visibilityMoments(merged, points, {.rays_per_sample = 4096});
    const auto expected =
        visibilityMoments(makeOccluders({remaining.occluder()}), points, {.rays_per_sample = 4096});
    for (size_t i = 0; i < points.size(); ++i)
    {
        EXPECT_NEAR((*moments)[i].m0, (*expected)[i].m0, 1e-5);
        EXPECT_LT((*moments)[i].m0, 2 * kPi - 0.3);
    }
}

TEST(VisibilityMoments, letRaysThroughBackFacesWhereTheMeshSaysSo)
{
    Mesh ceiling = makeFloor(kFar); // facing up
    for (Float3& p : ceiling.positions)
        p.z = 1;
    OccluderMesh occluder = ceiling.occluder();
    const SamplePoint below{{0.5f, 0, 0}, kUp, 1e-6f}, above{{0.5f, 0, 2}, -kUp, 1e-6f};
    const auto sees = [&](const SamplePoint& from, const Affine3& place)
    {
        Occluders occluders;
        occluders.place(occluders.add(occluder), place);
        occluders.finish();
        return visibilityMoments(occluders, {&from, 1}, {}).value()[0].m0 > 3;
    };
    // mirrored instances keep their front faces in front
    for (const Affine3& place : {Affine3{}, Affine3{{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}})
    {
        occluder.back_faces = BackFaces::block;
        EXPECT_FALSE(sees(below, place));
        EXPECT_FALSE(sees(above, place));
        occluder.back_faces = BackFaces::let_through;
        EXPECT_TRUE(sees(below, place));
        EXPECT_FALSE(sees(above, place));
    }
}

bool meets(const Mesh& mesh, Double3 origin, Double3 direction)
{
    for (size_t c = 0; c < mesh.corners.size(); c += 3)
    {
        const Double3 a = widen(mesh.positions[mesh.corners[c]]);
        const Double3 e1 = widen(mesh.positions[mesh.corners[c + 1]]) - a;
        const Double3 e2 = widen(mesh.positions[mesh.corners[c + 2]]) - a;
        const Double3 p = cross(direction, e2), s = origin - a, q = cross(s, e1);
        const double det = dot(e1, p), u = dot(s, p) / det, v = dot(direction, q) / det, t = dot(e2, q) / det;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0)
            return true;
    }
    return false;
}

TEST(VisibilityMoments, areThoseOfEachRayAgainstEachTriangle)
{
    const Mesh rock = makeMesh(shapes::rock(5, 0.8f));
    std::vector<SamplePoint> points = makePoints(rock, 0.2);
    const RaySettings settings{.rays_per_sample = 48, .first_ray = 7, .seed = 5};
    const auto moments = visibilityMoments(makeOccluders({rock.occluder()}), points, settings);
    size_t occluded = 0;
    for (size_t i = 0; i < points.size(); ++i)
    {
        std::vector<float> x(48), y(48), z(48);
        sampling::hemisphereDirections(7, sampling::deriveSeed(5, i), sampling::frameAround(points[i].normal),
                                       x, y, z);
        double seen = 0;
        for (size_t r = 0; r < 48; ++r)
            if (!meets(rock, widen(rayOrigin(points[i])), {double{x[r]}, double{y[r]}, double{z[r]}}))
                ++seen;
            else
                ++occluded;
        EXPECT_NEAR((*moments)[i].m0, 2 * kPi * seen / 48, 1e-5);
    }
    EXPECT_GT(occluded, points.size());
}

TEST(VisibilityMoments, ofTwoPartsOfASequenceAverageToThoseOfTheWhole)
{
    const Mesh rock = makeMesh(shapes::rock(8, 0.8f));
    const Occluders occluders = makeOccluders({rock.occluder()});
    const std::vector<SamplePoint> points = makePoints(rock, 0.5);
    const auto first = visibilityMoments(occluders, points, {.rays_per_sample = 64});
    const auto second = visibilityMoments(occluders, points, {.rays_per_sample = 64, .first_ray = 64});
    const auto whole = visibilityMoments(occluders, points, {.rays_per_sample = 128});
    for (size_t i = 0; i < points.size(); ++i)
    {
        EXPECT_NEAR(((*first)[i].m0 + (*second)[i].m0) / 2, (*whole)[i].m0, 1e-5);
        EXPECT_LT(length(((*first)[i].m1 + (*second)[i].m1) * 0.5f - (*whole)[i].m1), 0.02f);
    }
    EXPECT_GT(meanDifference(*first, *second), 1e-3);
}

TEST(VisibilityMoments, areTheSameBytesForAnyNumberOfThreads)
{
    const Mesh rock = makeMesh(shapes::rock(16, 0.6f));
    const auto run = [&](const RaySettings& settings)
    {
        Occluders occluders;
        const Occluders::Mesh mesh = occluders.add(rock.occluder());
        occluders.place(mesh);
        occluders.place(mesh, scaledAndMoved(0.5f, {1, 1, 1}));
        occluders.finish();
        return visibilityMoments(occluders, makePoints(rock, 3), settings).value();
    };
    for (const RaySettings& settings :
         {RaySettings{.rays_per_sample = 32}, RaySettings{.rays_per_sample = 20, .distance = 2, .power = 2}})
    {
        const std::vector<Moments> many = run(settings);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const std::vector<Moments> alone = run(settings);
        ASSERT_EQ(many.size(), alone.size());
        EXPECT_EQ(std::memcmp(many.data(), alone.data(), many.size() * sizeof(Moments)), 0);
    }
}

TEST(VisibilityMoments, tellHowFarTheyAreAndStopWhenTold)
{
    const Mesh rock = makeMesh(shapes::rock(16, 0.6f));
    const Occluders occluders = makeOccluders({rock.occluder()});
    const std::vector<SamplePoint> points = makePoints(rock, 2);
    uint64_t last = 0;
    int calls = 0;
    const uint64_t total = points.size() * 64;
    EXPECT_TRUE(visibilityMoments(occluders, points, {},
                                  [&](uint64_t done, uint64_t of)
                                  {
                                      EXPECT_EQ(of, total);
                                      EXPECT_GT(done, last);
                                      last = done;
                                      ++calls;
                                      return true;
                                  })
                    .has_value());
    EXPECT_EQ(last, total);
    EXPECT_GT(calls, 1);
    std::atomic<int> after{0};
    EXPECT_FALSE(visibilityMoments(occluders, points, {},
                                   [&](uint64_t, uint64_t)
                                   {
                                       ++after;
                                       return false;
                                   })
                     .has_value());
    EXPECT_EQ(after, 1);
}

TEST(VisibilityMoments, ofNothingAreOpen)
{
    Occluders occluders;
    const Occluders::Mesh nothing = occluders.add({});
    occluders.place(nothing);
    occluders.place(nothing, scaledAndMoved(2, {}));
    occluders.finish();
    EXPECT_EQ(seenFrom(occluders, {}, kUp).m0, static_cast<float>(2 * kPi));
    EXPECT_TRUE(visibilityMoments(occluders, {}, {})->empty());
}

} // namespace
} // namespace hearth::visibility
