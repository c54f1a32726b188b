// Progress of a cook for logs: a line when a source is done, and one every ten seconds of how far it is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/executor.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace hearth::command
{

using PrintLine = std::function<void(const std::string& line)>;
using MonotonicClock = std::function<std::chrono::steady_clock::time_point()>;

/// Between two lines that say how far something is.
inline constexpr std::chrono::seconds kBetweenProgressLines{10};

/// Says when the next line is due.
class LineTimer
{
public:
    explicit LineTimer(MonotonicClock clock = std::chrono::steady_clock::now);

    /// Since the timer was made.
    double elapsedSeconds() const;
    /// Whether kBetweenProgressLines have gone by since it last said so, or since it was made.
    bool isDue();

private:
    MonotonicClock clock_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
};

class ProgressLines
{
public:
    /// graph  that is run; only read here
    /// print  gets each line, without its end
    ProgressLines(const graph::Graph& graph, PrintLine print,
                  MonotonicClock clock = std::chrono::steady_clock::now);

    // As the events of graph::Executor.
    void starting(const graph::Action& action);
    void ended(const graph::Action& action, const graph::ActionOutcome& outcome);
    void waiting();

private:
    struct Source
    {
        std::set<std::string> open; ///< first outputs of actions that have not ended
        double seconds = 0;         ///< of the cookers that ran
        size_t cooked = 0;          ///< how many those are
        bool has_failed = false;
    };

    size_t countEnded() const;
    void printSource(const Source& source, const std::string& subject) const;

    PrintLine print_;
    LineTimer timer_;
    size_t action_count_;
    size_t pack_; ///< Action::source of what belongs to no source
    std::map<size_t, Source> sources_;
    std::vector<std::string> running_; ///< "clusters rock.glb", in the order of their starts
};

} // namespace hearth::command
