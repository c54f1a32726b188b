// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/event_log.h"

#include "cook/json/json.h"

#include <cerrno>
#include <cstring>

namespace hearth::command
{

namespace
{

constexpr const char* kSchema = "hearth.events/1";

/// Write JSON on one line.
std::string toJsonLine(const Json& json)
{
    return json.dump();
}

const char* outcomeName(graph::Outcome ending)
{
    return ending == graph::Outcome::cooked ? "cooked" : ending == graph::Outcome::cached ? "kept" : "failed";
}

} // namespace

Result<EventLog> EventLog::create(const std::string& path)
{
    std::FILE* file = std::fopen(path.c_str(), "we");
    if (file == nullptr)
        return Error{Issue::cannot_write, path, "", std::string("cannot write: ") + std::strerror(errno)};
    return EventLog(file);
}

void EventLog::write(const std::string& line)
{
    std::fwrite((line + "\n").data(), 1, line.size() + 1, file_.get());
    std::fflush(file_.get());
}

void EventLog::cook(const graph::Graph& graph)
{
    write(toJsonLine({{"event", "cook"}, {"schema", kSchema}, {"actions", graph.actions.size()}}));
}

void EventLog::start(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    write(toJsonLine({{"event", "start"},
                      {"cooker", action.cooker},
                      {"subject", action.subject},
                      {"why", outcome.causes}}));
}

void EventLog::end(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    uint64_t bytes = 0;
    for (const graph::CachedOutput& output : outcome.result.outputs)
        bytes += output.bytes;
    write(toJsonLine({{"event", "end"},
                      {"cooker", action.cooker},
                      {"subject", action.subject},
                      {"state", outcomeName(outcome.ending)},
                      {"seconds", outcome.result.seconds},
                      {"bytes", bytes}}));
}

void EventLog::error(const std::string& message)
{
    write(toJsonLine({{"event", "error"}, {"message", message}}));
}

void EventLog::done(int exit_code, double seconds)
{
    write(toJsonLine({{"event", "done"}, {"exit", exit_code}, {"seconds", seconds}}));
}

} // namespace hearth::command
