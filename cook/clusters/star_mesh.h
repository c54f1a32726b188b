// The connectivity of a group while it is simplified: triangles, the stars of positions, half-edge collapses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/group_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Where a wedge of a position that is removed goes.
struct WedgeMove
{
    uint32_t from;
    uint32_t to;
};

/// A neighbour of a position and how the triangles between them run.
struct Spoke
{
    uint32_t position;
    uint32_t out_count = 0; ///< triangles with the edge center -> position
    uint32_t in_count = 0;  ///< triangles with the edge position -> center
    WedgeMove out{};        ///< wedges of center and position in the last of each
    WedgeMove in{};

    bool regular(uint32_t layers) const { return out_count == layers && in_count == layers; }
};

class StarMesh
{
public:
    explicit StarMesh(const GroupMesh& group);

    struct Triangle
    {
        std::array<uint32_t, 3> position;
        std::array<uint32_t, 3> wedge;

        bool has(uint32_t p) const { return position[0] == p || position[1] == p || position[2] == p; }
        size_t cornerAt(uint32_t p) const { return position[0] == p ? 0 : position[1] == p ? 1 : 2; }
    };

    size_t triangleLimit() const { return triangles_.size(); }
    const Triangle& triangle(uint32_t t) const { return triangles_[t]; }
    bool alive(uint32_t t) const { return alive_[t] != 0; }
    size_t aliveCount() const { return alive_count_; }

    /// The triangles around a position, without those that are gone.
    std::span<const uint32_t> star(uint32_t position);

    /// Collect the ring of a position: its neighbours, each once, and the wedges that its triangles use there.
    void gather(uint32_t center);
    std::span<const Spoke> ring() const { return ring_; }
    std::span<const uint32_t> wedges() const { return wedges_; }

    /// The gathered spoke to a position, or nullptr.
    const Spoke* spokeTo(uint32_t position) const
    {
        const uint32_t place = mark_[position] - mark_value_;
        return place < ring_.size() && ring_[place].position == position ? &ring_[place] : nullptr;
    }

    /// How many sheets lie on each other around the gathered position: 1 but for faces that the source has twice.
    uint32_t layers() const;

    /// Whether the gathered position can go to another without gluing sheets together (link condition), without a
    /// triangle falling onto another, and without emptying a star.
    bool linkHolds(uint32_t from, uint32_t to);

    /// Triangles with both positions go; those with `from` alone get `to` and its wedges.
    void collapse(uint32_t from, uint32_t to, std::span<const WedgeMove> moves);

    void remove(uint32_t triangle);

private:
    struct Star
    {
        uint32_t first = 0;
        uint32_t count = 0;
    };

    std::vector<Triangle> triangles_;
    std::vector<uint8_t> alive_;
    size_t alive_count_;
    std::vector<Star> stars_; ///< pieces of star_items_, which may name triangles that are gone
    std::vector<uint32_t> star_items_;

    std::vector<Spoke> ring_;
    std::vector<uint32_t> wedges_;
    std::vector<uint32_t> mark_; ///< mark_value_ + place in ring_, for the positions in it
    uint32_t mark_value_ = 0;
    std::vector<uint32_t> tips_;
};

} // namespace hearth::clusters
