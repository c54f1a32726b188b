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
    uint64_t base_bytes;    ///< of an empty source: program, libraries, threads
    double bytes_per_byte;  ///< of source
    double seconds_per_mib; ///< of source, on two cores
};

constexpr uint64_t kMiB = uint64_t{1} << 20;

// Measured with --report on binary glTF of meshes, with images and without: see README.md.
constexpr std::array kCosts{
    Cost{"import", 24 * kMiB, 6, 0.05},      Cost{"clusters", 48 * kMiB, 20, 1.0},
    Cost{"textures", 24 * kMiB, 10, 0.1},    Cost{"skinning", 16 * kMiB, 1, 0.01},
    Cost{"visibility", 96 * kMiB, 25, 10.0}, Cost{"specular", 32 * kMiB, 0, 0},
    Cost{"link", 16 * kMiB, 3, 0.05},
};
constexpr double kLeastSeconds = 0.01;

uint64_t bytesOf(const std::string& path)
{
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

Estimate estimateOf(const std::string& cooker, uint64_t source_bytes)
{
    const auto cost =
        std::find_if(kCosts.begin(), kCosts.end(), [&](const Cost& c) { return c.cooker == cooker; });
    if (cost == kCosts.end())
        return {};
    const auto bytes = static_cast<double>(source_bytes);
    return {cost->base_bytes + static_cast<uint64_t>(bytes * cost->bytes_per_byte),
            kLeastSeconds + bytes / static_cast<double>(kMiB) * cost->seconds_per_mib};
}

} // namespace

void addEstimates(Graph& graph)
{
    // the last is of what belongs to no source, and reads what was made of all
    std::vector<uint64_t> bytes_of_source(graph.source_count + 1);
    for (const Action& action : graph.actions)
        for (const Input& input : action.inputs)
            if (input.action == kNoAction)
            {
                const uint64_t bytes = bytesOf(input.path);
                bytes_of_source[action.source] += bytes;
                bytes_of_source.back() += bytes;
            }
    for (Action& action : graph.actions)
        action.estimate = estimateOf(action.cooker, bytes_of_source[action.source]);
}

} // namespace hearth::graph
