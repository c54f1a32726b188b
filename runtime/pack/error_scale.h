// Feedback controller that coarsens drawing until the wanted pages fit the streaming budget.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cstdint>

namespace hearth::pack
{

/// Factor on the threshold of the cut, 1 .. kMaxScale. At each update it grows by an eighth of the excess of
/// wanted over budgeted bytes, by an eighth at most, and it shrinks as slowly when less than kLowWatermark of
/// the budget is wanted. Between the two it rests, so that it does not oscillate. Bytes fall with about the
/// square of the threshold: steps of an eighth do not overshoot, even if feedback is some frames late.
///
/// If the wanted bytes jump from below kLowWatermark to above the budget (levels that switch as a whole), the
/// factor rests above the jump until the wanted bytes or the budget change. After the budget has grown, the
/// factor shrinks as long as the wanted bytes fit.
class ErrorScale
{
public:
    static constexpr float kMaxScale =
        1024; ///< after ten halvings of detail, coarsening further does not help
    static constexpr float kGain = 0.125f;
    static constexpr float kLowWatermark = 0.875f;
    static constexpr float kMaxRise = 1.126f; ///< of one update, and a little for rounding
    /// maximum number of updates until a change affects the wanted bytes
    static constexpr uint32_t kMaxFeedbackUpdates = 16;

    float value() const { return value_; }

    void update(uint64_t wanted_bytes, uint64_t budget_bytes)
    {
        const float ratio =
            static_cast<float>(wanted_bytes) / static_cast<float>(std::max<uint64_t>(budget_bytes, 1));
        takeBudget(budget_bytes);
        is_recovering_ = is_recovering_ && ratio <= 1;
        // a jump leads from above the budget to below the watermark, and a rise ends less than a step
        // above it
        if ((ratio >= kLowWatermark && ratio <= 1) || value_ > over_budget_value_ * kMaxRise)
            over_budget_value_ = 0;
        const float excess = std::min(ratio - 1, is_recovering_ ? -0.5f : 1.0f);
        const float next = std::clamp(value_ * (1 + kGain * excess), 1.0f, kMaxScale);
        if (ratio > 1)
            over_budget_value_ = value_;
        if (ratio > 1 || is_recovering_ ||
            (ratio < kLowWatermark && (next > over_budget_value_ || hasDemandChanged(wanted_bytes))))
            set(next);
        ++updates_at_rest_;
    }

private:
    /// Forget what another budget did not hold. A greater one is tried down to where it is exceeded.
    void takeBudget(uint64_t bytes)
    {
        if (bytes == budget_bytes_)
            return;
        is_recovering_ = budget_bytes_ > 0 && bytes > budget_bytes_;
        over_budget_value_ = 0;
        budget_bytes_ = bytes;
    }

    void set(float value)
    {
        updates_at_rest_ = value == value_ ? updates_at_rest_ : 0;
        value_ = value;
    }

    /// True if other bytes are wanted than when the factor came to rest: pages that did not fit may fit now.
    bool hasDemandChanged(uint64_t wanted_bytes)
    {
        if (updates_at_rest_ <= kMaxFeedbackUpdates)
            demand_at_rest_ = wanted_bytes;
        if (wanted_bytes == demand_at_rest_)
            return false;
        over_budget_value_ = 0;
        return true;
    }

    float value_ = 1;
    float over_budget_value_ = 0;  ///< last value at which the wanted bytes exceeded the budget
    uint32_t updates_at_rest_ = 0; ///< updates since the last change of the value
    uint64_t demand_at_rest_ = 0;
    uint64_t budget_bytes_ = 0;  ///< of the last update
    bool is_recovering_ = false; ///< the budget has grown, and has not been exceeded since
};

} // namespace hearth::pack
