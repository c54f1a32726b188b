// Output of the scan readers (OBJ, PLY, STL, OFF, Draco): polygons as the file lists them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <string>
#include <vector>

namespace hearth::import
{

struct ScanSource
{
    std::span<const std::byte> bytes;
    const std::string& path;
    const ImportLimits& limits;

    std::string_view text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// Message for the user about a file that is read nevertheless.
struct ScanNote
{
    Issue issue;
    std::string where;
    std::string detail;
};

/// Polygons as in the file. Corners index positions, and may index normals and UVs of their own; all indices
/// are in range (kInvalidIndex: the corner has none) and all positions are finite.
struct ScanPolygons
{
    std::vector<Float3> positions;
    std::vector<Float4> colors;  ///< for each position, linear RGBA; or empty
    std::vector<Float3> normals; ///< any length, zero where the file has none
    std::vector<Float2> uvs;     ///< v runs from the top down

    std::vector<uint32_t> corner_positions;
    std::vector<uint32_t> corner_normals; ///< empty: normals belong to the positions
    std::vector<uint32_t> corner_uvs;     ///< empty: UVs belong to the positions
    /// end of the corners of each face, which start at the end of the previous face
    std::vector<uint32_t> face_ends;
    std::vector<uint32_t> face_materials; ///< for each face, an index into material_names or none; or empty

    std::vector<std::string> material_names;
    std::vector<std::string> material_libraries; ///< MTL files
    std::string texture_file;                    ///< base colour texture of the whole mesh (PLY)
    uint64_t vertex_count = 0;                   ///< as the file counts vertices
    std::vector<ScanNote> notes;

    void note(Issue issue, std::string where, std::string detail)
    {
        notes.push_back({issue, std::move(where), std::move(detail)});
    }
};

Result<ScanPolygons> readObj(const ScanSource& source);
Result<ScanPolygons> readPly(const ScanSource& source);
Result<ScanPolygons> readStl(const ScanSource& source);
Result<ScanPolygons> readOff(const ScanSource& source);
Result<ScanPolygons> readDrc(const ScanSource& source);

/// Convert a colour of a scan, stored as sRGB as cameras and screens have it, to linear light.
Float4 linearColor(float red, float green, float blue, float alpha);

/// Triangulate the polygons and give every distinct corner a vertex. Vertices that no triangle uses are
/// dropped. Normals are unit vectors; a normal that is missing in a file that has others is the mean of the
/// triangles around it.
mesh::SourceMesh meshFromScan(ScanPolygons&& scan);

/// Add node 0 and instance 0 of mesh 0, at the origin.
void addOnlyInstance(const std::string& name, PartBuilder& part);

} // namespace hearth::import
