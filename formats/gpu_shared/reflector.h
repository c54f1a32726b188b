// The surfaces right around a lamp, such as its shade, as seen from afar: the intensity that they give back,
// and the share of the lamp's own light that they let pass, over the angle to an axis.
// One source for C++ and GLSL, to the same bits. FORMAT.md, "Bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_REFLECTOR_H
#define HEARTH_SHARED_REFLECTOR_H

#include "formats/gpu_shared/brick_codes.h"
#include "formats/gpu_shared/shading.h"

HEARTH_SHARED_BEGIN

/// Samples over the angle t to a reflector's axis: sample i at sin(t / 2) = i /
/// (kReflectorSamples - 1), a straight line between two. They are closest about the axis.
HEARTH_CONSTANT uint kReflectorSamples = 16u;

/// Gain of a lamp that has no reflector.
HEARTH_CONSTANT uint kNoReflector = 0u;

/// Voxels around a lamp whose surfaces are a part of its reflector, if it has one.
HEARTH_CONSTANT float kReflectorReach = 3.0f;

/// Return sample `number` of 16 in four words, 0 to 1.
HEARTH_FUNCTION float reflectorSample(uint word0, uint word1, uint word2, uint word3, uint number)
{
    uint word = number < 8u ? (number < 4u ? word0 : word1) : (number < 12u ? word2 : word3);
    return float((word >> (8u * (number & 3u))) & 255u) / 255.0f;
}

/// Interpolate between samples.
HEARTH_FUNCTION float reflectorValue(uint word0, uint word1, uint word2, uint word3, float cosine)
{
    float at = sqrt(min(max(0.5f - 0.5f * cosine, 0.0f), 1.0f)) * float(kReflectorSamples - 1u);
    uint before = uint(min(at, float(kReflectorSamples - 2u))); // the last one ends the last line
    float a = reflectorSample(word0, word1, word2, word3, before);
    float b = reflectorSample(word0, word1, word2, word3, before + 1u);
    return a + (b - a) * (at - float(before));
}

/// Return the intensity that a reflector adds to its lamp's in a direction, over the lamp's without its cone.
/// from_lamp  unit
HEARTH_FUNCTION Float3 reflectorShare(HEARTH_IN(Light) light, Float3 from_lamp)
{
    if (light.reflector_gain == kNoReflector)
        return Float3(0.0f, 0.0f, 0.0f);
    float cosine = dot(decodeFaceNormal(light.reflector_axis), from_lamp);
    return decodeRadiance(light.reflector_gain) *
           reflectorValue(light.reflected0, light.reflected1, light.reflected2, light.reflected3, cosine);
}

/// Return the share of the lamp's own light that its reflector lets pass in a direction.
/// from_lamp  unit
HEARTH_FUNCTION float reflectorPassed(HEARTH_IN(Light) light, Float3 from_lamp)
{
    if (light.reflector_gain == kNoReflector)
        return 1.0f;
    float cosine = dot(decodeFaceNormal(light.reflector_axis), from_lamp);
    return reflectorValue(light.passed0, light.passed1, light.passed2, light.passed3, cosine);
}

HEARTH_SHARED_END

#endif
