// Prints the progress of a cook for logs: a line for each finished source, and a line on overall progress
// every ten seconds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/executor.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace hearth::command
{

using PrintLine = std::function<void(const std::string& line)>;
using MonotonicClock = std::function<std::chrono::steady_clock::time_point()>;

/// Time between two lines of overall progress.
inline constexpr std::chrono::seconds kProgressInterval{10};

/// Timer that says when the next line is due.
class LineTimer
{
public:
    explicit LineTimer(MonotonicClock clock = std::chrono::steady_clock::now);

    /// Return the seconds since construction.
    double elapsedSeconds() const;
    /// True if kProgressInterval have passed since it last returned true, or since construction.
    bool isDue();

private:
    MonotonicClock clock_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
};

/// Printer of a cook's progress as lines.
class ProgressLines
{
public:
    /// graph  graph that is run; read by the constructor only
    /// print  receives each line, without its line break
    ProgressLines(const graph::Graph& graph, PrintLine print,
                  MonotonicClock clock = std::chrono::steady_clock::now);

    /// actions  of the graph that are run; others are no part of the progress
    ProgressLines(const graph::Graph& graph, std::span<const size_t> actions, PrintLine print,
                  MonotonicClock clock = std::chrono::steady_clock::now);

    // Handlers of the events of graph::Executor.
    void starting(const graph::Action& action);
    void ended(const graph::Action& action, const graph::ActionOutcome& outcome);
    void waiting();

private:
    struct Source
    {
        std::set<std::string> unfinished; ///< first outputs of actions that have not ended
        double seconds = 0;               ///< of the cookers that ran, in total
        size_t cooked = 0;                ///< number of cookers that ran
        bool has_failed = false;
    };

    size_t countEnded() const;
    void printSource(const Source& source, const std::string& subject) const;

    PrintLine print_;
    LineTimer timer_;
    size_t action_count_;
    size_t pack_; ///< Action::source of actions that belong to no source
    std::map<size_t, Source> sources_;
    std::vector<std::string> running_; ///< "clusters rock.glb", in the order of their starts
};

} // namespace hearth::command
