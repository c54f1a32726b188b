// Receivers of a scene as shading reads them: a row for each instance in the buffer of lights, with its
// rectangle of the atlas. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_RECEIVER_ROWS_H
#define HEARTH_SHARED_RECEIVER_ROWS_H

#include "formats/gpu_shared/receivers/receivers.h"

HEARTH_SHARED_BEGIN

/// Bit of Light::reflector_axis: the atlas has the light of this lamp, direct and bounced. Surfaces with a
/// rectangle leave the lamp itself out.
HEARTH_CONSTANT uint kLightBaked = 0x80000000u;

/// Bit of Light::reflector_axis: the faces of bricks have the light of this lamp by its weight.
HEARTH_CONSTANT uint kLightOnFaces = 0x40000000u;

/// Row of an instance.
struct ReceiverRow
{
    uint place; ///< first texel of the rectangle, encodeReceiverPlace; above it two bits: the UV set
    uint size;  ///< columns, and rows in the upper half; 0: the instance has no rectangle
    /// Weight of the instance's emission, halves: red and green, then blue.
    uint emission_red_green;
    uint emission_blue;
};

HEARTH_CONSTANT uint kReceiverUvSetShift = 28;

/// Return the place in the atlas, in texels, to which a texture coordinate of an instance leads: within the
/// outermost texels' middles, so that no bilinear tap leaves the rectangle.
HEARTH_FUNCTION Float2 receiverTexel(uint place, uint size, Float2 uv)
{
    float columns = float(size & 0xFFFFu);
    float rows = float(size >> 16);
    return Float2(float(receiverX(place)) + min(max(uv.x * columns, 0.5f), columns - 0.5f),
                  float(receiverY(place)) + min(max(uv.y * rows, 0.5f), rows - 0.5f));
}

HEARTH_SHARED_END

#endif
