// Holds a finding against its class and the written judgements.
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
    judged, ///< otherwise than its class, for a written reason
    failed,
};

struct Checked
{
    const Asset* asset = nullptr;
    Finding finding;
    Verdict verdict = Verdict::failed;
    std::string_view why; ///< of the judgement
};

/// `finding` of `asset`. A judgement excuses loading in place of rejecting, or the reverse, where the class's
/// confidence is medium; one that excuses nothing is itself a fault.
Checked judge(const Asset& asset, Finding finding, std::span<const Judgement> judgements);

/// The judgements of files that are not in the manifest.
std::vector<std::string> strayJudgements(std::span<const Asset> assets,
                                         std::span<const Judgement> judgements);

} // namespace hearth::corpus
