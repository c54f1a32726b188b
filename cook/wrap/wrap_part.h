// Wraps the meshes of an import part into a part of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/wrap/wrap_mesh.h"

namespace hearth::wrap
{

struct WrapStatistics
{
    std::string name;
    uint32_t source_triangles = 0;
    uint32_t triangles = 0; ///< 0: no triangle of the source has an area
    double seconds = 0;     ///< processor time; 0: it has the wrap of an earlier mesh
};

/// Wrap each mesh (chunk SMSH) of an import part, and write them as chunks SMSH of the same numbers. Meshes
/// with the same positions and triangles are wrapped once; the wrap of a mesh for which the part has a proxy
/// is empty. The bytes do not depend on the number of threads.
/// returns  statistics for each mesh. errors: those of openPart, readSourceMesh, wrapMesh and ContainerWriter
Result<std::vector<WrapStatistics>> wrapPart(const std::string& import_path, const std::string& output_path,
                                             const WrapOptions& options);

/// Read the meshes of an import part and find in each the triangles that intersect.
/// returns  JSON text: {"meshes": [{"mesh": 0, "name": "...", "intersecting_triangle_pairs": 1, "pairs":
///          [[a, b]]}]}, of a mesh at most the first 1000 pairs
/// errors: those of openPart and readSourceMesh; input_too_large if all together takes more than max_seconds
/// of processor time
Result<std::string> describeSelfIntersections(const std::string& import_path, double max_seconds);

} // namespace hearth::wrap
