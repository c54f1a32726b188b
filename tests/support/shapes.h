// Procedural meshes for tests and benchmarks of the cookers; the same on every machine.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <cstdint>

namespace hearth::shapes
{

/// Sphere of 12 * n * n triangles (a cube of six n x n charts, projected to a sphere) with ridged noise,
/// smooth normals and a UV chart for each side. Closed by position, with seams between the charts. Roughness
/// 0 is a plain sphere.
mesh::SourceMesh rock(uint32_t n, float roughness, uint32_t seed = 1);

/// n x n quads of a height field, open at its border, with normals and UVs.
mesh::SourceMesh terrain(uint32_t n, uint32_t seed = 1);

/// `count` loose quads of two triangles each, spread through a ball.
mesh::SourceMesh foliage(uint32_t count, uint32_t seed = 1);

/// Cube of 12 * n * n triangles whose faces carry blocks of two heights. Every block has its own flat normals
/// and UV chart. Closed by position, with split vertices along every step.
mesh::SourceMesh blocks(uint32_t n);

/// n x n flat quads in a square of side 1.
mesh::SourceMesh grid(uint32_t n);

/// Triangles between random points of a set of `point_count`: non-manifold, self-intersecting.
mesh::SourceMesh tangle(uint32_t point_count, uint32_t triangle_count, uint32_t seed = 1);

/// Unconnected triangles (no shared vertices).
mesh::SourceMesh soup(uint32_t triangle_count, uint32_t seed = 1);

/// Moebius strip of `segments` x `width` quads: one side, one border, not orientable.
mesh::SourceMesh moebius(uint32_t segments, uint32_t width);

/// Append a second mesh to the first. Attributes that one of them lacks are dropped.
void append(mesh::SourceMesh& mesh, const mesh::SourceMesh& other);

} // namespace hearth::shapes
