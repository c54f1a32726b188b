// The processes that run actions: a large action has one to itself, small ones of one cooker share one.
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

struct CrewLimits
{
    unsigned large = 2; ///< processes that each run a large action, at once; they take all cores themselves
    unsigned all = 2;   ///< processes at work at once; one that runs small actions takes one core
    uint64_t memory_bytes = 0; ///< that they may take together, by estimates; one always works
};

/// How an action's process, or its place in one, ended.
struct CrewEnd
{
    size_t action = kNoAction; ///< none where a process ended that had nothing to do
    tools::ChildEnd end;
    /// Actions that stood behind it in a process that has died: they were not begun, and wait to be started again.
    std::vector<size_t> not_begun;
};

/// While it lives, signals are as with tools::ChildProcesses.
class Crew
{
public:
    Crew(const Graph& graph, const CrewLimits& limits);

    /// part_bytes  that the action reads of what actions before it made
    bool canStart(size_t action, uint64_t part_bytes) const;

    /// Run what canStart() has allowed. errors: child_failed.
    Status start(size_t action, uint64_t part_bytes, const std::vector<std::string>& command);

    /// Whether nothing runs.
    bool isIdle() const;

    /// Wait until an action ends; nullopt where a signal asks this process to end. Something runs.
    /// waiting  as that of tools::ChildProcesses::wait()
    std::optional<CrewEnd> wait(const std::function<void()>& waiting = {});

private:
    struct Process
    {
        std::string cooker;         ///< of a batch; empty: one action alone
        std::deque<size_t> actions; ///< the first is run, the others stand behind it
        uint64_t memory_bytes = 0;  ///< of the largest that it was given
    };

    bool isSmall(size_t action, uint64_t part_bytes) const;
    std::optional<size_t> batchFor(size_t action) const;
    bool hasRoom(size_t action, std::optional<size_t> batch) const;
    unsigned busy() const;
    Status startAlone(size_t action, const std::vector<std::string>& command);
    void retireIdle(std::optional<size_t> but);

    const Graph& graph_;
    CrewLimits limits_;
    std::vector<bool> is_small_; ///< of the actions, by estimate
    tools::ChildProcesses children_;
    std::map<size_t, Process> processes_; ///< by the ids of their children
};

} // namespace hearth::graph
