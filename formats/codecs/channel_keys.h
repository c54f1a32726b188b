// Reads the keys of an animation channel in place, one at a time: floats or packed (FORMAT.md, "Skins and
// animations").
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Value of a key: up to four numbers; missing ones are 0.
using KeyValue = std::array<double, 4>;

/// Bits of the index of the number that a packed rotation omits: it follows from the length 1.
inline constexpr uint32_t kOmittedIndexBits = 2;

/// Read `count` (at most 32) bits from bit `offset` on; bit 0 is the lowest of the first word.
inline uint32_t readBits(std::span<const uint32_t> words, uint64_t offset, uint32_t count)
{
    if (count == 0)
        return 0;
    const auto word = static_cast<size_t>(offset / 32);
    const auto shift = static_cast<uint32_t>(offset % 32);
    uint64_t bits = words[word];
    if (shift + count > 32)
        bits |= uint64_t{words[word + 1]} << 32;
    return static_cast<uint32_t>((bits >> shift) & ((uint64_t{1} << count) - 1));
}

inline bool isPacked(const AnimationChannelRecord& channel)
{
    return channel.encoding == static_cast<uint32_t>(KeyEncoding::packed);
}

/// Return the number of bits of one key of a packed channel.
inline uint32_t keyStride(const AnimationChannelRecord& channel)
{
    const bool rotation = channel.path == static_cast<uint32_t>(AnimationPath::rotation);
    return uint32_t{channel.time_bits} + (rotation ? kOmittedIndexBits : 0) + channel.value_bits[0] +
           channel.value_bits[1] + channel.value_bits[2];
}

/// Restore a unit rotation from three of its numbers; the omitted one is not negative.
inline KeyValue restoreRotation(uint32_t largest, const std::array<double, 3>& others)
{
    KeyValue rotation{};
    double rest = 1;
    for (uint32_t i = 0; i < 3; ++i)
    {
        rotation[i < largest ? i : i + 1] = others[i];
        rest -= others[i] * others[i];
    }
    rotation[largest] = std::sqrt(std::max(rest, 0.0));
    return rotation;
}

/// Key reader of a channel that has been checked.
class ChannelKeys
{
public:
    /// keys  chunk AKEY
    /// bits  chunk AKBT
    ChannelKeys(std::span<const float> keys, std::span<const uint32_t> bits,
                const AnimationChannelRecord& channel)
        : times_(keys.subspan(channel.first_time)),
          values_(keys.subspan(channel.first_value)),
          bits_(isPacked(channel) ? bits.subspan(channel.first_word) : std::span<const uint32_t>()),
          channel_(channel),
          stride_(keyStride(channel))
    {
    }

    uint32_t count() const { return channel_.key_count; }
    Interpolation interpolation() const { return static_cast<Interpolation>(channel_.interpolation); }

    /// Return the time of a key in seconds.
    float time(uint32_t key) const { return times_[timeIndex(key)]; }

    /// Return the first key later than a time; count() if there is none.
    uint32_t firstKeyAfter(double time_s) const
    {
        uint32_t first = 0, count = channel_.key_count;
        while (count > 0)
        {
            const uint32_t half = count / 2;
            if (double{time(first + half)} <= time_s)
            {
                first += half + 1;
                count -= half + 1;
            }
            else
                count = half;
        }
        return first;
    }

    /// Return the value of a key, `count` components from `first` on. Rotations are returned as stored, of
    /// any length.
    KeyValue value(uint32_t key, uint32_t first, uint32_t count) const
    {
        return interpolation() == Interpolation::cubic_spline ? row(size_t{key} * 3 + 1, first, count)
                                                              : row(key, first, count);
    }

    /// Return the tangents of a spline, per second.
    KeyValue inTangent(uint32_t key, uint32_t first, uint32_t count) const
    {
        return row(size_t{key} * 3, first, count);
    }
    KeyValue outTangent(uint32_t key, uint32_t first, uint32_t count) const
    {
        return row(size_t{key} * 3 + 2, first, count);
    }

private:
    size_t timeIndex(uint32_t key) const
    {
        return channel_.time_bits == 0 ? key : readBits(bits_, uint64_t{key} * stride_, channel_.time_bits);
    }

    KeyValue row(size_t row, uint32_t first, uint32_t count) const
    {
        if (isPacked(channel_))
            return packed(row);
        KeyValue value{};
        for (uint32_t i = 0; i < count; ++i)
            value[i] = double{values_[row * channel_.components + first + i]};
        return value;
    }

    KeyValue packed(size_t key) const
    {
        uint64_t offset = uint64_t{key} * stride_ + channel_.time_bits;
        const bool rotation = channel_.components == 4;
        const uint32_t largest = rotation ? readBits(bits_, offset, kOmittedIndexBits) : 0;
        offset += rotation ? kOmittedIndexBits : 0;
        std::array<double, 3> numbers{};
        for (size_t i = 0; i < 3; ++i)
        {
            const uint32_t count = channel_.value_bits[i];
            numbers[i] = double{values_[i]} + double{values_[3]} * readBits(bits_, offset, count);
            offset += count;
        }
        return rotation ? restoreRotation(largest, numbers) : KeyValue{numbers[0], numbers[1], numbers[2], 0};
    }

    std::span<const float> times_;
    std::span<const float> values_;
    std::span<const uint32_t> bits_;
    const AnimationChannelRecord& channel_;
    uint32_t stride_;
};

} // namespace hearth::formats
