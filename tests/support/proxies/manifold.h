// Plain counting of manifolds: shares nothing with the code that makes them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hearth::test
{

/// Return what keeps triangles from being a manifold with a consistent orientation, closed or with a
/// boundary; empty if nothing does: each directed edge once, each vertex with one fan of triangles.
/// triangles  three indices below vertex_count for each
std::string findManifoldDefect(size_t vertex_count, std::span<const uint32_t> triangles);

/// Count the directed edges that no triangle passes in the other direction.
size_t countOpenEdges(std::span<const uint32_t> triangles);

} // namespace hearth::test
