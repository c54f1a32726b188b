// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_bound.h"

#include "cook/clusters/surface/surface_tree.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

// The search ends when bounds are within this factor of a real distance.
constexpr double kSearchSlack = 1.1;

// A triangle is searched in at most this many pieces. On surfaces that lie apart by a thousandth of their
// size, one triangle that spans all of the other surface takes about a million.
constexpr size_t kMaxPieces = size_t{1} << 22;

// A corner within this part of a piece's radius of a border is on it. Without it rounding would cut slivers
// as long as the piece off it, again and again.
constexpr double kOnBorder = 1e-9;

// Triangles of a block are searched in parallel. They use the distances of earlier blocks, not of each other,
// so the result does not depend on the threads.
constexpr size_t kBlock = 4096;

// Points that are measured first, to find a large distance early: corners, and this many centers where the
// triangles are fewer, at most 1024 a triangle.
constexpr size_t kFirstPoints = 65536;
constexpr size_t kMaxHalvings = 10;

// Corners that are measured in sequence: each starts at the nearest triangle of the one before.
constexpr size_t kRun = 256;

// Rounding of a distance, in parts of the coordinates: a few times 2^-53, with margin.
constexpr double kBoundRounding = 1e-14;

/// Piece of a triangle: a triangle itself.
struct Piece
{
    Corners3 corners;
    TriangleId near{};            ///< a nearby triangle of the other surface
    TriangleId cut_by = kInvalid; ///< the triangle that it was cut along, if any
};

/// Result of one triangle.
struct TriangleBound
{
    double upper = 0;
    double sure = 0;
    uint64_t loose_pieces = 0;
};

Double3 pieceCenter(const Corners3& c)
{
    return (c[0] + c[1] + c[2]) * (1.0 / 3);
}

/// Return the radius around the center that contains the whole piece.
double pieceRadius(const Corners3& c, Double3 center)
{
    double radius2 = 0;
    for (const Double3 corner : c)
        radius2 = std::max(radius2, dot(corner - center, corner - center));
    return std::sqrt(radius2);
}

/// Return the largest distance of the piece to a triangle. It is at a corner: the distance to a convex set is
/// convex.
double farthestCorner(const Corners3& piece, const Corners3& triangle)
{
    return std::sqrt(std::max(
        {distance2(piece[0], triangle), distance2(piece[1], triangle), distance2(piece[2], triangle)}));
}

/// Append the two halves, cut at the longest edge.
void halve(const Piece& piece, std::vector<Piece>& pieces)
{
    const Corners3& c = piece.corners;
    size_t longest = 0;
    double longest2 = 0;
    for (size_t k = 0; k < 3; ++k)
    {
        const Double3 edge = c[(k + 1) % 3] - c[k];
        if (dot(edge, edge) > longest2)
        {
            longest = k;
            longest2 = dot(edge, edge);
        }
    }
    const Double3 p = c[longest], q = c[(longest + 1) % 3], apex = c[(longest + 2) % 3];
    const Double3 middle = (p + q) * 0.5;
    pieces.push_back({{p, middle, apex}, piece.near, piece.cut_by});
    pieces.push_back({{middle, q, apex}, piece.near, piece.cut_by});
}

using Polygon = std::vector<Double3>; ///< flat and convex

/// Cut a polygon along the line where `height`, a linear function, is 0.
template <typename Height>
void cut(const Polygon& polygon, const Height& height, Polygon& below, Polygon& above)
{
    below.clear();
    above.clear();
    for (size_t i = 0; i < polygon.size(); ++i)
    {
        const Double3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double at_p = height(p), at_q = height(q);
        if (at_p <= 0)
            below.push_back(p);
        if (at_p >= 0)
            above.push_back(p);
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
        {
            const Double3 between = p + (q - p) * (at_p / (at_p - at_q));
            below.push_back(between);
            above.push_back(between);
        }
    }
}

/// Append the triangles of a fan.
void addFan(const Polygon& polygon, TriangleId near, TriangleId cut_by, std::vector<Piece>& pieces)
{
    for (size_t i = 2; i < polygon.size(); ++i)
        pieces.push_back({{polygon[0], polygon[i - 1], polygon[i]}, near, cut_by});
}

/// Cut a piece along the border of the triangle that it lies over, perpendicular to that triangle's
/// plane. On a plane this yields the common refinement of both surfaces, where halves would never lie
/// over one triangle alone.
/// returns  false, and appends nothing, if the border does not cross the piece: between two triangles that
///          are nearly as near, such cuts would go on without end
bool cutAlong(const Piece& piece, double radius, const Corners3& border, std::vector<Piece>& pieces)
{
    const size_t first = pieces.size();
    Polygon inside(piece.corners.begin(), piece.corners.end());
    Polygon outside;
    Polygon rest;
    const Double3 normal = cross(border[1] - border[0], border[2] - border[0]);
    for (size_t k = 0; k < 3 && !inside.empty(); ++k)
    {
        const Double3 outward = cross(border[(k + 1) % 3] - border[k], normal);
        const double on_border = kOnBorder * radius * length(outward);
        const auto height = [&](Double3 p)
        {
            const double above = dot(p - border[k], outward);
            return std::abs(above) <= on_border ? 0 : above;
        };
        cut(inside, height, rest, outside);
        addFan(outside, piece.near, piece.near, pieces);
        inside.swap(rest);
    }
    addFan(inside, piece.near, piece.near, pieces);
    if (pieces.size() > first + 1)
        return true;
    pieces.resize(first);
    return false;
}

/// True if cutting along a triangle gains more than halving. A piece that is no larger than the allowed
/// distance is soon small enough.
bool worthCutting(const Piece& piece, double radius, double allowed, const Corners3& triangle)
{
    return piece.cut_by != piece.near && radius > allowed &&
           radius <= 2 * pieceRadius(triangle, pieceCenter(triangle));
}

/// Bound the distance of one triangle's points to a surface. Branch and bound: a piece is done when it lies
/// within the allowed distance of one triangle, or so close around its center that no point of it can be
/// farther; else it is cut.
///
/// known   a distance that occurs elsewhere, or that is good enough
TriangleBound boundTriangle(const Corners3& triangle, const SurfaceTree& other, double known)
{
    TriangleBound found;
    std::vector<Piece> open{{triangle}};
    for (size_t pieces = 1; !open.empty(); ++pieces)
    {
        Piece piece = open.back();
        open.pop_back();
        const Double3 center = pieceCenter(piece.corners);
        const double radius = pieceRadius(piece.corners, center);
        const double stop = std::max(0.0, kSearchSlack * std::max(known, found.sure) - radius);
        const SurfaceTree::Nearest nearest = other.nearest(center, stop * stop, piece.near);
        const double distance = std::sqrt(nearest.distance2);
        piece.near = nearest.triangle;
        // a search that stopped early only proves that the center is within the allowed distance
        if (distance > stop)
            found.sure = std::max(found.sure, distance);
        const Corners3 near = other.triangle(nearest.triangle);
        const double upper = std::min(distance + radius, farthestCorner(piece.corners, near));
        const double allowed = kSearchSlack * std::max(known, found.sure);
        const bool done = upper <= allowed;
        if (done || pieces >= kMaxPieces)
        {
            found.upper = std::max(found.upper, upper);
            found.loose_pieces += done ? 0 : 1;
        }
        else if (!worthCutting(piece, radius, allowed, near) || !cutAlong(piece, radius, near, open))
            halve(piece, open);
    }
    return found;
}

/// Return the largest distance of the surface's corners: mostly the farthest point of a surface is a corner.
double distanceOfCorners(const SurfaceView& from, const SurfaceTree& to)
{
    std::vector<VertexId> vertices(from.corners.begin(), from.corners.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<double> farthest2((vertices.size() + kRun - 1) / kRun, 0);
    tbb::parallel_for(size_t{0}, farthest2.size(),
                      [&](size_t run)
                      {
                          TriangleId near{};
                          for (size_t i = run * kRun; i < std::min(vertices.size(), (run + 1) * kRun); ++i)
                          {
                              const auto nearest =
                                  to.nearest(widen(from.positions[vertices[i]]), farthest2[run], near);
                              near = nearest.triangle;
                              farthest2[run] = std::max(farthest2[run], nearest.distance2);
                          }
                      });
    return std::sqrt(*std::max_element(farthest2.begin(), farthest2.end()));
}

/// Return the largest distance of the centers of the surface's triangles; if triangles are few, of their
/// parts.
double distanceOfCenters(const SurfaceTree& from, size_t triangle_count, const SurfaceTree& to)
{
    size_t halvings = 0;
    while (halvings < kMaxHalvings && (triangle_count << (halvings + 1)) <= kFirstPoints)
        ++halvings;
    std::vector<double> farthest2(triangle_count, 0);
    tbb::parallel_for(size_t{0}, triangle_count,
                      [&](size_t t)
                      {
                          std::vector<Piece> pieces{{from.triangle(toId<TriangleId>(t))}};
                          for (size_t i = 0; i < halvings; ++i)
                          {
                              std::vector<Piece> finer;
                              for (const Piece& piece : pieces)
                                  halve(piece, finer);
                              pieces = std::move(finer);
                          }
                          TriangleId near{};
                          for (const Piece& piece : pieces)
                          {
                              const auto nearest = to.nearest(pieceCenter(piece.corners), farthest2[t], near);
                              near = nearest.triangle;
                              farthest2[t] = std::max(farthest2[t], nearest.distance2);
                          }
                      });
    return std::sqrt(*std::max_element(farthest2.begin(), farthest2.end()));
}

/// Bound the distance of all points of one surface to the other one.
void boundOneSide(const SurfaceView& surface, const SurfaceTree& from, const SurfaceTree& to, double enough,
                  SurfaceBound& bound)
{
    const size_t triangle_count = surface.corners.triangleCount();
    bound.sure =
        std::max({bound.sure, distanceOfCorners(surface, to), distanceOfCenters(from, triangle_count, to)});
    std::vector<TriangleBound> found(std::min(triangle_count, kBlock));
    for (size_t first = 0; first < triangle_count; first += kBlock)
    {
        const size_t count = std::min(triangle_count - first, kBlock);
        const double known = std::max(enough, bound.sure);
        tbb::parallel_for(size_t{0}, count,
                          [&](size_t i) {
                              found[i] = boundTriangle(from.triangle(toId<TriangleId>(first + i)), to, known);
                          });
        for (size_t i = 0; i < count; ++i)
        {
            bound.upper = std::max(bound.upper, found[i].upper);
            bound.sure = std::max(bound.sure, found[i].sure);
            bound.loose_pieces += found[i].loose_pieces;
        }
    }
}

double largestCoordinate(const SurfaceView& surface)
{
    double largest = 0;
    for (const VertexId vertex : surface.corners)
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max(largest, std::abs(double{surface.positions[vertex][axis]}));
    return largest;
}

/// Two surfaces to be compared.
struct SurfacePair
{
    SurfacePair(const SurfaceView& a, const SurfaceView& b, double enough)
        : tree_a(checked(a)), tree_b(checked(b))
    {
        HEARTH_ASSERT(enough >= 0);
        const double coordinates = std::max(largestCoordinate(a), largestCoordinate(b));
        // smaller distances cannot be distinguished from 0 in the float positions of the surfaces
        least = std::max(enough, coordinates * 1e-6);
        rounding = coordinates * kBoundRounding;
    }

    /// Round a bound of any of both up.
    void finish(SurfaceBound& bound) const
    {
        bound.upper += rounding;
        HEARTH_ASSERT(bound.upper >= 0 && bound.sure >= 0);
    }

    static const SurfaceView& checked(const SurfaceView& surface)
    {
        HEARTH_ASSERT(!surface.corners.empty() && allBelow(surface.corners, surface.positions.size()));
        return surface;
    }

    SurfaceTree tree_a, tree_b;
    double least;
    double rounding;
};

} // namespace

SurfaceBounds boundSurfaceSides(const SurfaceView& a, const SurfaceView& b, double enough)
{
    const SurfacePair pair(a, b, enough);
    SurfaceBounds bounds;
    boundOneSide(a, pair.tree_a, pair.tree_b, pair.least, bounds.a);
    boundOneSide(b, pair.tree_b, pair.tree_a, pair.least, bounds.b);
    pair.finish(bounds.a);
    pair.finish(bounds.b);
    return bounds;
}

SurfaceBound boundSurfaces(const SurfaceView& a, const SurfaceView& b, double enough)
{
    const SurfacePair pair(a, b, enough);
    SurfaceBound bound;
    boundOneSide(a, pair.tree_a, pair.tree_b, pair.least, bound);
    boundOneSide(b, pair.tree_b, pair.tree_a, pair.least, bound);
    pair.finish(bound);
    return bound;
}

} // namespace hearth::clusters
