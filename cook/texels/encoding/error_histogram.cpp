// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/error_histogram.h"

#include "cook/texels/encoding/texel_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hearth::texels
{

using namespace formats;

namespace
{

/// Steps: finer than 8 bits, and few, since each stripe of an image has a histogram.
constexpr size_t kErrorSteps = 1u << 12;

/// Return the error of the last step: the whole range, a right angle and more, or 16 stops.
double maxTexelError(ImageRole role)
{
    return role == ImageRole::light ? 16 : role == ImageRole::normal ? 2 : 1;
}

/// Return the step of a difference of 16-bit codes, rounded up.
size_t findStep(uint32_t difference)
{
    return (difference * static_cast<uint32_t>(kErrorSteps - 1) + 65534) / 65535;
}

} // namespace

void ErrorHistogram::add(std::span<const DecodedTexel> plain, std::span<const DecodedTexel> stored)
{
    counts_.resize(kErrorSteps);
    if (role_ == ImageRole::normal || role_ == ImageRole::light)
    {
        const double scale = (kErrorSteps - 1) / maxTexelError(role_);
        for (size_t i = 0; i < plain.size(); ++i)
        {
            const double step = std::ceil(texelError(role_, channels_, plain[i], stored[i]) * scale);
            ++counts_[static_cast<size_t>(std::min(step, kErrorSteps - 1.0))];
        }
        return;
    }
    constexpr size_t kRun = 256;
    std::array<uint16_t, kRun> buffer;
    for (size_t begin = 0; begin < plain.size(); begin += kRun)
    {
        const size_t count = std::min(kRun, plain.size() - begin);
        const std::span differences = std::span(buffer).first(count);
        findCodeDifferences(role_, channels_, plain.subspan(begin, count), stored.subspan(begin, count),
                            differences);
        for (const uint16_t difference : differences)
            ++counts_[findStep(difference)];
    }
}

void ErrorHistogram::add(const ErrorHistogram& other)
{
    if (other.counts_.empty())
        return;
    counts_.resize(kErrorSteps);
    for (size_t step = 0; step < kErrorSteps; ++step)
        counts_[step] += other.counts_[step];
}

double ErrorHistogram::findPercentile() const
{
    const uint64_t total = std::accumulate(counts_.begin(), counts_.end(), uint64_t{0});
    const uint64_t wanted = total - total / 1000;
    uint64_t sum = 0;
    for (size_t step = 0; step < counts_.size(); ++step)
        if ((sum += counts_[step]) >= wanted)
            return static_cast<double>(step) * maxTexelError(role_) / (kErrorSteps - 1);
    return maxTexelError(role_);
}

} // namespace hearth::texels
