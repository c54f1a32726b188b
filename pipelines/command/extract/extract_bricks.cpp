// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_bricks.h"

#include "formats/base/atomic_file.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/pack/for_each_brick.h"
#include "pipelines/command/extract/open_pack.h"

#include <fmt/format.h>

#include <iterator>

namespace hearth::command
{

using namespace formats;

namespace
{

void appendPoint(std::string& text, Float3 p)
{
    fmt::format_to(std::back_inserter(text), ",{:.7g},{:.7g},{:.7g}", p.x, p.y, p.z);
}

void appendRow(std::string& text, const PackView& file, VoxelCoordinates voxel, uint32_t face,
               uint32_t face_index, uint8_t opacity)
{
    const bool none = face_index == shared::kNoFace;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.7g}", voxel.x, voxel.y, voxel.z,
                   voxelFaceName(face), opacity / 255.0);
    appendPoint(text, none ? Float3{} : shared::decodeAlbedo(file.brickAlbedo()[face_index]));
    appendPoint(text, none ? Float3{} : shared::decodeFaceNormal(file.brickNormals()[face_index]));
    appendPoint(text, none ? Float3{} : shared::decodeRadiance(file.brickEmission()[face_index]));
    appendPoint(text, none ? Float3{} : shared::decodeRadiance(file.brickLighting()[face_index]));
    text += '\n';
}

void appendVoxel(std::string& text, const PackView& file, const BrickRecord& brick, uint32_t bit,
                 VoxelCoordinates voxel)
{
    const uint8_t opacity = file.brickOpacity()[shared::brickVoxel(brick, bit)];
    bool has_face = false;
    for (uint32_t face = 0; face < shared::kVoxelFaces; ++face)
    {
        const uint32_t index = shared::brickFace(brick, bit, face);
        if (index == shared::kNoFace)
            continue;
        appendRow(text, file, voxel, face, index, opacity);
        has_face = true;
    }
    if (!has_face)
        appendRow(text, file, voxel, shared::kNoFace, shared::kNoFace, opacity);
}

} // namespace

Status extractBricks(const std::string& path, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    if (file.brickGrid().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkBrickGrid, 0), "the file has no bricks"};
    HEARTH_ASSIGN_OR_RETURN(AtomicFile csv, AtomicFile::create(output));
    csv.write(
        "x,y,z,face,opacity,albedo_r,albedo_g,albedo_b,normal_x,normal_y,normal_z,emissive_r,emissive_g,"
        "emissive_b,lighting_r,lighting_g,lighting_b\n");
    std::string text;
    forEachBrickOfGrid(file.brickGrid()[0], file.brickGroupsAlongAxis(),
                       [&](uint32_t index, VoxelCoordinates first)
                       {
                           const BrickRecord& brick = file.bricks()[index];
                           text.clear();
                           for (uint32_t bit = 0; bit < 64; ++bit)
                               if (shared::maskHas(brick.voxel_mask_low, brick.voxel_mask_high, bit))
                                   appendVoxel(text, file, brick, bit, voxelAtBit(first, bit, 1));
                           csv.write(text);
                       });
    return csv.finish();
}

} // namespace hearth::command
