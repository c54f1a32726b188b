// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/lights/receiver_rules.h"

#include "formats/texels/shared_exponent.h"
#include "runtime/pack/receivers/receiver_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <random>

namespace hearth::bench
{

namespace
{

using receivers::KeptLight;

/// Share of the mean light below which an edge is not seen.
constexpr double kDark = 1e-3;

/// Difference between neighbours, as a share of their light, from which an edge is a real one: a change
/// of it is no false edge.
constexpr double kRealEdge = 0.02;

/// Light of all texels under some weights.
using Picture = std::vector<Double3>;

double largestChannel(Double3 v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

std::span<const Float3> lightAt(const LampAtlas& atlas, std::span<const Float3> light, size_t texel)
{
    return light.subspan(texel * atlas.lamps.size(), atlas.lamps.size());
}

/// Return the light of all texels under weights.
/// light  [texels][lamps]
Picture takePicture(const LampAtlas& atlas, std::span<const Float3> light, const LampWeights& weights)
{
    Picture picture(atlas.valid.size());
    for (size_t texel = 0; texel < picture.size(); ++texel)
    {
        Double3 sum{};
        const std::span lamps = lightAt(atlas, light, texel);
        for (size_t lamp = 0; lamp < lamps.size(); ++lamp)
            sum = sum + widen(lamps[lamp] * weights[lamp]);
        picture[texel] = sum;
    }
    return picture;
}

void addErrors(const LampAtlas& atlas, const Picture& all_on, const Picture& exact, const Picture& got,
               RuleErrors& errors)
{
    double sum = 0;
    for (size_t texel = 0; texel < exact.size(); ++texel)
    {
        const Double3 error = got[texel] - exact[texel];
        errors.squares += dot(error, error);
        errors.light += dot(exact[texel], exact[texel]);
        sum += largestChannel(all_on[texel]);
    }
    const double dark = kDark * sum / static_cast<double>(atlas.texelCount());
    for (const auto& [a, b] : atlas.neighbours)
        if (const double light = largestChannel(all_on[a]);
            light > dark && largestChannel(all_on[a] - all_on[b]) < kRealEdge * light)
            errors.jump =
                std::max(errors.jump, largestChannel((got[a] - exact[a]) - (got[b] - exact[b])) / light);
}

/// Measure a rule.
/// show  makes the picture of the rule under weights
RuleFigures measureRule(const LampAtlas& atlas, std::span<const LampWeights> draws,
                        const std::function<Picture(const LampWeights&)>& show)
{
    const LampWeights ones(atlas.lamps.size(), {1, 1, 1});
    const Picture all_on = takePicture(atlas, atlas.light, ones);
    RuleFigures figures;
    addErrors(atlas, all_on, all_on, show(ones), figures.all_on);
    for (const LampWeights& weights : draws)
        addErrors(atlas, all_on, takePicture(atlas, atlas.light, weights), show(weights), figures.random);
    return figures;
}

/// Measure a rule that keeps these lights of all texels.
/// kept  [texels][lamps]
RuleFigures measureKept(const LampAtlas& atlas, std::span<const Float3> kept,
                        std::span<const LampWeights> draws)
{
    return measureRule(atlas, draws,
                       [&](const LampWeights& weights) { return takePicture(atlas, kept, weights); });
}

/// The rule alone, in double.
RuleFigures measureChoice(const LampAtlas& atlas, const receivers::SelectOptions& options,
                          std::span<const LampWeights> draws)
{
    std::vector<Float3> kept(atlas.light.size());
    std::vector<KeptLight> lamps;
    uint64_t triples = 0, words = 0;
    for (size_t texel = 0; texel < atlas.valid.size(); ++texel)
    {
        receivers::selectLights(lightAt(atlas, atlas.light, texel), atlas.hasSteady(), options, lamps);
        for (const KeptLight& lamp : lamps)
            kept[texel * atlas.lamps.size() + lamp.lamp] = narrow(lamp.color);
        triples += (lamps.size() + 2) / 3;
        words += atlas.valid[texel] != 0 ? 1 + lamps.size() : 0;
    }
    RuleFigures figures = measureKept(atlas, kept, draws);
    const auto texels = static_cast<double>(atlas.texelCount());
    figures.triples = static_cast<double>(triples) / texels;
    figures.bytes = static_cast<double>(4 * words) / texels;
    return figures;
}

/// The reference: the three brightest lamps, the others dropped.
RuleFigures measureHardRule(const LampAtlas& atlas, std::span<const LampWeights> draws)
{
    std::vector<Float3> kept = atlas.light;
    const size_t lamps = atlas.lamps.size();
    for (size_t texel = 0; texel < atlas.valid.size(); ++texel)
    {
        std::vector<double> order;
        for (const Float3& light : lightAt(atlas, atlas.light, texel))
            order.push_back(receivers::luminance(widen(light)));
        std::vector<double> sorted = order;
        std::sort(sorted.begin(), sorted.end(), std::greater<>());
        for (size_t lamp = 0; lamp < lamps; ++lamp)
            if (order[lamp] < sorted[std::min<size_t>(2, lamps - 1)])
                kept[texel * lamps + lamp] = {};
    }
    RuleFigures figures = measureKept(atlas, kept, draws);
    figures.triples = 1;
    figures.bytes = 16;
    return figures;
}

/// The rule that ships: atlas, update and a codec.
RuleFigures measureAtlas(const LampAtlas& atlas, const receivers::AtlasOptions& options,
                         std::span<const LampWeights> draws)
{
    const receivers::Atlas packed = receivers::packAtlas(atlas.baked(), options);
    std::vector<uint32_t> texels(atlas.valid.size());
    RuleFigures figures = measureRule(
        atlas, draws,
        [&](const LampWeights& weights)
        {
            pack::updateReceivers(packed.tables(), weights, 15, texels);
            Picture picture(texels.size());
            for (size_t i = 0; i < texels.size(); ++i)
            {
                const std::array<float, 3> color = formats::decodeSharedExponent(texels[i]);
                picture[i] = widen(Float3{color[0], color[1], color[2]}) * double{packed.record.scale};
            }
            return picture;
        });
    const auto count = static_cast<double>(atlas.texelCount());
    figures.triples = static_cast<double>(packed.triple_count) / count;
    figures.bytes = static_cast<double>(packed.words.size() * sizeof(uint32_t) +
                                        packed.blocks.size() * sizeof(formats::ReceiverBlockRecord)) /
                    count;
    return figures;
}

void print(const char* rule, const RuleFigures& figures)
{
    std::printf("%-32s all on %5.2f %% rms, random weights %5.2f %% rms, jump %5.2f %%, %.2f threes, %.1f "
                "bytes a texel\n",
                rule, 100 * figures.all_on.rms(), 100 * figures.random.rms(),
                100 * std::max(figures.all_on.jump, figures.random.jump), figures.triples, figures.bytes);
}

} // namespace

size_t LampAtlas::texelCount() const
{
    return static_cast<size_t>(std::ranges::count(valid, 1));
}

bool LampAtlas::hasSteady() const
{
    return !lamps.empty() && lamps[0].kind == static_cast<uint32_t>(formats::ReceiverLampKind::steady);
}

double RuleErrors::rms() const
{
    return std::sqrt(squares / light);
}

std::vector<LampWeights> drawWeights(const LampAtlas& atlas, size_t count)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<LampWeights> draws(count, LampWeights(atlas.lamps.size()));
    for (LampWeights& weights : draws)
        for (size_t lamp = 0; lamp < weights.size(); ++lamp)
            weights[lamp] = Float3{1, 1, 1} * (lamp == 0 && atlas.hasSteady() ? 1 : unit(random));
    return draws;
}

RuleFigures compareRules(const LampAtlas& atlas, std::span<const LampWeights> draws)
{
    print("three, hard", measureHardRule(atlas, draws));
    receivers::AtlasOptions options;
    options.select.max_colors = 3;
    print("three by rank", measureAtlas(atlas, options, draws));
    options.select.max_colors = shared::kMaxReceiverColors;
    print("threshold, unrounded", measureChoice(atlas, options.select, draws));
    const RuleFigures chosen = measureAtlas(atlas, options, draws);
    print("threshold, RGB9E5", chosen);
    options.codec = formats::ReceiverCodec::rgbm;
    print("threshold, RGBM", measureAtlas(atlas, options, draws));
    return chosen;
}

} // namespace hearth::bench
