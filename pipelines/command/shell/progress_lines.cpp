// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/progress_lines.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace hearth::command
{

namespace
{

// Most names of running actions on a line. More would not fit, because batches of small actions are long.
constexpr size_t kMaxNames = 3;

std::string actionName(const graph::Action& action)
{
    return action.cooker + " " + action.subject;
}

std::string actionList(const std::vector<std::string>& names)
{
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    return names.size() <= kMaxNames ? text : text + fmt::format(" and {} more", names.size() - kMaxNames);
}

std::vector<size_t> allActions(const graph::Graph& graph)
{
    std::vector<size_t> actions(graph.actions.size());
    std::iota(actions.begin(), actions.end(), size_t{0});
    return actions;
}

} // namespace

LineTimer::LineTimer(MonotonicClock clock) : clock_(std::move(clock)), start_(clock_()), last_(start_) {}

double LineTimer::elapsedSeconds() const
{
    return std::chrono::duration<double>(clock_() - start_).count();
}

bool LineTimer::isDue()
{
    const auto now = clock_();
    if (now - last_ < kProgressInterval)
        return false;
    last_ = now;
    return true;
}

ProgressLines::ProgressLines(const graph::Graph& graph, PrintLine print, MonotonicClock clock)
    : ProgressLines(graph, allActions(graph), std::move(print), std::move(clock))
{
}

ProgressLines::ProgressLines(const graph::Graph& graph, std::span<const size_t> actions, PrintLine print,
                             MonotonicClock clock)
    : print_(std::move(print)),
      timer_(std::move(clock)),
      action_count_(actions.size()),
      pack_(graph.source_count)
{
    for (const size_t action : actions)
        sources_[graph.actions[action].source].unfinished.insert(graph.actions[action].outputs.front());
}

size_t ProgressLines::countEnded() const
{
    size_t ended = action_count_;
    for (const auto& [index, source] : sources_)
        ended -= source.unfinished.size();
    return ended;
}

void ProgressLines::starting(const graph::Action& action)
{
    running_.push_back(actionName(action));
    waiting();
}

void ProgressLines::ended(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    if (const auto found = std::find(running_.begin(), running_.end(), actionName(action));
        found != running_.end())
        running_.erase(found);
    Source& source = sources_[action.source];
    if (outcome.ending == graph::Outcome::cooked)
    {
        source.seconds += outcome.result.seconds;
        ++source.cooked;
    }
    source.has_failed |= outcome.ending == graph::Outcome::failed;
    // an action ends a second time if the cache has lost its result: its source has been printed then
    const bool is_last = source.unfinished.erase(action.outputs.front()) == 1 && source.unfinished.empty();
    if (is_last && source.cooked > 0 && !source.has_failed && action.source != pack_)
        printSource(source, action.subject);
    waiting();
}

void ProgressLines::printSource(const Source& source, const std::string& subject) const
{
    print_(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", "source", source.seconds,
                       fmt::format("{} cooker{}", source.cooked, source.cooked == 1 ? "" : "s"), subject));
}

void ProgressLines::waiting()
{
    if (timer_.isDue())
        print_(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", "so far", timer_.elapsedSeconds(),
                           fmt::format("{} of {}", countEnded(), action_count_), actionList(running_)));
}

} // namespace hearth::command
