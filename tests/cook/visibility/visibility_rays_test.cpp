// Compares visibility moments by rays with closed forms.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/visibility/ray_scenes.h"
#include "tests/reference/polygon_visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hearth::visibility
{
namespace
{

using reference::Double3;

// Largest errors of 65,536 rays beside closed forms: m0, and each component of m1.
constexpr double kMaxM0Error = 2e-3, kMaxM1Error = 1.5e-3;

void expectMoments(const Moments& m, double m0, Double3 m1)
{
    EXPECT_NEAR(m.m0, m0, kMaxM0Error);
    EXPECT_NEAR(m.m1.x, m1.x, kMaxM1Error);
    EXPECT_NEAR(m.m1.y, m1.y, kMaxM1Error);
    EXPECT_NEAR(m.m1.z, m1.z, kMaxM1Error);
}

TEST(VisibilityMoments, ofAPlaneAreExactlyTheOpenHemisphere)
{
    const Mesh floor = makeFloor(1);
    const Occluders occluders = makeOccluders({floor.occluder()});
    const std::vector<SamplePoint> points = makePoints(floor, 100);
    const auto moments = visibilityMoments(occluders, points, {});
    for (const Moments& m : *moments)
    {
        EXPECT_EQ(m.m0, static_cast<float>(2 * kPi));
        EXPECT_EQ(m.m1, (Float3{0, 0, static_cast<float>(kPi)}));
    }
}

TEST(VisibilityMoments, insideASolidAreExactlyNothing)
{
    const Mesh sphere = makeSphere(16, 32, 1, true);
    const auto moments = visibilityMoments(makeOccluders({sphere.occluder()}), makePoints(sphere, 1), {});
    for (const Moments& m : *moments)
    {
        EXPECT_EQ(m.m0, 0);
        EXPECT_EQ(m.m1, (Float3{}));
    }
}

TEST(VisibilityMoments, atACreaseAreHalf)
{
    Mesh mesh = makeFloor(kFar);
    mesh.addQuad({0, -kFar, 0}, {0, kFar, 0}, {0, kFar, kFar}, {0, -kFar, kFar});
    const Moments m = seenFrom(makeOccluders({mesh.occluder()}), {0.01f, 0, 0}, kUp);
    EXPECT_NEAR(computeOcclusion(m, kUp), 0.5, 3e-4);
    expectMoments(m, kPi, {kPi / 2, 0, kPi / 2});
    // reference cone: half angle 65.53 degrees, scale 0.8536
    const double rho = double{length(m.m1)} / double{m.m0};
    EXPECT_NEAR(std::acos(2 * rho - 1) * 180 / kPi, 65.53, 0.05);
    EXPECT_NEAR(double{m.m0} / (4 * kPi * (1 - rho)), 0.8536, 1e-3);
}

TEST(VisibilityMoments, atACornerAreAQuarter)
{
    Mesh mesh = makeFloor(kFar);
    mesh.addQuad({0, -kFar, 0}, {0, kFar, 0}, {0, kFar, kFar}, {0, -kFar, kFar});
    mesh.addQuad({-kFar, 0, 0}, {kFar, 0, 0}, {kFar, 0, kFar}, {-kFar, 0, kFar});
    const Moments m = seenFrom(makeOccluders({mesh.occluder()}), {0.01f, 0.01f, 0}, kUp);
    EXPECT_NEAR(computeOcclusion(m, kUp), 0.25, 3e-4);
    expectMoments(m, kPi / 2, {kPi / 4, kPi / 4, kPi / 4});
    const double rho = double{length(m.m1)} / double{m.m0};
    EXPECT_NEAR(std::acos(2 * rho - 1) * 180 / kPi, 42.94, 0.05);
}

TEST(VisibilityMoments, besideAWallAreThoseOfItsHeight)
{
    const float h = 1;
    Mesh mesh = makeFloor(kFar);
    mesh.addQuad({0, -kFar, 0}, {0, kFar, 0}, {0, kFar, h}, {0, -kFar, h});
    const Occluders occluders = makeOccluders({mesh.occluder()});
    for (const float x : {0.1f, 0.5f, 1.0f, 4.0f})
    {
        const Moments m = seenFrom(occluders, {x, 0, 0}, kUp);
        const double phi = std::atan2(double{h}, double{x});
        SCOPED_TRACE(x);
        expectMoments(m, 2 * kPi - 2 * phi, {kPi / 2 * std::sin(phi), 0, kPi / 2 * (1 + std::cos(phi))});
    }
}

TEST(VisibilityMoments, atTheBottomOfAGrooveAreThoseOfItsOpening)
{
    for (const double opening : {0.3, 1.0, 2.0})
    {
        SCOPED_TRACE(opening);
        const double s = std::sin(opening / 2) * double{kFar}, c = std::cos(opening / 2) * double{kFar};
        const auto x = static_cast<float>(s), z = static_cast<float>(c);
        Mesh mesh;
        mesh.addQuad({0, -kFar, 0}, {x, -kFar, z}, {x, kFar, z}, {0, kFar, 0});
        mesh.addQuad({0, -kFar, 0}, {0, kFar, 0}, {-x, kFar, z}, {-x, -kFar, z});
        const Moments m = seenFrom(makeOccluders({mesh.occluder()}), {0, 0, 1e-3f}, kUp);
        EXPECT_NEAR(computeOcclusion(m, kUp), std::sin(opening / 2), 5e-4);
        expectMoments(m, 2 * opening, {0, 0, kPi * std::sin(opening / 2)});
    }
}

TEST(VisibilityMoments, onTheSidesOfAGrooveAreThoseBesideAPolygon)
{
    // however the groove is rotated
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (const double opening : {0.5, kPi / 3, 2 * kPi / 3})
    {
        const auto direction = [&] {
            return normalizeOr({normal(random), normal(random), normal(random)}, kUp);
        };
        const Float3 along = direction(), up = normalizeOr(cross(along, direction()), kUp);
        const Float3 side = cross(up, along);
        const auto s = static_cast<float>(std::sin(opening / 2)),
                   c = static_cast<float>(std::cos(opening / 2));
        const Float3 right = side * s + up * c, left = side * -s + up * c, half = along * 1.5f;
        Mesh mesh;
        mesh.addQuad(half, half + right, right - half, half * -1.0f);
        mesh.addQuad(half * -1.0f, left - half, half + left, half);
        const Occluders occluders = makeOccluders({mesh.occluder()});
        const reference::Polygon other{Double3(half * -1.0f), Double3(left - half), Double3(half + left),
                                       Double3(half)};
        const Float3 facing = normalizeOr(cross(right, half * -2.0f), kUp);
        for (const float x : {0.02f, 0.4f, 0.95f})
        {
            SCOPED_TRACE(x);
            const Float3 point = right * x + along * (x - 0.5f);
            const auto exact = reference::visibleBesidePolygons(Double3(point), Double3(facing), {&other, 1});
            const Moments m = seenFrom(occluders, point, facing);
            expectMoments(m, exact.m0, exact.m1);
            EXPECT_NEAR(computeOcclusion(m, facing), dot(exact.m1, Double3(facing)) / kPi, 3e-4);
        }
    }
}

TEST(VisibilityMoments, inAPitAreThoseOfItsMouth)
{
    const float r = 0.7f, d = 1.1f;
    Mesh mesh;
    constexpr int kSectors = 256;
    for (int i = 0; i < kSectors; ++i)
    {
        const double a = 2 * kPi * i / kSectors, b = 2 * kPi * (i + 1) / kSectors;
        const Float3 at_a{r * static_cast<float>(std::cos(a)), r * static_cast<float>(std::sin(a)), 0};
        const Float3 at_b{r * static_cast<float>(std::cos(b)), r * static_cast<float>(std::sin(b)), 0};
        mesh.addQuad(at_a, at_a + kUp * d, at_b + kUp * d, at_b);
    }
    const Moments m = seenFrom(makeOccluders({mesh.occluder()}), {}, kUp);
    const double exact = double{r} * r / (double{r} * r + double{d} * d);
    EXPECT_NEAR(computeOcclusion(m, kUp), exact, 5e-4);
    expectMoments(m, 2 * kPi * (1 - std::sqrt(1 - exact)), {0, 0, kPi * exact});
    // a cone of scale 1: its half angle equals the opening's
    const double rho = double{length(m.m1)} / double{m.m0};
    EXPECT_NEAR(2 * rho - 1, std::sqrt(1 - exact), 1e-3);
    EXPECT_NEAR(double{m.m0} / (4 * kPi * (1 - rho)), 1, 2e-3);
}

TEST(VisibilityMoments, underASphereAreThoseOfItsCap)
{
    const float height = 1.2f;
    const Mesh floor = makeFloor(10);
    const Mesh sphere = transformed(makeSphere(64, 128, 1, false), scaledAndMoved(1, {0, 0, height}));
    const Occluders occluders = makeOccluders({floor.occluder(), sphere.occluder()});
    for (const float x : {0.0f, 0.8f, 2.0f})
    {
        SCOPED_TRACE(x);
        const double h = double{height}, far2 = h * h + double{x} * x, far3 = std::pow(far2, 1.5);
        const Moments m = seenFrom(occluders, {x, 0, 0}, kUp);
        EXPECT_NEAR(computeOcclusion(m, kUp), 1 - h / far3, 1e-3);
        expectMoments(m, 2 * kPi * std::sqrt(1 - 1 / far2),
                      {kPi * double{x} / far3, 0, kPi * (1 - h / far3)});
    }
}

TEST(VisibilityMoments, underAnAttenuatedCeilingAreThoseOfItsLaw)
{
    Mesh ceiling = makeFloor(kFar);
    for (Float3& p : ceiling.positions)
        p.z = 0.6f;
    const Occluders occluders = makeOccluders({ceiling.occluder()});
    const float distance = 1.5f;
    const double k = 0.4, log_k = std::log(k);
    const Moments p1 = seenFrom(occluders, {}, kUp, {.distance = distance, .power = 1});
    EXPECT_NEAR(p1.m0, 2 * kPi * k * (1 - log_k), 5e-4);
    EXPECT_NEAR(p1.m1.z, 2 * kPi * (k - k * k / 2), 5e-4);
    const Moments p2 = seenFrom(occluders, {}, kUp, {.distance = distance, .power = 2});
    EXPECT_NEAR(p2.m0, 2 * kPi * (2 * k - k * k), 5e-4);
    EXPECT_NEAR(p2.m1.z, 2 * kPi * k * k * (0.5 - log_k), 5e-4);
    // exponents in between give values in between
    const Moments p15 = seenFrom(occluders, {}, kUp, {.distance = distance, .power = 1.5f});
    EXPECT_LT(p15.m0, p1.m0);
    EXPECT_GT(p15.m0, p2.m0);
    // a range limit without attenuation: occluded where the ceiling is nearer, so for all hits beyond
    // `nearest`
    const Moments limited = seenFrom(occluders, {}, kUp, {.distance = distance});
    EXPECT_NEAR(limited.m0, 2 * kPi * k, 2e-3);
    const Moments ring = seenFrom(occluders, {}, kUp, {.distance = distance, .nearest = 1.2f});
    EXPECT_NEAR(ring.m0, 2 * kPi * (k + 1 - 0.5), 2e-3);
}

TEST(VisibilityMoments, ofABowlAreConstant)
{
    // bottom of a sphere up to polar angle 0.4 pi: occlusion is 1 - A / (4 pi R^2) at every point
    const Mesh bowl = makeSphere(40, 160, 0.4, true);
    const std::vector<SamplePoint> all = makePoints(bowl, 0);
    std::vector<SamplePoint> points;
    for (size_t i = 0; i < all.size(); i += 20)
        points.push_back(all[i]);
    const auto moments =
        visibilityMoments(makeOccluders({bowl.occluder()}), points, {.rays_per_sample = 1024});
    const double exact = 1 - (1 - std::cos(0.4 * kPi)) / 2;
    double squares = 0, mean = 0;
    for (size_t i = 0; i < points.size(); ++i)
    {
        const double ao = computeOcclusion((*moments)[i], points[i].normal);
        mean += ao / static_cast<double>(points.size());
        squares += (ao - exact) * (ao - exact) / static_cast<double>(points.size());
    }
    // triangles of 2.25 degrees see slightly less or more than the sphere
    EXPECT_NEAR(mean, exact, 5e-4);
    EXPECT_LT(std::sqrt(squares), 0.004);
}

TEST(VisibilityHigherMoments, areThoseOfACapAndOfTheOpenHemisphere)
{
    // directions above a round opening: visible within a half-angle of the normal
    const double mouth = 0.8;
    Mesh funnel;
    constexpr int kSectors = 256;
    for (int i = 0; i < kSectors; ++i)
    {
        const auto at = [&](int sector, float height)
        {
            const double azimuth = 2 * kPi * sector / kSectors, r = height == 0 ? 20 : std::tan(mouth);
            return Float3{static_cast<float>(r * std::cos(azimuth)),
                          static_cast<float>(r * std::sin(azimuth)), height};
        };
        funnel.addQuad(at(i, 0), at(i, 1), at(i + 1, 1), at(i + 1, 0));
    }
    const Occluders occluders = makeOccluders({funnel.occluder()});
    const SamplePoint point{{}, kUp, 1e-6f};
    const RaySettings settings{.rays_per_sample = 1 << 16};
    const HigherMoments m = visibilityHigherMoments(occluders, {&point, 1}, settings).value()[0];
    const double c = std::cos(mouth), zz = 2 * kPi * (1 - c * c * c) / 3, xx = (2 * kPi * (1 - c) - zz) / 2;
    EXPECT_NEAR(m.second.xx, xx, 1.5e-3);
    EXPECT_NEAR(m.second.yy, xx, 1.5e-3);
    EXPECT_NEAR(m.second.zz, zz, 1.5e-3);
    EXPECT_NEAR(m.second.xy, 0, 1e-3);
    EXPECT_NEAR(m.second.xz, 0, 1e-3);
    EXPECT_NEAR(m.second.yz, 0, 1e-3);
    EXPECT_NEAR(m.second.xx + m.second.yy + m.second.zz, m.moments.m0, 1e-5);
    EXPECT_EQ(m.moments.m1, visibilityMoments(occluders, {&point, 1}, settings).value()[0].m1);

    const Occluders nothing = makeOccluders({});
    const SecondMoments open = visibilityHigherMoments(nothing, {&point, 1}, {}).value()[0].second;
    EXPECT_EQ(open.xx, static_cast<float>(2 * kPi / 3));
    EXPECT_EQ(open.zz, static_cast<float>(2 * kPi / 3));
    EXPECT_EQ(open.xy, 0);
    // with a slanted normal the moments rotate along
    const Mesh wall = transformed(funnel, {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}});
    const SamplePoint sideways{{}, {1, 0, 0}, 1e-6f};
    EXPECT_NEAR(visibilityHigherMoments(makeOccluders({wall.occluder()}), {&sideways, 1}, settings)
                    .value()[0]
                    .second.xx,
                zz, 1.5e-3);
}

} // namespace
} // namespace hearth::visibility
