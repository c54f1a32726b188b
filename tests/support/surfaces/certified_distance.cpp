// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/surfaces/certified_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <vector>

namespace hearth
{

namespace
{

/// Point with its distance to the surface, and the triangle of the surface that is nearest.
struct Probe
{
    Float3 place;
    double distance = 0;
    uint32_t triangle = 0;
};

/// Part of a triangle, with a bound of the distances of all its points.
struct Piece
{
    std::array<Probe, 3> corners;
    double upper = 0;

    bool operator<(const Piece& b) const { return upper < b.upper; }
};

class OneSidedSearch
{
public:
    OneSidedSearch(const SurfaceDistance& to, const DistanceSearch& search)
        : to_(to), search_(search), lower_(search.known)
    {
    }

    DistanceBounds run(std::span<const Float3> positions, std::span<const uint32_t> triangles)
    {
        std::vector<std::optional<Probe>> probes(positions.size());
        for (const uint32_t corner : triangles)
            if (!probes[corner])
                probes[corner] = probe(positions[corner]);
        for (size_t t = 0; t < triangles.size(); t += 3)
            add({{*probes[triangles[t]], *probes[triangles[t + 1]], *probes[triangles[t + 2]]}});
        size_t pieces = 0;
        while (!queue_.empty() && queue_.top().upper > enough() && pieces++ < search_.max_pieces)
        {
            const Piece piece = queue_.top();
            queue_.pop();
            halve(piece);
        }
        return {lower_, std::max(queue_.empty() ? 0.0 : queue_.top().upper, enough())};
    }

private:
    double enough() const { return lower_ * (1 + search_.relative) + search_.absolute; }

    Probe probe(Float3 place)
    {
        const SurfaceDistance::Nearest nearest = to_.nearest(place);
        lower_ = std::max(lower_, nearest.distance);
        return {place, nearest.distance, nearest.point.triangle};
    }

    /// The distance to one triangle is convex, so it is largest at a corner of the piece. The distance to the
    /// surface grows from a point by at most the way.
    double bound(const Piece& piece)
    {
        const auto& [a, b, c] = piece.corners;
        const auto toOne = [&](uint32_t triangle)
        {
            double farthest = 0;
            for (const Probe& corner : piece.corners)
                farthest = std::max(farthest, to_.toTriangle(corner.place, triangle));
            return farthest;
        };
        double upper = std::min({toOne(a.triangle), toOne(b.triangle), toOne(c.triangle)});
        if (upper <= enough())
            return upper;
        const Probe middle = probe(a.place / 3.0f + b.place / 3.0f + c.place / 3.0f);
        double radius = 0;
        for (const Probe& corner : piece.corners)
            radius = std::max(radius, double{length(corner.place - middle.place)});
        return std::min({upper, toOne(middle.triangle), middle.distance + radius});
    }

    void add(Piece piece)
    {
        piece.upper = bound(piece);
        if (piece.upper > enough())
            queue_.push(piece);
    }

    /// Cut a piece at the middle of its longest edge.
    void halve(const Piece& piece)
    {
        const auto edge = [&](size_t k)
        { return length(piece.corners[(k + 1) % 3].place - piece.corners[k].place); };
        const size_t longest = edge(0) >= std::max(edge(1), edge(2)) ? 0 : edge(1) >= edge(2) ? 1 : 2;
        const Probe &p = piece.corners[longest], &q = piece.corners[(longest + 1) % 3],
                    &apex = piece.corners[(longest + 2) % 3];
        const Probe middle = probe(p.place * 0.5f + q.place * 0.5f);
        add({{p, middle, apex}});
        add({{middle, q, apex}});
    }

    const SurfaceDistance& to_;
    DistanceSearch search_;
    double lower_;                     ///< some point is as far, or what is known
    std::priority_queue<Piece> queue_; ///< pieces that may be farther than enough
};

} // namespace

DistanceBounds certifyOneSided(std::span<const Float3> positions, std::span<const uint32_t> triangles,
                               const SurfaceDistance& to, const DistanceSearch& search)
{
    return OneSidedSearch(to, search).run(positions, triangles);
}

DistanceBounds certifyDistance(const TriangleSurface& a, const TriangleSurface& b,
                               const DistanceSearch& search)
{
    const DistanceBounds one =
        certifyOneSided(a.positions, a.triangles, SurfaceDistance(b.positions, b.triangles), search);
    DistanceSearch other = search;
    other.known = std::max(search.known, one.lower);
    const DistanceBounds two =
        certifyOneSided(b.positions, b.triangles, SurfaceDistance(a.positions, a.triangles), other);
    return {std::max(one.lower, two.lower), std::max(one.upper, two.upper)};
}

} // namespace hearth
