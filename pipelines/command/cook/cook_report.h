// Records the events and results of a running cook, for hearth cook --report.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/report/cook_report.h"

#include <chrono>
#include <string>
#include <vector>

namespace hearth::command
{

/// Recorder of a cook: fills its report from the events of the executor.
class CookRecorder
{
public:
    CookRecorder() : start_(std::chrono::steady_clock::now()) {}

    void begin(const graph::Graph& graph);
    void starting(const graph::Action& action);
    void ended(const graph::Action& action, const graph::ActionOutcome& outcome);
    /// Assign the failure to the action that ended last, if that action has failed.
    void failed(const graph::Failure& failure);
    /// Copy the outcomes and small outputs of all actions, while the executor still has its files.
    void copyOutcomes(graph::Executor& executor);
    /// Copy the paths that were read or probed, while the executor still has its files.
    void copyDependencies(const graph::Executor& executor);

    double seconds() const;
    report::CookReport& report() { return report_; }
    /// Paths of files that were read or probed, whether they exist or not.
    const std::vector<std::string>& dependencies() const { return dependencies_; }

private:
    size_t actionIndex(const graph::Action& action) const;

    std::chrono::steady_clock::time_point start_;
    report::CookReport report_;
    std::vector<std::string> dependencies_;
    std::vector<bool> lane_is_busy_;
    size_t last_failed_ = graph::kNoAction;
};

/// Return the stored bytes of a pack by the types of its chunks; empty if the pack cannot be read.
std::map<uint32_t, uint64_t> readChunkBytes(const std::string& pack);

/// Return the present time as ISO 8601 in UTC, to the second.
std::string utcNow();

} // namespace hearth::command
