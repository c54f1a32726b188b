// hearth cook --report: notes what happens while a cook runs, and writes what became of it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/report/cook_report.h"

#include <chrono>
#include <string>
#include <vector>

namespace hearth::command
{

class CookRecorder
{
public:
    CookRecorder() : start_(std::chrono::steady_clock::now()) {}

    void begin(const graph::Graph& graph);
    void starting(const graph::Action& action);
    void ended(const graph::Action& action, const graph::ActionOutcome& outcome);
    /// What failed is the action that ended last, or none.
    void failed(const graph::Failure& failure);
    /// While the executor still has its files.
    void takeOutcomes(graph::Executor& executor);
    /// What was read or looked for; the same.
    void takeFiles(const graph::Executor& executor);

    double seconds() const;
    report::CookReport& report() { return report_; }
    /// Paths of files, there or not.
    const std::vector<std::string>& lookedFor() const { return looked_for_; }

private:
    size_t indexOf(const graph::Action& action) const;

    std::chrono::steady_clock::time_point start_;
    report::CookReport report_;
    std::vector<std::string> looked_for_;
    std::vector<bool> lane_is_busy_;
    size_t last_failed_ = graph::kNoAction;
};

/// The bytes of a pack by the types of its chunks, those of bricks together as "bricks"; empty where there is none.
std::map<std::string, uint64_t> bytesOfChunks(const std::string& pack);

/// The moment as ISO 8601 in UTC, to the second.
std::string utcNow();

} // namespace hearth::command
