// Vectors in double precision, where floats are not exact enough.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cmath>

namespace hearth
{

struct Double3
{
    double x = 0, y = 0, z = 0;
};

// one line each: they read as a table
// clang-format off
inline Double3 widen(Float3 a) { return {a.x, a.y, a.z}; }
inline Float3 narrow(Double3 a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

inline Double3 operator+(Double3 a, Double3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Double3 operator-(Double3 a, Double3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 operator*(Double3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }

inline double dot(Double3 a, Double3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Double3 cross(Double3 a, Double3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Double3 a) { return std::sqrt(dot(a, a)); }
// clang-format on

} // namespace hearth
