// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/process_pool.h"

#include <algorithm>

namespace hearth::graph
{

namespace
{

// An action is small if starting a process (2 to 8 ms) is a good part of its time, and a second thread would
// hardly shorten it.
constexpr double kSmallSeconds = 0.1;
// Size limit for the input parts of a small action: parts may be large where the source was not. Parts of
// that size are read within kSmallSeconds.
constexpr uint64_t kSmallPartBytes = uint64_t{1} << 20;
// Below this number of small actions of a cooker, each starts a process of its own; from it on, a batch
// process is worth keeping.
constexpr std::ptrdiff_t kMinBatchActions = 8;
// Maximum queue of a batch behind its running action. It bridges the time until this process has handled a
// result; a longer queue would keep actions from a process that becomes free.
constexpr size_t kMaxQueuedActions = 4;

} // namespace

ProcessPool::ProcessPool(const Graph& graph, const PoolLimits& limits)
    : graph_(graph), limits_(limits), is_small_(graph.actions.size())
{
    std::map<std::string, std::ptrdiff_t> count_of_cooker;
    const auto isQuick = [](const Action& action) { return action.estimate.seconds <= kSmallSeconds; };
    for (const Action& action : graph.actions)
        count_of_cooker[action.cooker] += isQuick(action) ? 1 : 0;
    for (size_t i = 0; i < graph.actions.size(); ++i)
        is_small_[i] =
            isQuick(graph.actions[i]) && count_of_cooker[graph.actions[i].cooker] >= kMinBatchActions;
}

bool ProcessPool::isSmall(size_t action, uint64_t part_bytes) const
{
    return is_small_[action] && part_bytes <= kSmallPartBytes;
}

unsigned ProcessPool::busyCount() const
{
    return static_cast<unsigned>(std::count_if(processes_.begin(), processes_.end(),
                                               [](const auto& p) { return !p.second.actions.empty(); }));
}

bool ProcessPool::isIdle() const
{
    return busyCount() == 0;
}

/// Return the batch with the shortest queue for a small action; nullopt: start a new one.
std::optional<size_t> ProcessPool::findBatch(size_t action) const
{
    auto best = processes_.end();
    for (auto process = processes_.begin(); process != processes_.end(); ++process)
        if (process->second.cooker == graph_.actions[action].cooker &&
            (best == processes_.end() || process->second.actions.size() < best->second.actions.size()))
            best = process;
    if (best == processes_.end() || (!best->second.actions.empty() && busyCount() < limits_.all))
        return std::nullopt;
    return best->first;
}

/// True if the action fits the memory limit.
/// batch  in which the action would run; nullopt: a new process
bool ProcessPool::fitsMemory(size_t action, std::optional<size_t> batch) const
{
    uint64_t other_bytes = 0;
    uint64_t its = graph_.actions[action].estimate.memory_bytes;
    for (const auto& [id, process] : processes_)
        if (id == batch)
            its = std::max(its, process.memory_bytes);
        else
            // idle batches are ended when memory is short
            other_bytes += process.actions.empty() ? 0 : process.memory_bytes;
    return other_bytes == 0 || other_bytes + its <= limits_.memory_bytes;
}

bool ProcessPool::canStart(size_t action, uint64_t part_bytes) const
{
    const unsigned at_work = busyCount();
    if (!isSmall(action, part_bytes))
    {
        const auto large = std::count_if(processes_.begin(), processes_.end(),
                                         [](const auto& process) { return process.second.cooker.empty(); });
        return large < limits_.large && at_work < limits_.all && fitsMemory(action, std::nullopt);
    }
    const std::optional<size_t> batch = findBatch(action);
    const size_t ahead = batch ? processes_.at(*batch).actions.size() : 0;
    return (ahead > 0 ? ahead <= kMaxQueuedActions : at_work < limits_.all) && fitsMemory(action, batch);
}

/// End idle batch processes, except `but`, to free their memory.
void ProcessPool::endIdle(std::optional<size_t> but)
{
    for (auto process = processes_.begin(); process != processes_.end();)
    {
        const bool goes = process->second.actions.empty() && process->first != but;
        if (goes)
            children_.close(process->first);
        process = goes ? processes_.erase(process) : std::next(process);
    }
}

Status ProcessPool::startAlone(size_t action, const std::vector<std::string>& command)
{
    endIdle(std::nullopt);
    HEARTH_ASSIGN_OR_RETURN(const size_t child, children_.start(command));
    processes_[child] = {"", {action}, graph_.actions[action].estimate.memory_bytes};
    return success();
}

Status ProcessPool::start(size_t action, uint64_t part_bytes, const std::vector<std::string>& command)
{
    if (!isSmall(action, part_bytes))
        return startAlone(action, command);
    const auto line = tools::makeBatchLine(std::span(command).subspan(1));
    if (!line)
        return startAlone(action, command);

    std::optional<size_t> batch = findBatch(action);
    uint64_t total_bytes = graph_.actions[action].estimate.memory_bytes;
    for (const auto& [id, process] : processes_)
        total_bytes += process.memory_bytes;
    if (total_bytes > limits_.memory_bytes)
        endIdle(batch);
    if (!batch)
    {
        HEARTH_ASSIGN_OR_RETURN(batch, children_.startBatch(command[0]));
        processes_[*batch].cooker = graph_.actions[action].cooker;
    }
    Process& process = processes_[*batch];
    process.actions.push_back(action);
    process.memory_bytes = std::max(process.memory_bytes, graph_.actions[action].estimate.memory_bytes);
    children_.sendCommandLine(*batch, *line);
    return success();
}

std::optional<ActionEnd> ProcessPool::wait(const std::function<void()>& waiting)
{
    std::optional<tools::ChildOutcome> end = children_.wait(waiting);
    if (!end)
        return std::nullopt;
    ActionEnd action_end;
    if (const auto process = processes_.find(end->id); process != processes_.end())
    {
        std::deque<size_t>& actions = process->second.actions;
        if (!actions.empty())
        {
            action_end.action = actions.front();
            actions.pop_front();
        }
        if (!end->is_alive)
        {
            action_end.not_begun.assign(actions.begin(), actions.end());
            processes_.erase(process);
        }
    }
    action_end.end = std::move(*end);
    return action_end;
}

} // namespace hearth::graph
