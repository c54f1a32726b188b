// Where the keys of clips stand in the chunks ACHN, AKEY and AKBT.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/fitted_clip.h"

#include <vector>

namespace hearth::clips
{

/// Places count from the tables' own beginning.
struct ClipTables
{
    std::vector<formats::AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<uint32_t> key_bits;

    uint64_t bytes() const;
    void append(const ClipTables& other);
};

/// Equal times and values are stored once. Times that are not all of a table's are places in one that the whole clip shares,
/// where that takes fewer bits than times of their own.
ClipTables clipTables(const FittedClip& clip);

} // namespace hearth::clips
