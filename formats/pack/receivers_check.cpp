// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"

#include <algorithm>
#include <vector>

namespace hearth::formats::check
{

namespace
{

constexpr const char* kLampKind = "receiver lamp";
constexpr const char* kRectKind = "receiver rectangle";
constexpr uint32_t kMaxUvSets = 4;

/// Words of messages about texels of an atlas, and about faces of bricks as texels.
struct Words
{
    const char* atlas;
    const char* block;
    const char* word;
    const char* place_is_free; ///< of a texel that no rectangle, or no face, is left for
};
constexpr Words kTexelWords{"receivers", "receiver block", "receiver word",
                            " is at no rectangle, or in an earlier block"};
constexpr Words kFaceWords{"face receivers", "face block", "face word", " is in an earlier block"};

/// Set of texels of an atlas.
class TexelSet
{
public:
    explicit TexelSet(const ReceiverAtlasRecord& atlas)
        : width_(atlas.width), bits_((size_t{atlas.width} * atlas.height + 63) / 64)
    {
    }
    /// Add a texel. returns  false if it is there
    bool add(uint32_t x, uint32_t y)
    {
        const bool is_new = (word(x, y) & bit(x, y)) == 0;
        word(x, y) |= bit(x, y);
        return is_new;
    }
    /// Remove a texel. returns  false if it is not there
    bool remove(uint32_t x, uint32_t y)
    {
        const bool is_there = (word(x, y) & bit(x, y)) != 0;
        word(x, y) &= ~bit(x, y);
        return is_there;
    }

private:
    uint64_t& word(uint32_t x, uint32_t y) { return bits_[(size_t{y} * width_ + x) / 64]; }
    uint64_t bit(uint32_t x, uint32_t y) const { return uint64_t{1} << (size_t{y} * width_ + x) % 64; }

    size_t width_;
    std::vector<uint64_t> bits_;
};

Status checkAtlas(const PackView& view, const ReceiverTables& tables, const Words& words)
{
    const ReceiverAtlasRecord& atlas = tables.atlas;
    const auto wrong = [&](std::string detail)
    { return makeError(view, Issue::meaning_value, words.atlas, 0, std::move(detail)); };
    if (atlas.width == 0 || atlas.width > shared::kMaxReceiverSide || atlas.height == 0 ||
        atlas.height > shared::kMaxReceiverSide)
        return wrong(std::to_string(atlas.width) + " x " + std::to_string(atlas.height) + " texels");
    if (atlas.codec > static_cast<uint32_t>(ReceiverCodec::rgbm))
        return wrong("codec " + std::to_string(atlas.codec));
    if (!isPowerOfTwo(atlas.scale) || !inside(atlas.scale, kMinReceiverScale, 1 / kMinReceiverScale))
        return wrong("its scale is not possible");
    if (!reservedZero(atlas.reserved))
        return makeError(view, Issue::meaning_padding, words.atlas, 0, "a reserved field is not 0");
    if (atlas.lamp_count != tables.lamps.size() || atlas.rect_count != tables.rects.size() ||
        atlas.block_count != tables.blocks.size() || atlas.word_count != tables.words.size())
        return makeError(view, Issue::meaning_range, words.atlas, 0,
                         "its tables have other sizes than it says");
    return atlas.lamp_count <= kMaxReceiverLamps ? success() : wrong("too many lamps");
}

Status checkLamps(const PackView& view, const ReceiverTables& tables)
{
    for (size_t i = 0; i < tables.lamps.size(); ++i)
    {
        const ReceiverLampRecord& lamp = tables.lamps[i];
        const bool is_steady = lamp.kind == static_cast<uint32_t>(ReceiverLampKind::steady);
        if (lamp.kind > static_cast<uint32_t>(ReceiverLampKind::mesh_light) || (is_steady && lamp.index != 0))
            return makeError(view, Issue::meaning_value, kLampKind, i,
                             "kind " + std::to_string(lamp.kind) + ", index " + std::to_string(lamp.index));
        const auto key = [](const ReceiverLampRecord& l) { return uint64_t{l.kind} << 32 | l.index; };
        if (i > 0 && key(tables.lamps[i - 1]) >= key(lamp))
            return makeError(view, Issue::meaning_order, kLampKind, i, "lamps do not rise");
    }
    return success();
}

/// Add the texels around a rectangle that may receive, too: bilinear taps at its edge read them.
void addBorder(const ReceiverAtlasRecord& atlas, const ReceiverRectRecord& rect, TexelSet& texels)
{
    const uint32_t left = rect.x - (rect.x > 0 ? 1 : 0), top = rect.y - (rect.y > 0 ? 1 : 0);
    const uint32_t right = std::min(rect.x + rect.width + 1, atlas.width);
    const uint32_t bottom = std::min(rect.y + rect.height + 1, atlas.height);
    for (uint32_t y = top; y < bottom; ++y)
        for (uint32_t x = left; x < right; ++x)
            texels.add(x, y);
}

/// Check the rectangles, and collect their texels and those around them.
Status collectTexels(const PackView& view, const ReceiverTables& tables, TexelSet& texels)
{
    for (size_t i = 0; i < tables.rects.size(); ++i)
    {
        const ReceiverRectRecord& rect = tables.rects[i];
        const ReceiverAtlasRecord& atlas = tables.atlas;
        if (rect.width == 0 || rect.height == 0 || rect.x >= atlas.width || rect.y >= atlas.height ||
            rect.width > atlas.width - rect.x || rect.height > atlas.height - rect.y)
            return makeError(view, Issue::meaning_range, kRectKind, i, "it leaves the atlas");
        if (rect.uv_set >= kMaxUvSets)
            return makeError(view, Issue::meaning_value, kRectKind, i,
                             "UV set " + std::to_string(rect.uv_set));
        if (i > 0 && tables.rects[i - 1].instance >= rect.instance)
            return makeError(view, Issue::meaning_order, kRectKind, i, "instances do not rise");
        for (uint32_t y = rect.y; y < rect.y + rect.height; ++y)
            for (uint32_t x = rect.x; x < rect.x + rect.width; ++x)
                if (!texels.add(x, y))
                    return makeError(view, Issue::meaning_value, kRectKind, i, "it overlaps another one");
    }
    for (const ReceiverRectRecord& rect : tables.rects)
        addBorder(tables.atlas, rect, texels);
    return success();
}

/// Check the numbers of a block: those of its words are not read before.
/// first_word  behind the block before
Status checkBlock(const PackView& view, const ReceiverTables& tables, const Words& kinds, size_t i,
                  uint64_t first_word)
{
    const ReceiverBlockRecord& block = tables.blocks[i];
    const auto wrong = [&](Issue issue, std::string detail)
    { return makeError(view, issue, kinds.block, i, std::move(detail)); };
    if (block.texel_count == 0 || block.texel_count > shared::kReceiverBlockTexels ||
        block.color_count == 0 || block.color_count > shared::kMaxReceiverColors ||
        block.group >= shared::kReceiverGroups)
        return wrong(Issue::meaning_value, std::to_string(block.texel_count) + " texels, " +
                                               std::to_string(block.color_count) + " colours, group " +
                                               std::to_string(block.group));
    if (block.first_word != first_word)
        return wrong(Issue::meaning_order, "words start at " + std::to_string(block.first_word) +
                                               ", expected " + std::to_string(first_word));
    const uint64_t words = uint64_t{block.texel_count} * (1 + block.color_count);
    if (words > tables.words.size() - first_word)
        return wrong(Issue::meaning_range, "its words leave the table");
    if (i > 0 && tables.blocks[i - 1].group > block.group)
        return wrong(Issue::meaning_order, "update groups do not rise");
    for (uint32_t color = 0; color < shared::kMaxReceiverColors; ++color)
    {
        const uint32_t lamp = shared::receiverLamp(block, color);
        if (color >= block.color_count && lamp != 0)
            return wrong(Issue::meaning_padding, "a lamp behind its colours is not 0");
        if (color < block.color_count && lamp >= tables.lamps.size())
            return wrong(Issue::meaning_reference, "lamp " + std::to_string(lamp));
        if (color > 0 && color < block.color_count && lamp <= shared::receiverLamp(block, color - 1))
            return wrong(Issue::meaning_order, "lamps do not rise");
    }
    return success();
}

/// Check the places of a block's texels. All colours are allowed.
/// texels  at the rectangles, without those of earlier blocks; the block's are taken out
Status checkPlaces(const PackView& view, const ReceiverTables& tables, const Words& kinds, size_t i,
                   TexelSet& texels)
{
    const ReceiverBlockRecord& block = tables.blocks[i];
    const std::span places = tables.words.subspan(block.first_word, block.texel_count);
    for (size_t t = 0; t < places.size(); ++t)
    {
        const uint32_t x = shared::receiverX(places[t]), y = shared::receiverY(places[t]);
        const std::string text = "texel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
        const auto wrong = [&](Issue issue, const char* detail)
        { return makeError(view, issue, kinds.block, i, text + detail); };
        if ((places[t] & ~shared::kReceiverDrops) >> (2 * shared::kReceiverSideBits) != 0)
            return wrong(Issue::meaning_padding, ": reserved bits are not 0");
        if (x >= tables.atlas.width || y >= tables.atlas.height)
            return wrong(Issue::meaning_range, " lies outside the atlas");
        if (shared::receiverGroup(x, y) != block.group)
            return wrong(Issue::meaning_value, " is of another update group");
        if (t > 0 && receiverOrder(shared::receiverX(places[t - 1]), shared::receiverY(places[t - 1])) >=
                         receiverOrder(x, y))
            return wrong(Issue::meaning_order, " does not follow the one before");
        if (!texels.remove(x, y))
            return wrong(Issue::meaning_value, kinds.place_is_free);
    }
    return success();
}

Status checkBlocks(const PackView& view, const ReceiverTables& tables, const Words& kinds, TexelSet& texels)
{
    uint64_t words = 0, texel_count = 0;
    uint32_t group_blocks[shared::kReceiverGroups] = {};
    for (size_t i = 0; i < tables.blocks.size(); ++i)
    {
        HEARTH_TRY(checkBlock(view, tables, kinds, i, words));
        HEARTH_TRY(checkPlaces(view, tables, kinds, i, texels));
        const ReceiverBlockRecord& block = tables.blocks[i];
        words += uint64_t{block.texel_count} * (1 + block.color_count);
        texel_count += block.texel_count;
        ++group_blocks[block.group];
    }
    if (words != tables.words.size())
        return makeError(view, Issue::meaning_range, kinds.word, words, "belongs to no block");
    if (texel_count != tables.atlas.texel_count ||
        !std::equal(std::begin(group_blocks), std::end(group_blocks), std::begin(tables.atlas.group_blocks)))
        return makeError(view, Issue::meaning_value, kinds.atlas, 0,
                         "its blocks have other texels or groups than it says");
    return success();
}

/// Check that there are no tables but the lamps, which texels and faces share.
Status checkNoAtlas(const PackView& view, const ReceiverTables& tables, const Words& words)
{
    return tables.rects.empty() && tables.blocks.empty() && tables.words.empty()
               ? success()
               : makeError(view, Issue::meaning_range, words.atlas, 0, "tables without an atlas");
}

Status checkTexels(const PackView& view)
{
    const ReceiverTables tables = view.receivers();
    if (view.receiverAtlases().size() > 1)
        return makeError(view, Issue::meaning_value, kTexelWords.atlas, 1, "a pack has one at most");
    if (view.receiverAtlases().empty())
        return checkNoAtlas(view, tables, kTexelWords);
    HEARTH_TRY(checkAtlas(view, tables, kTexelWords));
    TexelSet texels(tables.atlas);
    HEARTH_TRY(collectTexels(view, tables, texels));
    return checkBlocks(view, tables, kTexelWords, texels);
}

/// Check faces of bricks as receivers. How many there are is in the grid: checkFaceReferences.
Status checkFaces(const PackView& view)
{
    const ReceiverTables tables = view.faceReceivers();
    if (view.faceAtlases().size() > 1)
        return makeError(view, Issue::meaning_value, kFaceWords.atlas, 1, "a pack has one at most");
    if (view.faceAtlases().empty())
        return checkNoAtlas(view, tables, kFaceWords);
    HEARTH_TRY(checkAtlas(view, tables, kFaceWords));
    TexelSet faces(tables.atlas);
    for (uint32_t y = 0; y < tables.atlas.height; ++y)
        for (uint32_t x = 0; x < tables.atlas.width; ++x)
            faces.add(x, y);
    return checkBlocks(view, tables, kFaceWords, faces);
}

} // namespace

Status checkReceiverTables(const PackView& view)
{
    if (view.receiverAtlases().empty() && view.faceAtlases().empty() && !view.receivers().lamps.empty())
        return makeError(view, Issue::meaning_range, kLampKind, 0, "there are no receivers");
    HEARTH_TRY(checkLamps(view, view.receivers()));
    HEARTH_TRY(checkTexels(view));
    return checkFaces(view);
}

Status checkReceiverReferences(const PackView& view)
{
    const ReceiverTables tables = view.receivers();
    for (size_t i = 0; i < tables.lamps.size(); ++i)
    {
        const ReceiverLampRecord& lamp = tables.lamps[i];
        const bool is_light = lamp.kind == static_cast<uint32_t>(ReceiverLampKind::light);
        const size_t size = is_light ? view.lights().size() : view.instances().size();
        if (lamp.kind != static_cast<uint32_t>(ReceiverLampKind::steady) && lamp.index >= size)
            return makeError(view, Issue::meaning_reference, kLampKind, i,
                             (is_light ? "light " : "instance ") + std::to_string(lamp.index));
    }
    for (size_t i = 0; i < tables.rects.size(); ++i)
    {
        const ReceiverRectRecord& rect = tables.rects[i];
        if (rect.instance >= view.instances().size())
            return makeError(view, Issue::meaning_reference, kRectKind, i,
                             "instance " + std::to_string(rect.instance));
        const uint32_t mesh = view.instances()[rect.instance].mesh;
        if (mesh >= view.meshes().size() ||
            (view.meshes()[mesh].attributes & shared::kVertexUv0 << rect.uv_set) == 0)
            return makeError(view, Issue::meaning_reference, kRectKind, i,
                             "UV set " + std::to_string(rect.uv_set) + " that its mesh does not have");
    }
    return success();
}

Status checkFaceReferences(const PackView& view)
{
    if (view.faceAtlases().empty())
        return success();
    const ReceiverTables tables = view.faceReceivers();
    const uint32_t count = view.brickGrid().empty() ? 0 : view.brickGrid()[0].face_count;
    const FaceAtlasSize size = faceAtlasSize(count);
    if (tables.atlas.width != size.width || tables.atlas.height != size.height)
        return makeError(view, Issue::meaning_reference, kFaceWords.atlas, 0,
                         "they are not those of the grid, which has " + std::to_string(count) + " faces");
    for (size_t i = 0; i < tables.blocks.size(); ++i)
        for (const uint32_t place :
             tables.words.subspan(tables.blocks[i].first_word, tables.blocks[i].texel_count))
            if (shared::receiverFace(place) >= count)
                return makeError(view, Issue::meaning_reference, kFaceWords.block, i,
                                 "face " + std::to_string(shared::receiverFace(place)));
    return success();
}

} // namespace hearth::formats::check
