// Files whose class in the manifest has medium confidence and from which Hearth deviates, each with the
// reason. Only loading in place of rejecting, or the reverse, can be listed; an entry that is not needed is a
// failure.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/corpus/check_asset.h"

#include <span>
#include <string_view>

namespace hearth::corpus
{

struct Judgement
{
    std::string_view file;
    Outcome outcome = Outcome::broken; ///< actual outcome in Hearth
    std::string_view why;
};

inline constexpr std::span<const Judgement> kJudgements{};

} // namespace hearth::corpus
