// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/report.h"

#include "tests/corpus/read_text.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace hearth::corpus
{

namespace
{

constexpr size_t kReportedSlowest = 10;

const char* className(const Checked& checked)
{
    return checked.asset->expected->name.data();
}

void printHead(const char* what, const Checked& checked)
{
    std::printf("%s %s  (%s, %s)\n", what, checked.asset->file.c_str(), className(checked),
                confidenceName(checked.asset->confidence));
}

/// Replace control characters: the programs' output contains text of untrusted assets.
std::string printable(const std::string& text)
{
    std::string result;
    for (const char c : text)
    {
        char escape[8];
        std::snprintf(escape, sizeof(escape), "\\x%02x",
                      static_cast<unsigned>(static_cast<unsigned char>(c)));
        result += isControlCharacter(c) ? escape : std::string(1, c);
    }
    return result;
}

long countVerdicts(std::span<const Checked> all, const AssetClass& expected, Confidence confidence,
                   Verdict verdict)
{
    return std::count_if(all.begin(), all.end(),
                         [&](const Checked& checked)
                         {
                             return checked.asset->expected == &expected &&
                                    checked.asset->confidence == confidence && checked.verdict == verdict;
                         });
}

} // namespace

void printFailures(std::span<const Checked> all)
{
    for (const Checked& checked : all)
    {
        if (checked.verdict != Verdict::failed)
            continue;
        printHead("FAILED", checked);
        for (const std::string& fault : checked.finding.faults)
            std::printf("    %s\n", fault.c_str());
        for (const std::string& line : checked.finding.messages)
            std::printf("    | %s\n", printable(line).c_str());
    }
}

void printMedium(std::span<const Checked> all)
{
    for (const Checked& checked : all)
    {
        if (checked.asset->confidence != Confidence::medium || checked.verdict == Verdict::passed)
            continue;
        printHead("medium", checked);
        std::printf("    %s: %s\n", outcomeName(checked.finding.outcome),
                    checked.why.empty() ? "no judgement is written" : checked.why.data());
    }
}

void printSlowest(std::span<const Checked> all)
{
    std::vector<const Checked*> slowest;
    for (const Checked& checked : all)
        slowest.push_back(&checked);
    std::stable_sort(slowest.begin(), slowest.end(),
                     [](const Checked* a, const Checked* b)
                     { return a->finding.total_seconds > b->finding.total_seconds; });
    slowest.resize(std::min(slowest.size(), kReportedSlowest));
    std::printf("%10s %10s %10s  slowest\n", "seconds", "cook", "peak MiB");
    for (const Checked* checked : slowest)
        std::printf("%10.2f %10.2f %10llu  %s\n", checked->finding.total_seconds,
                    checked->finding.cook_seconds,
                    static_cast<unsigned long long>(checked->finding.peak_rss_bytes >> 20),
                    checked->asset->file.c_str());
}

void printTable(std::span<const Checked> all)
{
    std::printf("%-32s %-10s %8s %8s %8s\n", "class", "confidence", "passed", "judged", "failed");
    for (const AssetClass& expected : kAssetClasses)
        for (const Confidence confidence : {Confidence::good, Confidence::high, Confidence::medium})
        {
            const long passed = countVerdicts(all, expected, confidence, Verdict::passed);
            const long judged = countVerdicts(all, expected, confidence, Verdict::judged);
            const long failed = countVerdicts(all, expected, confidence, Verdict::failed);
            if (passed + judged + failed > 0)
                std::printf("%-32s %-10s %8ld %8ld %8ld\n", expected.name.data(), confidenceName(confidence),
                            passed, judged, failed);
        }
}

} // namespace hearth::corpus
