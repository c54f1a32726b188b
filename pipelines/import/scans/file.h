// What the readers of scans (OBJ, PLY, STL, OFF, Draco) deliver: polygons as the file lists them.
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

/// Something that the user should know although the file is read.
struct ScanNote
{
    Issue issue;
    std::string where;
    std::string detail;
};

/// Polygons as the file has them. Corners name positions, and may name normals and UVs of their own; all indices are
/// in range (formats::kNone: the corner has none) and all positions are finite.
struct ScanFile
{
    std::vector<Float3> positions;
    std::vector<Float4> colors;  ///< of each position, linear RGBA; or empty
    std::vector<Float3> normals; ///< any length, zero where the file has none
    std::vector<Float2> uvs;     ///< v from the top down

    std::vector<uint32_t> corner_positions;
    std::vector<uint32_t> corner_normals; ///< empty: normals belong to the positions
    std::vector<uint32_t> corner_uvs;     ///< empty: UVs belong to the positions
    std::vector<uint32_t>
        face_ends; ///< for each face the end of its corners, which start where the last ended
    std::vector<uint32_t> face_materials; ///< of each face, an index into material_names or none; or empty

    std::vector<std::string> material_names;
    std::vector<std::string> material_libraries; ///< MTL files
    std::string texture_file;                    ///< base colour of everything (PLY)
    uint64_t vertex_count = 0;                   ///< as the file counts them
    std::vector<ScanNote> notes;

    void note(Issue issue, std::string where, std::string detail)
    {
        notes.push_back({issue, std::move(where), std::move(detail)});
    }
};

Result<ScanFile> readObj(const ScanSource& source);
Result<ScanFile> readPly(const ScanSource& source);
Result<ScanFile> readStl(const ScanSource& source);
Result<ScanFile> readOff(const ScanSource& source);
Result<ScanFile> readDrc(const ScanSource& source);

/// The colour of a scan, stored as cameras and screens have it (sRGB), as linear light.
Float4 linearColor(float red, float green, float blue, float alpha);

/// Triangulate the polygons and give every distinct corner a vertex. Vertices that no triangle uses are dropped.
/// Normals are unit; those that the file lacks while it has others are the mean of the triangles around them.
mesh::SourceMesh meshFromScan(ScanFile&& scan);

/// Node 0 and instance 0 of mesh 0, at the origin.
void addOnlyInstance(const std::string& name, PartBuilder& part);

} // namespace hearth::import
