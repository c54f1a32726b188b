// Finds proxies that an artist made: nodes or meshes called X_PROXY or UCX_X, or marked in their extras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/lods.h"
#include "pipelines/import/part/part_proxies.h"

#include <map>
#include <vector>

namespace hearth::import
{

/// Mesh that is a proxy of another one, or a part of it, with the transform of a node.
struct GltfProxyPiece
{
    uint32_t mesh = kInvalidIndex;
    uint32_t node = kInvalidIndex; ///< kInvalidIndex: no node has it, and it lies in the mesh's own space
    bool is_convex = false;
};

/// Pieces of the proxies of a mesh, in the order of the file, from the first node that has any.
struct GltfProxy
{
    uint32_t node = kInvalidIndex; ///< has the mesh that they stand for
    std::vector<GltfProxyPiece> pieces;
    std::vector<const FileProxies*> files; ///< in place of the pieces, if there are any
};

struct GltfProxies
{
    std::map<uint32_t, GltfProxy> of_mesh; ///< by the mesh that they stand for
    std::vector<bool> hidden;              ///< nodes that are proxies: not drawn, but those below them are
    std::vector<bool> proxy_only;          ///< meshes that no drawn node has, but a proxy
};

/// Find all proxies. A node stands for the mesh whose name it has: of the node above it, beside it, or
/// anywhere; by name of the node, or else of its mesh. One that is marked in its extras stands for the mesh
/// of the node above it, whatever its name, or for the only mesh of the file. What is called a proxy of no
/// mesh is drawn, what is marked as one is not; both get a warning. Proxies from files
/// are of the node or mesh that they name, or of the only mesh.
/// errors: usage where there is no such mesh
Result<GltfProxies> findProxies(const GltfModel& model, const GltfLods& lods, const GltfContext& context);

} // namespace hearth::import
