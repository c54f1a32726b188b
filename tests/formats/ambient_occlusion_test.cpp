// Tests ambient occlusion of cones against integration over the hemisphere, and of random skies with bent
// normals.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/ambient_occlusion.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace hearth::shared
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

float f(double x)
{
    return static_cast<float>(x);
}

/// (1/pi) int over the cone of max(0, n . w): polar rings about the axis; the part of each above the horizon
/// in closed form.
double integratedOcclusion(double theta, double aperture)
{
    constexpr int kRings = 4000;
    double sum = 0;
    for (int i = 0; i < kRings; ++i)
    {
        const double t = aperture * (i + 0.5) / kRings, step = aperture / kRings;
        // n . w = p + q cos(phi)
        const double p = std::cos(theta) * std::cos(t), q = std::sin(theta) * std::sin(t);
        const double end = p >= q ? kPi : p <= -q ? 0 : std::acos(-p / q);
        sum += 2 * (p * end + q * std::sin(end)) * std::sin(t) * step;
    }
    return sum / kPi;
}

TEST(ClippedConeOcclusion, isTheIntegralOverTheCone)
{
    double worst = 0;
    for (int i = 0; i <= 36; ++i)
        for (int j = 0; j <= 18; ++j)
        {
            const double theta = kPi * i / 36, aperture = kPi / 2 * j / 18;
            const double exact = integratedOcclusion(theta, aperture);
            const float value =
                clippedConeOcclusion(f(std::cos(theta)), f(std::max(0.0, std::cos(aperture))));
            worst = std::max(worst, std::abs(double{value} - exact));
        }
    EXPECT_LT(worst, 2e-6);
}

TEST(ClippedConeOcclusion, ofTheHemisphereIsHalfOfOnePlusTheCosine)
{
    for (const float c : {-1.0f, -0.5f, 0.0f, 0.3f, 0.99f, 1.0f})
        EXPECT_NEAR(clippedConeOcclusion(c, 0), (1 + c) / 2, 1e-6f);
    EXPECT_EQ(clippedConeOcclusion(1, 1), 0) << "a cone without width";
}

TEST(CheapShares, areAsNearToTheSquaredSineAsTheySay)
{
    double smooth = 0, quadratic = 0;
    for (int i = 0; i <= 1000; ++i)
    {
        const double a = i / 1000.0, exact = std::pow(std::sin(a * kPi / 2), 2);
        smooth = std::max(smooth, std::abs(double{smoothstepSinSquared(f(a))} - exact));
        quadratic = std::max(quadratic, std::abs(double{quadraticSinSquared(f(a))} - exact));
    }
    EXPECT_NEAR(smooth, 0.010, 0.0005);
    EXPECT_NEAR(quadratic, 0.0285, 0.0005);
    EXPECT_EQ(smoothstepSinSquared(1), 1);
    EXPECT_EQ(quadraticSinSquared(1), 1);
    EXPECT_NEAR(quadraticSinSquared(0.499999f), quadraticSinSquared(0.5f), 1e-5f) << "no jump in the middle";
}

constexpr std::array kModes{kAmbientOcclusionExact, kAmbientOcclusionSmoothstep, kAmbientOcclusionQuadratic};

TEST(AmbientOcclusion, isTheProductAtTheNormalItself)
{
    // a crease of two planes: 1/2, from the cone of its moments (65.53 degrees, 0.8536, the axis at 45)
    const double c = 2 * (std::sqrt(2.0) / 2) - 1, scale = 0.5 / (1 - c);
    const float cosine = f(std::sqrt(0.5));
    EXPECT_NEAR(ambientOcclusion(kAmbientOcclusionExact, f(scale), f(c), f(std::acos(c)), cosine, cosine),
                0.5f, 1e-6f);
    EXPECT_GT(scale * double{clippedConeOcclusion(cosine, f(c))}, 0.515)
        << "what clipping once more would give";
    for (const uint mode : kModes)
        EXPECT_NEAR(ambientOcclusion(mode, 1, 0, f(kPi / 2), 1, 1), 1, 1e-6f) << "the open hemisphere";
    EXPECT_EQ(ambientOcclusion(kAmbientOcclusionOff, 0.2f, 0.5f, 1, 0.1f, 0.1f), 1);
}

TEST(AmbientOcclusion, isBoundedAndContinuousInTheBend)
{
    for (const uint mode : kModes)
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 20; ++j)
            {
                const double aperture = kPi / 2 * i / 19, geometric = std::cos(kPi / 2 * j / 19);
                float before = -1;
                for (int k = 0; k <= 2000; ++k)
                {
                    const float shading = f(std::cos(kPi * k / 2000));
                    const float value = ambientOcclusion(mode, 0.9f, f(std::max(0.0, std::cos(aperture))),
                                                         f(aperture), f(geometric), shading);
                    ASSERT_GE(value, 0);
                    ASSERT_LE(value, 1);
                    if (k > 0)
                    {
                        ASSERT_NEAR(value, before, 0.003f) << mode << " " << aperture << " " << shading;
                        ASSERT_LE(value, before + 1e-5f) << "turning away from the axis never brightens";
                    }
                    before = value;
                }
            }
}

struct Direction
{
    double x, y, z;
};

double dot(Direction a, Direction b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Visible part of the hemisphere about z, as weights of directions of equal solid angle.
struct Sky
{
    std::vector<Direction> directions;
    std::vector<uint8_t> visible;
};

/// A random sky: half-spaces, blobs, or a cap.
Sky randomSky(std::mt19937& random, int kind)
{
    const auto uniform = [&](double low, double high)
    { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
    const auto anywhere = [&](double height)
    {
        const double z = uniform(0.02, height), phi = uniform(0, 2 * kPi), r = std::sqrt(1 - z * z);
        return Direction{r * std::cos(phi), r * std::sin(phi), z};
    };
    constexpr int kCount = 4000;
    Sky sky;
    for (int i = 0; i < kCount; ++i)
    {
        const double z = (i + 0.5) / kCount, phi = 2 * kPi * std::fmod(i * 0.6180339887, 1.0),
                     r = std::sqrt(1 - z * z);
        sky.directions.push_back({r * std::cos(phi), r * std::sin(phi), z});
    }
    sky.visible.assign(kCount, 1);
    const int obstacles = kind == 2 ? 1 : 1 + static_cast<int>(random() % 3);
    for (int o = 0; o < obstacles; ++o)
    {
        const Direction d = anywhere(kind == 0 ? 0.7 : 1);
        const double limit = kind == 0 ? 0 : std::cos(uniform(0.3, kind == 1 ? 0.8 : 1.5));
        for (size_t i = 0; i < kCount; ++i)
            if ((dot(sky.directions[i], d) > limit) == (kind == 1))
                sky.visible[i] = 0;
    }
    return sky;
}

TEST(AmbientOcclusion, followsBentNormalsUnderRandomSkies)
{
    std::mt19937 random(7);
    const auto uniform = [&](double low, double high)
    { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
    std::array<double, 3> squares{};
    double talk = 0, none = 0;
    int count = 0;
    for (int i = 0; i < 150; ++i)
    {
        const Sky sky = randomSky(random, i % 3);
        double m0 = 0;
        Direction m1{};
        const double solid = 2 * kPi / static_cast<double>(sky.directions.size());
        for (size_t d = 0; d < sky.directions.size(); ++d)
            if (sky.visible[d])
            {
                m0 += solid;
                m1 = {m1.x + sky.directions[d].x * solid, m1.y + sky.directions[d].y * solid,
                      m1.z + sky.directions[d].z * solid};
            }
        const double size = std::sqrt(dot(m1, m1));
        if (size < 0.05)
            continue;
        const double rho = size / m0, c = std::max(0.0, 2 * rho - 1), aperture = std::acos(c);
        const double scale = std::min(1.0, rho > 0.5 ? m0 / (4 * kPi * (1 - rho)) : size / kPi);
        for (int bend = 0; bend < 6; ++bend)
        {
            const double angle = uniform(0, kPi / 4), phi = uniform(0, 2 * kPi);
            const Direction n{std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi),
                              std::cos(angle)};
            double truth = 0;
            for (size_t d = 0; d < sky.directions.size(); ++d)
                truth += sky.visible[d] * std::max(0.0, dot(sky.directions[d], n)) * solid / kPi;
            const double geometric = m1.z / size, shading = dot(m1, n) / size;
            for (size_t mode = 0; mode < 3; ++mode)
                squares[mode] += std::pow(double{ambientOcclusion(kModes[mode], f(scale), f(c), f(aperture),
                                                                  f(geometric), f(shading))} -
                                              truth,
                                          2);
            const double a = aperture / (kPi / 2), share = std::pow(std::sin(aperture), 2);
            talk += std::pow(scale * share * std::max(0.0, shading + a * (1 - shading) / 2) - truth, 2);
            none += std::pow(scale * share * geometric - truth, 2);
            ++count;
        }
    }
    ASSERT_GT(count, 800);
    const auto rms = [&](double sum) { return std::sqrt(sum / count); };
    EXPECT_LT(rms(squares[0]), 0.0175) << "exact";
    EXPECT_LT(rms(squares[1]), 0.018) << "smoothstep";
    EXPECT_LT(rms(squares[2]), 0.0195) << "quadratic";
    EXPECT_GT(rms(talk), 2 * rms(squares[1])) << "the talk's correction";
    EXPECT_GT(rms(none), 5 * rms(squares[1])) << "without a correction";
    RecordProperty("rms", std::to_string(rms(squares[0])) + " " + std::to_string(rms(squares[1])) + " " +
                              std::to_string(rms(squares[2])) + " talk " + std::to_string(rms(talk)) +
                              " none " + std::to_string(rms(none)));
}

} // namespace
} // namespace hearth::shared
