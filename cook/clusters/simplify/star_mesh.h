// The connectivity of a group while it is simplified: triangles, the stars of positions, half-edge collapses.
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

/// A neighbour of a position and how the triangles between them run.
struct Spoke
{
    uint32_t position;
    uint32_t out_count = 0; ///< triangles with the edge center -> position
    uint32_t in_count = 0;  ///< triangles with the edge position -> center
    WedgeMove out{};        ///< wedges of center and position in the last of each
    WedgeMove in{};

    bool regular(uint32_t layers) const { return out_count == layers && in_count == layers; }
    /// Whether two wedges of the center have a way along it.
    bool onSeam() const { return out_count > 0 && in_count > 0 && out.from != in.from; }
    uint32_t triangleCount() const { return out_count + in_count; }
};

/// A neighbour of a position in a plain fan, and its wedge there.
struct FanEnd
{
    uint32_t position;
    uint32_t wedge;
};

/// A corner k of triangle t is named 4 t + k: steps around a triangle then need no division.
using Corner = uint32_t;

inline uint32_t triangleOf(Corner corner)
{
    return corner >> 2;
}
inline Corner nextCorner(Corner corner)
{
    return (corner & 3) == 2 ? corner - 2 : corner + 1;
}
inline Corner previousCorner(Corner corner)
{
    return (corner & 3) == 0 ? corner + 2 : corner - 1;
}

class StarMesh
{
public:
    explicit StarMesh(const GroupMesh& group);

    size_t triangleLimit() const { return alive_.size(); }
    bool alive(uint32_t triangle) const { return alive_[triangle] != 0; }
    size_t aliveCount() const { return alive_count_; }
    std::vector<uint32_t> aliveTriangles() const;

    static std::array<Corner, 3> cornersOf(uint32_t triangle)
    {
        return {triangle * 4, triangle * 4 + 1, triangle * 4 + 2};
    }
    uint32_t positionAt(Corner corner) const { return position_of_corner_[corner]; }
    uint32_t wedgeAt(Corner corner) const { return wedge_of_corner_[corner]; }

    /// How many triangles are around a position.
    uint32_t degree(uint32_t position) const { return stars_[position].alive; }

    /// Their corners at the position.
    std::span<const Corner> star(uint32_t position);

    /// Collect the fan of a position, if it is plain: closed, each edge between two triangles that run against each
    /// other, no seam at the position or along its edges. Most are, and this is faster than the ring.
    bool gatherFan(uint32_t center);
    bool plain() const { return fan_size_ != 0; } ///< whether a fan is gathered, not a ring
    std::span<const FanEnd> fan() const { return std::span(fan_).first(fan_size_); }
    uint32_t fanWedge() const { return fan_wedge_; }

    /// Collect the ring of a position: its neighbours, each once, and the wedges that its triangles use there.
    void gather(uint32_t center);
    std::span<const Spoke> ring() const { return ring_; }
    std::span<const uint32_t> wedges() const { return wedges_; }

    /// The gathered spoke to a position, or nullptr.
    const Spoke* spokeTo(uint32_t position) const
    {
        const uint32_t place = mark_[position] - mark_value_;
        return place < ring_.size() ? &ring_[place] : nullptr;
    }

    /// The gathered end at a position, or nullptr.
    const FanEnd* endAt(uint32_t position) const
    {
        const uint32_t place = mark_[position] - mark_value_;
        return place < fan_size_ ? &fan_[place] : nullptr;
    }

    /// How many sheets lie on each other around the gathered position: 1 but for faces that the source has twice.
    uint32_t layers() const { return layers_; }

    /// Whether a collapse of the gathered position along the spoke would leave an end without triangles.
    bool emptiesStar(uint32_t center, const Spoke& spoke) const
    {
        return spoke.triangleCount() == degree(center) || spoke.triangleCount() == degree(spoke.position);
    }

    /// Whether the gathered position can go to another without gluing sheets together (link condition), without a
    /// triangle falling onto another, and without emptying a star.
    bool linkHolds(uint32_t from, uint32_t to);

    /// Triangles with both positions go; those with `from` alone get `to` and its wedges.
    void collapse(uint32_t from, uint32_t to, std::span<const WedgeMove> moves);

    void remove(uint32_t triangle);

private:
    bool linkHoldsInFan(uint32_t from, uint32_t to);

    struct Star
    {
        uint32_t first = 0;
        uint32_t count = 0; ///< with triangles that are gone
        uint32_t alive = 0;
    };

    bool has(uint32_t triangle, uint32_t position) const
    {
        const uint32_t* at = &position_of_corner_[size_t{triangle} * 4];
        const bool first = at[0] == position, second = at[1] == position, third = at[2] == position;
        return first | second | third;
    }
    void clearGathered();
    bool gathered(uint32_t position) const
    {
        return mark_[position] - mark_value_ < ring_.size() + fan_size_;
    }
    bool isTip(uint32_t position) const
    {
        return std::find(tips_.begin(), tips_.end(), position) != tips_.end();
    }

    std::vector<uint32_t> position_of_corner_;
    std::vector<uint32_t> wedge_of_corner_;
    std::vector<uint8_t> alive_; ///< for each triangle, 1 or 0
    size_t alive_count_;
    std::vector<Star> stars_; ///< pieces of star_items_, which may name triangles that are gone
    std::vector<Corner> star_items_;

    std::vector<uint64_t> hash_of_wedge_;
    std::vector<FanEnd> fan_; ///< of the gathered position, or ring_; with room for more
    uint32_t fan_size_ = 0;
    uint32_t fan_wedge_ = 0;
    std::vector<Spoke> ring_;
    std::vector<uint32_t> wedges_;
    uint32_t layers_ = 1;
    std::vector<uint32_t> mark_; ///< mark_value_ + place in fan_ or ring_, for the positions in it
    uint32_t mark_value_ = 0;
    std::vector<uint32_t> tips_;
    std::vector<uint32_t> removed_; ///< triangles of a collapse
};

} // namespace hearth::clusters
