// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook_report.h"

#include "formats/container/container_reader.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace hearth::command
{

using graph::Outcome;

size_t CookRecorder::actionIndex(const graph::Action& action) const
{
    return static_cast<size_t>(&action - report_.graph->actions.data());
}

double CookRecorder::seconds() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void CookRecorder::begin(const graph::Graph& graph)
{
    report_.graph = &graph;
}

void CookRecorder::starting(const graph::Action& action)
{
    const auto lane = std::find(lane_is_busy_.begin(), lane_is_busy_.end(), false);
    const auto index = static_cast<size_t>(lane - lane_is_busy_.begin());
    if (lane == lane_is_busy_.end())
        lane_is_busy_.push_back(true);
    lane_is_busy_[index] = true;
    report_.times[actionIndex(action)] = {seconds(), static_cast<unsigned>(index)};
}

void CookRecorder::ended(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    const size_t index = actionIndex(action);
    if (const auto time = report_.times.find(index); time != report_.times.end())
        lane_is_busy_[time->second.lane] = false;
    last_failed_ = outcome.ending == Outcome::failed ? index : graph::kNoAction;
}

void CookRecorder::failed(const graph::Failure& failure)
{
    if (last_failed_ != graph::kNoAction)
        report_.errors[last_failed_] = failure.error;
    last_failed_ = graph::kNoAction;
}

void CookRecorder::copyOutcomes(graph::Executor& executor)
{
    report_.outcomes = executor.outcomes();
    for (size_t i = 0; i < report_.outcomes.size(); ++i)
    {
        const std::vector<std::string>& outputs = report_.graph->actions[i].outputs;
        const Outcome ending = report_.outcomes[i].ending;
        for (size_t output = 1; output < outputs.size(); ++output)
        {
            if (ending != Outcome::cooked && ending != Outcome::cached)
                continue;
            std::optional<std::string> text = executor.readOutput(i, output);
            const bool is_image = outputs[output].ends_with(".png");
            if (text)
                (is_image ? report_.images : report_.statistics)[i] = std::move(*text);
        }
    }
}

void CookRecorder::copyDependencies(const graph::Executor& executor)
{
    for (size_t i = 0; i < report_.graph->actions.size(); ++i)
    {
        for (const graph::Input& input : report_.graph->actions[i].inputs)
            if (input.action == graph::kNoAction)
                dependencies_.push_back(input.path);
        const std::vector<std::string> found = executor.probedFiles(i);
        dependencies_.insert(dependencies_.end(), found.begin(), found.end());
    }
}

std::map<uint32_t, uint64_t> readChunkBytes(const std::string& pack)
{
    std::map<uint32_t, uint64_t> bytes;
    const auto reader = formats::ContainerReader::open(pack, formats::Check::structure);
    if (!reader.ok())
        return bytes;
    for (const formats::ChunkEntry& entry : reader->chunks())
        bytes[entry.type] += entry.stored_size;
    return bytes;
}

std::string utcNow()
{
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    const size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return {text.data(), size};
}

} // namespace hearth::command
