// One clip, each channel of it as small as its share of the error allows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/packed_curve.h"
#include "cook/animation_compression/reach.h"

#include <vector>

namespace hearth::clips
{

/// What is stored of a channel: floats, or a packed curve.
struct FittedChannel
{
    formats::AnimationChannelRecord record{}; ///< without places in the chunks
    std::vector<float> times;
    std::vector<float> values; ///< where it is not packed
    PackedCurve packed;        ///< where it is
};

struct FittedClip
{
    std::vector<FittedChannel> channels; ///< channels that do as the rest pose does are left out
    double stated_error =
        0; ///< metres in the world: what was allowed; the largest of the models that the clip moves
    double proven_error = 0; ///< at least how far any vertex is off, at any time
};

/// The error that is stated: metres, or a share of the size of each model, which is what hangs on a node that the clip moves
/// while no node above it moves.
struct StatedError
{
    double metres = 0;
    double share_of_size = 0;
};

/// A node's error moves what hangs on it by at most the node's reach times it, so the errors of a chain of nodes add up. Each
/// channel gets an equal part of what those above it left over.
FittedClip fitClip(const formats::MotionTables& tables, const formats::AnimationRecord& animation,
                   const SceneReach& scene, const StatedError& stated);

/// All channels as they are.
FittedClip sourceClip(const formats::MotionTables& tables, const formats::AnimationRecord& animation);

} // namespace hearth::clips
