// Wraps a mesh: a closed surface around all its triangles, whose guarantees are checked after rounding.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "cook/wrap/cgal_wrap.h"

namespace hearth::wrap
{

/// Fractions of the diagonal of a mesh's box, so that one setting suits meshes of all sizes, and bounds the
/// time and the triangles of each.
struct WrapOptions
{
    double alpha = 1 / 50.;   ///< radius of the largest hole that is closed, and size of triangles
    double offset = 1 / 600.; ///< distance from the source
    /// Distance that decimation may move the wrap, which lies half as far more away for it. 0: none.
    double error = 1 / 500.;
    /// Triangles to decimate to, if need be farther away: at up to 16 times the offset. A wrap that needs
    /// more to be one has more.
    uint64_t triangles = UINT64_MAX;
    double max_seconds = 600; ///< processor time for each mesh

    bool decimates() const { return error > 0 || triangles != UINT64_MAX; }
};

/// Return the triangles that have an area, without copies of earlier ones; positions that are equal have one
/// index, and all are used.
/// numbers  if not null: gets the number of each triangle in the mesh
Surface makeSurface(const mesh::SourceMesh& mesh, std::vector<uint32_t>* numbers = nullptr);

/// Wrap the mesh in its bind pose. The result is watertight, does not intersect itself, and lies around
/// every triangle of the source that has an area, without touching it: in the stored floats, not only before
/// they are rounded, and decimated as far as it stays so. It has positions, triangles, and for each the
/// material of the source's nearest triangle. It has no triangle if the source has none with an area.
/// errors: wrap_failed, naming `file`, the mesh and the remedy
Result<mesh::SourceMesh> wrapMesh(const mesh::SourceMesh& source, const WrapOptions& options,
                                  const std::string& file, uint32_t mesh_index);

/// Name a mesh in messages.
std::string meshText(uint32_t mesh_index, const std::string& name);

} // namespace hearth::wrap
