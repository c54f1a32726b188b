// Finds what pixels of a frame show, on request. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_PICKS_H
#define HEARTH_SHARED_PICKS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Triangle that a pixel shows.
struct Pick
{
    uint instance; ///< kNothingPicked: the sky
    uint cluster;
    uint triangle; ///< of the cluster
    uint reserved;
};

HEARTH_CONSTANT uint kNothingPicked = 0xFFFFFFFFu;

/// Pixels of a frame that are looked at, at most.
HEARTH_CONSTANT uint kMaxPicks = 4096;
HEARTH_CONSTANT uint kGroupPicks = 64; ///< threads of a workgroup

HEARTH_SHARED_END

#endif
