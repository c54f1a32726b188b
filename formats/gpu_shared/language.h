// Makes one header valid as C++ and GLSL: the types and macros of formats/gpu_shared. Headers there may use
// only features of both languages: no swizzles, no references, no library beyond the functions here. Bits
// agree where only + - * / and sqrt are used; the precision of angles is each library's.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LANGUAGE_H
#define HEARTH_SHARED_LANGUAGE_H

#ifdef __cplusplus

#include "formats/base/math.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#define HEARTH_SHARED_BEGIN                                                                                  \
    namespace hearth::shared                                                                                 \
    {
#define HEARTH_SHARED_END }
#define HEARTH_FUNCTION inline
#define HEARTH_CONSTEXPR_FUNCTION constexpr
#define HEARTH_IN(type) const type&
#define HEARTH_CONSTANT inline constexpr
#define HEARTH_PRECISE

namespace hearth::shared
{
using uint = uint32_t;
using std::abs;
using std::acos;
using std::cos;
using std::floor;
using std::sin;
using std::sqrt;
inline float max(float a, float b)
{
    return a < b ? b : a;
}
inline float min(float a, float b)
{
    return b < a ? b : a;
}
/// Return the angle of the point (x, y), in radians.
inline float arcTangent(float y, float x)
{
    return std::atan2(y, x);
}
/// Return the bits of a float. The bits of positive floats order as their values do.
inline uint floatBits(float value)
{
    return std::bit_cast<uint>(value);
}
constexpr float floatFromBits(uint bits)
{
    return std::bit_cast<float>(bits);
}
/// Return the number of set bits.
constexpr int bitCount(uint bits)
{
    return std::popcount(bits);
}
inline Float3 normalize(Float3 v)
{
    return v / length(v);
}
/// Decode normalized integers, the first in the lowest bits. The smallest of a signed one is no legal code.
inline Float2 unpackSnorm2x8(uint code)
{
    return {static_cast<float>(static_cast<int8_t>(code)) / 127.0f,
            static_cast<float>(static_cast<int8_t>(code >> 8)) / 127.0f};
}
inline Float2 unpackSnorm2x16(uint code)
{
    return {static_cast<float>(static_cast<int16_t>(code)) / 32767.0f,
            static_cast<float>(static_cast<int16_t>(code >> 16)) / 32767.0f};
}
inline Float2 unpackUnorm2x16(uint code)
{
    return {static_cast<float>(code & 0xFFFFu) / 65535.0f, static_cast<float>(code >> 16) / 65535.0f};
}
inline Float4 unpackUnorm4x8(uint code)
{
    return {static_cast<float>(code & 0xFFu) / 255.0f, static_cast<float>(code >> 8 & 0xFFu) / 255.0f,
            static_cast<float>(code >> 16 & 0xFFu) / 255.0f, static_cast<float>(code >> 24) / 255.0f};
}
} // namespace hearth::shared

#else

#define HEARTH_SHARED_BEGIN
#define HEARTH_SHARED_END
#define HEARTH_FUNCTION
#define HEARTH_CONSTEXPR_FUNCTION
#define HEARTH_IN(type) type
#define HEARTH_CONSTANT const
// forbids contraction into fused multiply-adds: the C++ side is compiled with -ffp-contract=off
#define HEARTH_PRECISE precise

#define floatBits floatBitsToUint
#define floatFromBits uintBitsToFloat
#define arcTangent atan
vec2 unpackSnorm2x8(uint code)
{
    return unpackSnorm4x8(code).xy;
}

#define Float2 vec2
#define Float3 vec3
#define Float4 vec4

#endif

#endif
