// Tests the exact occlusion of lobes by cones, and the table that stores it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/astc.h"
#include "cook/specular/configurations.h"
#include "tests/cook/specular/lobe_reference.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <set>

#include <tbb/global_control.h>

namespace hearth::test
{

using namespace specular;
using formats::kSpecularTexels;

namespace
{

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr uint32_t kNodes = shared::kSpecularNodes;
constexpr Masking kMaskings[] = {Masking::separable, Masking::correlated};
constexpr SpecularSpacing kSpacings[] = {SpecularSpacing::cosine, SpecularSpacing::half_sine};

Double3 direction(double tilt, double around)
{
    return {std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)};
}

/// Random cones of any aperture and lobes of any kind, grazing and narrow ones included.
struct RandomCase
{
    Lobe lobe;
    Cone cone;
};

std::vector<RandomCase> randomCases(size_t count, uint64_t seed)
{
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<RandomCase> cases(count);
    for (size_t i = 0; i < count; ++i)
    {
        RandomCase& made = cases[i];
        made.lobe = {0.089 + 0.911 * uniform(), i % 8 == 0 ? kRightAngle : kRightAngle * uniform(),
                     kMaskings[i % 2]};
        // every third axis lies in the plane of incidence near the lobe, as the table's axes do
        const bool in_plane = i % 3 == 0;
        const double tilt = in_plane ? made.lobe.theta_o + uniform() - 0.5 : 2 * uniform();
        made.cone = {direction(tilt, in_plane ? 0 : 2 * std::numbers::pi * uniform()),
                     kRightAngle * uniform()};
        if (in_plane)
            made.cone.axis.y = 0;
    }
    return cases;
}

double computeRms(const std::vector<double>& errors)
{
    double sum = 0;
    for (const double error : errors)
        sum += error * error;
    return std::sqrt(sum / static_cast<double>(errors.size()));
}

} // namespace

TEST(OcclusionOf, isWhatCountingVisibleNormalsFinds)
{
    std::vector<double> errors;
    for (const auto& [lobe, cone] : randomCases(24, 1))
    {
        errors.push_back(computeOcclusion(lobe, cone) - countedOcclusion(lobe, cone, 500));
        EXPECT_LT(std::abs(errors.back()), 1e-3)
            << lobe.roughness << " " << lobe.theta_o << " " << cone.half_angle;
    }
    EXPECT_LT(computeRms(errors), 2e-4);
}

TEST(OcclusionOf, isTheIntegralOverDirections)
{
    size_t tried = 0;
    for (const auto& [lobe, cone] : randomCases(60, 2))
    {
        if (lobe.roughness < 0.4 || lobe.theta_o > 1.2 || ++tried > 8)
            continue;
        EXPECT_NEAR(computeOcclusion(lobe, cone), integratedOcclusion(lobe, cone, 250), 1e-4)
            << lobe.roughness << " " << lobe.theta_o << " " << cone.half_angle;
    }
    EXPECT_GE(tried, 8u);
}

TEST(OcclusionOf, hardlyChangesWithMorePoints)
{
    std::vector<double> errors;
    for (const auto& [lobe, cone] : randomCases(200, 3))
        errors.push_back(computeOcclusion(lobe, cone) -
                         computeOcclusion(lobe, cone, {.outer = 72, .inner = 56}));
    EXPECT_LT(computeRms(errors), 2e-5);
}

TEST(OcclusionOf, hasTheLimitsOfAShare)
{
    for (const auto& [lobe, cone] : randomCases(40, 4))
    {
        EXPECT_NEAR(computeOcclusion(lobe, {cone.axis, 0}), 0, 1e-12);
        EXPECT_NEAR(computeOcclusion(lobe, {cone.axis, std::numbers::pi}), 1, 1e-6);
        EXPECT_NEAR(computeOcclusion(lobe, {{0, 0, 1}, kRightAngle}), 1, 1e-6)
            << "all that is above the horizon";
        const double rest = computeOcclusion(lobe, {cone.axis * -1, std::numbers::pi - cone.half_angle});
        EXPECT_NEAR(computeOcclusion(lobe, cone) + rest, 1, 2e-4) << lobe.roughness << " " << lobe.theta_o;
    }
}

TEST(OcclusionOf, takesGrazingViewsAsALimit)
{
    for (const Masking masking : kMaskings)
        for (const double roughness : {0.089, 0.3, 1.0})
            for (const double tilt : {-1.5, 0.0, 1.2})
            {
                const Cone cone{direction(tilt, 0.3), 0.9};
                EXPECT_NEAR(computeOcclusion({roughness, kRightAngle, masking}, cone),
                            computeOcclusion({roughness, kRightAngle - 1e-5, masking}, cone), 1e-3)
                    << roughness << " " << tilt;
            }
}

TEST(OcclusionOf, tendsToTheClosedFormOfNarrowLobesSeenFromAbove)
{
    for (const double beta : {0.0, 0.02, 0.3, 0.6})
        for (const double half_angle : {0.01, 0.3, 0.6, 1.2})
            EXPECT_NEAR(computeOcclusion({0.12, 0, Masking::correlated}, {direction(beta, 1), half_angle}),
                        shared::specularCap(static_cast<float>(std::cos(half_angle)),
                                            static_cast<float>(std::cos(beta)), 0.0144f),
                        1e-3)
                << beta << " " << half_angle;
}

TEST(Table, isWithinWhatIsAskedOfDenseQuadrature)
{
    std::mt19937_64 random(5);
    for (const SpecularSpacing spacing : kSpacings)
    {
        const TableSettings settings{kMaskings[static_cast<size_t>(spacing)], 0.4, spacing};
        const TableValues values = cookTable(settings);
        std::vector<double> errors;
        for (int i = 0; i < 16; ++i)
        {
            const auto node = static_cast<uint32_t>(random() % kSpecularTexels);
            const AssumedLobe place =
                assumeLobe(formats::specularNodeRoughness(node / 16 % 16),
                           std::acos(formats::specularNodeCosBeta(node / 256, spacing)), settings);
            const Cone cone{place.axis, kRightAngle * formats::specularNodeAperture(node % 16)};
            errors.push_back(double{values[node]} - countedOcclusion(place.lobe, cone, 500));
        }
        EXPECT_LT(computeRms(errors), 5e-4);
    }
}

TEST(Table, growsWithTheAperture)
{
    for (const SpecularSpacing spacing : kSpacings)
    {
        const TableSettings settings{.spacing = spacing};
        const TableValues values = cookTable(settings);
        const formats::SpecularTableRecord record = packTable(values, settings);
        for (uint32_t i = 0; i < kSpecularTexels; ++i)
        {
            if (i % kNodes == 0)
                continue;
            EXPECT_GE(values[i], values[i - 1]) << i;
            EXPECT_GE(record.values[i], record.values[i - 1]) << i;
        }
    }
}

TEST(Table, neverFallsByMoreThanQuadratureErrs)
{
    for (uint32_t row = 0; row < kNodes * kNodes; row += 5)
    {
        const AssumedLobe place =
            assumeLobe(formats::specularNodeRoughness(row % kNodes),
                       std::acos(formats::specularNodeCosBeta(row / kNodes, SpecularSpacing::cosine)), {});
        std::vector<double> half_angles(61);
        for (size_t i = 0; i < half_angles.size(); ++i)
            half_angles[i] = kRightAngle * static_cast<double>(i) / 60;
        std::vector<double> shares(half_angles.size());
        computeOcclusions(place.lobe, place.axis, half_angles, shares);
        for (size_t i = 1; i < shares.size(); ++i)
            EXPECT_GT(shares[i], shares[i - 1] - 2e-5) << row << " " << i;
    }
}

TEST(Table, isOneWhereAHemisphereOpensAroundNormalAndLobe)
{
    for (const Masking masking : kMaskings)
    {
        const TableSettings settings{.masking = masking};
        const TableValues values = cookTable(settings);
        const formats::SpecularTableRecord record = packTable(values, settings);
        for (uint32_t roughness = 0; roughness < kNodes; ++roughness)
        {
            const uint32_t first = (15 * kNodes + roughness) * kNodes;
            EXPECT_NEAR(values[first + 15], 1, 1e-6) << roughness;
            EXPECT_EQ(record.values[first + 15], 255);
            EXPECT_EQ(record.values[first], 0) << "a closed cone";
        }
    }
}

TEST(Table, hasNoRowOfZeros)
{
    const TableValues values = cookTable({});
    for (uint32_t row = 0; row < kNodes * kNodes; ++row)
        EXPECT_GT(values[row * kNodes + 15], 0) << row;
    // grazing view, and axis along the view: half of a rough lobe reflects back
    EXPECT_GT(values[15 * kNodes + 15], 0.3f);
    EXPECT_LT(values[15 * kNodes + 15], 0.7f);
}

TEST(Table, isTheSameForAnyNumberOfThreads)
{
    const auto cook = [](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return cookTable({});
    };
    EXPECT_EQ(cook(1), cook(4));
}

TEST(LookUp, findsTheNodesAndIsLinearBetweenThem)
{
    TableValues values{};
    for (uint32_t i = 0; i < kSpecularTexels; ++i)
        values[i] = static_cast<float>(i % 16) + 100.0f * static_cast<float>(i / 16 % 16) +
                    10000.0f * static_cast<float>(i / 256);
    for (const SpecularSpacing spacing : kSpacings)
        for (const uint32_t node : {0u, 15u, 4095u, 2345u, 1111u, 3333u})
        {
            const auto find = [&](double aperture_step, double roughness_step)
            {
                return lookUp(
                    values, spacing,
                    static_cast<float>(std::cos(
                        kRightAngle * (formats::specularNodeAperture(node % 16) + aperture_step / 15))),
                    static_cast<float>(formats::specularNodeRoughness(node / 16 % 16) +
                                       roughness_step * 0.911 / 15),
                    static_cast<float>(formats::specularNodeCosBeta(node / 256, spacing)));
            };
            EXPECT_NEAR(find(0, 0), values[node], 0.5) << node;
            if (node % 16 != 15 && node / 16 % 16 != 15)
            {
                EXPECT_NEAR(find(0.5, 0.25), values[node] + 25.5f, 0.5) << node;
            }
        }
}

TEST(LookUp, staysInsideTheTable)
{
    const TableValues values = cookTable({});
    for (const float beyond : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f})
        for (const SpecularSpacing spacing : kSpacings)
        {
            const float value = lookUp(values, spacing, beyond, beyond, beyond);
            EXPECT_TRUE(value >= 0 && value <= 1) << beyond;
        }
}

TEST(PackTable, roundsToTheNearestCode)
{
    const TableSettings settings{Masking::separable, 0.78, SpecularSpacing::half_sine};
    const TableValues values = cookTable(settings);
    const formats::SpecularTableRecord record = packTable(values, settings);
    EXPECT_EQ(record.masking, 0u);
    EXPECT_EQ(record.spacing, 1u);
    EXPECT_EQ(record.normal_lambda, 0.78f);
    const TableValues again = unpackTable(record);
    for (uint32_t i = 0; i < kSpecularTexels; ++i)
        EXPECT_NEAR(again[i], values[i], 0.5001 / 255);
}

TEST(RandomConfigurations, areThoseOfTheirSeed)
{
    const std::vector<Configuration> first = randomConfigurations(100, 1);
    const std::vector<Configuration> again = randomConfigurations(100, 1);
    const std::vector<Configuration> other = randomConfigurations(100, 2);
    std::set<double> roughnesses;
    for (size_t i = 0; i < first.size(); ++i)
    {
        EXPECT_EQ(first[i].half_angle, again[i].half_angle);
        EXPECT_EQ(first[i].axis.y, again[i].axis.y);
        EXPECT_NE(first[i].theta_o, other[i].theta_o);
        EXPECT_TRUE(first[i].half_angle >= 0 && first[i].half_angle <= kRightAngle);
        EXPECT_TRUE(first[i].theta_o >= 0 && first[i].theta_o <= kRightAngle);
        EXPECT_GE(first[i].axis.z, 0.5);
        EXPECT_NEAR(length(first[i].axis), 1, 1e-12);
        roughnesses.insert(first[i].roughness);
    }
    EXPECT_EQ(roughnesses.size(), first.size());
    EXPECT_GE(*roughnesses.begin(), 0.089);
}

TEST(EncodeAstc, putsSlicesOfBetaBesideEachOther)
{
    TableValues values{};
    for (size_t node = 0; node < values.size(); ++node)
        values[node] = static_cast<float>(node / 256) / 15;
    const AstcTable table = encodeAstc(values, 4);
    ASSERT_EQ(table.blocks.size(), 64u * 4 * 16);
    for (size_t node = 0; node < values.size(); ++node)
        EXPECT_NEAR(table.decoded[node], values[node], 5e-4f);
    // each block of a slice has one value (a void-extent block without weights); its last bytes are red,
    // green, blue, alpha
    for (size_t block = 0; block < 64 * 4; ++block)
    {
        const auto at = [&](size_t byte) { return static_cast<uint32_t>(table.blocks[block * 16 + byte]); };
        EXPECT_EQ(at(0), 0xFCu);
        EXPECT_NEAR(at(8) | at(9) << 8, static_cast<double>(block % 64 / 4) * 65535 / 15, 64);
        EXPECT_EQ(at(8) | at(9) << 8, at(10) | at(11) << 8);
        EXPECT_EQ(at(14) | at(15) << 8, 0xFFFFu);
    }
}

} // namespace hearth::test
