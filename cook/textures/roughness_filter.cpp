// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/roughness_filter.h"

#include "cook/textures/texel_codec.h"
#include "formats/base/assert.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace hearth::textures
{

namespace
{

/// Return what a spread of normals adds to alpha^2, as a multiple of its variance. GGX lobes around
/// normals that spread by sigma are together nearest, by the area between the curves, to one of
/// alpha^2 + c sigma^2: c is 2.09, 1.99, 1.76, 1.65 and 1.57 at sigma / alpha of .5, 1, 2, 4 and 8,
/// which this meets within .03.
///
/// ratio2  (sigma / alpha)^2
float spreadWeight(float ratio2)
{
    return 1.55f + 0.55f / (1 + 0.32f * ratio2);
}

constexpr float kMinAlpha2 = 1e-12f; // of a mirror, whose weight is that of the widest spread

// Variance of an error that is even over a step of 8 bits, of a range of 2.
constexpr float kByteStepError = 2.0f / 255 * (2.0f / 255) / 12;

/// Return the roughness, at most 1, of a lobe around normals that spread by a variance.
float widen(float roughness, float variance)
{
    const float alpha2 = std::max(roughness * roughness * roughness * roughness, kMinAlpha2);
    return std::sqrt(std::sqrt(std::min(alpha2 + spreadWeight(variance / alpha2) * variance, 1.0f)));
}

} // namespace

float lostVariance(float mean_length, float step_error)
{
    const float rho = std::min(mean_length, 1.0f);
    const float concentration_part = rho * (3 - rho * rho);
    if (concentration_part <= 0)
        return 1;
    return std::max((1 - rho * rho) / concentration_part - step_error, 0.0f);
}

void RoughnessFilter::readRow(uint32_t y, std::span<Float4> out) const
{
    const size_t row_bytes = source_.texels.size() / source_.image.height;
    decodeRow(Content::normals, source_.image.format, source_.texels.subspan(y * row_bytes, row_bytes), out);
    for (Float4& texel : out)
    {
        const Float3 normal =
            normalizeOr({texel.x * source_.normal_scale, texel.y * source_.normal_scale, texel.z}, {0, 0, 1});
        texel = {normal.x, normal.y, normal.z, 0};
    }
}

FloatImage RoughnessFilter::averageNormals(uint32_t width, uint32_t height)
{
    const auto readMeans = [&](uint32_t y, std::span<Float4> out)
    {
        if (means_.texels.empty())
            readRow(y, out);
        else
            std::ranges::copy(means_.row(y), out.begin());
    };
    uint32_t from_width = source_.image.width, from_height = source_.image.height;
    if (!means_.texels.empty())
        from_width = means_.width, from_height = means_.height;
    while (from_width / 2 >= width && from_height / 2 >= height)
    {
        means_ = halve(from_width, from_height, readMeans);
        from_width = means_.width;
        from_height = means_.height;
    }
    return averageAreas(from_width, from_height, readMeans, width, height);
}

void RoughnessFilter::apply(FloatImage& mip)
{
    HEARTH_ASSERT(source_.roughness_factor > 0);
    if (mip.width >= source_.image.width && mip.height >= source_.image.height)
        return;
    const FloatImage means = averageNormals(mip.width, mip.height);
    const float step_error = kByteStepError * source_.normal_scale * source_.normal_scale;
    const auto widenRows = [&](const tbb::blocked_range<uint32_t>& rows)
    {
        for (uint32_t y = rows.begin(); y < rows.end(); ++y)
            for (uint32_t x = 0; x < mip.width; ++x)
            {
                const Float4& mean = means.row(y)[x];
                const float variance = lostVariance(length({mean.x, mean.y, mean.z}), step_error);
                if (float& texel = mip.row(y)[x].y; variance > 0)
                    texel = std::min(
                        widen(texel * source_.roughness_factor, variance) / source_.roughness_factor, 1.0f);
            }
    };
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, mip.height), widenRows);
}

} // namespace hearth::textures
