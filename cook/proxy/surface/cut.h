// Reads cuts of a mesh's cluster hierarchy as surfaces: the builder's levels of detail decimate a proxy.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/surface.h"
#include "formats/pack/pack_view.h"

#include <vector>

namespace hearth::proxy
{

/// Return the least error, from `error` on, whose cut has at most `max_triangles`; that of the coarsest
/// cut if none has as few.
/// part   a clusters part that checkHierarchy accepts
/// error  metres, >= 0, finite
float findCutError(const formats::PackView& part, uint32_t mesh, float error, uint64_t max_triangles);

/// Read the cut whose clusters have at most `error` (the rule is at GroupRecord), welded by position.
/// errors: those of PackView::decodePage; meaning_geometry
Result<Surface> readCut(const formats::PackView& part, uint32_t mesh, float error);

/// Vertices of a mesh's first level, cluster by cluster.
struct FinestVertices
{
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< empty if the mesh has none
};

/// errors: those of readCut
Result<FinestVertices> readFinestVertices(const formats::PackView& part, uint32_t mesh);

} // namespace hearth::proxy
