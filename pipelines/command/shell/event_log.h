// hearth cook --events: writes the events of a running cook, for programs that watch it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/executor.h"

#include <cstdio>
#include <memory>
#include <string>

namespace hearth::command
{

/// Log of a JSON object per line, each written at once, schema "hearth.events/1": "event" is "cook" (schema,
/// number of actions), "start" (cooker, subject, why), "end" (cooker, subject, state: "cooked", "kept" or
/// "failed", seconds, bytes), "error" (message) or "done" (exit, seconds). Write errors are ignored: a cook
/// does not end because its watcher has gone.
class EventLog
{
public:
    /// errors: cannot_write
    static Result<EventLog> create(const std::string& path);

    void cook(const graph::Graph& graph);
    void start(const graph::Action& action, const graph::ActionOutcome& outcome);
    void end(const graph::Action& action, const graph::ActionOutcome& outcome);
    void error(const std::string& message);
    void done(int exit_code, double seconds);

private:
    struct Close
    {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    explicit EventLog(std::FILE* file) : file_(file) {}
    void write(const std::string& line);

    std::unique_ptr<std::FILE, Close> file_;
};

} // namespace hearth::command
