// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/alpha_coverage.h"

#include <cmath>

namespace hearth::textures
{

namespace
{

// Bins of the histogram. Alphas in one bin count as equal: eight times finer than 8 bits resolve at a scale
// of 32.
constexpr size_t kBins = 65536;

/// Return the smallest 8-bit alpha that passes, above 255 if none does.
uint32_t minPassingAlpha(float cutoff)
{
    uint32_t alpha = 0;
    while (alpha < 256 && static_cast<float>(alpha) / 255.0f < cutoff)
        ++alpha;
    return alpha;
}

size_t binIndex(float alpha)
{
    return static_cast<size_t>(std::clamp(alpha, 0.0f, 1.0f) * static_cast<float>(kBins - 1) + 0.5f);
}

} // namespace

double alphaCoverage(std::span<const std::byte> texels, float cutoff)
{
    const uint32_t min_alpha = minPassingAlpha(cutoff);
    size_t passing = 0;
    for (size_t at = 3; at < texels.size(); at += 4)
        passing += static_cast<uint32_t>(texels[at]) >= min_alpha ? 1u : 0u;
    const size_t count = texels.size() / 4;
    return count == 0 ? 0 : static_cast<double>(passing) / static_cast<double>(count);
}

float scaleForCoverage(const FloatImage& image, float cutoff, double coverage)
{
    const uint32_t min_alpha = minPassingAlpha(cutoff);
    const auto target =
        static_cast<size_t>(std::llround(coverage * static_cast<double>(image.texels.size())));
    if (min_alpha == 0 || min_alpha > 255 || target == 0)
        return 1;
    std::vector<uint32_t> bins(kBins);
    for (const Float4& texel : image.texels)
        ++bins[binIndex(texel.w)];

    // stored alpha is rounded: values down to half a step below it pass, too
    const float threshold = (static_cast<float>(min_alpha) - 0.5f) / 255;
    size_t passing = 0;
    size_t unscaled = 0;
    for (size_t bin = binIndex(threshold); bin < kBins; ++bin)
        unscaled += bins[bin];
    if (unscaled == target)
        return 1;

    // from the most opaque texel down, stop where one more bin brings the count no nearer
    size_t bin = kBins;
    while (bin > 1 && passing < target)
    {
        const size_t next = passing + bins[bin - 1];
        if (next > target && next - target >= target - passing)
            break;
        passing = next;
        --bin;
    }
    // the bin's lower end, so that the whole bin passes
    const float edge = (static_cast<float>(bin) - 0.5f) / static_cast<float>(kBins - 1);
    return threshold / edge;
}

} // namespace hearth::textures
