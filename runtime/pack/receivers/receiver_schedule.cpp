// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/receivers/receiver_schedule.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::pack
{

namespace
{

// Order in which groups take turns: each two of the same pair are diagonal neighbours, a checkerboard.
constexpr std::array<uint32_t, shared::kReceiverGroups> kTurns{0, 3, 1, 2};

bool isWeight(float value)
{
    return std::isfinite(value) && value >= 0;
}

} // namespace

ReceiverSchedule::ReceiverSchedule(size_t lamp_count) : weights_(lamp_count, Float3{1, 1, 1}) {}

void ReceiverSchedule::setWeight(size_t lamp, Float3 weight)
{
    HEARTH_ASSERT(lamp < weights_.size());
    HEARTH_ASSERT(isWeight(weight.x) && isWeight(weight.y) && isWeight(weight.z));
    weights_[lamp] = weight;
}

float ReceiverSchedule::measureChange(uint32_t group) const
{
    const std::vector<Float3>& shown = shown_[group];
    float change = 0;
    for (size_t lamp = 0; lamp < shown.size(); ++lamp)
        for (int c = 0; c < 3; ++c)
            change = std::max(change, std::abs(weights_[lamp][c] - shown[lamp][c]));
    return shown.size() == weights_.size() ? change : std::numeric_limits<float>::infinity();
}

uint32_t ReceiverSchedule::nextGroups()
{
    uint32_t behind = 0;
    float change = 0;
    for (uint32_t group = 0; group < shared::kReceiverGroups; ++group)
        if (shown_[group] != weights_)
        {
            behind |= 1u << group;
            change = std::max(change, measureChange(group));
        }
    if (behind == 0)
        return 0;

    while ((behind >> kTurns[next_turn_] & 1) == 0)
        next_turn_ = (next_turn_ + 1) % shared::kReceiverGroups;
    uint32_t groups = 1u << kTurns[next_turn_];
    if (change > kFullUpdateChange)
    {
        next_turn_ = shared::kReceiverGroups - 1; // turns begin again
        groups = behind;
    }
    else if (change > kHalfUpdateChange)
    {
        const uint32_t first = next_turn_ & ~1u;
        next_turn_ = first + 1; // the last of the pair: the other one is next
        groups = behind & (1u << kTurns[first] | 1u << kTurns[first + 1]);
    }
    for (uint32_t group = 0; group < shared::kReceiverGroups; ++group)
        if ((groups >> group & 1) != 0)
            shown_[group] = weights_;
    next_turn_ = (next_turn_ + 1) % shared::kReceiverGroups;
    return groups;
}

} // namespace hearth::pack
