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
class ErrorScale
{
public:
    static constexpr float kMost = 1024; ///< past ten halvings of detail, waiting for room does not help
    static constexpr float kGain = 0.125f;
    static constexpr float kRoom = 0.875f;

    float value() const { return value_; }

    void update(uint64_t wanted_bytes, uint64_t budget_bytes)
    {
        const float ratio =
            static_cast<float>(wanted_bytes) / static_cast<float>(std::max<uint64_t>(budget_bytes, 1));
        if (ratio > 1 || ratio < kRoom)
            value_ = std::clamp(value_ * (1 + kGain * std::min(ratio - 1, 1.0f)), 1.0f, kMost);
    }

private:
    float value_ = 1;
};

} // namespace hearth::pack
