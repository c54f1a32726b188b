// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/wrap/wrap_oracle.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

namespace hearth::test
{

namespace
{

using Corners = std::array<Double3, 3>;

Corners getCorners(const CheckedSurface& surface, size_t triangle)
{
    const auto corner = [&](size_t k) { return widen(surface.positions[surface.indices[3 * triangle + k]]); };
    return {corner(0), corner(1), corner(2)};
}

/// Return on which side of the plane of a, b, c the point lies: -1, 0 or 1. Extended precision: exact for
/// coordinates with few bits, as those of hand-made surfaces, and off by 1e-18 of the size cubed otherwise.
int findSide(Double3 a, Double3 b, Double3 c, Double3 point)
{
    using Number = long double;
    const Number ux = Number{b.x} - Number{a.x}, uy = Number{b.y} - Number{a.y},
                 uz = Number{b.z} - Number{a.z};
    const Number vx = Number{c.x} - Number{a.x}, vy = Number{c.y} - Number{a.y},
                 vz = Number{c.z} - Number{a.z};
    const Number wx = Number{point.x} - Number{a.x}, wy = Number{point.y} - Number{a.y},
                 wz = Number{point.z} - Number{a.z};
    const Number volume = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
    return (volume > 0) - (volume < 0);
}

Double3 planeNormal(const Corners& t)
{
    return cross(t[1] - t[0], t[2] - t[0]);
}

/// True if a segment in the plane of a triangle touches it.
bool segmentMeetsInPlane(Double3 from, Double3 to, const Corners& t)
{
    const Double3 normal = planeNormal(t);
    const auto side = [&](Double3 p, Double3 q, Double3 x) { return findSide(p, q, p + normal, x); };
    const auto isInside = [&](Double3 x)
    {
        const std::array<int, 3> sides = {side(t[0], t[1], x), side(t[1], t[2], x), side(t[2], t[0], x)};
        const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
        return *least * *most >= 0;
    };
    if (isInside(from) || isInside(to))
        return true;
    for (size_t k = 0; k < 3; ++k)
    {
        const Double3 p = t[k], q = t[(k + 1) % 3];
        const int p_side = side(from, to, p), q_side = side(from, to, q);
        const bool is_on_one_line = p_side == 0 && q_side == 0; // then an end would be inside
        if (!is_on_one_line && p_side * q_side <= 0 && side(p, q, from) * side(p, q, to) <= 0)
            return true;
    }
    return false;
}

/// True if a segment touches a triangle.
bool segmentMeets(Double3 from, Double3 to, const Corners& t)
{
    const int from_side = findSide(t[0], t[1], t[2], from), to_side = findSide(t[0], t[1], t[2], to);
    if (from_side == 0 && to_side == 0)
        return segmentMeetsInPlane(from, to, t);
    if (from_side == to_side)
        return false;
    bool has_positive = false, has_negative = false;
    for (size_t k = 0; k < 3; ++k)
    {
        const int side = findSide(from, to, t[k], t[(k + 1) % 3]);
        has_positive |= side > 0;
        has_negative |= side < 0;
    }
    return !has_positive || !has_negative;
}

bool trianglesMeet(const Corners& a, const Corners& b)
{
    for (size_t k = 0; k < 3; ++k)
        if (segmentMeets(a[k], a[(k + 1) % 3], b) || segmentMeets(b[k], b[(k + 1) % 3], a))
            return true;
    return false;
}

bool boxesApart(const Corners& a, const Corners& b)
{
    const auto apart = [&](double Double3::*axis)
    {
        const auto [a_min, a_max] = std::minmax({a[0].*axis, a[1].*axis, a[2].*axis});
        const auto [b_min, b_max] = std::minmax({b[0].*axis, b[1].*axis, b[2].*axis});
        return a_max < b_min || b_max < a_min;
    };
    return apart(&Double3::x) || apart(&Double3::y) || apart(&Double3::z);
}

bool pairMeets(const CheckedSurface& surface, size_t i, size_t j)
{
    const Corners a = getCorners(surface, i), b = getCorners(surface, j);
    if (boxesApart(a, b))
        return false;
    std::vector<size_t> shared_a, shared_b;
    for (size_t k = 0; k < 3; ++k)
        for (size_t l = 0; l < 3; ++l)
            if (surface.indices[3 * i + k] == surface.indices[3 * j + l])
            {
                shared_a.push_back(k);
                shared_b.push_back(l);
            }
    if (shared_a.size() == 3)
        return true;
    if (shared_a.size() == 2)
    {
        const Double3 tip_a = a[3 - shared_a[0] - shared_a[1]], tip_b = b[3 - shared_b[0] - shared_b[1]];
        const Double3 p = a[shared_a[0]], q = a[shared_a[1]], normal = planeNormal(a);
        return findSide(a[0], a[1], a[2], tip_b) == 0 &&
               findSide(p, q, p + normal, tip_a) == findSide(p, q, p + normal, tip_b);
    }
    if (shared_a.size() == 1)
    {
        const size_t k = shared_a[0], l = shared_b[0];
        return segmentMeets(a[(k + 1) % 3], a[(k + 2) % 3], b) ||
               segmentMeets(b[(l + 1) % 3], b[(l + 2) % 3], a);
    }
    return trianglesMeet(a, b);
}

} // namespace

bool isWatertight(const CheckedSurface& surface)
{
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (size_t i = 0; i < surface.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k)
            ++uses[{surface.indices[i + k], surface.indices[i + (k + 1) % 3]}];
    return std::all_of(uses.begin(), uses.end(),
                       [&](const auto& use)
                       {
                           const auto opposite = uses.find({use.first.second, use.first.first});
                           return use.second == 1 && opposite != uses.end() && opposite->second == 1;
                       });
}

std::vector<std::pair<uint32_t, uint32_t>> findCrossings(const CheckedSurface& surface)
{
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    const auto count = static_cast<uint32_t>(surface.indices.size() / 3);
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t j = i + 1; j < count; ++j)
            if (pairMeets(surface, i, j))
                pairs.emplace_back(i, j);
    return pairs;
}

double windingNumber(const CheckedSurface& surface, Double3 point)
{
    double angle = 0;
    for (size_t i = 0; i < surface.indices.size() / 3; ++i)
    {
        const Corners t = getCorners(surface, i);
        const Double3 a = t[0] - point, b = t[1] - point, c = t[2] - point;
        const double la = length(a), lb = length(b), lc = length(c);
        angle += 2 * std::atan2(dot(a, cross(b, c)),
                                la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return angle / (4 * std::numbers::pi);
}

double enclosedVolume(const CheckedSurface& surface)
{
    double volume = 0;
    for (size_t i = 0; i < surface.indices.size() / 3; ++i)
    {
        const Corners t = getCorners(surface, i);
        volume += dot(t[0], cross(t[1], t[2])) / 6;
    }
    return volume;
}

} // namespace hearth::test
