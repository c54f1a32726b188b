// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/light_pictures/receiver_picture.h"

#include <algorithm>

namespace hearth::light_pictures
{

using namespace formats;

namespace
{

/// Add the light of all lamps of a block.
void addBlock(const ReceiverTables& tables, const ReceiverBlockRecord& block, bool shows_drops,
              LightPicture& picture)
{
    for (uint32_t i = 0; i < block.texel_count; ++i)
    {
        const uint32_t place = tables.words[block.first_word + i];
        Float3 sum;
        for (uint32_t color = 0; color < block.color_count; ++color)
            sum += shared::decodeReceiverColor(
                tables.words[block.first_word + (1 + color) * block.texel_count + i], tables.atlas.codec);
        if (shows_drops && (place & shared::kReceiverDrops) != 0)
            sum = {std::max({sum.x, sum.y, sum.z}), 0, 0};
        picture.texels[size_t{shared::receiverY(place)} * picture.width + shared::receiverX(place)] =
            sum * tables.atlas.scale;
    }
}

} // namespace

LightPicture drawReceivers(const ReceiverTables& tables, bool shows_drops)
{
    LightPicture picture{tables.atlas.width, tables.atlas.height, {}};
    picture.texels.resize(size_t{picture.width} * picture.height);
    for (const ReceiverBlockRecord& block : tables.blocks)
        addBlock(tables, block, shows_drops, picture);
    return picture;
}

} // namespace hearth::light_pictures
