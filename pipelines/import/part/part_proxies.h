// Adds proxies that an artist made to an import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// Mesh of the source that is a proxy of another one, or a part of it.
struct ProxyPiece
{
    mesh::SourceMesh mesh; ///< in the object space of the mesh that it stands for, in its bind pose
    bool is_convex = false;
    std::string where; ///< JSON pointer or file name, for warnings
};

/// Piece of a proxy from a file, which has materials of its own.
struct FileProxyPiece : ProxyPiece
{
    std::vector<std::string> material_names; ///< of the numbers in mesh.triangle_materials
};

/// Proxies of one mesh from a file, in the space in which both files are drawn.
struct FileProxies
{
    std::string mesh; ///< name of the mesh or of its node; empty: the only mesh
    std::string file; ///< as it was named
    std::string word; ///< of the command line, for errors
    std::vector<FileProxyPiece> pieces;
};

/// Return the piece with the source's materials of the same names; a material that the source lacks is
/// unknown.
/// names  of the source's materials; of equal ones the first counts
ProxyPiece matchMaterials(std::span<const std::string_view> names, FileProxyPiece piece);

/// Return the error for proxies of which nobody knows for which mesh they are.
/// names  of meshes of the source
Error findNoMeshError(const FileProxies& proxies, std::span<const std::string> names);

/// Add the proxies of a mesh: one of all pieces that need not be convex, welded, with a section for each
/// material; and one of all convex pieces, each welded, with a section for each. Triangles without area are
/// dropped. A piece that should be convex and is not gets a warning, and a section that is not.
/// mesh       number in the part; those of several calls ascend
/// of         the mesh itself
void addProxies(uint32_t mesh, const mesh::SourceMesh& of, std::span<const ProxyPiece> pieces,
                PartBuilder& part);

} // namespace hearth::import
