// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/convex/decompose.h"

#include "cook/mesh/interior_edges.h"
#include "cook/proxy/convex/lattice.h"
#include "cook/proxy/convex/piece.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

namespace hearth::proxy
{

namespace
{

// Half the thickness that sheets and lines are given, in steps: about a thousandth of the longest side.
constexpr int32_t kHalfThickness = 128;

// The cost of a hull is its volume and its area times this many steps, a two-hundredth of the longest side:
// sheets have a cost then, and a cut of a convex piece saves nothing.
constexpr double kAreaThickness = 1024;

// Planes that are tried in each piece: along each axis, and along the planes of its strongest folds.
constexpr int kPlanesOfAxis = 7;
constexpr size_t kMaxFolds = 16;

// Folds with less than this sine do not count: curved surfaces are full of them.
constexpr double kMinFoldSine = 0.1;

// The search cuts into up to this many times the wanted parts, and then joins them.
constexpr uint32_t kPartsToJoin = 2;

// Rounds of cutting and joining, at most: what is joined makes room for more cuts.
constexpr int kMaxRounds = 4;

// Bounds of distances during the search, over the error that is wanted.
constexpr double kEnoughOfError = 0.25;

double findCost(const Hull& hull)
{
    return findVolume(hull) + kAreaThickness * findArea(hull);
}

/// Return the hull of points; one without volume is made thicker.
Hull makeSolidHull(const std::vector<LatticePoint>& points)
{
    Hull hull = makeHull(points);
    if (!hull.triangles.empty())
        return hull;
    std::vector<LatticePoint> thick;
    constexpr int32_t kHalf = kHalfThickness;
    for (const auto& [x, y, z] : points)
        thick.insert(thick.end(), {{x - kHalf, y, z},
                                   {x + kHalf, y, z},
                                   {x, y - kHalf, z},
                                   {x, y + kHalf, z},
                                   {x, y, z - kHalf},
                                   {x, y, z + kHalf}});
    return makeHull(thick);
}

/// Piece of the surface and its hull.
struct Part
{
    Piece piece;
    Hull hull;
    double cost = 0;
    double distance = 0;   ///< bound of how far the hull reaches from the solid, metres
    bool is_final = false; ///< no plane cuts it
};

class Decomposition
{
public:
    Decomposition(const Solid& solid, const ConvexSettings& settings)
        : solid_(solid),
          surface_(solid.surface()),
          settings_(settings),
          lattice_(surface_),
          error_(settings.error * double{findDiagonal(surface_)}),
          enough_(std::max(error_ * kEnoughOfError, lattice_.step()))
    {
    }

    std::vector<Part> run()
    {
        for (Piece& piece : makeShells())
            parts_.push_back(makePart(std::move(piece)));
        measureFrom(0);
        for (int round = 0; round < kMaxRounds; ++round)
        {
            while (parts_.size() < size_t{kPartsToJoin} * settings_.max_parts && cutFarthest())
            {
            }
            if (!joinParts(JoinRule::within_error))
                break;
        }
        joinParts(JoinRule::to_max_parts);
        return std::move(parts_);
    }

    const Lattice& lattice() const { return lattice_; }

    std::vector<std::array<Float3, 3>> toTriangles(const Hull& hull) const
    {
        std::vector<std::array<Float3, 3>> triangles;
        for (const auto& [a, b, c] : hull.triangles)
            triangles.push_back({lattice_.toPosition(hull.points[a]), lattice_.toPosition(hull.points[b]),
                                 lattice_.toPosition(hull.points[c])});
        return triangles;
    }

private:
    /// Return a piece for each shell; one for all of them if they are many more than parts.
    std::vector<Piece> makeShells() const
    {
        const std::vector<uint32_t>& shells = solid_.shells().of_triangle;
        std::map<uint32_t, Piece> pieces; // by the first triangle
        for (uint32_t t = 0; t < surface_.triangleCount(); ++t)
        {
            std::array<Double3, 3> polygon;
            std::ranges::transform(surface_.corners(t), polygon.begin(),
                                   [&](Float3 corner) { return lattice_.fromPosition(corner); });
            pieces[shells[t]].addPolygon(polygon, surface_.materials[t]);
        }
        for (const auto& [triangle, edge] : findFolds())
            pieces[shells[triangle]].edges.push_back(edge);
        std::vector<Piece> list;
        for (auto& [first, piece] : pieces)
            list.push_back(std::move(piece));
        if (list.size() <= size_t{kPartsToJoin} * settings_.max_parts)
            return list;
        for (size_t i = 1; i < list.size(); ++i)
            append(list[0], list[i]);
        list.resize(1);
        return list;
    }

    static void append(Piece& piece, const Piece& other)
    {
        const auto first = static_cast<uint32_t>(piece.corners.size());
        piece.corners.insert(piece.corners.end(), other.corners.begin(), other.corners.end());
        for (const uint32_t end : other.ends)
            piece.ends.push_back(first + end);
        piece.materials.insert(piece.materials.end(), other.materials.begin(), other.materials.end());
        piece.edges.insert(piece.edges.end(), other.edges.begin(), other.edges.end());
    }

    /// Return edges at which closed shells are not convex, and open ones are folded, each with one of its
    /// triangles.
    std::vector<std::pair<uint32_t, FoldedEdge>> findFolds() const
    {
        const std::vector<bool>& is_closed = solid_.shells().is_closed;
        const auto place = [&](uint32_t vertex) { return lattice_.fromPosition(surface_.positions[vertex]); };
        const auto findPlane = [&](uint32_t triangle) -> Plane
        {
            const uint32_t* corner = &surface_.indices[3 * size_t{triangle}];
            const Double3 a = place(corner[0]);
            const Double3 vector = cross(place(corner[1]) - a, place(corner[2]) - a);
            const double size = length(vector);
            const Double3 normal = size > 0 ? vector * (1 / size) : Double3{};
            return {normal, dot(normal, a)};
        };
        std::vector<std::pair<uint32_t, FoldedEdge>> folds;
        for (const mesh::InteriorEdge& edge :
             mesh::findInteriorEdges(surface_.indices, surface_.positions.size()))
        {
            const Double3 a = place(edge.a), b = place(edge.b);
            const std::array<Plane, 2> planes{findPlane(edge.triangles[0]), findPlane(edge.triangles[1])};
            const double sine = length(cross(planes[0].normal, planes[1].normal));
            const bool is_concave = dot(planes[0].normal, place(edge.l)) > planes[0].offset;
            const bool is_of_sheet = !is_closed[edge.triangles[0]];
            if (sine > kMinFoldSine && (is_concave || is_of_sheet))
                folds.push_back(
                    {edge.triangles[0], {(a + b) * 0.5, planes, sine * length(b - a), is_of_sheet}});
        }
        return folds;
    }

    static Part makePart(Piece piece)
    {
        Part part;
        part.hull = makeSolidHull(collectLatticePoints(piece));
        part.cost = findCost(part.hull);
        part.piece = std::move(piece);
        return part;
    }

    bool reachesTooFar(const Hull& hull) const
    {
        return solid_.boundDistance(toTriangles(hull), enough_, error_) > error_;
    }

    double measure(const Hull& hull) const { return solid_.boundDistance(toTriangles(hull), enough_); }

    void measureFrom(size_t first)
    {
        tbb::parallel_for(first, parts_.size(),
                          [&](size_t i) { parts_[i].distance = measure(parts_[i].hull); });
    }

    /// Cut the part that reaches farthest from the solid; false if none reaches too far, or can be cut.
    bool cutFarthest()
    {
        Part* farthest = nullptr;
        for (Part& part : parts_)
            if (!part.is_final && part.distance > error_ &&
                (farthest == nullptr || part.distance > farthest->distance))
                farthest = &part;
        if (farthest == nullptr)
            return false;
        const std::optional<Plane> plane = findBestPlane(farthest->piece);
        if (!plane)
        {
            farthest->is_final = true;
            return true;
        }
        CutPiece cut = cutPiece(farthest->piece, *plane);
        *farthest = makePart(std::move(cut.below));
        farthest->distance = measure(farthest->hull);
        parts_.push_back(makePart(std::move(cut.above)));
        measureFrom(parts_.size() - 1);
        return true;
    }

    /// Return the plane whose two hulls cost least; nothing if no plane has parts of the piece on both sides.
    std::optional<Plane> findBestPlane(const Piece& piece) const
    {
        const std::vector<Plane> planes = collectPlanes(piece);
        constexpr double kCutsNothing = std::numeric_limits<double>::infinity();
        std::vector<double> costs(planes.size(), kCutsNothing);
        tbb::parallel_for(size_t{0}, planes.size(),
                          [&](size_t i)
                          {
                              const CutPiece cut = cutPiece(piece, planes[i]);
                              if (!cut.below.ends.empty() && !cut.above.ends.empty())
                                  costs[i] = findCost(makeSolidHull(collectLatticePoints(cut.below))) +
                                             findCost(makeSolidHull(collectLatticePoints(cut.above)));
                          });
        const auto least = std::ranges::min_element(costs);
        if (least == costs.end() || *least == kCutsNothing)
            return std::nullopt;
        return planes[static_cast<size_t>(least - costs.begin())];
    }

    static std::vector<Plane> collectPlanes(const Piece& piece)
    {
        std::vector<Plane> planes;
        constexpr std::array<Double3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (const Double3 axis : kAxes)
        {
            const auto [low, high] =
                std::ranges::minmax(piece.corners, {}, [&](Double3 corner) { return dot(corner, axis); });
            const double from = dot(low, axis), size = dot(high, axis) - from;
            // from the middle outwards: of planes that cost the same the first is taken
            for (int i = 0; i < kPlanesOfAxis; ++i)
            {
                const int steps = (kPlanesOfAxis + 1) / 2 + (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
                planes.push_back({axis, std::round(from + size * steps / (kPlanesOfAxis + 1))});
            }
        }
        std::vector<FoldedEdge> folds = piece.edges;
        std::ranges::stable_sort(folds, std::ranges::greater{}, &FoldedEdge::weight);
        folds.resize(std::min(folds.size(), kMaxFolds));
        for (const FoldedEdge& edge : folds)
            for (const Plane& plane : edge.planes)
            {
                planes.push_back(plane);
                if (edge.is_of_sheet) // the other triangle may be on either side
                {
                    planes.push_back({plane.normal, plane.offset, FacesInPlane::go_above});
                    planes.push_back({plane.normal * -1.0, -plane.offset, FacesInPlane::go_above});
                }
            }
        return planes;
    }

    /// Two parts, by number, and the cost of joining them.
    struct Pair
    {
        size_t first = 0, second = 0;
        double added_cost = 0;
        Hull hull = {};
    };

    Pair makePair(size_t first, size_t second) const
    {
        std::vector<LatticePoint> points = parts_[first].hull.points;
        const std::vector<LatticePoint>& others = parts_[second].hull.points;
        points.insert(points.end(), others.begin(), others.end());
        Pair pair{.first = first, .second = second, .hull = makeHull(points)};
        pair.added_cost = findCost(pair.hull) - parts_[first].cost - parts_[second].cost;
        return pair;
    }

    enum class JoinRule
    {
        within_error, ///< join parts whose common hull reaches no farther from the solid than is wanted
        to_max_parts, ///< join parts while there are too many
    };

    /// Join pairs of parts, always those whose common hull adds the least cost. Return whether any were
    /// joined.
    bool joinParts(JoinRule rule)
    {
        std::vector<Pair> pairs;
        for (size_t a = 0; a < parts_.size(); ++a)
            for (size_t b = a + 1; b < parts_.size(); ++b)
                pairs.push_back({.first = a, .second = b});
        makePairs(pairs);
        std::vector<bool> is_joined(parts_.size(), false);
        size_t count = parts_.size();
        while (!pairs.empty() && (rule == JoinRule::within_error || count > settings_.max_parts))
        {
            const auto least = std::ranges::min_element(pairs, {}, &Pair::added_cost);
            if (rule == JoinRule::within_error && reachesTooFar(least->hull))
            {
                *least = std::move(pairs.back());
                pairs.pop_back();
                continue;
            }
            const size_t first = least->first, second = least->second;
            parts_[first].hull = std::move(least->hull);
            parts_[first].cost = findCost(parts_[first].hull);
            append(parts_[first].piece, parts_[second].piece);
            is_joined[second] = true;
            --count;
            std::erase_if(pairs,
                          [&](const Pair& pair) { return pair.first == second || pair.second == second; });
            renewPairs(pairs, first);
        }
        if (count == parts_.size())
            return false;
        std::vector<Part> left;
        for (size_t i = 0; i < parts_.size(); ++i)
            if (!is_joined[i])
                left.push_back(std::move(parts_[i]));
        parts_ = std::move(left);
        measureFrom(0);
        return true;
    }

    void makePairs(std::vector<Pair>& pairs) const
    {
        tbb::parallel_for(size_t{0}, pairs.size(),
                          [&](size_t i) { pairs[i] = makePair(pairs[i].first, pairs[i].second); });
    }

    /// Make the pairs of a part that has grown anew.
    void renewPairs(std::vector<Pair>& pairs, size_t part) const
    {
        tbb::parallel_for(size_t{0}, pairs.size(),
                          [&](size_t i)
                          {
                              if (pairs[i].first == part || pairs[i].second == part)
                                  pairs[i] = makePair(pairs[i].first, pairs[i].second);
                          });
    }

    const Solid& solid_;
    const Surface& surface_;
    const ConvexSettings& settings_;
    Lattice lattice_;
    double error_;  ///< metres
    double enough_; ///< metres
    std::vector<Part> parts_;
};

/// Return a hull with at most kMaxPartVertices that holds the given one: that of the farthest vertices, grown
/// about its middle until it holds all.
Hull limitVertices(const Hull& hull)
{
    if (hull.points.size() <= kMaxPartVertices)
        return hull;
    const Hull coarse = makeHull(hull.points, kMaxPartVertices);
    Double3 middle;
    const auto toPlace = [](LatticePoint p) { return Double3{double(p.x), double(p.y), double(p.z)}; };
    for (const LatticePoint point : coarse.points)
        middle = middle + toPlace(point) * (1 / static_cast<double>(coarse.points.size()));
    for (double scale = 1.001;; scale *= 1.005)
    {
        std::vector<LatticePoint> grown;
        for (const LatticePoint point : coarse.points)
            grown.push_back(roundToLattice(middle + (toPlace(point) - middle) * scale));
        Hull result = makeHull(grown);
        if (std::ranges::all_of(hull.points, [&](LatticePoint point) { return holds(result, point); }))
            return result;
    }
}

/// Return the material with the greatest area.
uint32_t findMaterial(const Piece& piece)
{
    std::map<uint32_t, double> areas;
    uint32_t first = 0;
    for (size_t p = 0; p < piece.ends.size(); ++p)
    {
        Double3 vector;
        for (uint32_t i = first + 2; i < piece.ends[p]; ++i)
            vector = vector + cross(piece.corners[i - 1] - piece.corners[first],
                                    piece.corners[i] - piece.corners[first]);
        areas[piece.materials[p]] += length(vector);
        first = piece.ends[p];
    }
    return std::ranges::max_element(areas, {}, [](const auto& entry) { return entry.second; })->first;
}

} // namespace

ConvexParts decompose(const Solid& solid, const ConvexSettings& settings)
{
    HEARTH_RUNTIME_ASSERT(settings.max_parts > 0);
    Decomposition decomposition(solid, settings);
    const std::vector<Part> parts = decomposition.run();
    const Lattice& lattice = decomposition.lattice();
    ConvexParts result;
    std::vector<std::array<Float3, 3>> triangles;
    for (const Part& part : parts)
    {
        const Hull hull = limitVertices(part.hull);
        const auto first = static_cast<uint32_t>(result.surface.positions.size());
        for (const LatticePoint point : hull.points)
            result.surface.positions.push_back(lattice.toPosition(point));
        const uint32_t material = findMaterial(part.piece);
        for (const auto& [a, b, c] : hull.triangles)
            result.surface.add({first + a, first + b, first + c}, material);
        result.ends.push_back(static_cast<uint32_t>(result.surface.triangleCount()));
    }
    for (size_t t = 0; t < result.surface.triangleCount(); ++t)
        triangles.push_back(result.surface.corners(t));
    const double enough =
        std::max(settings.error * 0.05 * double{findDiagonal(solid.surface())}, lattice.step());
    result.distance = solid.boundDistance(triangles, enough);
    // corners of pieces are rounded to half a step along each axis
    result.surface_distance = lattice.step();
    return result;
}

} // namespace hearth::proxy
