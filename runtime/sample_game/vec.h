// Vectors of the game: metres, right-handed, +Y up.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cmath>

namespace game
{

inline constexpr float kPi = 3.14159265f;

struct Vec
{
    float x = 0, y = 0, z = 0;

    Vec operator+(Vec b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vec operator-(Vec b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vec operator*(float s) const { return {x * s, y * s, z * s}; }
};

inline float dot(Vec a, Vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec unit(Vec a)
{
    return a * (1 / std::sqrt(dot(a, a)));
}
/// Return the level direction of a heading: 0 along +Z, a quarter turn along +X.
inline Vec headingToDirection(float heading)
{
    return {std::sin(heading), 0, std::cos(heading)};
}
inline float mix(float a, float b, float share)
{
    return a + (b - a) * share;
}
/// Go from 0 at `from` to 1 at `to`, smoothly.
inline float smooth(float from, float to, float at)
{
    const float share = std::fmin(1.0f, std::fmax(0.0f, (at - from) / (to - from)));
    return share * share * (3 - 2 * share);
}

} // namespace game
