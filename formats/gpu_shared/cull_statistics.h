// Counts culling outcomes of the instances and clusters of a frame, on request. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_CULL_STATISTICS_H
#define HEARTH_SHARED_CULL_STATISTICS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Outcome of a cluster: the first test that rejects it, or kOutcomeCandidate if only occlusion remains.
HEARTH_CONSTANT uint kOutcomeInstance = 0;  ///< its instance is culled: not tested
HEARTH_CONSTANT uint kOutcomeLod = 1;       ///< not in the cut
HEARTH_CONSTANT uint kOutcomeFrustum = 2;   ///< outside the frustum
HEARTH_CONSTANT uint kOutcomeCone = 3;      ///< faces away
HEARTH_CONSTANT uint kOutcomeCandidate = 4; ///< drawn unless occluded
/// Drawn unless occluded, of an instance that only the late phase tested.
HEARTH_CONSTANT uint kOutcomeLateCandidate = 5;
HEARTH_CONSTANT uint kOutcomeCount = 6;

struct CullStatistics
{
    uint empty_instances;    ///< instances of meshes without triangles
    uint outside_instances;  ///< outside the frustum
    uint occluded_instances; ///< occluded in both phases
    uint late_instances;     ///< occluded by the last frame's depth, not by this frame's
    uint visible_instances;
    uint clusters[kOutcomeCount];
    uint triangles_low[kOutcomeCount]; ///< 64 bits, because the number of triangles multiplies by instances
    uint triangles_high[kOutcomeCount];
};

HEARTH_SHARED_END

#endif
