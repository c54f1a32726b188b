// What became of the instances and clusters of a frame, counted on request. Written once for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_CULL_STATISTICS_H
#define HEARTH_SHARED_CULL_STATISTICS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Of a cluster: the first test that it fails, or that none but occlusion was left.
HEARTH_CONSTANT uint kOutcomeInstance = 0;  ///< its instance is hidden: not looked at
HEARTH_CONSTANT uint kOutcomeLod = 1;       ///< not in the cut
HEARTH_CONSTANT uint kOutcomeFrustum = 2;   ///< outside the frustum
HEARTH_CONSTANT uint kOutcomeCone = 3;      ///< faces away
HEARTH_CONSTANT uint kOutcomeCandidate = 4; ///< drawn unless it is occluded
HEARTH_CONSTANT uint kOutcomeLateCandidate =
    5; ///< the same, of an instance that only the late phase looked at
HEARTH_CONSTANT uint kOutcomeCount = 6;

struct CullStatistics
{
    uint empty_instances;    ///< of meshes without triangles
    uint outside_instances;  ///< outside the frustum
    uint occluded_instances; ///< hidden in both phases
    uint late_instances;     ///< hidden by the last frame's depth, not by this one's
    uint visible_instances;
    uint clusters[kOutcomeCount];
    uint triangles_low[kOutcomeCount]; ///< 64 bits: instances multiply
    uint triangles_high[kOutcomeCount];
};

HEARTH_SHARED_END

#endif
