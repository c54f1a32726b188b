// Reads and converts the channels of decoded images, whatever their number type.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Return an image with 8 bits a channel where 16 say no more: many programs save 8 bits as 16.
DecodedImage dropEmptyBits(DecodedImage image);

/// Return an image with 8 bits a channel, each rounded to the nearest. The image has no floats (asserted).
DecodedImage narrow(DecodedImage image);

/// Return an image with 16 bits a channel, without loss. The image has no floats (asserted).
DecodedImage widen(DecodedImage image);

/// Return a normal map with blue, where it has none: blue is 0 in every texel, as formats of two channels are
/// read. It becomes z of the unit vector whose x and y are red and green.
DecodedImage completeNormals(DecodedImage image);

/// Divide colours by alpha, in the codes in which they are stored; those under alpha 0 stay.
void straightenAlpha(DecodedImage& image);

/// Make every texel opaque.
void dropAlpha(DecodedImage& image);

/// Return an image whose channels are those of `first` where their bit is set, and else of `second`: bit 0 is
/// R, bit 3 is A. It has the larger width and height of both; an empty image counts as white.
/// Images of 8 bits a channel (asserted), not both empty.
DecodedImage mergeChannels(const DecodedImage& first, const DecodedImage& second, uint32_t first_channels);

/// Return the linear light of a channel of sRGB; both are 1 for white.
float linearFromSrgb(float encoded);

/// True if no texel has a colour. The image has no floats (asserted).
bool isGrey(const DecodedImage& image);

/// True if a texel is not opaque. The image has no floats (asserted).
bool hasAlpha(const DecodedImage& image);

} // namespace hearth::import
