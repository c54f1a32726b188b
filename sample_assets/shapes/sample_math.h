// Mathematical functions that the generators need beyond formats/base/math.h. Sine and cosine are implemented
// here: the C library chooses its code by processor, and samples must have the same bytes everywhere. Only +
// - * / and sqrt are used below, which IEEE 754 defines exactly to the last bit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <array>
#include <cmath>

namespace hearth::samples
{

inline constexpr float kPi = 3.14159265f;

/// Return the sine by its Taylor series after reduction to [-pi/2, pi/2]; error below 1e-11 for |x| < 1e4.
inline double taylorSine(double x)
{
    constexpr double pi = 3.14159265358979323846;
    const double half_turns = std::floor(x / pi + 0.5);
    const double r = x - half_turns * pi;
    const double r2 = r * r;
    double sum = 0;
    for (const double divisor : {15.0 * 14, 13.0 * 12, 11.0 * 10, 9.0 * 8, 7.0 * 6, 5.0 * 4, 3.0 * 2})
        sum = (1.0 + sum) * (-r2 / divisor);
    const double value = r * (1.0 + sum);
    const bool odd = std::floor(half_turns * 0.5) * 2.0 != half_turns;
    return odd ? -value : value;
}

inline float sine(float x)
{
    return static_cast<float>(taylorSine(static_cast<double>(x)));
}
inline float cosine(float x)
{
    return static_cast<float>(taylorSine(static_cast<double>(x) + 1.57079632679489661923));
}

inline float clamp01(float x)
{
    return std::clamp(x, 0.0f, 1.0f);
}
inline float lerp(float a, float b, float t)
{
    return a + (b - a) * t;
}
inline Float3 lerp(Float3 a, Float3 b, float t)
{
    return a + (b - a) * t;
}

/// Return 0 below `from`, 1 above `to`, smooth between; `from` may be greater than `to`.
inline float smoothstep(float from, float to, float x)
{
    const float t = clamp01((x - from) / (to - from));
    return t * t * (3.0f - 2.0f * t);
}

/// Return the display colour of a glow, nearly 1 - exp(-glow): for unlit surfaces, which shadow no light that
/// they hold.
inline Float3 exposeGlow(Float3 glow)
{
    const auto expose = [](float x) { return 1 - 1 / (1 + x + 0.5f * x * x); };
    return {expose(glow.x), expose(glow.y), expose(glow.z)};
}

/// Return the smaller of a and b, rounded over a range of `width` where they are close.
inline float smoothMin(float a, float b, float width)
{
    const float h = std::max(width - std::abs(a - b), 0.0f) / width;
    return std::min(a, b) - h * h * width * 0.25f;
}

inline Float3 normalize(Float3 v)
{
    return normalizeOr(v, {0, 1, 0});
}

/// Return the unit quaternion that rotates by `angle_rad` about the unit `axis`.
inline Float4 rotationAbout(Float3 axis, float angle_rad)
{
    const float s = sine(angle_rad * 0.5f);
    return {axis.x * s, axis.y * s, axis.z * s, cosine(angle_rad * 0.5f)};
}

/// Return the rotation b, then a.
inline Float4 multiply(Float4 a, Float4 b)
{
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// Return the rotation on the shortest way from a to b, straight between the quaternions.
inline Float4 blendRotations(Float4 a, Float4 b, float t)
{
    const float sign = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -1.0f : 1.0f;
    const Float4 q{lerp(a.x, b.x * sign, t), lerp(a.y, b.y * sign, t), lerp(a.z, b.z * sign, t),
                   lerp(a.w, b.w * sign, t)};
    const float length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
}

inline Float3 rotate(Float4 q, Float3 v)
{
    const Float3 u{q.x, q.y, q.z};
    const Float3 t = cross(u, v) * 2.0f;
    return v + t * q.w + cross(u, t);
}

/// Return the rotation from unit vector `from` to unit vector `to`; they must not be opposite.
inline Float4 rotationBetween(Float3 from, Float3 to)
{
    const Float3 axis = cross(from, to);
    const Float4 q{axis.x, axis.y, axis.z, 1.0f + dot(from, to)};
    const float length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
}

/// Return the rotation of an object at `eye` whose -Z axis looks at `target` and whose +Y axis stays upright.
inline Float4 rotationLookingAt(Float3 eye, Float3 target)
{
    const Float3 back = normalize(eye - target);
    const Float3 right = normalize(cross({0, 1, 0}, back));
    const Float4 turn = rotationBetween({0, 0, 1}, back);
    // the shortest turn rolls the camera: undo the roll about its own axis
    const Float3 rolled = rotate(turn, {1, 0, 0});
    const Float4 unroll = rotationBetween(rolled, right);
    return multiply(unroll, turn);
}

inline Float3 apply(const std::array<Float3, 3>& columns, Float3 v)
{
    return columns[0] * v.x + columns[1] * v.y + columns[2] * v.z;
}

} // namespace hearth::samples
