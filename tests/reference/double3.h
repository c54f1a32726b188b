// Vectors and matrices in double precision for the references. Shares nothing with the code under test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <cmath>

namespace hearth::reference
{

struct Double3
{
    double x = 0, y = 0, z = 0;

    Double3() = default;
    Double3(double a, double b, double c) : x(a), y(b), z(c) {}
    explicit Double3(Float3 v) : x(double{v.x}), y(double{v.y}), z(double{v.z}) {}
    friend bool operator==(const Double3&, const Double3&) = default;
};

inline Double3 operator+(Double3 a, Double3 b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Double3 operator-(Double3 a, Double3 b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Double3 operator-(Double3 a)
{
    return {-a.x, -a.y, -a.z};
}
inline Double3 operator*(Double3 a, double s)
{
    return {a.x * s, a.y * s, a.z * s};
}
inline Double3 operator*(Double3 a, Double3 b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Double3 operator/(Double3 a, double s)
{
    return {a.x / s, a.y / s, a.z / s};
}
inline Double3& operator+=(Double3& a, Double3 b)
{
    return a = a + b;
}
inline double dot(Double3 a, Double3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Double3 cross(Double3 a, Double3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Double3 a)
{
    return std::sqrt(dot(a, a));
}
inline Double3 normalize(Double3 a)
{
    return a / length(a);
}
inline Double3 abs(Double3 a)
{
    return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}

/// Affine transform of the file formats, in double.
struct DoubleAffine
{
    Double3 row[3];
    Double3 translation;

    explicit DoubleAffine(const Affine3& a)
        : row{{double{a.m[0][0]}, double{a.m[0][1]}, double{a.m[0][2]}},
              {double{a.m[1][0]}, double{a.m[1][1]}, double{a.m[1][2]}},
              {double{a.m[2][0]}, double{a.m[2][1]}, double{a.m[2][2]}}},
          translation{double{a.m[0][3]}, double{a.m[1][3]}, double{a.m[2][3]}}
    {
    }

    explicit DoubleAffine(const Affine3d& a)
        : row{{a.m[0][0], a.m[0][1], a.m[0][2]},
              {a.m[1][0], a.m[1][1], a.m[1][2]},
              {a.m[2][0], a.m[2][1], a.m[2][2]}},
          translation{a.m[0][3], a.m[1][3], a.m[2][3]}
    {
    }

    Double3 vector(Double3 v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
    Double3 point(Double3 p) const { return vector(p) + translation; }
    double determinant() const { return dot(row[0], cross(row[1], row[2])); }

    /// Return the vector v with vector(v) = w; the determinant must not be 0.
    Double3 solve(Double3 w) const
    {
        const Double3 a = cross(row[1], row[2]), b = cross(row[2], row[0]), c = cross(row[0], row[1]);
        return (a * w.x + b * w.y + c * w.z) / determinant();
    }

    /// Direction of a surface's normal after the transform, by the cofactor matrix, which exists for any
    /// affine matrix.
    Double3 normal(Double3 n) const
    {
        const Double3 a = cross(row[1], row[2]), b = cross(row[2], row[0]), c = cross(row[0], row[1]);
        return {dot(a, n), dot(b, n), dot(c, n)};
    }
};

} // namespace hearth::reference
