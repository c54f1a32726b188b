// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/report.h"

#include "cook/json/json.h"
#include "cook/specular/astc.h"
#include "cook/specular/prior_art.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace hearth::specular
{

namespace
{

constexpr double kRightAngle = std::numbers::pi / 2;

/// Nodes of theta_o in the four-dimensional table: 32 KiB.
constexpr int kViewNodes = 8;

constexpr double kTalkNormalLambda = 0.78;

using Values = std::vector<double>;

ErrorFigures computeErrors(std::string name, const Values& values, const Values& exact)
{
    ErrorFigures figures;
    figures.name = std::move(name);
    const auto count = static_cast<double>(values.size());
    Values errors(values.size());
    for (size_t i = 0; i < values.size(); ++i)
    {
        const double error = values[i] - exact[i];
        figures.rms += error * error / count;
        figures.bias += error / count;
        errors[i] = std::abs(error);
    }
    figures.rms = std::sqrt(figures.rms);
    std::sort(errors.begin(), errors.end());
    figures.p95 = errors[errors.size() * 95 / 100];
    figures.largest = errors.back();
    return figures;
}

/// Evaluates all methods on one set of configurations.
class MethodEvaluator
{
public:
    MethodEvaluator(std::vector<Configuration> configurations, const TableSettings& settings)
        : configurations_(std::move(configurations)), settings_(settings)
    {
    }

    Values evaluate(const std::function<double(const Configuration&)>& method) const
    {
        Values values(configurations_.size());
        tbb::parallel_for(size_t{0}, values.size(),
                          [&](size_t i) { values[i] = method(configurations_[i]); });
        return values;
    }

    Values exact() const
    {
        return evaluate([&](const Configuration& c) { return exactOcclusion(c, settings_.masking); });
    }

    /// Evaluate a table of three dimensions with infinitely many nodes.
    Values idealTable(double normal_lambda) const
    {
        TableSettings settings = settings_;
        settings.normal_lambda = normal_lambda;
        return evaluate(
            [settings](const Configuration& c)
            {
                const double beta = std::acos(std::clamp(cosBeta(c), -1.0, 1.0));
                const AssumedLobe place = assumeLobe(c.roughness, beta, settings);
                return computeOcclusion(place.lobe, {place.axis, c.half_angle});
            });
    }

    /// Evaluate a table with 16 nodes in each dimension, linear between them; `rounded`: to 8 bits.
    Values table(double normal_lambda, SpecularSpacing spacing, bool rounded) const
    {
        const TableSettings settings{settings_.masking, normal_lambda, spacing};
        TableValues values = cookTable(settings);
        if (rounded)
            values = unpackTable(packTable(values, settings));
        return lookUpAll(values, spacing);
    }

    Values lookUpAll(const TableValues& values, SpecularSpacing spacing) const
    {
        return evaluate([&](const Configuration& c) { return double{tableOcclusion(c, values, spacing)}; });
    }

    /// Evaluate with the given theta_o; the normal lies in the plane of reflection vector and axis, on the
    /// side of the axis.
    double keepingTheta(double half_angle, double roughness, double theta_o, double beta) const
    {
        const double tilt = theta_o - beta;
        return computeOcclusion({roughness, theta_o, settings_.masking},
                                {{std::sin(tilt), 0, std::cos(tilt)}, half_angle});
    }

    Values idealKeepingTheta() const
    {
        return evaluate(
            [this](const Configuration& c) {
                return keepingTheta(c.half_angle, c.roughness, c.theta_o,
                                    std::acos(std::clamp(cosBeta(c), -1.0, 1.0)));
            });
    }

    /// Evaluate the same by interpolation between the sixteen nodes around each configuration.
    Values tableKeepingTheta() const
    {
        return evaluate([this](const Configuration& c) { return lookUpKeepingTheta(c); });
    }

private:
    double lookUpKeepingTheta(const Configuration& c) const
    {
        const Float3 place = shared::specularTableCoordinates(
            static_cast<float>(std::cos(c.half_angle)), static_cast<float>(c.roughness),
            static_cast<float>(cosBeta(c)), static_cast<shared::uint>(settings_.spacing));
        const std::array<double, 4> at{
            double{place.x} * (shared::kSpecularNodes - 1), double{place.y} * (shared::kSpecularNodes - 1),
            double{place.z} * (shared::kSpecularNodes - 1), c.theta_o / kRightAngle * (kViewNodes - 1)};
        double sum = 0;
        for (uint32_t corner = 0; corner < 16; ++corner)
        {
            std::array<uint32_t, 4> node{};
            double weight = 1;
            for (uint32_t axis = 0; axis < 4; ++axis)
            {
                const uint32_t last = axis == 3 ? kViewNodes - 1 : shared::kSpecularNodes - 1;
                const uint32_t first = std::min(static_cast<uint32_t>(at[axis]), last - 1);
                const uint32_t step = corner >> axis & 1;
                const double part = at[axis] - first;
                node[axis] = first + step;
                weight *= step == 1 ? part : 1 - part;
            }
            if (weight > 0)
                sum += weight *
                       keepingTheta(kRightAngle * formats::specularNodeAperture(node[0]),
                                    formats::specularNodeRoughness(node[1]),
                                    kRightAngle * node[3] / (kViewNodes - 1),
                                    std::acos(formats::specularNodeCosBeta(node[2], settings_.spacing)));
        }
        return sum;
    }

    std::vector<Configuration> configurations_;
    TableSettings settings_;
};

void compareMethods(const MethodEvaluator& evaluator, const Values& exact, double lambda,
                    std::vector<ErrorFigures>& methods)
{
    const auto add = [&](std::string name, const Values& values)
    { methods.push_back(computeErrors(std::move(name), values, exact)); };
    add("fit, no table", evaluator.evaluate([](const Configuration& c) { return double{fitOcclusion(c)}; }));
    add(fmt::format("table, cosine, normal lambda {}", lambda),
        evaluator.table(lambda, SpecularSpacing::cosine, true));
    add(fmt::format("table, half sine, normal lambda {}", lambda),
        evaluator.table(lambda, SpecularSpacing::half_sine, true));
    const Values talk = evaluator.table(kTalkNormalLambda, SpecularSpacing::cosine, true);
    add(fmt::format("table, cosine, normal lambda {}", kTalkNormalLambda), talk);
    const Values tilts = evaluator.evaluate([](const Configuration& c) { return std::max(c.axis.z, 0.0); });
    Values darkened(talk.size());
    std::transform(talk.begin(), talk.end(), tilts.begin(), darkened.begin(), std::multiplies<>());
    add("the same times dot(axis, normal): the talk's shader", darkened);
    add("table of four dimensions, 32 KiB, theta_o kept", evaluator.tableKeepingTheta());
    add("four dimensions, without interpolation", evaluator.idealKeepingTheta());
    for (int tenths = 0; tenths <= 10; ++tenths)
        add(fmt::format("three dimensions, without interpolation, normal lambda {:.1f}", tenths / 10.0),
            evaluator.idealTable(tenths / 10.0));
    add(fmt::format("three dimensions, without interpolation, normal lambda {}", kTalkNormalLambda),
        evaluator.idealTable(kTalkNormalLambda));
    add("two cones, smoothstep", evaluator.evaluate(coneOverlapOcclusion));
    add("ambient occlusion alone", evaluator.evaluate(occlusionFromAmbient));
}

void compareInterpolations(const MethodEvaluator& evaluator, double lambda, std::vector<ErrorFigures>& list)
{
    const Values ideal = evaluator.idealTable(lambda);
    list.push_back(computeErrors("cosine", evaluator.table(lambda, SpecularSpacing::cosine, false), ideal));
    list.push_back(
        computeErrors("cosine, 8 bits", evaluator.table(lambda, SpecularSpacing::cosine, true), ideal));
    list.push_back(
        computeErrors("half sine", evaluator.table(lambda, SpecularSpacing::half_sine, false), ideal));
    list.push_back(
        computeErrors("half sine, 8 bits", evaluator.table(lambda, SpecularSpacing::half_sine, true), ideal));
    list.push_back(
        computeErrors("four dimensions", evaluator.tableKeepingTheta(), evaluator.idealKeepingTheta()));
}

/// Compare the table as a texture: its nodes, and lookups in it.
void compareAstc(const MethodEvaluator& evaluator, const Values& exact, const TableSettings& settings,
                 Comparison& comparison)
{
    const TableValues values = cookTable(settings);
    for (const uint32_t block : kAstcBlocks)
    {
        const AstcTable astc = encodeAstc(values, block);
        const std::string name = fmt::format("ASTC, {0} x {0}, {1} bytes", block, astc.blocks.size());
        comparison.astc.push_back(
            computeErrors(name, {astc.decoded.begin(), astc.decoded.end()}, {values.begin(), values.end()}));
        comparison.methods.push_back(computeErrors(
            "the table as " + name, evaluator.lookUpAll(astc.decoded, settings.spacing), exact));
    }
}

/// Compare some nodes of the table with a quadrature whose error is far below the error allowed for the
/// table.
void measureNodes(const TableSettings& settings, Comparison& comparison)
{
    constexpr uint32_t kStride = 37; // coprime to 16: nodes of all kinds
    const TableValues values = cookTable(settings);
    std::vector<double> errors((values.size() + kStride - 1) / kStride);
    tbb::parallel_for(
        size_t{0}, errors.size(),
        [&](size_t i)
        {
            const auto node = static_cast<uint32_t>(i * kStride);
            const AssumedLobe place =
                assumeLobe(formats::specularNodeRoughness(node / 16 % 16),
                           std::acos(formats::specularNodeCosBeta(node / 256, settings.spacing)), settings);
            const double fine = computeOcclusion(
                place.lobe, {place.axis, kRightAngle * formats::specularNodeAperture(node % 16)},
                {.outer = 128, .inner = 96});
            errors[i] = std::abs(double{values[node]} - fine);
        });
    const double squares = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
    comparison.quadrature_rms = std::sqrt(squares / static_cast<double>(errors.size()));
    comparison.quadrature_largest = *std::max_element(errors.begin(), errors.end());
}

const char* optionName(Masking masking)
{
    return masking == Masking::separable ? "separable" : "correlated";
}

const char* optionName(SpecularSpacing spacing)
{
    return spacing == SpecularSpacing::cosine ? "cosine" : "half-sine";
}

std::string tableText(std::string_view title, const std::vector<ErrorFigures>& list)
{
    std::string text = fmt::format("{:<64}{:>8}{:>9}{:>8}{:>8}\n", title, "rms", "bias", "p95", "max");
    for (const ErrorFigures& figures : list)
        text += fmt::format("{:<64}{:>8.4f}{:>+9.4f}{:>8.4f}{:>8.4f}\n", figures.name, figures.rms,
                            figures.bias, figures.p95, figures.largest);
    return text;
}

Json tableJson(const std::vector<ErrorFigures>& list)
{
    Json array = Json::array();
    for (const ErrorFigures& figures : list)
        array.push_back({{"name", figures.name},
                         {"rms", figures.rms},
                         {"bias", figures.bias},
                         {"p95", figures.p95},
                         {"max", figures.largest}});
    return array;
}

} // namespace

Comparison compare(const TableSettings& settings, size_t configuration_count, uint64_t seed)
{
    HEARTH_ASSERT(configuration_count > 0);
    Comparison comparison;
    comparison.settings = settings;
    comparison.configuration_count = configuration_count;
    const MethodEvaluator evaluator(randomConfigurations(configuration_count, seed), settings);
    const Values exact = evaluator.exact();
    compareMethods(evaluator, exact, settings.normal_lambda, comparison.methods);
    compareAstc(evaluator, exact, settings, comparison);
    compareInterpolations(evaluator, settings.normal_lambda, comparison.interpolations);
    measureNodes(settings, comparison);
    return comparison;
}

std::string comparisonText(const Comparison& comparison)
{
    return fmt::format("{} random configurations, {} masking, table spaced by {}\n\n",
                       comparison.configuration_count, optionName(comparison.settings.masking),
                       optionName(comparison.settings.spacing)) +
           tableText("against the exact value", comparison.methods) + "\n" +
           tableText("nodes of textures, against the table", comparison.astc) + "\n" +
           tableText("interpolation: against what the nodes are taken from", comparison.interpolations) +
           fmt::format("\nnodes against a finer quadrature, before rounding: rms {:.1e}, max {:.1e}\n",
                       comparison.quadrature_rms, comparison.quadrature_largest);
}

std::string comparisonJson(const Comparison& comparison, double cook_seconds)
{
    const Json document{{"schema", "hearth.specular/1"},
                        {"masking", optionName(comparison.settings.masking)},
                        {"normal_lambda", comparison.settings.normal_lambda},
                        {"spacing", optionName(comparison.settings.spacing)},
                        {"cook_seconds", cook_seconds},
                        {"configurations", comparison.configuration_count},
                        {"ways", tableJson(comparison.methods)},
                        {"astc", tableJson(comparison.astc)},
                        {"interpolation", tableJson(comparison.interpolations)},
                        {"nodes_rms", comparison.quadrature_rms},
                        {"nodes_max", comparison.quadrature_largest}};
    return document.dump(2) + "\n";
}

} // namespace hearth::specular
