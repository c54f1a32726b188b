// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/compress.h"

#include "formats/base/assert.h"
#include "formats/base/rounding.h"
#include "formats/pack/pack_view.h"

#include <set>
#include <utility>

#include <tbb/parallel_for.h>

namespace hearth::animation_compression
{

using namespace formats;

namespace
{

struct CompressedClip
{
    ClipTables tables;
    ClipStatistics statistics;
};

/// Return the range of all channels of a clip: those of lights follow those of nodes.
Range allChannels(const AnimationRecord& animation)
{
    HEARTH_ASSERT(animation.light_channels.count == 0 ||
                  animation.light_channels.first == animation.channels.first + animation.channels.count);
    return {animation.channels.first, animation.channels.count + animation.light_channels.count};
}

/// Return the bytes of a source's clip. Times and values that channels share count once.
uint64_t sourceBytes(const AnimationTables& tables, const AnimationRecord& animation)
{
    std::set<std::pair<uint32_t, size_t>> ranges;
    for (const AnimationChannelRecord& channel : recordsInRange(tables.channels, allChannels(animation)))
    {
        const bool spline = channel.interpolation == static_cast<uint32_t>(Interpolation::cubic_spline);
        ranges.insert({channel.first_time, channel.key_count});
        ranges.insert(
            {channel.first_value, size_t{channel.key_count} * channel.components * (spline ? 3 : 1)});
    }
    uint64_t bytes = uint64_t{allChannels(animation).count} * sizeof(AnimationChannelRecord);
    for (const auto& [first, count] : ranges)
        bytes += count * sizeof(float);
    return bytes;
}

uint32_t keyCount(std::span<const AnimationChannelRecord> channels)
{
    uint32_t count = 0;
    for (const AnimationChannelRecord& channel : channels)
        count += channel.key_count;
    return count;
}

CompressedClip compressClip(const AnimationTables& tables, const AnimationRecord& animation,
                            const SceneReach& scene, const StatedError& stated)
{
    CompressedClip result{clipTables(sourceClip(tables, animation)), {}};
    const bool exact = !(stated.metres > 0) && !(stated.share_of_size > 0);
    const FittedClip fitted = exact ? FittedClip{} : fitClip(tables, animation, scene, stated);
    result.statistics.stated_error = fitted.stated_error;
    if (!exact)
    {
        ClipTables smaller = clipTables(fitted);
        if (smaller.bytes() < result.tables.bytes())
        {
            result.tables = std::move(smaller);
            result.statistics.proven_error = fitted.proven_error;
        }
    }
    result.statistics.keys_before = keyCount(recordsInRange(tables.channels, allChannels(animation)));
    result.statistics.keys_after = keyCount(result.tables.channels);
    result.statistics.bytes_before = sourceBytes(tables, animation);
    result.statistics.bytes_after = result.tables.bytes();
    return result;
}

} // namespace

CompressedClips compressClips(const AnimationTables& tables, std::span<const AttachedVertices> carried,
                              const StatedError& stated)
{
    const SceneReach scene = computeSceneReach(tables, carried);
    std::vector<CompressedClip> clips(tables.animations.size());
    tbb::parallel_for(size_t{0}, clips.size(),
                      [&](size_t i)
                      { clips[i] = compressClip(tables, tables.animations[i], scene, stated); });
    CompressedClips result;
    for (size_t i = 0; i < clips.size(); ++i)
    {
        AnimationRecord animation = tables.animations[i];
        const auto first = static_cast<uint32_t>(result.tables.channels.size());
        const auto end = first + static_cast<uint32_t>(clips[i].tables.channels.size());
        animation.light_channels.first = end - animation.light_channels.count;
        animation.channels = {first, animation.light_channels.first - first};
        animation.error = roundUp(clips[i].statistics.proven_error);
        result.animations.push_back(animation);
        result.tables.append(clips[i].tables);
        result.statistics.push_back(clips[i].statistics);
    }
    return result;
}

} // namespace hearth::animation_compression
