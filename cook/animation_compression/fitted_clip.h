// Compresses one clip: each channel becomes as small as its share of the error allows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/packed_curve.h"
#include "cook/animation_compression/reach.h"

#include <vector>

namespace hearth::animation_compression
{

/// Compressed channel: floats, or a packed curve.
struct FittedChannel
{
    formats::AnimationChannelRecord record{}; ///< without offsets into the chunks
    std::vector<float> times;
    std::vector<float> values; ///< if it is not packed
    PackedCurve packed;        ///< if it is packed
};

struct FittedClip
{
    /// without the channels that equal the rest pose; those of lights, all of them, come last
    std::vector<FittedChannel> channels;
    /// allowed error, metres in world space; the largest of the models that the clip moves
    double stated_error = 0;
    double proven_error = 0; ///< upper bound for the error of any vertex at any time, metres in world space
};

/// Stated error: metres, or a share of the size of each model. A model is a node that the clip moves, but
/// whose ancestors it does not move, with its descendants.
struct StatedError
{
    double metres = 0;
    double share_of_size = 0;
};

/// Compress a clip. An error of a node moves its descendants' vertices by at most the node's reach times the
/// error, so the errors of a chain of nodes add up. Each channel gets an equal share of the error that its
/// ancestors have left. Channels of lights stay unchanged.
FittedClip fitClip(const formats::AnimationTables& tables, const formats::AnimationRecord& animation,
                   const SceneReach& scene, const StatedError& stated);

/// Return all channels unchanged.
FittedClip sourceClip(const formats::AnimationTables& tables, const formats::AnimationRecord& animation);

} // namespace hearth::animation_compression
