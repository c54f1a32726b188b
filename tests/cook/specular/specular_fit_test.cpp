// Compares the fit that the shader evaluates with exact values, and tests the search for its constants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/specular/fit.h"
#include "cook/specular/report.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace hearth::test
{

using namespace specular;

namespace
{

double rms(const std::vector<Configuration>& configurations, const std::vector<double>& exact,
           const auto& way)
{
    double sum = 0;
    for (size_t i = 0; i < exact.size(); ++i)
        sum += std::pow(double{way(configurations[i])} - exact[i], 2);
    return std::sqrt(sum / static_cast<double>(exact.size()));
}

/// Visible share as a function of angles, as in the comment beside specularCap.
double capInAngles(double half_angle, double beta, double width)
{
    const auto u = [&](double x) { return std::atan2(std::sin(x / 2), width * std::cos(x / 2)); };
    return std::pow(std::sin((u(beta + half_angle) - u(beta - half_angle)) / 2), 2);
}

} // namespace

TEST(SpecularCap, isTheFormInAngles)
{
    for (const double width : {0.008, 0.1, 0.5, 1.0})
        for (double half_angle = 0; half_angle < 1.6; half_angle += 0.05)
            for (double beta = 0; beta < 3.1; beta += 0.1)
                EXPECT_NEAR(shared::specularCap(static_cast<float>(std::cos(half_angle)),
                                                static_cast<float>(std::cos(beta)),
                                                static_cast<float>(width)),
                            capInAngles(half_angle, beta, width), width < 0.05 ? 2e-3 : 2e-5)
                    << half_angle << " " << beta << " " << width;
}

TEST(SpecularFit, isCloserThanTheTableForEitherMasking)
{
    for (const Masking masking : {Masking::separable, Masking::correlated})
    {
        const std::vector<Configuration> configurations =
            randomConfigurations(1000, 101 + static_cast<uint64_t>(masking));
        std::vector<double> exact;
        for (const Configuration& configuration : configurations)
            exact.push_back(exactOcclusion(configuration, masking));
        const double fit = rms(configurations, exact, [](const Configuration& c) { return fitOcclusion(c); });
        EXPECT_LT(fit, 0.025) << "0.035 is asked";
        for (const SpecularSpacing spacing : {SpecularSpacing::cosine, SpecularSpacing::half_sine})
        {
            const TableSettings settings{.masking = masking, .spacing = spacing};
            const TableValues values = unpackTable(packTable(cookTable(settings), settings));
            const double table =
                rms(configurations, exact,
                    [&](const Configuration& c) { return tableOcclusion(c, values, spacing); });
            EXPECT_LT(fit, table / 2);
            EXPECT_LT(table, 0.09);
        }
    }
}

TEST(SpecularFit, isAShareEverywhere)
{
    constexpr float kPlaces[] = {-1, -0.5f, 0, 1e-6f, 0.3f, 0.999999f, 1, 1.0000001f};
    for (const float aperture : kPlaces)
        for (const float roughness : {0.0f, 0.089f, 0.5f, 1.0f})
            for (const float view : kPlaces)
                for (const float normal : kPlaces)
                    for (const float mirror : kPlaces)
                    {
                        const float share =
                            shared::specularOcclusionFit(aperture, roughness, view, normal, mirror);
                        EXPECT_TRUE(share >= 0 && share <= 1) << share;
                    }
}

TEST(SpecularFit, isOneForTheOpenHemisphere)
{
    for (const float roughness : {0.089f, 0.4f, 1.0f})
        for (const float view : {0.0f, 0.2f, 0.9f, 1.0f})
            EXPECT_NEAR(shared::specularOcclusionFit(0, roughness, view, 1, view), 1, 1e-5f);
    EXPECT_EQ(shared::specularOcclusionFit(1, 0.5f, 0.5f, 1, 0.5f), 0) << "a closed cone";
}

TEST(SpecularFit, hardlyEverFallsWhileTheConeOpens)
{
    for (Configuration configuration : randomConfigurations(300, 103))
    {
        float highest = 0;
        for (int step = 0; step <= 60; ++step)
        {
            configuration.half_angle = std::numbers::pi / 2 * step / 60;
            const float share = fitOcclusion(configuration);
            EXPECT_GT(share, highest - 0.02f);
            highest = std::max(highest, share);
        }
    }
}

TEST(ConstantsFit, findsThatTheHeadersConstantsAreAsGoodAsAny)
{
    const ConstantsFit found = fitConstants(1500, 7, Masking::correlated);
    EXPECT_LE(found.rms, found.start_rms);
    EXPECT_GT(found.rms, 0.97 * found.start_rms) << "run hearth-specular --fit";
    const ConstantsFit again = fitConstants(1500, 7, Masking::correlated);
    EXPECT_EQ(formatConstants(found.constants), formatConstants(again.constants));
    EXPECT_EQ(formatConstants(shared::kSpecularFit).substr(0, 20), "SpecularFit(-0.4416f");
}

TEST(Compare, hasTheWaysInTheirOrderOfMerit)
{
    const Comparison comparison = compare({}, 100, 3);
    const auto rms_of = [&](const std::string& start)
    {
        for (const ErrorFigures& figures : comparison.methods)
            if (figures.name.starts_with(start))
                return figures.rms;
        ADD_FAILURE() << start;
        return 0.0;
    };
    EXPECT_LT(rms_of("fit"), rms_of("four dimensions"));
    EXPECT_LT(rms_of("four dimensions"), rms_of("three dimensions"));
    EXPECT_LT(rms_of("table, half sine"), rms_of("table, cosine"));
    EXPECT_LT(rms_of("table, cosine"), rms_of("the same times dot"));
    EXPECT_LT(rms_of("the same times dot"), rms_of("ambient"));
    EXPECT_LT(comparison.quadrature_rms, 5e-4);
    EXPECT_GT(comparison.quadrature_largest, 0);

    const Json json = Json::parse(comparisonJson(comparison, 0.5)).value();
    EXPECT_EQ(json["schema"], "hearth.specular/1");
    EXPECT_EQ(json["masking"], "correlated");
    EXPECT_EQ(json["ways"].size(), comparison.methods.size());
    EXPECT_EQ(json["interpolation"][0]["name"], "cosine");
    EXPECT_NE(comparisonText(comparison).find("fit, no table"), std::string::npos);
}

} // namespace hearth::test
