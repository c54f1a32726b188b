// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/read_texels.h"

#include "cook/textures/texture_part.h"
#include "formats/pack/pack_view.h"

namespace hearth::textures
{

using namespace formats;

Result<std::vector<std::byte>> readTexels(const ContainerReader& part, const ImageRecord& image,
                                          uint32_t index)
{
    const std::string where = "image " + std::to_string(index);
    if (image.width == 0 || image.width > kMaxTextureSize || image.height == 0 ||
        image.height > kMaxTextureSize || texelBytes(image.format) == 0)
        return Error{Issue::meaning_value, part.name(), where,
                     std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " texels of format " + std::to_string(image.format)};
    if (part.find(kChunkImageData, index) == nullptr)
        return Error{Issue::chunk_missing, part.name(), chunkName(kChunkImageData, index), ""};
    HEARTH_ASSIGN_OR_RETURN(const ChunkData data, part.read(kChunkImageData, index));
    const uint64_t finest = mipOffset(image, 1);
    if (data.bytes().size() < finest)
        return Error{Issue::chunk_size, part.name(), chunkName(kChunkImageData, index),
                     std::to_string(data.bytes().size()) + " bytes, the image has " + std::to_string(finest)};
    return std::vector<std::byte>(data.bytes().begin(),
                                  data.bytes().begin() + static_cast<std::ptrdiff_t>(finest));
}

} // namespace hearth::textures
