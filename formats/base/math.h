// Small vectors and affine transforms, shared by the cooker and the runtime.
// Plain structs with the memory layout that files and GPU buffers use; names follow GLSL where it has one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hearth
{

struct Float2
{
    float x = 0, y = 0;
    friend bool operator==(const Float2&, const Float2&) = default;
};

struct Float3
{
    float x = 0, y = 0, z = 0;

    float& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    float operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    friend bool operator==(const Float3&, const Float3&) = default;
};

struct Float4
{
    float x = 0, y = 0, z = 0, w = 0;
    friend bool operator==(const Float4&, const Float4&) = default;
};

// one line each: they read as a table
// clang-format off
inline Float2 operator+(Float2 a, Float2 b) { return {a.x + b.x, a.y + b.y}; }
inline Float2 operator-(Float2 a, Float2 b) { return {a.x - b.x, a.y - b.y}; }
inline Float2 operator*(Float2 a, float s) { return {a.x * s, a.y * s}; }

inline Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float3 operator-(Float3 a) { return {-a.x, -a.y, -a.z}; }
inline Float3 operator*(Float3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Float3 operator*(float s, Float3 a) { return a * s; }
inline Float3 operator*(Float3 a, Float3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Float3 operator/(Float3 a, float s) { return {a.x / s, a.y / s, a.z / s}; }
inline Float3& operator+=(Float3& a, Float3 b) { return a = a + b; }
inline Float3& operator-=(Float3& a, Float3 b) { return a = a - b; }
// clang-format on

inline float dot(Float3 a, Float3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float3 cross(Float3 a, Float3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Float3 a)
{
    return std::sqrt(dot(a, a));
}
inline Float3 min(Float3 a, Float3 b)
{
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Float3 max(Float3 a, Float3 b)
{
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
inline bool isFinite(Float3 a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Unit vector along `a`, or `fallback` where `a` is too short to have a direction.
inline Float3 normalizeOr(Float3 a, Float3 fallback)
{
    const float len = length(a);
    return len > 1e-30f ? a / len : fallback;
}

/// Affine transform, row-major 3x4: row i is (m[i][0..2] | translation m[i][3]). Named target_from_source.
struct Affine3
{
    float m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    friend bool operator==(const Affine3&, const Affine3&) = default;
};

inline Float3 transformVector(const Affine3& t, Float3 v)
{
    return {t.m[0][0] * v.x + t.m[0][1] * v.y + t.m[0][2] * v.z,
            t.m[1][0] * v.x + t.m[1][1] * v.y + t.m[1][2] * v.z,
            t.m[2][0] * v.x + t.m[2][1] * v.y + t.m[2][2] * v.z};
}

inline Float3 transformPoint(const Affine3& t, Float3 p)
{
    return transformVector(t, p) + Float3{t.m[0][3], t.m[1][3], t.m[2][3]};
}

inline Affine3 operator*(const Affine3& a, const Affine3& b)
{
    Affine3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] +
                        (j == 3 ? a.m[i][3] : 0.0f);
    return r;
}

inline float determinant(const Affine3& t)
{
    return t.m[0][0] * (t.m[1][1] * t.m[2][2] - t.m[1][2] * t.m[2][1]) -
           t.m[0][1] * (t.m[1][0] * t.m[2][2] - t.m[1][2] * t.m[2][0]) +
           t.m[0][2] * (t.m[1][0] * t.m[2][1] - t.m[1][1] * t.m[2][0]);
}

/// Axis-aligned box; empty until a point is added.
struct Box3
{
    Float3 min{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
               std::numeric_limits<float>::infinity()};
    Float3 max{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
               -std::numeric_limits<float>::infinity()};

    void add(Float3 p)
    {
        min = hearth::min(min, p);
        max = hearth::max(max, p);
    }
    void add(const Box3& b)
    {
        min = hearth::min(min, b.min);
        max = hearth::max(max, b.max);
    }
    bool empty() const { return min.x > max.x; }
    Float3 center() const { return (min + max) * 0.5f; }
};

struct Sphere
{
    Float3 center;
    float radius = 0;
};

} // namespace hearth
