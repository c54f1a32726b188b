// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/halve.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace hearth::textures
{

namespace
{

/// Texels that one texel of the result covers, with the weight of each.
struct Coverage
{
    uint32_t first = 0;
    std::vector<float> weights{};
};

/// Compute the coverage of texel `target` of `target_size`: [target, target + 1) * size / target_size. Exact
/// in integers.
Coverage computeCoverage(uint32_t target, uint32_t target_size, uint32_t size)
{
    const uint64_t start = uint64_t{target} * size;
    const uint64_t end = start + size;
    Coverage coverage{.first = static_cast<uint32_t>(start / target_size)};
    for (uint64_t texel = coverage.first; texel * target_size < end; ++texel)
    {
        const uint64_t overlap =
            std::min(end, (texel + 1) * target_size) - std::max(start, texel * target_size);
        coverage.weights.push_back(static_cast<float>(static_cast<double>(overlap) / size));
    }
    return coverage;
}

void addScaled(Float4& sum, const Float4& texel, float weight)
{
    sum.x += texel.x * weight;
    sum.y += texel.y * weight;
    sum.z += texel.z * weight;
    sum.w += texel.w * weight;
}

} // namespace

FloatImage averageAreas(uint32_t width, uint32_t height, const RowReader& readRow, uint32_t target_width,
                        uint32_t target_height)
{
    FloatImage result;
    result.width = target_width;
    result.height = target_height;
    result.texels.resize(size_t{result.width} * result.height);

    std::vector<Coverage> columns(result.width);
    for (uint32_t x = 0; x < result.width; ++x)
        columns[x] = computeCoverage(x, result.width, width);

    const auto fillRows = [&](const tbb::blocked_range<uint32_t>& rows)
    {
        std::vector<Float4> source(width);
        std::vector<Float4> sum(width);
        for (uint32_t y = rows.begin(); y < rows.end(); ++y)
        {
            const Coverage lines = computeCoverage(y, result.height, height);
            std::fill(sum.begin(), sum.end(), Float4{});
            for (size_t i = 0; i < lines.weights.size(); ++i)
            {
                readRow(lines.first + static_cast<uint32_t>(i), source);
                for (uint32_t x = 0; x < width; ++x)
                    addScaled(sum[x], source[x], lines.weights[i]);
            }
            const std::span<Float4> out = result.row(y);
            for (uint32_t x = 0; x < result.width; ++x)
                for (size_t i = 0; i < columns[x].weights.size(); ++i)
                    addScaled(out[x], sum[columns[x].first + i], columns[x].weights[i]);
        }
    };
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, result.height), fillRows);
    return result;
}

FloatImage halve(uint32_t width, uint32_t height, const RowReader& readRow)
{
    return averageAreas(width, height, readRow, std::max(1u, width / 2), std::max(1u, height / 2));
}

} // namespace hearth::textures
