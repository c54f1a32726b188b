// The readers behind hearth-import, one for each family of source formats.
// Every reader treats its bytes as hostile: it checks counts against what is there before it allocates or reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/read_list.h"
#include "pipelines/import/file_bytes.h"
#include "pipelines/import/part_builder.h"

#include <span>
#include <string>

namespace hearth::import
{

/// Limits that keep a hostile file from taking the machine; generous for real assets.
struct ImportLimits
{
    uint64_t max_file_bytes = uint64_t{8} << 30;
    uint64_t max_vertices = uint64_t{1} << 28;     ///< of one mesh
    uint64_t max_triangles = uint64_t{1} << 28;    ///< of one mesh
    uint64_t max_image_texels = uint64_t{1} << 26; ///< 8192 x 8192: what a mobile GPU can use
    uint32_t max_image_size = 16384;
    uint64_t max_instances = uint64_t{1} << 20;
};

struct ImportOptions
{
    ImportLimits limits;
    float crease_angle_rad = 1.0471976f; ///< 60 degrees: sharper edges of a mesh without normals stay hard
    tools::ReadList* reads = nullptr;    ///< notes the files that are read; null: nobody asks
};

/// glTF 2.0 and GLB, with what they refer to in the same folder or below.
Status importGltf(const std::string& path, const FileBytes& file, const ImportOptions& options,
                  PartBuilder& part);

/// OBJ (+ MTL), PLY, STL, OFF, and bare Draco (.drc): one mesh, one node, one instance.
Status importScan(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                  PartBuilder& part);

/// A lone image becomes an unlit card, one metre high, so that it can be cooked and looked at by itself.
Status importImage(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                   PartBuilder& part);

/// Decode PNG, JPEG, WebP, TGA, BMP, HDR, EXR or KTX2 by content. `name` stands in messages.
/// errors: image_malformed, image_unsupported, input_too_large.
Result<DecodedImage> decodeImage(std::span<const std::byte> bytes, const std::string& name,
                                 const ImportLimits& limits);

/// Whether the bytes start as one of the image formats that decodeImage knows, whatever their state.
bool looksLikeImage(const std::string& path, std::span<const std::byte> bytes);

/// Fill in what the source leaves out: area-weighted smooth normals with a crease angle (vertices are split where
/// needed, all attributes, influences and morph targets with them; vertices that no triangle uses are left out).
void generateNormals(mesh::SourceMesh& mesh, float crease_angle_rad);

/// Tangents from UV set `uv_set`, whose v runs down the image, for a mesh that has normals (asserted); vertices are
/// split where the UVs are mirrored.
void generateTangents(mesh::SourceMesh& mesh, uint32_t uv_set);

} // namespace hearth::import
