// Encodes and decodes the faces of bricks: radiance as R11G11B10F, albedo, normal. One source for C++ and
// GLSL, to the same bits. FORMAT.md, "Bricks", has the layouts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICK_CODES_H
#define HEARTH_SHARED_BRICK_CODES_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

// The unsigned floats have 5 bits of exponent, as halves, above 6 or 5 bits of mantissa. The smallest code
// above 0 is 2^-20 or 2^-19, the largest is kMaxRadianceRedGreen or kMaxRadianceBlue. Codes below 2^-14 are
// denormals. Exponent 31 would be infinity or NaN, and no code has it.
HEARTH_CONSTANT float kMaxRadianceRedGreen = 65024.0f;
HEARTH_CONSTANT float kMaxRadianceBlue = 64512.0f;

/// Return the nearest unsigned float of 5 + mantissa_bits bits, the even one of two. Negative values and NaN
/// give 0, too large values the largest code.
HEARTH_FUNCTION uint encodeUnsignedFloat(float value, uint mantissa_bits)
{
    if (!(value > 0.0f))
        return 0u;
    uint most = (31u << mantissa_bits) - 1u;
    uint bits = floatBits(value);
    if (bits >= 0x47800000u) // 2^16
        return most;
    uint whole = bits;
    uint shift = 23u - mantissa_bits;
    uint first = 0x38000000u >> shift; // exponent 15 less than a float's
    if (bits < 0x38800000u)            // 2^-14
    {
        whole = (bits & 0x7FFFFFu) | 0x800000u;
        shift = 136u - mantissa_bits - (bits >> 23);
        first = 0u;
        if (shift > 24u)
            return 0u;
    }
    uint code = whole >> shift;
    uint rest = whole & ((1u << shift) - 1u);
    uint middle = 1u << (shift - 1u);
    if (rest > middle || (rest == middle && (code & 1u) != 0u))
        ++code;
    code -= first;
    return code < most ? code : most;
}

/// Decode an unsigned float. The exponent of the code is below 31.
HEARTH_FUNCTION float decodeUnsignedFloat(uint code, uint mantissa_bits)
{
    uint mantissa = code & ((1u << mantissa_bits) - 1u);
    uint exponent = code >> mantissa_bits;
    if (exponent == 0u)
        return float(mantissa) * floatFromBits((113u - mantissa_bits) << 23);
    return floatFromBits((exponent + 112u) << 23 | mantissa << (23u - mantissa_bits));
}

/// Encode radiance as R11G11B10F: r in bits 0 to 10, g in 11 to 21, b in 22 to 31.
/// radiance  linear Rec.709; encodeUnsignedFloat encodes each colour
HEARTH_FUNCTION uint encodeRadiance(Float3 radiance)
{
    return encodeUnsignedFloat(radiance.x, 6u) | encodeUnsignedFloat(radiance.y, 6u) << 11 |
           encodeUnsignedFloat(radiance.z, 5u) << 22;
}

HEARTH_FUNCTION Float3 decodeRadiance(uint code)
{
    return Float3(decodeUnsignedFloat(code & 2047u, 6u), decodeUnsignedFloat(code >> 11 & 2047u, 6u),
                  decodeUnsignedFloat(code >> 22, 5u));
}

/// True if no exponent of the code is 31 (infinity or NaN).
HEARTH_FUNCTION bool isLegalRadiance(uint code)
{
    return (code >> 6 & 31u) != 31u && (code >> 17 & 31u) != 31u && code >> 27 != 31u;
}

HEARTH_FUNCTION uint encodeUnorm10(float value)
{
    return value > 0.0f ? uint(min(value, 1.0f) * 1023.0f + 0.5f) : 0u;
}

/// Encode albedo as three unorms of 10 bits: r in bits 0 to 9, g in 10 to 19, b in 20 to 29. Values are
/// clamped to [0, 1]. Bits 30 and 31 are 0: encodeFaceDepth.
HEARTH_FUNCTION uint encodeAlbedo(Float3 albedo)
{
    return encodeUnorm10(albedo.x) | encodeUnorm10(albedo.y) << 10 | encodeUnorm10(albedo.z) << 20;
}

HEARTH_FUNCTION Float3 decodeAlbedo(uint code)
{
    return Float3(float(code & 1023u) / 1023.0f, float(code >> 10 & 1023u) / 1023.0f,
                  float(code >> 20 & 1023u) / 1023.0f);
}

/// Encode the depth of a surface behind its face, [0, 1] voxels, in bits 30 and 31 of the albedo's code: to a
/// quarter of a voxel, at most three quarters.
HEARTH_FUNCTION uint encodeFaceDepth(float depth)
{
    return uint(min(max(depth, 0.0f) * 4.0f + 0.5f, 3.0f)) << 30;
}

/// Return the depth that an albedo's code holds, in voxels.
HEARTH_FUNCTION float decodeFaceDepth(uint code)
{
    return float(code >> 30) * 0.25f;
}

/// Decode the unit normal of a face from 2 x 8 bits, coded as vertex normals: octahedral, x in the low byte.
HEARTH_FUNCTION Float3 decodeFaceNormal(uint code)
{
    // the arithmetic shift extends the sign of each byte
    HEARTH_PRECISE float x = float(int(code << 24) >> 24) / 127.0f;
    HEARTH_PRECISE float y = float(int(code << 16) >> 24) / 127.0f;
    HEARTH_PRECISE float z = 1.0f - abs(x) - abs(y);
    HEARTH_PRECISE float folded_x = (1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f);
    HEARTH_PRECISE float folded_y = (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f);
    x = z < 0.0f ? folded_x : x;
    y = z < 0.0f ? folded_y : y;
    HEARTH_PRECISE float size = sqrt(x * x + y * y + z * z);
    return Float3(x / size, y / size, z / size);
}

HEARTH_SHARED_END

#endif
