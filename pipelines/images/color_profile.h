// Converts rows of colours to sRGB by an ICC profile.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace hearth::images
{

/// Conversion of colours to sRGB: relative colorimetric with black point compensation, as Photoshop does.
class ColorProfile
{
public:
    /// Read a profile for colours of `channel_count` channels: 1 grey, 3 RGB, 4 CMYK.
    /// channel_bytes  1 or 2
    /// returns  nullopt if it is damaged or a profile of other colours
    static std::optional<ColorProfile> read(std::span<const std::byte> profile, unsigned channel_count,
                                            size_t channel_bytes);

    /// Convert `count` colours into RGB of the same number of bytes a channel.
    void convert(const void* colors, void* rgb, size_t count) const;

private:
    struct Deleter
    {
        void operator()(void* transform) const;
    };
    explicit ColorProfile(void* transform) : transform_(transform) {}

    std::unique_ptr<void, Deleter> transform_;
};

} // namespace hearth::images
