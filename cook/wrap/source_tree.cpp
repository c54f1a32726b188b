// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/source_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::wrap
{

using clusters::Corners3;

namespace
{

/// Return the sum of the absolute coordinates: at least the length.
double sumOfSides(Double3 a)
{
    return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}

float roundDown(double value)
{
    const auto rounded = static_cast<float>(value);
    return double{rounded} <= value ? rounded
                                    : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

/// Return a box around a triangle whose corners may be no floats.
Box3 makeBox(const Corners3& corners)
{
    Box3 box;
    for (const Double3 corner : corners)
    {
        box.add(Float3{roundDown(corner.x), roundDown(corner.y), roundDown(corner.z)});
        box.add(Float3{-roundDown(-corner.x), -roundDown(-corner.y), -roundDown(-corner.z)});
    }
    return box;
}

/// Call `add` with the box of a triangle; or, if an edge is longer than allowed, with those of its halves,
/// each halved in turn.
template <typename Add>
void splitLongEdges(const Corners3& corners, double max_edge2, const Add& add)
{
    std::array<double, 3> edges2{};
    for (size_t i = 0; i < 3; ++i)
    {
        const Double3 edge = corners[(i + 1) % 3] - corners[i];
        edges2[i] = dot(edge, edge);
    }
    const auto longest = static_cast<size_t>(std::max_element(edges2.begin(), edges2.end()) - edges2.begin());
    if (!(edges2[longest] > max_edge2))
    {
        add(makeBox(corners));
        return;
    }
    const Double3 from = corners[longest], to = corners[(longest + 1) % 3], tip = corners[(longest + 2) % 3];
    const Double3 middle = (from + to) * 0.5;
    splitLongEdges({from, middle, tip}, max_edge2, add);
    splitLongEdges({middle, to, tip}, max_edge2, add);
}

} // namespace

bool ConvexBody::Plane::isInFront(Double3 x) const
{
    const Double3 away = x - point;
    return dot(normal, away) > rounding * sumOfSides(away);
}

ConvexBody::ConvexBody(std::span<const Double3> corners)
    : corner_count_(corners.size()), low_(corners[0]), high_(corners[0])
{
    HEARTH_ASSERT(corner_count_ == 3 || corner_count_ == 4);
    for (size_t i = 0; i < corner_count_; ++i)
    {
        const Double3 p = corners_[i] = corners[i];
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    }
    addFaces();
}

ConvexBody::Plane ConvexBody::makePlane(const Corners3& corners)
{
    const Double3 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    // some twenty roundings, each of 2^-53 of the product of the sides at most
    constexpr double kRounding = 0x1p-46;
    return {corners[0], cross(ab, ac), kRounding * sumOfSides(ab) * sumOfSides(ac)};
}

/// Add the planes of the faces. A tetrahedron that is flat but for rounding has none where its inside is not
/// known.
void ConvexBody::addFaces()
{
    const auto add = [&](Plane plane, bool is_turned)
    {
        if (is_turned)
            plane.normal = plane.normal * -1;
        planes_[plane_count_++] = plane;
    };
    if (corner_count_ == 3)
    {
        const Plane plane = makePlane({corners_[0], corners_[1], corners_[2]});
        add(plane, false);
        add(plane, true);
        return;
    }
    for (size_t i = 0; i < 4; ++i)
    {
        Plane plane = makePlane({corners_[(i + 1) % 4], corners_[(i + 2) % 4], corners_[(i + 3) % 4]});
        const bool is_turned = plane.isInFront(corners_[i]);
        if (is_turned || dot(plane.normal, corners_[i] - plane.point) <
                             -plane.rounding * sumOfSides(corners_[i] - plane.point))
            add(plane, is_turned);
    }
}

Double3 ConvexBody::center() const
{
    return (low_ + high_) * 0.5;
}

bool ConvexBody::mayTouch(const Box3& box) const
{
    const Double3 low = widen(box.min), high = widen(box.max);
    if (low.x > high_.x || low.y > high_.y || low.z > high_.z || high.x < low_.x || high.y < low_.y ||
        high.z < low_.z)
        return false;
    return std::none_of(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(plane_count_),
                        [&](const Plane& plane)
                        {
                            // the corner of the box that is farthest behind the plane
                            return plane.isInFront({plane.normal.x > 0 ? low.x : high.x,
                                                    plane.normal.y > 0 ? low.y : high.y,
                                                    plane.normal.z > 0 ? low.z : high.z});
                        });
}

bool ConvexBody::mayTouch(const Corners3& triangle) const
{
    const auto isBeyond = [](const Plane& plane, std::span<const Double3> points)
    { return std::all_of(points.begin(), points.end(), [&](Double3 p) { return plane.isInFront(p); }); };
    for (size_t i = 0; i < plane_count_; ++i)
        if (isBeyond(planes_[i], triangle))
            return false;
    Plane plane = makePlane(triangle);
    for (int side = 0; side < 2; ++side, plane.normal = plane.normal * -1)
        if (isBeyond(plane, std::span(corners_).first(corner_count_)))
            return false;
    return true;
}

SourceTree::SourceTree(const Surface& surface, double max_edge_m) : surface_(surface)
{
    std::vector<Box3> boxes;
    for (uint32_t triangle = 0; triangle < surface.triangleCount(); ++triangle)
        splitLongEdges(corners(triangle), max_edge_m * max_edge_m,
                       [&](const Box3& box)
                       {
                           boxes.push_back(box);
                           triangle_of_piece_.push_back(triangle);
                       });
    tree_ = mesh::TriangleTree(static_cast<uint32_t>(boxes.size()),
                               [&](uint32_t piece) -> std::array<Float3, 3> {
                                   return {boxes[piece].min, boxes[piece].max, boxes[piece].center()};
                               });
}

Corners3 SourceTree::corners(uint32_t triangle) const
{
    const std::array<Float3, 3> c = surface_.corners(triangle);
    return {widen(c[0]), widen(c[1]), widen(c[2])};
}

SourceTree::Nearest SourceTree::findNearest(Double3 point, uint32_t hint) const
{
    const auto measure = [&](uint32_t triangle) -> Nearest
    {
        const Double3 offset = clusters::offsetFromTriangle(point, corners(triangle));
        return {triangle, offset, dot(offset, offset)};
    };
    Nearest best = measure(hint);
    tree_.visitNearest(
        point, [&](double box_distance2) { return box_distance2 < best.distance2; },
        [&](uint32_t i)
        {
            const Nearest found = measure(triangle_of_piece_[tree_.order()[i]]);
            if (found.distance2 < best.distance2)
                best = found;
        });
    return best;
}

bool SourceTree::isWithin(Double3 point, double distance2) const
{
    bool found = false;
    tree_.visitNearest(
        point, [&](double box_distance2) { return !found && box_distance2 <= distance2; },
        [&](uint32_t i) {
            found = found ||
                    clusters::distance2(point, corners(triangle_of_piece_[tree_.order()[i]])) <= distance2;
        });
    return found;
}

} // namespace hearth::wrap
