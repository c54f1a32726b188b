// Compares a finding with its class and the written judgements.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/corpus/judgements.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::corpus
{

enum class Verdict
{
    passed,
    judged, ///< deviates from its class for a written reason
    failed,
};

struct Checked
{
    const Asset* asset = nullptr;
    Finding finding;
    Verdict verdict = Verdict::failed;
    std::string_view why; ///< reason of the judgement
};

/// Judge `finding` of `asset`. A judgement excuses loading in place of rejecting, or the reverse, if the
/// class's confidence is medium; a judgement that excuses nothing is itself a fault.
Checked judge(const Asset& asset, Finding finding, std::span<const Judgement> judgements);

/// Return the judgements of files that are not in the manifest.
std::vector<std::string> strayJudgements(std::span<const Asset> assets,
                                         std::span<const Judgement> judgements);

} // namespace hearth::corpus
