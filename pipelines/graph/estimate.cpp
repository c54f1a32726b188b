// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/estimate.h"

#include "pipelines/cookers/registry.h"

#include <filesystem>

namespace hearth::graph
{

namespace
{

constexpr double kMinSeconds = 0.01;

uint64_t fileBytes(const std::string& path)
{
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

Estimate makeEstimate(const std::string& name, uint64_t source_bytes)
{
    const cookers::Cooker* cooker = cookers::findCooker(name);
    if (cooker == nullptr)
        return {};
    const auto bytes = static_cast<double>(source_bytes);
    constexpr double kBytesPerMib = 1 << 20;
    return {cooker->cost.base_bytes + static_cast<uint64_t>(bytes * cooker->cost.bytes_per_byte),
            kMinSeconds + bytes / kBytesPerMib * cooker->cost.seconds_per_mib};
}

} // namespace

void addEstimates(Graph& graph)
{
    // the last element sums all sources, for actions that belong to no source
    std::vector<uint64_t> bytes_of_source(graph.source_count + 1);
    for (const Action& action : graph.actions)
        for (const Input& input : action.inputs)
            if (input.action == kNoAction)
            {
                const uint64_t bytes = fileBytes(input.path);
                bytes_of_source[action.source] += bytes;
                bytes_of_source.back() += bytes;
            }
    for (Action& action : graph.actions)
        action.estimate = makeEstimate(action.cooker, bytes_of_source[action.source]);
}

} // namespace hearth::graph
