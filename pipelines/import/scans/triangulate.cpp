// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/triangulate.h"

#include <array>
#include <cstddef>

namespace hearth::import
{

namespace
{

/// Limit of point tests per corner of a polygon; only artificial files come near it.
constexpr size_t kMaxTestsPerCorner = 512;

struct Point2
{
    double x = 0;
    double y = 0;
    friend bool operator==(const Point2&, const Point2&) = default;
};

struct Vector3
{
    double x = 0, y = 0, z = 0;
};

Vector3 difference(Float3 a, Float3 b)
{
    return {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
}

Vector3 cross(Vector3 a, Vector3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(Vector3 a, Vector3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Return twice the signed area of the triangle, positive if it is counter-clockwise.
double signedArea2(Point2 a, Point2 b, Point2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool contains(Point2 a, Point2 b, Point2 c, Point2 p)
{
    return signedArea2(a, b, p) >= 0 && signedArea2(b, c, p) >= 0 && signedArea2(c, a, p) >= 0;
}

/// Return Newell's mean normal of a polygon; its length is twice the area.
Vector3 newellNormal(std::span<const Float3> corners)
{
    Vector3 sum;
    for (size_t i = 0; i < corners.size(); ++i)
    {
        const Vector3 a = difference(corners[i], corners[0]);
        const Vector3 b = difference(corners[(i + 1) % corners.size()], corners[0]);
        const Vector3 c = cross(a, b);
        sum = {sum.x + c.x, sum.y + c.y, sum.z + c.z};
    }
    return sum;
}

/// Project along the axis in which the normal is longest; the result is a counter-clockwise polygon.
std::vector<Point2> project(std::span<const Float3> corners, Vector3 normal)
{
    const double x = std::abs(normal.x);
    const double y = std::abs(normal.y);
    const double z = std::abs(normal.z);
    const int dropped = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const double along = dropped == 0 ? normal.x : dropped == 1 ? normal.y : normal.z;
    int first = (dropped + 1) % 3;
    int second = (dropped + 2) % 3;
    if (along < 0)
        std::swap(first, second);
    std::vector<Point2> points(corners.size());
    for (size_t i = 0; i < corners.size(); ++i)
        points[i] = {double{corners[i][first]}, double{corners[i][second]}};
    return points;
}

class EarClipper
{
public:
    explicit EarClipper(std::vector<Point2> points)
        : points_(std::move(points)),
          next_(points_.size()),
          previous_(points_.size()),
          tests_left_(points_.size() * kMaxTestsPerCorner)
    {
        const auto count = static_cast<uint32_t>(points_.size());
        for (uint32_t i = 0; i < count; ++i)
        {
            next_[i] = (i + 1) % count;
            previous_[i] = (i + count - 1) % count;
        }
        is_concave_.resize(count);
        for (uint32_t i = 0; i < count; ++i)
            if (signedArea2At(i) < 0)
            {
                concave_.push_back(i);
                is_concave_[i] = 1;
            }
    }

    void run(std::vector<uint32_t>& triangles)
    {
        auto left = static_cast<uint32_t>(points_.size());
        uint32_t corner = 0;
        uint32_t tried = 0;
        while (left > 2)
        {
            // a polygon that intersects itself may have no ear: after a full round any corner is taken
            if (tried < left && !isEar(corner))
            {
                corner = next_[corner];
                ++tried;
                continue;
            }
            triangles.insert(triangles.end(), {previous_[corner], corner, next_[corner]});
            remove(corner);
            // continuing behind the neighbour keeps the triangles from forming a fan
            corner = next_[next_[corner]];
            tried = 0;
            --left;
        }
    }

private:
    double signedArea2At(uint32_t i) const
    {
        return signedArea2(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    bool isEar(uint32_t i)
    {
        if (tests_left_ <= concave_.size())
            return true;
        --tests_left_;
        if (signedArea2At(i) < 0)
            return false;
        tests_left_ -= concave_.size();
        const Point2 a = points_[previous_[i]];
        const Point2 b = points_[i];
        const Point2 c = points_[next_[i]];
        for (uint32_t other : concave_)
        {
            const Point2 p = points_[other];
            if (is_concave_[other] != 0 && p != a && p != b && p != c && contains(a, b, c, p))
                return false;
        }
        return true;
    }

    /// Remove a corner; this can only make its neighbours less concave.
    void remove(uint32_t i)
    {
        const uint32_t before = previous_[i];
        const uint32_t after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        markConvex(i);
        for (uint32_t neighbour : {before, after})
            if (signedArea2At(neighbour) >= 0)
                markConvex(neighbour);
        if (convex_in_list_ * 2 > concave_.size())
        {
            std::erase_if(concave_, [&](uint32_t c) { return is_concave_[c] == 0; });
            convex_in_list_ = 0;
        }
    }

    void markConvex(uint32_t i)
    {
        convex_in_list_ += is_concave_[i];
        is_concave_[i] = 0;
    }

    std::vector<Point2> points_;
    std::vector<uint32_t> next_;
    std::vector<uint32_t> previous_;
    std::vector<uint32_t> concave_; ///< may include corners that are no longer concave
    std::vector<uint8_t> is_concave_;
    size_t convex_in_list_ = 0;
    size_t tests_left_;
};

void triangulateQuad(std::span<const Float3> c, std::vector<uint32_t>& triangles)
{
    const Vector3 d02 = difference(c[2], c[0]);
    const Vector3 d13 = difference(c[3], c[1]);
    // a diagonal is inside if its two triangles have the same orientation
    const double inside02 = dot(cross(difference(c[1], c[0]), d02), cross(d02, difference(c[3], c[0])));
    const double inside13 = dot(cross(difference(c[2], c[1]), d13), cross(d13, difference(c[0], c[1])));
    const bool ok02 = inside02 > 0;
    const bool ok13 = inside13 > 0;
    const bool take13 = ok13 && (!ok02 || dot(d13, d13) < dot(d02, d02));
    if (take13)
        triangles.insert(triangles.end(), {0, 1, 3, 1, 2, 3});
    else
        triangles.insert(triangles.end(), {0, 1, 2, 0, 2, 3});
}

} // namespace

void triangulatePolygon(std::span<const Float3> corners, std::vector<uint32_t>& triangles)
{
    if (corners.size() == 3)
        triangles.insert(triangles.end(), {0, 1, 2});
    else if (corners.size() == 4)
        triangulateQuad(corners, triangles);
    else
        EarClipper(project(corners, newellNormal(corners))).run(triangles);
}

} // namespace hearth::import
