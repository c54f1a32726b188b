// Surface samples of meshes for tests of the visibility fit; the same on every machine.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "cook/visibility/mesh/surface_sample.h"

#include <cstdint>
#include <vector>

namespace hearth::test
{

inline visibility::MeshView makeMeshView(const mesh::SourceMesh& mesh)
{
    return {mesh.positions, mesh.normals, mesh.indices};
}

/// Return `per_triangle` samples on each triangle, uniform at random; each weighs its share of the triangle's
/// area.
std::vector<visibility::SurfaceSample> makeSamples(const visibility::MeshView& mesh, uint32_t per_triangle,
                                                   uint32_t seed = 1);

/// Return the position of a sample.
Float3 getPoint(const visibility::MeshView& mesh, const visibility::SurfaceSample& sample);

} // namespace hearth::test
