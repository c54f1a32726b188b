// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/unwrap/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hearth::receivers
{

namespace
{

/// Points of an overlap's grid along a side.
constexpr double kMaxGridSide = 4096;

/// Twice the signed area of a triangle; positive if it is counterclockwise.
double cross(Point2 a, Point2 b, Point2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Return the convex hull, counterclockwise.
/// Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979
std::vector<Point2> findHull(std::vector<Point2> points)
{
    const auto key = [](Point2 p) { return std::pair(p.x, p.y); };
    std::ranges::sort(points, {}, key);
    std::vector<Point2> hull;
    const auto add = [&](Point2 p, size_t first)
    {
        while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0)
            hull.pop_back();
        hull.push_back(p);
    };
    for (const Point2 p : points)
        add(p, 0);
    const size_t lower = hull.size() - 1;
    for (size_t i = points.size(); i-- > 0;)
        add(points[i], lower);
    if (hull.size() > 1)
        hull.pop_back(); // the first one again
    return hull;
}

/// Box of points along a direction and across it.
struct TurnedBox
{
    Point2 direction{1, 0}; ///< unit
    Point2 low, high;       ///< along and across

    Point2 turn(Point2 p) const
    {
        return {p.x * direction.x + p.y * direction.y, p.y * direction.x - p.x * direction.y};
    }
    double width() const { return high.x - low.x; }
    double height() const { return high.y - low.y; }
    double area() const { return width() * height(); }
};

TurnedBox makeBox(Point2 direction, std::span<const Point2> points)
{
    constexpr double kFar = std::numeric_limits<double>::infinity();
    TurnedBox box{direction, {kFar, kFar}, {-kFar, -kFar}};
    for (const Point2 point : points)
    {
        const Point2 p = box.turn(point);
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    return box;
}

/// Return the box of the least area, which has a side along an edge of the hull.
/// Source: H. Freeman and R. Shapira, "Determining the minimum-area encasing rectangle for an arbitrary
/// closed curve", 1975
TurnedBox findSmallestBox(const std::vector<Point2>& points)
{
    const std::vector<Point2> hull = findHull(points);
    TurnedBox best = makeBox({1, 0}, hull);
    for (size_t i = 0; i < hull.size(); ++i)
    {
        const Point2 a = hull[i], b = hull[(i + 1) % hull.size()];
        const double size = std::hypot(b.x - a.x, b.y - a.y);
        if (!(size > 0))
            continue;
        const TurnedBox box = makeBox({(b.x - a.x) / size, (b.y - a.y) / size}, hull);
        // clearly smaller, so that rounding does not turn a square
        if (box.area() < 0.999 * best.area())
            best = box;
    }
    return best.width() >= best.height() ? best : makeBox({-best.direction.y, best.direction.x}, hull);
}

/// Return a unit vector across a unit vector.
Double3 findSide(Double3 normal)
{
    const Double3 axis = std::abs(normal.x) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 side = hearth::cross(axis, normal);
    return side * (1 / length(side));
}

} // namespace

ProjectedChart projectChart(std::span<const Float3> positions, std::span<const uint32_t> indices,
                            const TriangleGraph& graph, Chart chart)
{
    const Double3 normal = meanNormal(graph, chart), side = findSide(normal);
    const Double3 up = hearth::cross(normal, side);
    std::vector<Point2> points;
    points.reserve(3 * chart.size());
    for (const uint32_t triangle : chart)
        for (size_t corner = 0; corner < 3; ++corner)
        {
            const Double3 p = widen(positions[indices[size_t{3} * triangle + corner]]);
            points.push_back({dot(p, side), dot(p, up)});
        }
    const TurnedBox box = findSmallestBox(points);
    ProjectedChart projected{std::move(chart), {}, box.width(), box.height()};
    for (size_t i = 0; i + 2 < points.size(); i += 3)
    {
        auto& corners = projected.corners.emplace_back();
        for (size_t corner = 0; corner < 3; ++corner)
        {
            const Point2 p = box.turn(points[i + corner]);
            corners[corner] = {p.x - box.low.x, p.y - box.low.y};
        }
    }
    return projected;
}

double measureOverlap(const ProjectedChart& chart, double step)
{
    step = std::max({step, chart.width / kMaxGridSide, chart.height / kMaxGridSide});
    const auto columns = static_cast<size_t>(chart.width / step) + 1;
    const auto rows = static_cast<size_t>(chart.height / step) + 1;
    std::vector<uint8_t> counts(columns * rows);
    const auto first = [&](double low)
    { return static_cast<size_t>(std::max(0.0, std::ceil(low / step - 0.5))); };
    const auto last = [&](double high, size_t count) {
        return static_cast<size_t>(
            std::clamp(std::floor(high / step + 0.5), 0.0, static_cast<double>(count)));
    };
    for (const std::array<Point2, 3>& corners : chart.corners)
    {
        const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
        const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
        const double side = cross(corners[0], corners[1], corners[2]) < 0 ? -1 : 1;
        for (size_t y = first(top); y < last(bottom, rows); ++y)
            for (size_t x = first(left); x < last(right, columns); ++x)
            {
                const Point2 p{(static_cast<double>(x) + 0.5) * step, (static_cast<double>(y) + 0.5) * step};
                // an edge belongs to neither side, so that neighbours do not share a point
                if (side * cross(corners[0], corners[1], p) > 0 &&
                    side * cross(corners[1], corners[2], p) > 0 &&
                    side * cross(corners[2], corners[0], p) > 0)
                    counts[y * columns + x] = std::min<uint8_t>(counts[y * columns + x] + 1, 2);
            }
    }
    const auto covered = std::ranges::count_if(counts, [](uint8_t count) { return count > 0; });
    const auto doubly = std::ranges::count(counts, 2);
    return covered == 0 ? 0 : static_cast<double>(doubly) / static_cast<double>(covered);
}

} // namespace hearth::receivers
