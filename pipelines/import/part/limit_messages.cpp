// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/limit_messages.h"

#include "pipelines/import/part/import_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hearth::import
{

std::string describeExcess(uint64_t count, std::string_view things, uint64_t limit)
{
    return fmt::format("{} {}, at most {} are read", count, things, limit);
}

std::optional<size_t> findBadPosition(std::span<const Float3> positions)
{
    // a comparison with NaN is false
    const auto isGood = [](Float3 p)
    {
        return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
               std::abs(p.z) <= kMaxCoordinate;
    };
    const auto bad = std::find_if_not(positions.begin(), positions.end(), isGood);
    return bad == positions.end() ? std::nullopt
                                  : std::optional(static_cast<size_t>(bad - positions.begin()));
}

std::string describeBadPosition(Float3 position)
{
    const std::string text = fmt::format("({:g}, {:g}, {:g})", position.x, position.y, position.z);
    return isFinite(position) ? fmt::format("{}, coordinates go up to {:g}", text, kMaxCoordinate)
                              : text + ", which is not finite";
}

} // namespace hearth::import
