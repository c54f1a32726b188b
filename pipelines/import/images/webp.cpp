// Decodes WebP through libwebp: lossy, lossless and alpha; animations are refused.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/codecs.h"

#include <webp/decode.h>

namespace hearth::import
{

namespace
{

constexpr int kLossy = 1;

/// Return the size of the shortest file with the image of the header: VP8 codes a macroblock's mode in two
/// bits or more. A lossless image of one colour takes no bits a texel.
uint64_t minFileBytes(const WebPBitstreamFeatures& features)
{
    const auto blocks = [](int size) { return (static_cast<uint64_t>(size) + 15) / 16; };
    return features.format == kLossy ? blocks(features.width) * blocks(features.height) / 4 : 0;
}

} // namespace

Result<DecodedImage> decodeWebp(const EncodedImage& source)
{
    WebPBitstreamFeatures features;
    const VP8StatusCode status = WebPGetFeatures(source.data(), source.bytes.size(), &features);
    if (status != VP8_STATUS_OK)
        return source.malformed(status == VP8_STATUS_NOT_ENOUGH_DATA ? "WebP: the file ends too early"
                                                                     : "WebP: the header is damaged");
    HEARTH_TRY(checkImageSize(source, static_cast<uint64_t>(features.width),
                              static_cast<uint64_t>(features.height)));
    if (features.has_animation != 0)
        return source.unsupported("animated WebP images are not read");
    HEARTH_TRY(checkFileSize(source, "WebP", minFileBytes(features)));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, static_cast<uint64_t>(features.width),
                                          static_cast<uint64_t>(features.height), ChannelType::unorm8));
    if (WebPDecodeRGBAInto(source.data(), source.bytes.size(), imageBytes(image), image.texels.size(),
                           features.width * 4) == nullptr)
        return source.malformed("WebP: the data is damaged or ends too early");
    return image;
}

} // namespace hearth::import
