// Bloom, automatic exposure and photo filter: their constants. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_POST_H
#define HEARTH_SHARED_POST_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Levels of bloom, each half the side of the one before. The last one's texels are 32 pixels wide: bloom
/// reaches about three of them.
HEARTH_CONSTANT uint kBloomLevels = 5;

/// Side of a level of bloom, the first of which is 1.
HEARTH_FUNCTION uint bloomSize(uint pixels, uint level)
{
    uint size = pixels >> level;
    return size == 0u ? 1u : size;
}

/// Weights of linear Rec. 709 colours in the luminance.
HEARTH_CONSTANT Float3 kLuminanceWeights = Float3(0.2126f, 0.7152f, 0.0722f);

/// Least luminance that automatic exposure tells from black: ten stops below white.
HEARTH_CONSTANT float kMinMeteredLuminance = 9.765625e-4f;

/// Largest radiance of an unlit colour, where the tone curve is .994: white comes out a step of 255 darker,
/// at most, than without the linear image, and does not outshine every lamp in the bloom.
HEARTH_CONSTANT float kMaxUnlitRadiance = 32.0f;

HEARTH_SHARED_END

#endif
