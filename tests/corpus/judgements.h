// Files whose class in the manifest is a judgement (confidence medium) and where Hearth does otherwise, each with the
// reason. Only loading in place of rejecting, or the reverse, can stand here; an entry that is not needed is a failure.
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
    Outcome outcome = Outcome::broken; ///< what Hearth does instead
    std::string_view why;
};

inline constexpr std::span<const Judgement> kJudgements{};

} // namespace hearth::corpus
