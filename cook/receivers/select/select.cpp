// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/select/select.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/post.h"

#include <algorithm>

namespace hearth::receivers
{

namespace
{

// Distance in luminance over which a lamp fades before the next by rank takes its place, as a share of its
// own. Smaller ones are steps, larger ones lose more.
constexpr double kRankFade = 0.25;
// Weight left to a lamp that has faded by rank: where all lamps are equal they share the light equally.
constexpr double kMinRankWeight = 1e-3;

struct Candidate
{
    uint32_t lamp;
    double luminance, channel; ///< its largest channel
};

/// Return the share of its light that a lamp keeps between a and b.
double clampSmoothly(double value, double a, double b)
{
    if (value >= b)
        return 1;
    if (value <= a)
        return 0;
    const double off = (b - value) / (b - a);
    return 1 - off * off * off * off;
}

/// Sort the lamps that are not black by falling luminance.
std::vector<Candidate> rankLamps(std::span<const Float3> light, bool is_steady)
{
    std::vector<Candidate> lamps;
    for (size_t i = is_steady ? 1 : 0; i < light.size(); ++i)
        if (const Double3 color = widen(light[i]); luminance(color) > 0)
            lamps.push_back({static_cast<uint32_t>(i), luminance(color), largestChannel(color)});
    std::stable_sort(lamps.begin(), lamps.end(),
                     [](const Candidate& a, const Candidate& b) { return a.luminance > b.luminance; });
    return lamps;
}

/// Add what is dropped to what is kept, by luminance.
void shareDropped(Double3 dropped, std::vector<KeptLight>& kept)
{
    double sum = 0;
    for (const KeptLight& light : kept)
        sum += luminance(light.color);
    for (KeptLight& light : kept)
        light.color = light.color + dropped * (luminance(light.color) / sum);
}

} // namespace

double luminance(Double3 color)
{
    return dot(color, widen(shared::kLuminanceWeights));
}

double largestChannel(Double3 color)
{
    return std::max({color.x, color.y, color.z});
}

void selectLights(std::span<const Float3> light, bool is_steady, const SelectOptions& options,
                  std::vector<KeptLight>& kept)
{
    HEARTH_ASSERT(options.max_colors >= 2 && options.max_colors <= shared::kMaxReceiverColors);
    kept.clear();
    const Double3 steady = is_steady ? widen(light[0]) : Double3{};
    if (luminance(steady) > 0)
        kept.push_back({0, steady});
    const std::vector<Candidate> lamps = rankLamps(light, is_steady);
    Double3 sum{};
    for (const Float3& lamp : light)
        sum = sum + widen(lamp);

    double brightest = largestChannel(steady);
    for (const Candidate& lamp : lamps)
        brightest = std::max(brightest, lamp.channel);
    const double high = std::min(options.high * largestChannel(sum), brightest);
    const double low = high * (options.low / options.high);
    const size_t places = options.max_colors - kept.size();
    const double next = lamps.size() > places ? lamps[places].luminance : 0;
    Double3 dropped{};
    for (size_t rank = 0; rank < lamps.size(); ++rank)
    {
        const Candidate& lamp = lamps[rank];
        double weight = rank < places ? clampSmoothly(lamp.channel, low, high) : 0;
        if (next > 0)
            weight *= std::clamp((lamp.luminance - next) / (kRankFade * lamp.luminance), kMinRankWeight, 1.0);
        const Double3 color = widen(light[lamp.lamp]);
        if (weight > 0)
            kept.push_back({lamp.lamp, color * weight});
        dropped = dropped + color * (1 - weight);
    }
    if (kept.empty())
        return;
    shareDropped(dropped, kept);
    std::sort(kept.begin(), kept.end(),
              [](const KeptLight& a, const KeptLight& b) { return a.lamp < b.lamp; });
}

} // namespace hearth::receivers
