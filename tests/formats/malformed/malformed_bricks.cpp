// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <limits>

namespace hearth::test
{

const std::vector<MalformedPack>& malformedBricks()
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    static const std::vector<MalformedPack> list = {
        {"bricksWithoutGrid", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { p.brick_grids.clear(); }},
        {"brickFacesWithoutGrid", Issue::meaning_range, "brick grid 0",
         [](PackModel& p)
         {
             p.brick_grids.clear();
             p.bricks = {};
             p.bricks.lighting.push_back(0);
         }},
        {"brickGridTwice", Issue::meaning_value, "brick grid 1",
         [](PackModel& p) { p.brick_grids.push_back(p.brick_grids[0]); }},
        {"brickOriginNaN", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].origin.y = kNaN; }},
        {"brickVoxelSizeZero", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxel_size = 0; }},
        {"brickVoxelSizeNegative", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxel_size = -1; }},
        {"brickVoxelSizeInfinite", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxel_size = kInfinity; }},
        {"brickGridEndsAtInfinity", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxel_size = 1e38f; }},
        {"brickVoxelsNone", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxels[1] = 0; }},
        {"brickVoxelsTooMany", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxels[2] = formats::kMaxGridVoxels + 1; }},
        {"brickGridReserved", Issue::meaning_padding, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].reserved = 1; }},
        {"brickGroupsOfAnotherGrid", Issue::meaning_value, "brick grid 0",
         [](PackModel& p) { p.brick_grids[0].voxels[0] = 33; }},
        {"brickGroupCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { p.bricks.groups.pop_back(); }},
        {"brickCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { ++p.brick_grids[0].brick_count; }},
        {"brickSolidCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { --p.brick_grids[0].solid_count; }},
        {"brickAlbedoCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { p.bricks.albedo.push_back(0); }},
        {"brickNormalCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { p.bricks.normals.pop_back(); }},
        {"brickEmissionCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { p.bricks.emission.clear(); }},
        {"brickLightingCount", Issue::meaning_range, "brick grid 0",
         [](PackModel& p) { p.bricks.lighting.push_back(0); }},
        {"brickGroupOverlaps", Issue::meaning_order, "brick group 1",
         [](PackModel& p) { p.bricks.groups[1].first_brick = 1; }},
        {"brickGroupBeyond", Issue::meaning_range, "brick group 1",
         [](PackModel& p) { p.bricks.groups[1].brick_mask_high = ~0u; }},
        {"brickOfNoGroup", Issue::meaning_range, "brick 2",
         [](PackModel& p) { p.bricks.groups[1].brick_mask_low = p.bricks.groups[1].brick_mask_high = 0; }},
        {"brickEmpty", Issue::meaning_value, "brick 1",
         [](PackModel& p) { p.bricks.bricks[1].voxel_mask_high = 0; }},
        {"brickVoxelBeyondGrid", Issue::meaning_bounds, "brick 2",
         [](PackModel& p) { p.bricks.bricks[2].voxel_mask_high <<= 1; }},
        {"brickWhollyBeyondGrid", Issue::meaning_bounds, "brick 2",
         [](PackModel& p) { p.bricks.groups[1].brick_mask_low <<= 1; }},
        {"brickFaceOfNoVoxel", Issue::meaning_value, "brick 0",
         [](PackModel& p) { p.bricks.bricks[0].face_masks[6] |= 1; }},
        {"brickVoxelsOverlap", Issue::meaning_order, "brick 1",
         [](PackModel& p) { p.bricks.bricks[1].first_voxel = 1; }},
        {"brickVoxelsBeyond", Issue::meaning_range, "brick 2",
         [](PackModel& p) { p.bricks.bricks[2].first_voxel = 4; }},
        {"brickVoxelOfNoBrick", Issue::meaning_range, "solid voxel 4",
         [](PackModel& p)
         {
             p.bricks.opacity.push_back(1);
             ++p.brick_grids[0].solid_count;
         }},
        {"brickFacesOverlap", Issue::meaning_order, "brick 1",
         [](PackModel& p) { p.bricks.bricks[1].first_face = 0; }},
        {"brickFaceLeftOut", Issue::meaning_order, "brick 1",
         [](PackModel& p) { p.bricks.bricks[0].face_masks[11] = 0; }},
        {"brickFaceOfNoBrick", Issue::meaning_range, "brick face 21",
         [](PackModel& p) { p.bricks.bricks[2].face_masks[11] = 0; }},
        {"brickOpacityZero", Issue::meaning_value, "solid voxel 1",
         [](PackModel& p) { p.bricks.opacity[1] = 0; }},
        {"brickNormalNoCode", Issue::meaning_value, "brick face 5",
         [](PackModel& p) { p.bricks.normals[5] = 0x80; }},
        {"brickEmissionInfinite", Issue::meaning_value, "brick face 4",
         [](PackModel& p) { p.bricks.emission[4] = 31u << 6; }},
        {"brickLightingNaN", Issue::meaning_value, "brick face 21",
         [](PackModel& p) { p.bricks.lighting[21] = 31u << 27 | 1u << 22; }},
        {"reflectorCount", Issue::meaning_range, "reflector 2",
         [](PackModel& p) { p.bricks.reflectors.pop_back(); }},
        {"reflectorInfinite", Issue::meaning_value, "reflector 1",
         [](PackModel& p) { p.bricks.reflectors[1].gain = 31u << 6; }},
        {"reflectorAxisNoCode", Issue::meaning_value, "reflector 1",
         [](PackModel& p) { p.bricks.reflectors[1].axis = 0x80; }},
        {"reflectorsWithoutGrid", Issue::meaning_range, "brick grid 0",
         [](PackModel& p)
         {
             const auto reflectors = p.bricks.reflectors;
             p.bricks = {};
             p.brick_grids.clear();
             p.bricks.reflectors = reflectors;
         }},
    };
    return list;
}

} // namespace hearth::test
