// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_receivers.h"

#include "pipelines/command/extract/open_pack.h"
#include "pipelines/light_pictures/receiver_picture.h"

namespace hearth::command
{

using namespace formats;

Status extractReceivers(const std::string& path, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    if (file.receiverAtlases().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkReceivers, 0), "the file has no receivers"};
    if (!light_pictures::isPictureName(output))
        return Error{Issue::usage, output, "", "receivers are written as .exr or .png"};
    return light_pictures::writePicture(output, light_pictures::drawReceivers(file.receivers(), false), 1);
}

} // namespace hearth::command
