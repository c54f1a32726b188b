// Rules by which texels of receivers keep lamps, and their errors under random weights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/select/atlas.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace hearth::bench
{

/// Atlas with the light of each lamp, as it is before a rule chooses.
struct LampAtlas
{
    uint32_t width = 0, height = 0;
    std::vector<formats::ReceiverLampRecord> lamps; ///< steady light is the first or absent
    std::vector<formats::ReceiverRectRecord> rects; ///< by rising instance
    std::vector<uint8_t> valid;                     ///< [width * height]
    std::vector<Float3> light;                      ///< [width * height][lamps]
    /// Texels that are seen side by side, by index: a difference between their errors is a false edge.
    std::vector<std::pair<uint32_t, uint32_t>> neighbours;

    size_t texelCount() const;
    bool hasSteady() const;
    receivers::BakedLight baked() const { return {width, height, lamps, rects, valid, light}; }
};

/// Weights of all lamps.
using LampWeights = std::vector<Float3>;

/// Draw weights from 0 to 1, one for all channels of a lamp; steady light has 1.
std::vector<LampWeights> drawWeights(const LampAtlas& atlas, size_t count);

/// Errors of a rule.
struct RuleErrors
{
    double squares = 0, light = 0; ///< sums over texels and weights
    /// Largest difference of the error between neighbours of about the same light, as a share of it.
    double jump = 0;

    double rms() const;
};

/// Figures of a rule.
struct RuleFigures
{
    RuleErrors all_on, random;
    double triples = 0; ///< records of three colours a texel
    double bytes = 0;   ///< a texel
};

/// Print the figures of all rules: that of the reference, which keeps the three brightest lamps, that of
/// three by rank, and the one that ships, unrounded and in both codecs.
/// returns  those of the one that ships, in RGB9E5
RuleFigures compareRules(const LampAtlas& atlas, std::span<const LampWeights> draws);

} // namespace hearth::bench
