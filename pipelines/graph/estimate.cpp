// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/estimate.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace hearth::graph
{

namespace
{

struct Cost
{
    std::string_view cooker;
    uint64_t base_bytes;    ///< for an empty source: program, libraries, threads
    double bytes_per_byte;  ///< peak memory per byte of source
    double seconds_per_mib; ///< seconds per MiB of source, on two cores
};

constexpr uint64_t kMiB = uint64_t{1} << 20;

// Measured with --report on GLBs of 15 MB (a rock of 400 000 triangles) and 81 MB (the demo scene): the
// larger figure per byte of source, plus a third for the next release. Two cores; visibility at quality
// draft. Bricks: the generated room, a GLB of 2 MB, at 0.1 m with three bounces.
constexpr std::array kCosts{
    Cost{"import", 16 * kMiB, 6, 0.03},      Cost{"clusters", 16 * kMiB, 8, 0.2},
    Cost{"textures", 16 * kMiB, 4.5, 0.04},  Cost{"skinning", 8 * kMiB, 0.9, 0.002},
    Cost{"visibility", 16 * kMiB, 24, 0.35}, Cost{"specular", 16 * kMiB, 0, 0},
    Cost{"bricks", 16 * kMiB, 6, 0.4},       Cost{"link", 16 * kMiB, 3, 0.01},
};
constexpr double kMinSeconds = 0.01;

uint64_t fileBytes(const std::string& path)
{
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

Estimate makeEstimate(const std::string& cooker, uint64_t source_bytes)
{
    const auto cost =
        std::find_if(kCosts.begin(), kCosts.end(), [&](const Cost& c) { return c.cooker == cooker; });
    if (cost == kCosts.end())
        return {};
    const auto bytes = static_cast<double>(source_bytes);
    return {cost->base_bytes + static_cast<uint64_t>(bytes * cost->bytes_per_byte),
            kMinSeconds + bytes / static_cast<double>(kMiB) * cost->seconds_per_mib};
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
