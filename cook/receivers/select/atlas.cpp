// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/select/atlas.h"

#include "formats/base/assert.h"
#include "formats/texels/rgbm.h"
#include "formats/texels/shared_exponent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hearth::receivers
{

using formats::ReceiverBlockRecord;
using formats::ReceiverCodec;

namespace
{

// Largest colour stored as RGB9E5: the sum of all lamps, which has the same format, may be 16 times as bright
// by their weights before it is cut.
constexpr double kMaxStoredRgb9e5 = 4096;

/// Lamps that a texel keeps; 0 behind count.
struct LampSet
{
    uint32_t count = 0;
    std::array<uint32_t, shared::kMaxReceiverColors> lamps{};

    friend auto operator<=>(const LampSet&, const LampSet&) = default;
};

struct Texel
{
    uint32_t x, y;
    LampSet set;
    size_t first_color; ///< of Chosen::colors
    bool drops;         ///< shared::kReceiverDrops

    uint32_t group() const { return shared::receiverGroup(x, y); }
    uint32_t order() const { return formats::receiverOrder(x, y); }
};

/// Texels with light, row by row, and their colours.
struct Chosen
{
    std::vector<Texel> texels;
    std::vector<Float3> colors;
    double largest = 0; ///< largest channel of the sum of a texel's lamps
    double largest_dropped = 0;
};

/// Return the largest channel of a lamp that is not kept, over that of the sum of all.
double measureDropped(std::span<const Float3> light, std::span<const KeptLight> kept)
{
    Double3 sum{};
    double dropped = 0;
    size_t next = 0;
    for (size_t lamp = 0; lamp < light.size(); ++lamp)
    {
        const Double3 color = widen(light[lamp]);
        sum = sum + color;
        if (next < kept.size() && kept[next].lamp == lamp)
            ++next;
        else
            dropped = std::max(dropped, largestChannel(color));
    }
    return largestChannel(sum) > 0 ? dropped / largestChannel(sum) : 0;
}

void chooseTexel(const BakedLight& baked, const SelectOptions& options, uint32_t x, uint32_t y,
                 std::vector<KeptLight>& kept, Chosen& chosen)
{
    const size_t lamps = baked.lamps.size();
    const std::span light = baked.light.subspan((size_t{y} * baked.width + x) * lamps, lamps);
    const bool is_steady =
        lamps != 0 && baked.lamps[0].kind == static_cast<uint32_t>(formats::ReceiverLampKind::steady);
    selectLights(light, is_steady, options, kept);
    if (kept.empty())
        return;
    const double dropped = measureDropped(light, kept);
    Texel texel{x, y, {}, chosen.colors.size(), dropped > double{shared::kMaxUnseenDrop}};
    Double3 sum{};
    for (const KeptLight& lamp : kept)
    {
        texel.set.lamps[texel.set.count++] = lamp.lamp;
        chosen.colors.push_back(narrow(lamp.color));
        sum = sum + lamp.color;
    }
    chosen.texels.push_back(texel);
    chosen.largest = std::max({chosen.largest, sum.x, sum.y, sum.z});
    chosen.largest_dropped = std::max(chosen.largest_dropped, dropped);
}

Chosen chooseTexels(const BakedLight& baked, const SelectOptions& options)
{
    Chosen chosen;
    std::vector<KeptLight> kept;
    for (uint32_t y = 0; y < baked.height; ++y)
        for (uint32_t x = 0; x < baked.width; ++x)
            if (baked.valid[size_t{y} * baked.width + x] != 0)
                chooseTexel(baked, options, x, y, kept, chosen);
    return chosen;
}

/// Return the power of two by which colours are divided so that they fit the codec.
float chooseScale(double largest, ReceiverCodec codec)
{
    const double limit = codec == ReceiverCodec::rgbm ? formats::kMaxRgbmValue : kMaxStoredRgb9e5;
    if (largest == 0)
        return 1;
    const int exponent = static_cast<int>(std::ceil(std::log2(largest / limit)));
    return std::clamp(static_cast<float>(std::ldexp(1.0, std::min(exponent, 127))),
                      formats::kMinReceiverScale, 1 / formats::kMinReceiverScale);
}

uint32_t encodeColor(Float3 color, float scale, ReceiverCodec codec)
{
    const std::array<double, 3> channels{double{color.x} / double{scale}, double{color.y} / double{scale},
                                         double{color.z} / double{scale}};
    return codec == ReceiverCodec::rgbm ? formats::encodeRgbm(channels)
                                        : formats::encodeSharedExponent(channels);
}

/// Return the texels by update group, then set of lamps, then along the Z-order curve.
std::vector<uint32_t> sortTexels(std::span<const Texel> texels)
{
    std::vector<uint32_t> order(texels.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](uint32_t i, uint32_t j)
              {
                  const Texel &a = texels[i], &b = texels[j];
                  if (a.group() != b.group())
                      return a.group() < b.group();
                  return a.set != b.set ? a.set < b.set : a.order() < b.order();
              });
    return order;
}

/// Half-open range of sorted texels.
struct BlockRange
{
    size_t begin, end;
};

/// Cut the sorted texels into blocks, which follow each other by group and the place of their first texel.
std::vector<BlockRange> cutBlocks(std::span<const Texel> texels, std::span<const uint32_t> order)
{
    std::vector<BlockRange> blocks;
    for (size_t begin = 0; begin < order.size();)
    {
        const Texel& first = texels[order[begin]];
        size_t end = begin + 1;
        while (end < order.size() && end - begin < shared::kReceiverBlockTexels &&
               texels[order[end]].group() == first.group() && texels[order[end]].set == first.set)
            ++end;
        blocks.push_back({begin, end});
        begin = end;
    }
    std::sort(blocks.begin(), blocks.end(),
              [&](const BlockRange& i, const BlockRange& j)
              {
                  const Texel &a = texels[order[i.begin]], &b = texels[order[j.begin]];
                  return a.group() != b.group() ? a.group() < b.group() : a.order() < b.order();
              });
    return blocks;
}

/// Add a block of texels and its words.
void appendBlock(const Chosen& chosen, std::span<const uint32_t> members, Atlas& atlas)
{
    const Texel& first = chosen.texels[members[0]];
    ReceiverBlockRecord block{};
    block.first_word = static_cast<uint32_t>(atlas.words.size());
    block.texel_count = static_cast<uint32_t>(members.size());
    block.color_count = first.set.count;
    block.group = first.group();
    for (uint32_t color = 0; color < block.color_count; ++color)
        block.lamps[color / 2] |= first.set.lamps[color] << (16 * (color % 2));
    for (const uint32_t member : members)
    {
        const Texel& texel = chosen.texels[member];
        atlas.words.push_back(shared::encodeReceiverPlace(texel.x, texel.y) |
                              (texel.drops ? shared::kReceiverDrops : 0u));
        atlas.dropping_count += texel.drops ? 1 : 0;
    }
    for (uint32_t color = 0; color < block.color_count; ++color)
        for (const uint32_t member : members)
            atlas.words.push_back(encodeColor(chosen.colors[chosen.texels[member].first_color + color],
                                              atlas.record.scale,
                                              static_cast<ReceiverCodec>(atlas.record.codec)));
    atlas.blocks.push_back(block);
    ++atlas.record.group_blocks[block.group];
    atlas.color_count += uint64_t{block.color_count} * block.texel_count;
    atlas.triple_count += uint64_t{(block.color_count + 2) / 3} * block.texel_count;
}

} // namespace

Atlas packAtlas(const BakedLight& baked, const AtlasOptions& options)
{
    const size_t texels = size_t{baked.width} * baked.height;
    HEARTH_ASSERT(baked.width >= 1 && baked.width <= shared::kMaxReceiverSide);
    HEARTH_ASSERT(baked.height >= 1 && baked.height <= shared::kMaxReceiverSide);
    HEARTH_ASSERT(baked.lamps.size() <= formats::kMaxReceiverLamps);
    HEARTH_ASSERT(baked.valid.size() == texels && baked.light.size() == texels * baked.lamps.size());

    const Chosen chosen = chooseTexels(baked, options.select);
    Atlas atlas;
    atlas.lamps.assign(baked.lamps.begin(), baked.lamps.end());
    atlas.rects.assign(baked.rects.begin(), baked.rects.end());
    atlas.record.width = baked.width;
    atlas.record.height = baked.height;
    atlas.record.codec = static_cast<uint32_t>(options.codec);
    atlas.record.scale = chooseScale(chosen.largest, options.codec);
    const std::vector<uint32_t> order = sortTexels(chosen.texels);
    for (const BlockRange& range : cutBlocks(chosen.texels, order))
        appendBlock(chosen, std::span(order).subspan(range.begin, range.end - range.begin), atlas);
    HEARTH_ASSERT(atlas.words.size() < formats::kMaxTableBytes / sizeof(uint32_t));
    atlas.record.lamp_count = static_cast<uint32_t>(atlas.lamps.size());
    atlas.record.rect_count = static_cast<uint32_t>(atlas.rects.size());
    atlas.record.block_count = static_cast<uint32_t>(atlas.blocks.size());
    atlas.record.word_count = static_cast<uint32_t>(atlas.words.size());
    atlas.record.texel_count = static_cast<uint32_t>(chosen.texels.size());
    atlas.largest_dropped = chosen.largest_dropped;
    return atlas;
}

Atlas packFaces(std::span<const formats::ReceiverLampRecord> lamps, std::span<const Float3> light,
                uint32_t face_count, const AtlasOptions& options)
{
    HEARTH_ASSERT(face_count > 0 && light.size() == face_count * lamps.size());
    const formats::FaceAtlasSize size = formats::faceAtlasSize(face_count);
    const size_t cells = size_t{size.width} * size.height;
    std::vector<uint8_t> valid(cells);
    std::fill_n(valid.begin(), face_count, uint8_t{1});
    std::vector<Float3> light_of_cells(light.begin(), light.end());
    light_of_cells.resize(cells * lamps.size());
    return packAtlas({size.width, size.height, lamps, {}, valid, light_of_cells}, options);
}

} // namespace hearth::receivers
