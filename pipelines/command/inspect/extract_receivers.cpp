// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/extract_receivers.h"

#include "pipelines/command/inspect/light_picture.h"
#include "pipelines/command/inspect/open_pack.h"

namespace hearth::command
{

using namespace formats;

namespace
{

/// Add the light of all lamps of a block.
void addBlock(const ReceiverTables& tables, const ReceiverBlockRecord& block, LightPicture& picture)
{
    for (uint32_t i = 0; i < block.texel_count; ++i)
    {
        const uint32_t place = tables.words[block.first_word + i];
        Float3 sum;
        for (uint32_t color = 0; color < block.color_count; ++color)
            sum += shared::decodeReceiverColor(
                tables.words[block.first_word + (1 + color) * block.texel_count + i], tables.atlas.codec);
        picture.texels[size_t{shared::receiverY(place)} * picture.width + shared::receiverX(place)] =
            sum * tables.atlas.scale;
    }
}

} // namespace

Status extractReceivers(const std::string& path, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    if (file.receiverAtlases().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkReceivers, 0), "the file has no receivers"};
    if (!isPictureName(output))
        return Error{Issue::usage, output, "", "receivers are written as .exr or .png"};
    const ReceiverTables tables = file.receivers();
    LightPicture picture{tables.atlas.width, tables.atlas.height, {}};
    picture.texels.resize(size_t{picture.width} * picture.height);
    for (const ReceiverBlockRecord& block : tables.blocks)
        addBlock(tables, block, picture);
    return writePicture(output, picture, 1);
}

} // namespace hearth::command
