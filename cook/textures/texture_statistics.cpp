// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_statistics.h"

#include "cook/json/json.h"
#include "cook/textures/texel_codec.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"
#include "formats/records/texel_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Return four channels of a texel, scaled so that their maximum is `kMax`.
template <typename T, int64_t kMax>
std::array<int64_t, 4> readTexel(const std::byte* texels, size_t i)
{
    std::array<T, 4> stored;
    std::memcpy(stored.data(), texels + i * sizeof(stored), sizeof(stored));
    constexpr int64_t kScale = kMax / std::numeric_limits<T>::max();
    return {stored[0] * kScale, stored[1] * kScale, stored[2] * kScale, stored[3] * kScale};
}

/// Return the mean of the squared differences of all channels of the finest mip and a smaller one: colours
/// times alpha. Channels of 8 bits are summed in integers, which is faster.
/// Finest, Smaller  types of their channels
template <typename Finest, typename Smaller>
double meanSquare(const ImageRecord& image, const std::byte* finest, const std::byte* smaller,
                  MipExtent smaller_size)
{
    constexpr bool kIsNarrow = sizeof(Finest) == 1 && sizeof(Smaller) == 1;
    constexpr int64_t kMax = kIsNarrow ? 255 : 65535;
    const bool is_color = classifyContent(image) == Content::color;
    // 2^28 texels of 4 channels of 2^32 fit 64 bits
    std::conditional_t<kIsNarrow, uint64_t, double> sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x)
        {
            // odd sizes are stretched, too, so that all of the smaller mip is used
            const size_t smaller_x = size_t{x} * smaller_size.width / image.width;
            const size_t smaller_y = size_t{y} * smaller_size.height / image.height;
            const auto a = readTexel<Finest, kMax>(finest, size_t{y} * image.width + x);
            const auto b = readTexel<Smaller, kMax>(smaller, smaller_y * smaller_size.width + smaller_x);
            for (size_t channel = 0; channel < 4; ++channel)
            {
                const bool by_alpha = is_color && channel < 3;
                const int64_t difference =
                    a[channel] * (by_alpha ? a[3] : kMax) - b[channel] * (by_alpha ? b[3] : kMax);
                if constexpr (kIsNarrow)
                    sum += static_cast<uint64_t>(difference * difference);
                else
                    sum += static_cast<double>(difference) * static_cast<double>(difference);
            }
        }
    constexpr auto kRange = static_cast<double>(kMax * kMax);
    return static_cast<double>(sum) / (4.0 * image.width * image.height) / (kRange * kRange);
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

double mipError(const ImageRecord& image, std::span<const std::byte> mips, uint32_t mip,
                std::span<const std::byte> imported)
{
    HEARTH_ASSERT(classifyContent(image) != Content::light && mip < image.mip_count);
    const std::byte* smaller = mips.data() + mipOffset(image, mip);
    const MipExtent size = mipExtent(image, mip);
    if (isUnorm16(image.format))
        return std::sqrt(meanSquare<uint16_t, uint16_t>(image, mips.data(), smaller, size));
    return std::sqrt(imported.empty() ? meanSquare<uint8_t, uint8_t>(image, mips.data(), smaller, size)
                                      : meanSquare<uint16_t, uint8_t>(image, imported.data(), smaller, size));
}

std::string statisticsJson(const std::string& source, std::span<const ImageStatistics> images)
{
    Json json{{"schema", "hearth.textures/1"}, {"source", source}, {"images", Json::array()}};
    for (size_t i = 0; i < images.size(); ++i)
        json["images"].push_back(imageJson(images[i], i));
    return json.dump(2) + "\n";
}

} // namespace hearth::textures
