// Topology of triangle soups on a lattice, by plain searches: the reference of cook/topology.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hearth::reference
{

using LatticePoint = std::array<int, 3>;
using LatticeTriangle = std::array<LatticePoint, 3>;

struct ShellFacts
{
    size_t triangles = 0;
    bool is_closed = false;
    bool is_orientable = false;
    size_t reversed = 0;
    std::optional<int> genus;
    std::optional<double> volume;

    friend auto operator<=>(const ShellFacts&, const ShellFacts&) = default;
};

struct LoopFacts
{
    double length = 0;
    size_t edges = 0;
    bool is_closed = false;

    friend auto operator<=>(const LoopFacts&, const LoopFacts&) = default;
};

struct TopologyFacts
{
    size_t zero_area = 0;
    size_t doubled = 0;
    size_t opposite_doubled = 0;
    size_t components = 0;
    size_t non_manifold_edges = 0;
    size_t inconsistent_edges = 0;
    std::vector<std::pair<LatticePoint, size_t>> non_manifold_vertices; ///< with their fans, sorted
    std::vector<LoopFacts> loops;                                       ///< sorted
    std::vector<ShellFacts> shells;                                     ///< sorted
    size_t t_junctions = 0;
    size_t open_t_junctions = 0;
};

/// Search the facts. Time O(n^2) and more.
TopologyFacts findTopology(const std::vector<LatticeTriangle>& soup);

} // namespace hearth::reference
