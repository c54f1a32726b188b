// Packs the keys of clips into the chunks ACHN, AKEY and AKBT.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/fitted_clip.h"

#include <vector>

namespace hearth::animation_compression
{

/// Tables of clips. Offsets are relative to the beginning of these tables.
struct ClipTables
{
    std::vector<formats::AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<uint32_t> key_bits;

    uint64_t bytes() const;
    void append(const ClipTables& other);
};

/// Pack a clip. Equal times and values are stored once. Channels that use only some of the clip's times store
/// indices into one time table of the clip, if that takes fewer bits than separate times.
ClipTables clipTables(const FittedClip& clip);

} // namespace hearth::animation_compression
