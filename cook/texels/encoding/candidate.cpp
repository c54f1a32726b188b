// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/candidate.h"

#include <algorithm>
#include <bit>

namespace hearth::texels
{

using namespace formats;

namespace
{

/// Channels that must be stored, and those that a swizzle makes.
struct ChannelSplit
{
    std::vector<uint8_t> stored;
    Channels ones = 0; ///< 1 everywhere, or read by nobody
    Channels zeros = 0;
};

/// Split the channels of an image. At least one is stored.
ChannelSplit splitChannels(const PlainImage& image)
{
    ChannelSplit split;
    DecodedTexel values;
    const Channels constant = findConstantChannels(image, values);
    for (uint8_t c = 0; c < 4; ++c)
    {
        const auto bit = static_cast<Channels>(1u << c);
        if (!has(image.channels, c) || (has(constant, c) && values[c] == 0xFFFF))
            split.ones |= bit;
        else if (has(constant, c) && values[c] == 0)
            split.zeros |= bit;
        else
            split.stored.push_back(c);
    }
    if (split.stored.empty())
    {
        const uint8_t first = static_cast<uint8_t>(std::countr_zero(static_cast<uint32_t>(image.channels)));
        split.stored.push_back(first);
        split.ones &= static_cast<Channels>(~(1u << first));
        split.zeros &= static_cast<Channels>(~(1u << first));
    }
    return split;
}

/// Set the swizzle of channels that are not stored.
void addConstants(const ChannelSplit& split, Candidate& candidate)
{
    for (uint32_t c = 0; c < 4; ++c)
        if (has(split.ones, c) || has(split.zeros, c))
            candidate.swizzle[c] = has(split.ones, c) ? Swizzle::one : Swizzle::zero;
}

/// Return the number of the stored channel as the source of a swizzle.
Swizzle readFrom(uint32_t channel)
{
    return static_cast<Swizzle>(static_cast<uint32_t>(Swizzle::red) + channel);
}

/// Store the channels in the order of the image, one for each, others as 1.
Candidate layOutPlainly(const ChannelSplit& split, TexelFormat format)
{
    Candidate candidate{.traits = &texelTraits(format), .stored = {0, 1, 2, 3}};
    for (uint8_t c = 0; c < 4; ++c)
        if (std::ranges::find(split.stored, c) == split.stored.end())
            candidate.stored[c] = kStoredOne;
    addConstants(split, candidate);
    return candidate;
}

/// Store the channels one after the other, from red on.
Candidate layOutInOrder(const ChannelSplit& split, TexelFormat format)
{
    Candidate candidate{.traits = &texelTraits(format),
                        .stored = {kStoredOne, kStoredOne, kStoredOne, kStoredOne}};
    for (uint8_t i = 0; i < split.stored.size(); ++i)
    {
        candidate.stored[i] = split.stored[i];
        candidate.swizzle[split.stored[i]] = i == split.stored[i] ? Swizzle::identity : readFrom(i);
    }
    addConstants(split, candidate);
    return candidate;
}

/// Store one channel as luminance, or two as luminance and alpha, which ASTC codes with fewer bits than red
/// and green.
Candidate layOutAsLuminance(const ChannelSplit& split, TexelFormat format)
{
    const uint8_t first = split.stored.front(),
                  second = split.stored.size() > 1 ? split.stored[1] : kStoredOne;
    Candidate candidate{.traits = &texelTraits(format), .stored = {first, first, first, second}};
    candidate.swizzle[first] = first < 3 ? Swizzle::identity : Swizzle::red;
    if (second != kStoredOne)
    {
        candidate.swizzle[second] = second == 3 ? Swizzle::identity : Swizzle::alpha;
        candidate.has_two_parts = true;
    }
    addConstants(split, candidate);
    return candidate;
}

bool isColor(const PlainImage& image)
{
    return isSrgb(image.record.format);
}

/// Return true if the stored channels are numbers that the transfer function does not change: a format of
/// sRGB would change them.
bool isLinear(const ChannelSplit& split)
{
    return split.stored.size() == 1 && split.stored.front() == 3;
}

void addAstc(const PlainImage& image, const ChannelSplit& split, std::vector<Candidate>& candidates)
{
    const bool is_srgb = isColor(image) && !isLinear(split);
    const TexelFormat first = is_srgb ? TexelFormat::astc_srgb : TexelFormat::astc_unorm;
    for (uint32_t footprint = 0; footprint < kAstcFootprints; ++footprint)
    {
        const TexelFormat format = astcFormat(first, footprint);
        const bool is_luminance = !isColor(image) && split.stored.size() <= 2;
        candidates.push_back(is_luminance ? layOutAsLuminance(split, format) : layOutPlainly(split, format));
    }
}

/// Formats of a family with blocks of 4 x 4 texels, by what they store.
struct BlockFormats
{
    TexelFormat one, two;          ///< numbers
    TexelFormat color, color_srgb; ///< without alpha
    TexelFormat alpha, alpha_srgb; ///< with alpha
};

constexpr BlockFormats kEtc2{TexelFormat::eac_r11_unorm,    TexelFormat::eac_rg11_unorm,
                             TexelFormat::etc2_rgb8_unorm,  TexelFormat::etc2_rgb8_srgb,
                             TexelFormat::etc2_rgba8_unorm, TexelFormat::etc2_rgba8_srgb};
constexpr BlockFormats kBc{TexelFormat::bc4_unorm,    TexelFormat::bc5_unorm, TexelFormat::bc1_rgb_unorm,
                           TexelFormat::bc1_rgb_srgb, TexelFormat::bc3_unorm, TexelFormat::bc3_srgb};

/// Return true if alpha is among the stored channels.
bool storesAlpha(const ChannelSplit& split)
{
    return split.stored.back() == 3;
}

void addBlockFormats(const PlainImage& image, const ChannelSplit& split, const BlockFormats& formats,
                     std::vector<Candidate>& candidates)
{
    const bool is_srgb = isColor(image) && !isLinear(split);
    if (!is_srgb && split.stored.size() <= 2)
        candidates.push_back(layOutInOrder(split, split.stored.size() == 1 ? formats.one : formats.two));
    else if (storesAlpha(split))
        candidates.push_back(layOutPlainly(split, is_srgb ? formats.alpha_srgb : formats.alpha));
    else
        candidates.push_back(layOutPlainly(split, is_srgb ? formats.color_srgb : formats.color));
}

void addBc7(const PlainImage& image, const ChannelSplit& split, std::vector<Candidate>& candidates)
{
    const bool is_srgb = isColor(image) && !isLinear(split);
    if (is_srgb || split.stored.size() > 2)
        candidates.push_back(layOutPlainly(split, is_srgb ? TexelFormat::bc7_srgb : TexelFormat::bc7_unorm));
}

/// Store no more channels than are read, with 8 bits of each.
Candidate layOutWithoutCompression(const PlainImage& image, const ChannelSplit& split)
{
    if (isColor(image))
        return layOutPlainly(split, TexelFormat::rgba8_srgb);
    if (split.stored.size() > 2)
        return layOutPlainly(split, TexelFormat::rgba8_unorm);
    return layOutInOrder(split, split.stored.size() == 1 ? TexelFormat::r8_unorm : TexelFormat::rg8_unorm);
}

std::vector<Candidate> listLightCandidates(const Families& families)
{
    std::vector<Candidate> candidates;
    const auto add = [&](TexelFormat format) {
        candidates.push_back({.traits = &texelTraits(format), .stored = {0, 1, 2, kStoredOne}});
    };
    if (families.bc)
        add(TexelFormat::bc6h_ufloat);
    if (families.astc_hdr)
        for (uint32_t footprint = 0; footprint < kAstcFootprints; ++footprint)
            add(astcFormat(TexelFormat::astc_float, footprint));
    std::ranges::stable_sort(candidates, {}, &Candidate::bitsPerTexel);
    add(TexelFormat::rgb9e5_float);
    return candidates;
}

} // namespace

std::vector<Candidate> listCandidates(const PlainImage& image, const Families& families)
{
    if (image.role == ImageRole::light)
        return listLightCandidates(families);
    std::vector<Candidate> candidates;
    const ChannelSplit split = splitChannels(image);
    if (families.etc2)
        addBlockFormats(image, split, kEtc2, candidates);
    if (families.bc)
    {
        addBlockFormats(image, split, kBc, candidates);
        addBc7(image, split, candidates);
    }
    if (families.astc)
        addAstc(image, split, candidates);
    std::ranges::stable_sort(candidates, {}, &Candidate::bitsPerTexel);
    candidates.push_back(layOutWithoutCompression(image, split));
    return candidates;
}

} // namespace hearth::texels
