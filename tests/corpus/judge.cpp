// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/judge.h"

#include <algorithm>

namespace hearth::corpus
{

namespace
{

bool allows(const AssetClass& expected, Outcome outcome)
{
    return (outcome == Outcome::loads && expected.may_load) ||
           (outcome == Outcome::rejects && expected.may_reject);
}

} // namespace

Checked judge(const Asset& asset, Finding finding, std::span<const Judgement> judgements)
{
    Checked checked{&asset, std::move(finding), Verdict::failed, {}};
    const auto judgement = std::find_if(judgements.begin(), judgements.end(),
                                        [&](const Judgement& entry) { return entry.file == asset.file; });
    const bool as_asked = allows(*asset.expected, checked.finding.outcome);
    if (judgement == judgements.end())
    {
        checked.verdict = as_asked ? Verdict::passed : Verdict::failed;
        return checked;
    }
    checked.why = judgement->why;
    if (asset.confidence != Confidence::medium)
        checked.finding.faults.push_back("has a judgement, and its class is certain");
    else if (as_asked)
        checked.finding.faults.push_back("has a judgement, and meets its class without");
    else if (checked.finding.outcome != judgement->outcome)
        checked.finding.faults.push_back("has a judgement that says: " +
                                         std::string(outcomeName(judgement->outcome)));
    else
        checked.verdict = Verdict::judged;
    return checked;
}

std::vector<std::string> strayJudgements(std::span<const Asset> assets, std::span<const Judgement> judgements)
{
    std::vector<std::string> stray;
    for (const Judgement& judgement : judgements)
        if (std::none_of(assets.begin(), assets.end(),
                         [&](const Asset& asset) { return asset.file == judgement.file; }))
            stray.emplace_back(judgement.file);
    return stray;
}

} // namespace hearth::corpus
