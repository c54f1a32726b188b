// Runs the Google benchmarks of a program, and holds those that have aims against them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/aims.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

namespace
{

using namespace hearth::bench;

/// Prints as usual, and judges each run. An aim's figure is "seconds" of an iteration or the name of a
/// counter.
class AimReporter : public benchmark::ConsoleReporter
{
public:
    void ReportRuns(const std::vector<Run>& runs) override
    {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs)
        {
            has_failed_ = has_failed_ || run.error_occurred;
            judge(run);
        }
    }

    /// Return the exit code of the program.
    int finish() const { return has_failed_ || has_missed_ ? 1 : 0; }

private:
    void judge(const Run& run)
    {
        const std::string name = run.benchmark_name();
        if (std::none_of(kAims.begin(), kAims.end(), [&](const Aim& aim) { return aim.bench == name; }))
            return;
        Judgement judgement(name);
        for (const Aim& aim : kAims)
            if (aim.bench == name)
            {
                const auto counter = run.counters.find(std::string(aim.figure));
                if (aim.figure == "seconds")
                    judgement.record(aim.figure,
                                     run.real_accumulated_time / static_cast<double>(run.iterations));
                else if (counter != run.counters.end())
                    judgement.record(aim.figure, counter->second.value);
            }
        has_missed_ = judgement.finish() != 0 || has_missed_;
    }

    bool has_failed_ = false, has_missed_ = false;
};

} // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    AimReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    return reporter.finish();
}
