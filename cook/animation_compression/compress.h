// Compresses animation clips within a stated error in metres at the vertices.
// cook/animation_compression/README.md has the proof.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/clip_tables.h"

#include <string>
#include <vector>

namespace hearth::animation_compression
{

/// Default error of a clip, as a share of the model's size: two tenths of the allowed difference between
/// posed vertices and plain glTF skinning.
inline constexpr double kDefaultShareOfSize = 2e-6;

struct ClipStatistics
{
    uint32_t keys_before = 0; ///< over all channels
    uint32_t keys_after = 0;
    uint64_t bytes_before = 0; ///< of channel records, times and values
    uint64_t bytes_after = 0;
    double stated_error = 0; ///< metres
    double proven_error = 0;
};

struct CompressedClips
{
    std::vector<formats::AnimationRecord> animations;
    ClipTables tables;
    std::vector<ClipStatistics> statistics; ///< one for each animation
};

/// Compress all clips. Clips stay unchanged if the stated error is 0, or if they would not become smaller.
/// Deterministic: the result does not depend on the number of threads.
/// tables   all finite, of the source: no packed channels
/// carried  every vertex that nodes move, in any order
CompressedClips compressClips(const formats::AnimationTables& tables,
                              std::span<const AttachedVertices> carried, const StatedError& stated);

} // namespace hearth::animation_compression
