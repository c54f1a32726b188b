// Tests the lobes of specular gathering against the reflection integral of a GGX surface, summed over the
// whole hemisphere.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/gather.h"
#include "formats/gpu_shared/gather_lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace hearth::shared
{

namespace
{

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kRays = kGatherLobeRays * kGatherFrames; ///< rays of a lobe until the sequence repeats

using Radiance = std::function<double(Float3)>;

Float3 eyeAt(double angle)
{
    return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
}

/// Worlds with light on one side of an edge. The edges are at increasing angles from the mirror direction,
/// across the plane of eye and normal, which is z, and along it.
std::vector<Radiance> edgesAbout(Float3 to_eye)
{
    const Float3 mirror{-to_eye.x, -to_eye.y, to_eye.z};
    const Float3 along{mirror.z, 0, -mirror.x};
    std::vector<Radiance> edges;
    for (const Float3 side : {along, along * -1, Float3{0, 1, 0}})
        for (int i = -6; i <= 6; ++i)
        {
            const float off = 0.2f * static_cast<float>(i);
            const Float3 plane = side * std::cos(off) + mirror * std::sin(off);
            edges.push_back([=](Float3 d) { return dot(plane, d) > 0 ? 1.0 : 0.0; });
        }
    return edges;
}

/// Reflection of each world by a surface of constant Fresnel factor, relative to its reflection of a world
/// that is 1 everywhere.
/// source  brdf.glsl
std::vector<double> computeReflected(const std::vector<Radiance>& worlds, Float3 to_eye, double roughness)
{
    constexpr int kRings = 180, kSectors = 360;
    const double alpha2 = std::pow(roughness, 4);
    std::vector<double> sums(worlds.size());
    double all = 0;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector)
        {
            const double theta = (ring + 0.5) / kRings * kPi / 2, phi = (sector + 0.5) / kSectors * 2 * kPi;
            const double l = std::cos(theta), v = double{to_eye.z};
            const Float3 light{static_cast<float>(std::sin(theta) * std::cos(phi)),
                               static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(l)};
            const Float3 sum = light + to_eye;
            const double h = double{sum.z} / double{length(sum)};
            const double d = (h * alpha2 - h) * h + 1;
            const double visibility = 0.5 / (l * std::sqrt(v * v * (1 - alpha2) + alpha2) +
                                             v * std::sqrt(l * l * (1 - alpha2) + alpha2));
            const double weight = alpha2 / (kPi * d * d) * visibility * l * std::sin(theta);
            all += weight;
            for (size_t i = 0; i < worlds.size(); ++i)
                sums[i] += weight * worlds[i](light);
        }
    for (double& sum : sums)
        sum /= all;
    return sums;
}

double lobeMean(const Radiance& world, Float3 to_eye, float roughness)
{
    double sum = 0, weights = 0;
    for (uint32_t i = 0; i < kRays; ++i)
    {
        const GatherLobeRay ray = gatherLobeRay(to_eye, {0, 0, 1}, roughness, i, kRays, 0);
        sum += double{ray.weight} * world(ray.direction);
        weights += double{ray.weight};
    }
    return sum / weights;
}

double cosineMean(const Radiance& world)
{
    double sum = 0;
    for (uint32_t i = 0; i < 4096; ++i)
        sum += world(brickRayDirection({0, 0, 1}, i, 4096, 0)) / 4096;
    return sum;
}

double rootMeanSquare(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

} // namespace

TEST(GatherLobe, isTheReflectionOfASurfaceOfItsRoughness)
{
    for (const double angle : {0.05, 0.7, 1.3})
        for (const float roughness : {kGatherSharpRoughness, kGatherWideRoughness})
        {
            const Float3 to_eye = eyeAt(angle);
            const std::vector<Radiance> worlds = edgesAbout(to_eye);
            std::vector<double> found;
            for (const Radiance& world : worlds)
                found.push_back(lobeMean(world, to_eye, roughness));
            EXPECT_LT(rootMeanSquare(found, computeReflected(worlds, to_eye, double{roughness})), 0.012)
                << "angle " << angle << " roughness " << roughness;
        }
}

TEST(GatherLobe, turnsWithTheNormal)
{
    const Float3 normals[] = {{0, 0, 1}, {0, 0, -1}, {0.6f, 0, -0.8f}, {-0.48f, 0.6f, 0.64f}};
    for (const Float3 normal : normals)
        for (const float roughness : {kGatherSharpRoughness, kGatherWideRoughness})
        {
            // along the normal, so that the lobe is rotationally symmetric
            Float3 sum;
            for (uint32_t i = 0; i < kRays; ++i)
            {
                const GatherLobeRay ray = gatherLobeRay(normal, normal, roughness, i, kRays, 0);
                EXPECT_NEAR(length(ray.direction), 1, 1e-5f);
                EXPECT_TRUE(ray.weight >= 0 && ray.weight <= 1);
                EXPECT_EQ(ray.weight > 0, dot(ray.direction, normal) > 0);
                sum += ray.direction * ray.weight;
            }
            EXPECT_GT(dot(sum, normal) / length(sum), 0.999f);
        }
    // from behind, as happens with smooth normals at silhouettes
    for (uint32_t i = 0; i < kRays; ++i)
    {
        const GatherLobeRay ray =
            gatherLobeRay({0.8f, 0, -0.6f}, {0, 0, 1}, kGatherSharpRoughness, i, kRays, 0);
        EXPECT_NEAR(length(ray.direction), 1, 1e-5f);
    }
}

TEST(GatherLobe, twoAndTheCosineStandForAllRoughnesses)
{
    for (const double angle : {0.05, 0.7, 1.3})
    {
        const Float3 to_eye = eyeAt(angle);
        const std::vector<Radiance> worlds = edgesAbout(to_eye);
        for (const float roughness : {0.2f, 0.3f, 0.4f, 0.55f, 0.65f, 0.75f, 0.9f, 1.0f})
        {
            const GatherLobeShares shares = gatherLobeShares(roughness);
            EXPECT_NEAR(shares.sharp + shares.wide + shares.cosine, 1, 1e-6f);
            std::vector<double> found;
            for (const Radiance& world : worlds)
                found.push_back(double{shares.sharp} * lobeMean(world, to_eye, kGatherSharpRoughness) +
                                double{shares.wide} * lobeMean(world, to_eye, kGatherWideRoughness) +
                                double{shares.cosine} * cosineMean(world));
            EXPECT_LT(rootMeanSquare(found, computeReflected(worlds, to_eye, double{roughness})), 0.045)
                << "angle " << angle << " roughness " << roughness;
        }
    }
    // smoother surfaces use the sharpest lobe
    EXPECT_EQ(gatherLobeShares(0).sharp, 1);
    EXPECT_EQ(gatherLobeShares(0).wide, 0);
}

} // namespace hearth::shared
