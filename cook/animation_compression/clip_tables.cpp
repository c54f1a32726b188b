// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/clip_tables.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <set>

namespace hearth::animation_compression
{

using namespace formats;

namespace
{

using Times = std::vector<float>;

/// Writes bit fields one behind the other; each stream begins at a word.
class BitStream
{
public:
    explicit BitStream(std::vector<uint32_t>& words) : words_(words), offset_(words.size() * 32) {}

    void write(uint32_t value, uint32_t count)
    {
        for (uint32_t bit = 0; bit < count; ++bit, ++offset_)
        {
            if (offset_ % 32 == 0)
                words_.push_back(0);
            words_.back() |= (value >> bit & 1u) << (offset_ % 32);
        }
    }

private:
    std::vector<uint32_t>& words_;
    size_t offset_;
};

/// Return all times of the channels that have several keys.
Times commonTimes(const FittedClip& clip)
{
    Times times;
    for (const FittedChannel& channel : clip.channels)
        if (channel.times.size() > 1)
            times.insert(times.end(), channel.times.begin(), channel.times.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

uint32_t timeIndex(const Times& table, float time)
{
    return static_cast<uint32_t>(std::lower_bound(table.begin(), table.end(), time) - table.begin());
}

bool isContiguousIn(const Times& table, const Times& times)
{
    const size_t first = timeIndex(table, times[0]);
    return times.size() <= table.size() - first &&
           std::equal(times.begin(), times.end(), table.begin() + static_cast<std::ptrdiff_t>(first));
}

uint32_t timeIndexBits(const Times& table)
{
    return static_cast<uint32_t>(std::bit_width(table.size() - 1));
}

/// True if the clip is smaller with one time table than with a list for each channel.
bool isTimeTableSmaller(const Times& table, const FittedClip& clip)
{
    if (table.empty() || timeIndexBits(table) > kMaxKeyFieldBits)
        return false;
    std::set<Times> own, beside;
    uint64_t with = 32 * table.size(), without = 0;
    for (const FittedChannel& channel : clip.channels)
    {
        const Times& times = channel.times;
        if (times.size() < 2)
            continue;
        without += own.insert(times).second ? 32 * times.size() : 0;
        if (isContiguousIn(table, times))
            continue;
        if (isPacked(channel.record))
            with += timeIndexBits(table) * times.size();
        else
            with += beside.insert(times).second ? 32 * times.size() : 0;
    }
    return with <= without;
}

class ClipWriter
{
public:
    ClipTables write(const FittedClip& clip)
    {
        table_ = commonTimes(clip);
        if (isTimeTableSmaller(table_, clip))
            table_offset_ = storeFloats(table_);
        for (const FittedChannel& channel : clip.channels)
            addChannel(channel);
        return std::move(tables_);
    }

private:
    uint32_t storeFloats(const std::vector<float>& floats)
    {
        const auto [found, added] = offsets_.try_emplace(floats, static_cast<uint32_t>(tables_.keys.size()));
        if (added)
            tables_.keys.insert(tables_.keys.end(), floats.begin(), floats.end());
        return found->second;
    }

    void addChannel(const FittedChannel& channel)
    {
        AnimationChannelRecord record = channel.record;
        storeTimes(channel, record);
        if (isPacked(record))
        {
            const PackedCurve& packed = channel.packed;
            record.first_value = storeFloats({packed.base[0], packed.base[1], packed.base[2], packed.step});
            writeKeys(channel, record);
        }
        else
            record.first_value = storeFloats(channel.values);
        tables_.channels.push_back(record);
    }

    void storeTimes(const FittedChannel& channel, AnimationChannelRecord& record)
    {
        // the value of a single key holds at all times, so any time will do
        if (channel.times.size() == 1 && table_offset_)
            record.first_time = *table_offset_;
        else if (table_offset_ && isContiguousIn(table_, channel.times))
            record.first_time = *table_offset_ + timeIndex(table_, channel.times[0]);
        else if (table_offset_ && isPacked(record))
        {
            record.first_time = *table_offset_;
            record.time_bits = static_cast<uint8_t>(timeIndexBits(table_));
        }
        else
            record.first_time = storeFloats(channel.times);
    }

    void writeKeys(const FittedChannel& channel, AnimationChannelRecord& record)
    {
        record.first_word = static_cast<uint32_t>(tables_.key_bits.size());
        BitStream stream(tables_.key_bits);
        for (size_t i = 0; i < channel.packed.keys.size(); ++i)
        {
            const PackedCurve::Key& key = channel.packed.keys[i];
            if (record.time_bits > 0)
                stream.write(timeIndex(table_, channel.times[i]), record.time_bits);
            if (record.path == static_cast<uint32_t>(AnimationPath::rotation))
                stream.write(key.largest, kOmittedIndexBits);
            for (size_t n = 0; n < key.codes.size(); ++n)
                stream.write(key.codes[n], record.value_bits[n]);
        }
    }

    ClipTables tables_;
    Times table_; ///< times of the whole clip
    std::optional<uint32_t> table_offset_;
    std::map<std::vector<float>, uint32_t> offsets_;
};

} // namespace

uint64_t ClipTables::bytes() const
{
    return channels.size() * sizeof(AnimationChannelRecord) + keys.size() * sizeof(float) +
           key_bits.size() * sizeof(uint32_t);
}

void ClipTables::append(const ClipTables& other)
{
    const auto first_key = static_cast<uint32_t>(keys.size());
    const auto first_word = static_cast<uint32_t>(key_bits.size());
    for (AnimationChannelRecord channel : other.channels)
    {
        channel.first_time += first_key;
        channel.first_value += first_key;
        channel.first_word += isPacked(channel) ? first_word : 0;
        channels.push_back(channel);
    }
    keys.insert(keys.end(), other.keys.begin(), other.keys.end());
    key_bits.insert(key_bits.end(), other.key_bits.begin(), other.key_bits.end());
}

ClipTables clipTables(const FittedClip& clip)
{
    return ClipWriter().write(clip);
}

} // namespace hearth::animation_compression
