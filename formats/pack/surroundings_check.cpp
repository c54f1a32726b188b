// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/pack/check_tools.h"

namespace hearth::formats::check
{

namespace
{

bool isFiniteHalf(uint16_t half)
{
    return (half >> 10 & 31) != 31;
}

} // namespace

Status checkSurroundings(const PackView& view)
{
    const std::span<const SurroundingsRecord> records = view.surroundings();
    const bool is_baked = !records.empty() || !view.radianceTransfers().empty();
    if (is_baked && records.size() != view.instances().size())
        return makeError(view, Issue::meaning_range, "surroundings", records.size(),
                         "there are " + std::to_string(view.instances().size()) + " instances");
    for (size_t i = 0; i < records.size(); ++i)
    {
        if (!isNoneOrBelow(records[i].transfer, view.radianceTransfers().size()))
            return makeError(view, Issue::meaning_reference, "surroundings", i,
                             "radiance transfer " + std::to_string(records[i].transfer));
        if (!std::ranges::all_of(records[i].visibility, isFiniteHalf))
            return makeError(view, Issue::meaning_value, "surroundings", i, "a factor is not finite");
    }
    for (size_t i = 0; i < view.radianceTransfers().size(); ++i)
        if (!std::ranges::all_of(view.radianceTransfers()[i].values, isFiniteHalf))
            return makeError(view, Issue::meaning_value, "radiance transfer", i, "a value is not finite");
    return success();
}

} // namespace hearth::formats::check
