// Push constants of the update of receivers by drawn points. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_RECEIVER_POINTS_H
#define HEARTH_SHARED_RECEIVER_POINTS_H

#include "formats/gpu_shared/receivers/receivers.h"

HEARTH_SHARED_BEGIN

struct ReceiverPointsPush
{
    uint first_block; ///< this and the next two as in ReceiversPush
    uint first_weight;
    uint codec;
    float texel_width; ///< in clip space: 2 over that of the atlas
    float texel_height;
};

HEARTH_SHARED_END

#endif
