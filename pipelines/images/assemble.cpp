// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/assemble.h"

#include "formats/base/half.h"
#include "pipelines/images/color_profile.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace hearth::images
{

namespace
{

/// Return a colour that alpha does not multiply; rounded to the nearest, within the range.
template <typename T>
T straighten(T color, T alpha, Alpha kind)
{
    if constexpr (std::is_floating_point_v<T>)
    {
        if (!(alpha > 0))
            return color;
        return (kind == Alpha::on_white ? color - (1 - alpha) : color) / alpha;
    }
    else
    {
        constexpr int64_t kMax = std::numeric_limits<T>::max();
        if (alpha == 0)
            return kind == Alpha::on_white ? T{0} : color;
        const int64_t multiplied = kind == Alpha::on_white ? int64_t{color} - (kMax - alpha) : color;
        const int64_t straight = (std::max<int64_t>(multiplied, 0) * kMax + alpha / 2) / alpha;
        return static_cast<T>(std::min(straight, kMax));
    }
}

/// Convert ink to RGB by the plain formula.
template <typename T>
void convertInk(const T* ink, T* rgb)
{
    if constexpr (std::is_floating_point_v<T>)
        for (size_t c = 0; c < 3; ++c)
            rgb[c] = (1 - ink[c]) * (1 - ink[3]);
    else
    {
        constexpr uint64_t kMax = std::numeric_limits<T>::max();
        for (size_t c = 0; c < 3; ++c)
            rgb[c] = static_cast<T>(((kMax - ink[c]) * (kMax - ink[3]) + kMax / 2) / kMax);
    }
}

template <typename T>
constexpr T opaque()
{
    return std::is_floating_point_v<T> ? T{1} : std::numeric_limits<T>::max();
}

/// Turns an image as its orientation says: mirrored in x, in y, then with both swapped.
/// source  TIFF 6.0, "Orientation"
struct Turn
{
    uint32_t width, height; ///< before turning
    uint32_t orientation;

    bool swapsSides() const { return orientation >= 5; }

    /// Return the index of texel (x, y) in the turned image.
    size_t place(uint32_t x, uint32_t y) const
    {
        const bool mirrors_x = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
        const bool mirrors_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
        const size_t to_x = mirrors_x ? width - 1 - x : x;
        const size_t to_y = mirrors_y ? height - 1 - y : y;
        return swapsSides() ? to_x * height + to_y : to_y * width + to_x;
    }
};

/// Store a texel; floats as halves.
template <typename T>
void store(const T (&rgba)[4], std::byte* texels, size_t place)
{
    if constexpr (std::is_floating_point_v<T>)
    {
        const uint16_t halves[4] = {halfFromFloat(rgba[0]), halfFromFloat(rgba[1]), halfFromFloat(rgba[2]),
                                    halfFromFloat(rgba[3])};
        std::memcpy(texels + place * sizeof(halves), halves, sizeof(halves));
    }
    else
        std::memcpy(texels + place * sizeof(rgba), rgba, sizeof(rgba));
}

/// Return the conversion that the image's profile asks for; nullopt: none.
std::optional<ColorProfile> findConversion(Samples& samples, bool convert_icc)
{
    const bool is_ink = samples.color_count == 4;
    std::optional<ColorProfile> conversion;
    if (!samples.profile.empty() && samples.number != Number::float32 && (convert_icc || is_ink))
    {
        conversion = ColorProfile::read(samples.profile, samples.color_count, numberBytes(samples.number));
        if (!conversion)
            samples.addNote(Issue::image_colors,
                            "its ICC profile is damaged, or of other colours than the image");
    }
    if (is_ink && !conversion)
        samples.addNote(Issue::image_colors,
                        "it is CMYK without a usable ICC profile: its colours are a guess");
    return conversion;
}

template <typename T>
void assembleRows(const Samples& samples, const std::optional<ColorProfile>& conversion, const Turn& turn,
                  std::byte* texels)
{
    const size_t count = samples.color_count;
    std::vector<T> colors(count * samples.width), rgb(conversion ? size_t{3} * samples.width : 0);
    std::vector<T> row(size_t{samples.channel_count} * samples.width);
    for (uint32_t y = 0; y < samples.height; ++y)
    {
        std::memcpy(row.data(), samples.values.data() + y * row.size() * sizeof(T), row.size() * sizeof(T));
        for (size_t x = 0; x < samples.width; ++x)
            for (size_t c = 0; c < count; ++c)
                colors[x * count + c] = row[x * samples.channel_count + samples.colors[c]];
        // alpha multiplies the stored numbers, so it is taken away before they are converted
        if (samples.alpha == Alpha::multiplied || samples.alpha == Alpha::on_white)
            for (size_t i = 0; i < colors.size(); ++i)
            {
                const T alpha = row[i / count * samples.channel_count + samples.alpha_channel];
                // white is no ink, so that ink on white is merely multiplied
                if (count == 4 && samples.alpha == Alpha::on_white)
                    colors[i] = straighten(colors[i], alpha, Alpha::multiplied);
                else
                    colors[i] = straighten(colors[i], alpha, samples.alpha);
            }
        if (conversion)
            conversion->convert(colors.data(), rgb.data(), samples.width);
        for (uint32_t x = 0; x < samples.width; ++x)
        {
            T texel[4];
            if (conversion)
                std::copy_n(rgb.data() + size_t{3} * x, 3, texel);
            else if (count == 4)
                convertInk(colors.data() + 4 * x, texel);
            else
                for (size_t c = 0; c < 3; ++c)
                    texel[c] = colors[x * count + std::min(c, count - 1)];
            texel[3] = samples.alpha == Alpha::none
                           ? opaque<T>()
                           : row[size_t{x} * samples.channel_count + samples.alpha_channel];
            store(texel, texels, turn.place(x, y));
        }
    }
}

} // namespace

Assembled assemble(Samples& samples, bool convert_icc)
{
    const std::optional<ColorProfile> conversion = findConversion(samples, convert_icc);
    const uint32_t orientation =
        samples.orientation >= 1 && samples.orientation <= 8 ? samples.orientation : 1;
    const Turn turn{samples.width, samples.height, orientation};
    Assembled image;
    image.width = turn.swapsSides() ? samples.height : samples.width;
    image.height = turn.swapsSides() ? samples.width : samples.height;
    const size_t texel_bytes = samples.number == Number::unorm8 ? 4 : 8;
    image.texels.resize(texel_bytes * samples.width * samples.height);
    if (samples.number == Number::unorm8)
        assembleRows<uint8_t>(samples, conversion, turn, image.texels.data());
    else if (samples.number == Number::unorm16)
        assembleRows<uint16_t>(samples, conversion, turn, image.texels.data());
    else
        assembleRows<float>(samples, conversion, turn, image.texels.data());
    return image;
}

} // namespace hearth::images
