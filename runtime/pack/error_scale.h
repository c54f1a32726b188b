// How much coarser than asked to draw, so that what is wanted fits the budget.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cstdint>

namespace hearth::pack
{

/// A factor on the threshold of the cut, 1 .. kMost. It grows by an eighth of the excess of wanted over budgeted bytes
/// at each update, by an eighth at most, and shrinks as slowly when less than kRoom of the budget is wanted. Between the
/// two it rests, so that it does not swing about the budget. Bytes fall with about the square of the threshold: an
/// eighth at a time stays well below what would overshoot, even where feedback is some frames late.
/// Where what is wanted jumps from below kRoom to above the budget (levels that switch as a whole), it rests above the
/// jump for as long as the same is wanted.
class ErrorScale
{
public:
    static constexpr float kMost = 1024; ///< past ten halvings of detail, waiting for room does not help
    static constexpr float kGain = 0.125f;
    static constexpr float kRoom = 0.875f;
    static constexpr uint32_t kFeedback =
        16; ///< updates until a change has come back as other bytes, at most

    float value() const { return value_; }

    void update(uint64_t wanted_bytes, uint64_t budget_bytes)
    {
        const float ratio =
            static_cast<float>(wanted_bytes) / static_cast<float>(std::max<uint64_t>(budget_bytes, 1));
        const float next = std::clamp(value_ * (1 + kGain * std::min(ratio - 1, 1.0f)), 1.0f, kMost);
        if (ratio > 1)
            too_fine_ = value_;
        if (ratio > 1 || (ratio < kRoom && (next > too_fine_ || wantsOther(wanted_bytes))))
            set(next);
        ++rested_;
    }

private:
    void set(float value)
    {
        rested_ = value == value_ ? rested_ : 0;
        value_ = value;
    }

    /// Other bytes than when it came to rest, so that what did not fit may fit now.
    bool wantsOther(uint64_t wanted_bytes)
    {
        if (rested_ <= kFeedback)
            rest_wanted_ = wanted_bytes;
        if (wanted_bytes == rest_wanted_)
            return false;
        too_fine_ = 0;
        return true;
    }

    float value_ = 1;
    float too_fine_ = 0;  ///< the last value at which more was wanted than fits
    uint32_t rested_ = 0; ///< updates since the value changed
    uint64_t rest_wanted_ = 0;
};

} // namespace hearth::pack
