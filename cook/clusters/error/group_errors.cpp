// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/group_errors.h"

#include "cook/clusters/core/bounds.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hearth::clusters
{

namespace
{

double square(double x)
{
    return x * x;
}

} // namespace

GroupErrors rootErrors()
{
    return {std::numeric_limits<float>::infinity(), 0, {}};
}

void ErrorAccumulator::add(const GroupErrors& errors, uint32_t triangles)
{
    HEARTH_ASSERT(errors.lod >= 0 && errors.position >= 0 && triangles > 0);
    largest_.lod = std::max(largest_.lod, errors.lod);
    largest_.position = std::max(largest_.position, errors.position);
    largest_.attributes.normal = std::max(largest_.attributes.normal, errors.attributes.normal);
    largest_.attributes.uv = std::max(largest_.attributes.uv, errors.attributes.uv);
    normal2_ += triangles * square(double{errors.attributes.normal});
    uv2_ += triangles * square(double{errors.attributes.uv});
    triangles_ += triangles;
}

GroupErrors ErrorAccumulator::errorsOfReplacement(const Replacement& replacement, const Config& config) const
{
    // each level loses finer waves than the next one: such waves add up by their squares
    const double count = std::max(triangles_, 1.0);
    const AttributeError& step = replacement.attributes.error;
    const double normal = std::sqrt(normal2_ / count + square(double{step.normal}));
    const double uv = std::sqrt(uv2_ / count + square(double{step.uv}));
    constexpr double kHalfTurn{std::numbers::pi_v<float>};
    return errorsWith({static_cast<float>(std::min(normal, kHalfTurn)), roundUp(uv)}, replacement, config);
}

GroupErrors ErrorAccumulator::errorsAgainstSource(const Replacement& replacement, const Config& config) const
{
    return errorsWith(replacement.attributes.error, replacement, config);
}

GroupErrors ErrorAccumulator::errorsWith(const AttributeError& attributes, const Replacement& replacement,
                                         const Config& config) const
{
    HEARTH_ASSERT(replacement.distance >= 0 && replacement.weight >= 1);
    GroupErrors errors;
    errors.attributes = {std::max(attributes.normal, largest_.attributes.normal),
                         std::max(attributes.uv, largest_.attributes.uv)};
    const auto distance = double{replacement.distance};
    errors.position = roundUp(std::max(distance, double{largest_.position}) * kMonotoneSlack);
    const double wave =
        double{attributes.normal} * double{replacement.attributes.edge_length} / (2 * std::numbers::pi);
    const double lod = std::max({distance, double{config.normal_error_weight} * wave,
                                 double{config.uv_error_weight} * double{attributes.uv}});
    errors.lod = roundUp(std::max(lod * double{replacement.weight}, double{largest_.lod}) * kMonotoneSlack);
    HEARTH_ASSERT(errors.lod >= largest_.lod && errors.position >= largest_.position);
    return errors;
}

} // namespace hearth::clusters
