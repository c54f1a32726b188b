// Connectivity of a group while it is simplified: triangles, stars (triangles around a position), half-edge
// collapses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Neighbour of a position, with the half-edges between them.
struct Spoke
{
    PositionId position;
    uint32_t out_count = 0; ///< triangles with the half-edge center -> position
    uint32_t in_count = 0;  ///< triangles with the half-edge position -> center
    WedgeMove out{};        ///< wedges of center and position in the last of these triangles
    WedgeMove in{};

    bool regular(uint32_t layers) const { return out_count == layers && in_count == layers; }
    /// True if two wedges of the center have an edge along the spoke: it is a seam.
    bool onSeam() const { return out_count > 0 && in_count > 0 && out.from != in.from; }
    uint32_t triangleCount() const { return out_count + in_count; }
};

/// Neighbour of a position in a plain fan, with the neighbour's wedge.
struct FanEnd
{
    PositionId position;
    WedgeId wedge;
};

/// Corner in a StarMesh: corner k of triangle t is 4 t + k, so steps around a triangle need no division.
enum class StarCorner : uint32_t
{
};

constexpr TriangleId cornerTriangle(StarCorner corner)
{
    return TriangleId{toIndex(corner) >> 2};
}
constexpr StarCorner nextCorner(StarCorner corner)
{
    const uint32_t number = toIndex(corner);
    return StarCorner{(number & 3) == 2 ? number - 2 : number + 1};
}
constexpr StarCorner previousCorner(StarCorner corner)
{
    const uint32_t number = toIndex(corner);
    return StarCorner{(number & 3) == 0 ? number + 2 : number - 1};
}

/// Triangle mesh with stars for half-edge collapses.
class StarMesh
{
public:
    explicit StarMesh(const GroupMesh& group);

    size_t aliveCount() const { return alive_count_; }

    /// Return the remaining triangles, ascending.
    IdVector<TriangleId, TriangleId> aliveTriangles() const;

    static std::array<StarCorner, 3> triangleCorners(TriangleId triangle)
    {
        const uint32_t first = toIndex(triangle) * 4;
        return {StarCorner{first}, StarCorner{first + 1}, StarCorner{first + 2}};
    }
    PositionId positionIdAt(StarCorner corner) const { return position_id_of_corner_[corner]; }
    WedgeId wedgeAt(StarCorner corner) const { return wedge_of_corner_[corner]; }

    /// Return the number of triangles around a position.
    uint32_t degree(PositionId position) const { return stars_[position].alive; }

    /// Return the corners, at the position, of the triangles around it.
    std::span<const StarCorner> star(PositionId position);

    /// Collect the fan of a position if it is plain: closed, manifold (each edge between two triangles of
    /// opposite direction), without seams at the position or along its edges. Most are, and this is faster
    /// than the ring. False if it is not plain.
    bool gatherFan(PositionId center);
    bool plain() const { return fan_size_ != 0; } ///< true if a fan is gathered, not a ring
    std::span<const FanEnd> fan() const { return std::span(fan_).first(fan_size_); }
    WedgeId fanWedge() const { return fan_wedge_; }

    /// Collect the ring of a position: its neighbours, each once, and the wedges of its triangles there.
    void gather(PositionId center);
    std::span<const Spoke> ring() const { return ring_; }
    std::span<const WedgeId> wedges() const { return wedges_; }

    /// Return the gathered spoke to a position, or nullptr.
    const Spoke* spokeTo(PositionId position) const
    {
        const uint32_t place = mark_[position] - mark_value_;
        return place < ring_.size() ? &ring_[place] : nullptr;
    }

    /// Return the gathered end at a position, or nullptr.
    const FanEnd* endAt(PositionId position) const
    {
        const uint32_t place = mark_[position] - mark_value_;
        return place < fan_size_ ? &fan_[place] : nullptr;
    }

    /// Return the number of coincident sheets around the gathered position: 1 except for triangles that the
    /// source has twice.
    uint32_t layers() const { return layers_; }

    /// True if collapsing the gathered position along the spoke would leave an end without triangles.
    bool emptiesStar(PositionId center, const Spoke& spoke) const
    {
        return spoke.triangleCount() == degree(center) || spoke.triangleCount() == degree(spoke.position);
    }

    /// True if the gathered position can collapse to another without joining sheets (link condition), without
    /// a triangle coinciding with another, and without emptying a star.
    bool satisfiesLinkCondition(PositionId from, PositionId to);

    /// Collapse a position: triangles with both positions are removed; triangles with `from` alone get `to`
    /// and its wedges.
    void collapse(PositionId from, PositionId to, std::span<const WedgeMove> moves);

    void remove(TriangleId triangle);

private:
    bool satisfiesLinkConditionInFan(PositionId from, PositionId to);

    struct Star
    {
        uint32_t first = 0;
        uint32_t count = 0; ///< including removed triangles
        uint32_t alive = 0;
    };

    bool has(TriangleId triangle, PositionId position) const
    {
        const PositionId* at = position_id_of_corner_.data() + size_t{toIndex(triangle)} * 4;
        const bool first = at[0] == position, second = at[1] == position, third = at[2] == position;
        return first | second | third;
    }
    void clearGathered();
    bool gathered(PositionId position) const
    {
        return mark_[position] - mark_value_ < ring_.size() + fan_size_;
    }
    bool isTip(PositionId position) const
    {
        return std::find(tips_.begin(), tips_.end(), position) != tips_.end();
    }

    IdVector<StarCorner, PositionId> position_id_of_corner_;
    IdVector<StarCorner, WedgeId> wedge_of_corner_;
    IdVector<TriangleId, uint8_t> alive_; ///< 1 or 0
    size_t alive_count_;
    IdVector<PositionId, Star> stars_; ///< ranges of star_items_, which may include removed triangles
    std::vector<StarCorner> star_items_;

    IdVector<WedgeId, uint64_t> hash_of_wedge_;
    std::vector<FanEnd> fan_; ///< of the gathered position, or ring_; larger than needed
    uint32_t fan_size_ = 0;
    WedgeId fan_wedge_{};
    std::vector<Spoke> ring_;
    std::vector<WedgeId> wedges_;
    uint32_t layers_ = 1;
    /// mark_value_ + index in fan_ or ring_, for the positions in it.
    IdVector<PositionId, uint32_t> mark_;
    uint32_t mark_value_ = 0;
    std::vector<PositionId> tips_;
    std::vector<TriangleId> removed_; ///< triangles that a collapse removes
};

} // namespace hearth::clusters
