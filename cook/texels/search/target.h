// Targets of error: how much an image may lose, by its role and content.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"
#include "cook/texels/rules/families.h"

namespace hearth::texels
{

/// Errors that an image may have, in the unit of combineMips.
struct Target
{
    double error;  ///< of all texels
    double smooth; ///< of smooth ones (SmoothCells), where the eye sees seams between blocks; may be infinite
};

/// Return the target of a role, without regard to content: peak signal-to-noise ratios of 34, 39, 43 dB for
/// colours, of smooth texels 48, 53, 55; 33, 36, 41 for data; 3, 1.5, .75 degrees for normals; .1, .05, .03
/// stops for light. Measured over four mips, of which the coarser ones lose more: the finest mip is 1 to 5 dB
/// better.
Target findTarget(formats::ImageRole role, Effort quality);

/// Return the target of an image: that of its role, with these exceptions.
///   cutouts  6 dB better: no mip averages their errors away, a test of alpha turns them into whole pixels
///   colours of at most 256 texels a side  3 dB better: they are seen from near
///   normals  a quarter, an eighth, a sixteenth of their spread (findNormalSpread), between the target of the
///            role and half of it: errors vanish among strong bumps, and bury weak ones
Target findTarget(const PlainImage& image, Effort quality);

/// Return a target that a person sets for all texels, in the unit of the role (imageErrorUnit). That of
/// smooth texels stays as far from it, in decibels, as in findTarget.
Target makeTarget(formats::ImageRole role, Effort quality, double wanted);

/// Return how much the normals of a map vary from near texel to texel, in radians: the RMS angle to their
/// mean in cells of 8 x 8 texels of mip 0.
double findNormalSpread(const PlainImage& image);

} // namespace hearth::texels
