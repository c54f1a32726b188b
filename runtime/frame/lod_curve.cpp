// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/lod_curve.h"

#include <cmath>
#include <limits>
#include <string>

namespace hearth::shared
{

namespace
{

// Maximum ratio of neighbouring factors: the rounding of the larger one must stay below the growth of group
// errors towards the root (2^-18).
constexpr float kMaxFactorRatio = 8.0f;

std::string findFault(std::span<const LodKnot> curve)
{
    if (curve.size() > kMaxLodKnots)
        return "has " + std::to_string(curve.size()) + " knots, the most are " + std::to_string(kMaxLodKnots);
    for (size_t i = 0; i < curve.size(); ++i)
    {
        const auto [distance, factor] = curve[i];
        const std::string knot = "knot " + std::to_string(i + 1);
        if (!std::isfinite(distance) || !std::isfinite(factor) || distance < 0 || !(factor > 0))
            return knot + " is not a distance from 0 and a factor above 0";
        if (i == 0)
            continue;
        const auto [distance_before, factor_before] = curve[i - 1];
        if (!(distance > distance_before))
            return knot + " is no farther away than the one before it";
        if (factor > kMaxFactorRatio * factor_before || factor_before > kMaxFactorRatio * factor)
            return knot + " differs from the one before it by more than 8 times";
        // the factor over the distance must not grow; on a line between knots it does not grow if it does not
        // from end to end
        if (double{factor} * double{distance_before} > double{factor_before} * double{distance})
            return knot + " grows faster than the distance";
    }
    return {};
}

} // namespace

Status setLodCurve(FrameView& view, std::span<const LodKnot> curve)
{
    if (const std::string fault = findFault(curve); !fault.empty())
        return Error{Issue::usage, "", "", "the LOD curve: " + fault};
    const LodKnot one{0, 1};
    if (curve.empty())
        curve = {&one, 1};
    for (size_t i = 0; i < kMaxLodKnots; ++i)
    {
        const bool is_knot = i < curve.size();
        const bool last = i + 1 >= curve.size();
        const LodKnot& knot = curve[is_knot ? i : curve.size() - 1];
        // x: start of the segment, y and z: factor at its start and end, w: 1 / its length
        view.lod_curve[i] = {is_knot ? knot.distance : std::numeric_limits<float>::max(), knot.factor,
                             last ? knot.factor : curve[i + 1].factor,
                             last ? 0.0f : 1.0f / (curve[i + 1].distance - knot.distance)};
    }
    return success();
}

} // namespace hearth::shared
