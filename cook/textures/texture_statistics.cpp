// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_statistics.h"

#include "cook/json/json.h"
#include "cook/textures/texel_codec.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"
#include "formats/records/texel_format_name.h"

#include <algorithm>
#include <cmath>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Sum the squared differences of one texel's channels, from 0 to 255 * 255: colours times alpha, others
/// times 255.
uint64_t squaredDifference(Content content, const uint8_t* a, const uint8_t* b)
{
    uint64_t sum = 0;
    for (int channel = 0; channel < 4; ++channel)
    {
        const bool by_alpha = content == Content::color && channel < 3;
        const int64_t difference =
            int64_t{a[channel]} * (by_alpha ? a[3] : 255) - int64_t{b[channel]} * (by_alpha ? b[3] : 255);
        sum += static_cast<uint64_t>(difference * difference);
    }
    return sum;
}

const char* contentName(Content content)
{
    switch (content)
    {
    case Content::color:
        return "color";
    case Content::data:
        return "data";
    case Content::normals:
        return "normals";
    case Content::light:
        return "light";
    }
    return "unknown";
}

/// Convert to decibels below the whole range; null if nothing differs.
Json psnr(double rms)
{
    return rms > 0 ? Json(-20 * std::log10(rms)) : Json(nullptr);
}

Json errorJson(double rms)
{
    return {{"rms", rms}, {"psnr_db", psnr(rms)}};
}

Json imageJson(const ImageStatistics& image, size_t index)
{
    Json json{{"index", index},
              {"name", image.name},
              {"width", image.image.width},
              {"height", image.image.height},
              {"mips", image.image.mip_count},
              {"format", texelFormatName(image.image.format)},
              {"content", contentName(classifyContent(image.image))},
              {"placeholder", (image.image.flags & kImagePlaceholder) != 0},
              {"bytes", image.bytes},
              {"bytes_stored", image.stored_bytes}};
    for (const UseStatistics& use : image.uses)
        json["uses"].push_back({{"material", use.material}, {"role", use.role}});
    if (image.error)
        json["error"] = errorJson(*image.error);
    if (image.half_error)
        json["half_size_error"] = errorJson(*image.half_error);
    return json;
}

} // namespace

double mipError(const ImageRecord& image, std::span<const std::byte> mips, uint32_t mip)
{
    HEARTH_ASSERT(texelBytes(image.format) == 4 && mip < image.mip_count);
    const Content content = classifyContent(image);
    const auto* finest = reinterpret_cast<const uint8_t*>(mips.data());
    const auto* smaller = reinterpret_cast<const uint8_t*>(mips.data() + mipOffset(image, mip));
    const MipExtent size = mipExtent(image, mip);
    uint64_t sum = 0; // 2^28 texels of 4 channels of 2^32 fit
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x)
        {
            // odd sizes are stretched, too, so that all of the smaller mip is used
            const size_t smaller_x = size_t{x} * size.width / image.width;
            const size_t smaller_y = size_t{y} * size.height / image.height;
            sum += squaredDifference(content, finest + (size_t{y} * image.width + x) * 4,
                                     smaller + (smaller_y * size.width + smaller_x) * 4);
        }
    const double channels = 4.0 * image.width * image.height;
    return std::sqrt(static_cast<double>(sum) / channels) / (255.0 * 255.0);
}

std::string statisticsJson(const std::string& source, std::span<const ImageStatistics> images)
{
    Json json{{"schema", "hearth.textures/1"}, {"source", source}, {"images", Json::array()}};
    for (size_t i = 0; i < images.size(); ++i)
        json["images"].push_back(imageJson(images[i], i));
    return json.dump(2) + "\n";
}

} // namespace hearth::textures
