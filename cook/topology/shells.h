// Shells: pieces of a surface that hang together by edges of two triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/edges.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hearth::topology
{

enum class ShellSide : uint8_t
{
    open,    ///< it bounds no volume, so that no side is outside
    outward, ///< its triangles face outwards
    cavity,  ///< they face inwards, within a solid: the wall of a hollow
    flipped, ///< they face inwards, and no solid is around it
    flat,    ///< closed, but without volume, as a leaf of two sides
    unclear, ///< closed, but one-sided as Klein's bottle
};

struct Shell
{
    uint32_t triangles = 0;
    uint32_t first_triangle = 0;   ///< of the surface: the lowest of the shell
    bool is_closed = true;         ///< every edge has two of its triangles
    bool is_orientable = true;     ///< false: one-sided, as Moebius' strip
    uint32_t reversed = 0;         ///< triangles that face the other side than most of the shell
    uint32_t doubled = 0;          ///< triangles that have a copy
    std::optional<uint32_t> genus; ///< handles; of closed orientable shells
    double area = 0;
    double volume = 0; ///< of closed orientable shells, by the side that most triangles face
    ShellSide side = ShellSide::open;
    Box3 box;
};

struct Shells
{
    std::vector<Shell> shells; ///< in the order of their first triangles
    std::vector<uint32_t> shell_of_triangle;
    /// By triangle: whether it faces the other side than most of its shell. Meaningless for one-sided
    /// shells, where it is false.
    std::vector<bool> is_reversed;
};

/// Find the shells. Solids that share an edge or a corner are several shells. Time about linear.
Shells findShells(const Surface& surface, const Edges& edges);

/// Return the number of pieces that share no vertex.
uint32_t countComponents(const Surface& surface);

} // namespace hearth::topology
