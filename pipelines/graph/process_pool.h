// Pool of child processes that run actions: a large action has a process of its own, small actions of one
// cooker share a batch process.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/child_processes.h"
#include "pipelines/graph/action.h"

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

struct PoolLimits
{
    unsigned large = 2;        ///< concurrent processes for large actions, which use all cores themselves
    unsigned all = 2;          ///< concurrent processes at work; a batch of small actions uses one core
    uint64_t memory_bytes = 0; ///< limit for the sum of estimated memory; one process always runs
};

/// End of an action.
struct ActionEnd
{
    size_t action = kNoAction; ///< kNoAction where an idle process ended
    tools::ChildOutcome end;
    /// Actions that were queued in a process that has died: they were not begun and must be started again.
    std::vector<size_t> not_begun;
};

/// Process pool. Signals are handled as in tools::ChildProcesses while it lives.
class ProcessPool
{
public:
    ProcessPool(const Graph& graph, const PoolLimits& limits);

    /// True if the action may start now.
    /// part_bytes  size of its inputs that earlier actions made
    bool canStart(size_t action, uint64_t part_bytes) const;

    /// Start an action that canStart() has allowed. errors: child_failed.
    Status start(size_t action, uint64_t part_bytes, const std::vector<std::string>& command);

    /// True if nothing runs.
    bool isIdle() const;

    /// Wait until an action ends; nullopt where a signal asks this process to end. Precondition: something
    /// runs.
    /// waiting  as in tools::ChildProcesses::wait()
    std::optional<ActionEnd> wait(const std::function<void()>& waiting = {});

private:
    struct Process
    {
        std::string cooker;         ///< cooker of a batch; empty: a process for one action
        std::deque<size_t> actions; ///< the first is running, the others are queued
        uint64_t memory_bytes = 0;  ///< estimate of its largest action so far
    };

    bool isSmall(size_t action, uint64_t part_bytes) const;
    std::optional<size_t> findBatch(size_t action) const;
    bool fitsMemory(size_t action, std::optional<size_t> batch) const;
    unsigned busyCount() const;
    Status startAlone(size_t action, const std::vector<std::string>& command);
    void endIdle(std::optional<size_t> but);

    const Graph& graph_;
    PoolLimits limits_;
    std::vector<bool> is_small_; ///< for each action, by its estimate
    tools::ChildProcesses children_;
    std::map<size_t, Process> processes_; ///< by child id
};

} // namespace hearth::graph
