// The algorithm is by C. Portaneri, M. Rouxel-Labbe, M. Hemmer, D. Cohen-Steiner and P. Alliez, "Alpha
// Wrapping with an Offset", 2022.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/cgal_wrap.h"

#include "cook/wrap/thread_time.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace hearth::wrap
{

namespace
{

namespace aw3 = CGAL::Alpha_wraps_3::internal;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Mesh = CGAL::Surface_mesh<Point>;

Point makePoint(Float3 position)
{
    return {double{position.x}, double{position.y}, double{position.z}};
}

Double3 makeDouble3(const Point& point)
{
    return {point.x(), point.y(), point.z()};
}

Triangle makeTriangle(const Surface& surface, size_t triangle)
{
    const std::array<Float3, 3> corners = surface.corners(triangle);
    return {makePoint(corners[0]), makePoint(corners[1]), makePoint(corners[2])};
}

/// Thrown through CGAL, whose loop has no other exit.
struct TimeIsUp
{
};

class Deadline
{
public:
    explicit Deadline(double max_seconds) : end_(threadSeconds() + max_seconds) {}

    /// Throw TimeIsUp if the time is up. Call it at each step: reading the clock takes a microsecond.
    void check()
    {
        if (++steps_ % 256 == 0 && threadSeconds() > end_)
            throw TimeIsUp();
    }

private:
    double end_;
    uint32_t steps_ = 0;
};

/// Ends a wrap that takes too long: CGAL calls it at every step.
struct TimeLimit : aw3::Wrapping_default_visitor
{
    explicit TimeLimit(double max_seconds) : deadline(max_seconds) {}

    template <typename Wrapper, typename Gate>
    void before_facet_treatment(const Wrapper&, const Gate&)
    {
        deadline.check();
    }

    Deadline deadline;
};

/// Answers the questions of CGAL's wrapper about a source, in place of CGAL's Triangle_soup_oracle, whose
/// trees start each search anew and test boxes exactly: several times faster. Whether a cell touches the
/// source is decided exactly, as there; distances are in doubles.
class SourceOracle
{
public:
    using Geom_traits = aw3::Alpha_wrap_AABB_traits<Kernel>; // the name that the wrapper looks for
    using Ball = Geom_traits::Ball_3;

    explicit SourceOracle(const SourceTree& source) : source_(source) {}

    Geom_traits geom_traits() const { return {}; }

    CGAL::Bbox_3 bbox() const
    {
        CGAL::Bbox_3 box;
        for (const Float3 position : source_.surface().positions)
            box += makePoint(position).bbox();
        return box;
    }

    template <typename Traits>
    bool do_intersect(const aw3::Tetrahedron_with_outside_info<Traits>& cell) const
    {
        const std::array corners{makeDouble3(cell.m_tet[0]), makeDouble3(cell.m_tet[1]),
                                 makeDouble3(cell.m_tet[2]), makeDouble3(cell.m_tet[3])};
        const auto touches = geom_traits().do_intersect_3_object();
        return source_.hasTouching(ConvexBody(corners), [&](uint32_t triangle)
                                   { return touches(cell, makeTriangle(source_.surface(), triangle)); });
    }

    bool do_intersect(const Ball& ball) const
    {
        return source_.isWithin(makeDouble3(ball.boundary().center()), ball.boundary().squared_radius());
    }

    Point closest_point(const Point& point) const
    {
        const Double3 closest = makeDouble3(point) - findNearest(point).offset;
        return {closest.x, closest.y, closest.z};
    }

    /// Find the first point of a segment that is at the offset from the source, by CGAL's search.
    bool first_intersection(const Point& from, const Point& to, Point& found, double offset_m) const
    {
        const auto distance = [this](const Point& point) { return std::sqrt(findNearest(point).distance2); };
        const double precision = 0.01 * offset_m; // CGAL's own
        return aw3::Offset_intersection<Geom_traits, decltype(distance)>(distance, offset_m, precision, 1)
            .first_intersection(from, to, found);
    }

private:
    SourceTree::Nearest findNearest(const Point& point) const
    {
        const SourceTree::Nearest nearest = source_.findNearest(makeDouble3(point), hint_);
        hint_ = nearest.triangle; // the next point is mostly on the same segment
        return nearest;
    }

    const SourceTree& source_;
    mutable uint32_t hint_ = 0;
};

/// Collects pairs and keeps the first ones in order: all pairs of a tangle do not fit into memory.
class FirstPairs
{
public:
    explicit FirstPairs(size_t max_pairs) : max_pairs_(max_pairs) {}

    void add(TrianglePair pair)
    {
        ++found_.count;
        found_.pairs.push_back(pair);
        if (found_.pairs.size() >= 2 * max_pairs_ + 1024)
            keepFirst();
    }

    SelfIntersections finish()
    {
        keepFirst();
        return std::move(found_);
    }

private:
    void keepFirst()
    {
        std::sort(found_.pairs.begin(), found_.pairs.end());
        found_.pairs.resize(std::min(found_.pairs.size(), max_pairs_));
    }

    size_t max_pairs_;
    SelfIntersections found_;
};

/// Round to floats. Vertices are sorted by position; each triangle starts with its first vertex, and
/// triangles are sorted, too.
Surface makeCanonical(const Mesh& mesh)
{
    Surface surface;
    std::vector<Float3> positions;
    for (const auto vertex : mesh.vertices())
    {
        const Point& point = mesh.point(vertex);
        positions.push_back(narrow(makeDouble3(point)));
    }
    std::vector<uint32_t> order(positions.size()), rank(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i)
    { return std::make_tuple(positions[i].x, positions[i].y, positions[i].z); };
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (uint32_t i = 0; i < order.size(); ++i)
    {
        rank[order[i]] = i;
        surface.positions.push_back(positions[order[i]]);
    }
    std::vector<std::array<uint32_t, 3>> triangles;
    for (const auto face : mesh.faces())
    {
        std::array<uint32_t, 3> triangle{};
        size_t corner = 0;
        for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
            triangle[corner++] = rank[static_cast<uint32_t>(vertex)];
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        triangles.push_back(triangle);
    }
    std::sort(triangles.begin(), triangles.end());
    for (const std::array<uint32_t, 3>& triangle : triangles)
        surface.indices.insert(surface.indices.end(), triangle.begin(), triangle.end());
    return surface;
}

/// Corners that two triangles share: how many, and where the last of them is in each.
struct SharedCorners
{
    int count = 0;
    int in_a = 0;
    int in_b = 0;
};

SharedCorners findShared(const uint32_t* a, const uint32_t* b)
{
    SharedCorners shared;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a[i] == b[j])
                shared = {shared.count + 1, i, j};
    return shared;
}

/// Return the corner that the other triangle does not have.
int findOther(const uint32_t* triangle, const uint32_t* other)
{
    return static_cast<int>(std::find_if(triangle, triangle + 3,
                                         [&](uint32_t corner)
                                         { return std::find(other, other + 3, corner) == other + 3; }) -
                            triangle);
}

/// True if two triangles with a common edge lie in one plane, on the same side of the edge.
bool overlapAtEdge(const Triangle& a, const Triangle& b, int tip_of_a, int tip_of_b)
{
    const Point& tip = a.vertex(tip_of_a);
    const Point& from = a.vertex(tip_of_a + 1);
    const Point& to = a.vertex(tip_of_a + 2);
    const Point& other = b.vertex(tip_of_b);
    return CGAL::coplanar(from, to, tip, other) &&
           CGAL::coplanar_orientation(from, to, tip, other) == CGAL::POSITIVE;
}

/// True if two triangles with a common corner meet beyond it.
bool meetBeyondCorner(const Triangle& a, const Triangle& b, int in_a, int in_b)
{
    return CGAL::do_intersect(a, Segment(b.vertex(in_b + 1), b.vertex(in_b + 2))) ||
           CGAL::do_intersect(b, Segment(a.vertex(in_a + 1), a.vertex(in_a + 2)));
}

bool intersect(const Surface& surface, uint32_t a, uint32_t b)
{
    const uint32_t* const corners_of_a = &surface.indices[3 * size_t{a}];
    const uint32_t* const corners_of_b = &surface.indices[3 * size_t{b}];
    const Triangle triangle_a = makeTriangle(surface, a), triangle_b = makeTriangle(surface, b);
    const SharedCorners shared = findShared(corners_of_a, corners_of_b);
    switch (shared.count)
    {
    case 0:
        return CGAL::do_intersect(triangle_a, triangle_b);
    case 1:
        return meetBeyondCorner(triangle_a, triangle_b, shared.in_a, shared.in_b);
    case 2:
        return overlapAtEdge(triangle_a, triangle_b, findOther(corners_of_a, corners_of_b),
                             findOther(corners_of_b, corners_of_a));
    default:
        return true;
    }
}

} // namespace

std::optional<Surface> computeAlphaWrap(const SourceTree& source, double alpha_m, double offset_m,
                                        double max_seconds)
{
    const SourceOracle oracle(source);
    TimeLimit limit(max_seconds);
    Mesh wrap;
    try
    {
        aw3::Alpha_wrap_3<SourceOracle> wrapper(oracle);
        wrapper(alpha_m, offset_m, wrap, CGAL::parameters::visitor(limit));
    }
    catch (const TimeIsUp&)
    {
        return std::nullopt;
    }
    return makeCanonical(wrap);
}

std::optional<SelfIntersections> findSelfIntersections(const Surface& surface, size_t max_pairs,
                                                       double max_seconds)
{
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, uint32_t>;
    std::vector<Box> boxes;
    for (uint32_t i = 0; i < surface.triangleCount(); ++i)
        boxes.emplace_back(makeTriangle(surface, i).bbox(), i);
    FirstPairs first(max_pairs);
    Deadline deadline(max_seconds);
    try
    {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                      [&](const Box& a, const Box& b)
                                      {
                                          deadline.check();
                                          const auto [low, high] = std::minmax({a.info(), b.info()});
                                          if (intersect(surface, low, high))
                                              first.add({low, high});
                                      });
    }
    catch (const TimeIsUp&)
    {
        return std::nullopt;
    }
    return first.finish();
}

bool containsPoints(const Surface& surface, std::span<const Float3> points)
{
    Mesh mesh;
    for (const Float3 position : surface.positions)
        mesh.add_vertex(makePoint(position));
    for (size_t i = 0; i < surface.indices.size(); i += 3)
        mesh.add_face(Mesh::Vertex_index(surface.indices[i]), Mesh::Vertex_index(surface.indices[i + 1]),
                      Mesh::Vertex_index(surface.indices[i + 2]));
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
    return std::all_of(points.begin(), points.end(),
                       [&](Float3 point) { return side(makePoint(point)) == CGAL::ON_BOUNDED_SIDE; });
}

std::vector<uint32_t> findTouching(const Surface& surface, const SourceTree& source)
{
    std::vector<uint32_t> touching;
    for (uint32_t i = 0; i < surface.triangleCount(); ++i)
    {
        const std::array<Float3, 3> c = surface.corners(i);
        const Triangle triangle = makeTriangle(surface, i);
        const auto touches = [&](uint32_t other)
        { return CGAL::do_intersect(triangle, makeTriangle(source.surface(), other)); };
        if (source.hasTouching(ConvexBody(std::array{widen(c[0]), widen(c[1]), widen(c[2])}), touches))
            touching.push_back(i);
    }
    return touching;
}

} // namespace hearth::wrap
