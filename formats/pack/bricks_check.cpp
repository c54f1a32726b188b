// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/gpu_shared/shading.h"
#include "formats/pack/check_tools.h"
#include "formats/pack/for_each_brick.h"

namespace hearth::formats::check
{

namespace
{

constexpr const char* kGrid = "brick grid";
constexpr const char* kGroup = "brick group";
constexpr const char* kBrick = "brick";
constexpr const char* kVoxel = "solid voxel";
constexpr const char* kFace = "brick face";

Status checkNoGrid(const PackView& view)
{
    const bool none = view.brickGroupsAlongAxis().empty() && view.bricks().empty() &&
                      view.brickOpacity().empty() && view.brickAlbedo().empty() &&
                      view.brickNormals().empty() && view.brickEmission().empty() &&
                      view.brickLighting().empty() && view.reflectors().empty();
    return none ? success()
                : makeError(view, Issue::meaning_range, kGrid, 0, "there are bricks without a grid");
}

/// Check that the counts match the tables, and are within the limits.
Status checkCounts(const PackView& view, const BrickGridRecord& grid)
{
    const struct
    {
        const char* what;
        uint32_t count;
        size_t in_table;
        uint32_t most;
    } counts[] = {
        {"groups", grid.group_count, view.brickGroupsAlongAxis().size(), kMaxBrickGroups},
        {"bricks", grid.brick_count, view.bricks().size(), kMaxBrickVoxels},
        {"opacities", grid.solid_count, view.brickOpacity().size(), kMaxBrickVoxels},
        {"albedos", grid.face_count, view.brickAlbedo().size(), kMaxBrickFaces},
        {"normals", grid.face_count, view.brickNormals().size(), kMaxBrickFaces},
        {"emissions", grid.face_count, view.brickEmission().size(), kMaxBrickFaces},
        {"lightings", grid.face_count, view.brickLighting().size(), kMaxBrickFaces},
    };
    for (const auto& count : counts)
    {
        if (count.in_table != count.count)
            return makeError(view, Issue::meaning_range, kGrid, 0,
                             "says " + std::to_string(count.count) + " " + count.what + ", there are " +
                                 std::to_string(count.in_table));
        if (count.count > count.most)
            return makeError(view, Issue::meaning_value, kGrid, 0,
                             std::to_string(count.count) + " " + count.what + ", " +
                                 std::to_string(count.most) + " at most");
    }
    return success();
}

Status checkGrid(const PackView& view, const BrickGridRecord& grid)
{
    Float3 end = grid.origin;
    for (int axis = 0; axis < 3; ++axis)
        end[axis] += grid.voxel_size * static_cast<float>(grid.voxels[axis]);
    if (!finite(grid.origin) || !finite(grid.voxel_size) || !(grid.voxel_size > 0) || !finite(end))
        return makeError(view, Issue::meaning_value, kGrid, 0,
                         "its origin or the size of its voxels is not possible");
    for (const uint32_t along : grid.voxels)
        if (along == 0 || along > kMaxGridVoxels)
            return makeError(view, Issue::meaning_value, kGrid, 0,
                             std::to_string(along) + " voxels along an axis, 1 to " +
                                 std::to_string(kMaxGridVoxels) + " are possible");
    if (grid.reserved != 0)
        return makeError(view, Issue::meaning_padding, kGrid, 0, "a reserved field is not 0");
    if (grid.group_count != brickGroupCount(grid.voxels))
        return makeError(view, Issue::meaning_value, kGrid, 0,
                         std::to_string(grid.group_count) + " groups where its voxels reach into " +
                             std::to_string(brickGroupCount(grid.voxels)));
    return checkCounts(view, grid);
}

/// Check that the bricks of the groups follow each other and cover the table.
Status checkGroups(const PackView& view)
{
    RangeCursor bricks(view, kGroup, kBrick, view.bricks().size());
    for (size_t i = 0; i < view.brickGroupsAlongAxis().size(); ++i)
    {
        const BrickGroupRecord& group = view.brickGroupsAlongAxis()[i];
        HEARTH_TRY(bricks.take(
            i, {group.first_brick, shared::maskCount(group.brick_mask_low, group.brick_mask_high)}));
    }
    return bricks.finish();
}

uint64_t wholeMask(uint32_t low, uint32_t high)
{
    return uint64_t{high} << 32 | low;
}

/// Return the mask of a brick's voxels that lie in the grid.
uint64_t gridMaskOfBrick(const BrickGridRecord& grid, VoxelCoordinates first)
{
    uint64_t mask = 0;
    for (uint32_t bit = 0; bit < 64; ++bit)
    {
        const VoxelCoordinates voxel = voxelAtBit(first, bit, 1);
        if (voxel.x < grid.voxels[0] && voxel.y < grid.voxels[1] && voxel.z < grid.voxels[2])
            mask |= uint64_t{1} << bit;
    }
    return mask;
}

class BrickCheck
{
public:
    explicit BrickCheck(const PackView& view)
        : view_(view),
          voxels_(view, kBrick, kVoxel, view.brickOpacity().size()),
          faces_(view, kBrick, kFace, view.brickAlbedo().size())
    {
    }

    Status check(uint32_t index, VoxelCoordinates first)
    {
        const BrickRecord& brick = view_.bricks()[index];
        const uint64_t solid = wholeMask(brick.voxel_mask_low, brick.voxel_mask_high);
        if (solid == 0)
            return makeError(view_, Issue::meaning_value, kBrick, index, "none of its voxels is solid");
        if ((solid & ~gridMaskOfBrick(view_.brickGrid()[0], first)) != 0)
            return makeError(view_, Issue::meaning_bounds, kBrick, index,
                             "a solid voxel lies outside the grid");
        uint32_t face_count = 0;
        for (uint32_t face = 0; face < shared::kVoxelFaces; ++face)
        {
            const uint32_t low = brick.face_masks[2 * face], high = brick.face_masks[2 * face + 1];
            if ((wholeMask(low, high) & ~solid) != 0)
                return makeError(view_, Issue::meaning_value, kBrick, index,
                                 "a voxel that is not solid has a face");
            face_count += shared::maskCount(low, high);
        }
        HEARTH_TRY(voxels_.take(
            index, {brick.first_voxel, shared::maskCount(brick.voxel_mask_low, brick.voxel_mask_high)}));
        return faces_.take(index, {brick.first_face, face_count});
    }

    Status finish() const
    {
        HEARTH_TRY(voxels_.finish());
        return faces_.finish();
    }

private:
    const PackView& view_;
    RangeCursor voxels_;
    RangeCursor faces_;
};

Status checkBrickTable(const PackView& view)
{
    BrickCheck check(view);
    Status status = success();
    forEachBrickOfGrid(view.brickGrid()[0], view.brickGroupsAlongAxis(),
                       [&](uint32_t brick, VoxelCoordinates first)
                       {
                           if (status.ok())
                               status = check.check(brick, first);
                       });
    HEARTH_TRY(std::move(status));
    return check.finish();
}

/// Check the reflectors. Parts with bricks do not have the lights.
Status checkReflectors(const PackView& view)
{
    const size_t lights = std::min<size_t>(view.lights().size(), shared::kMaxLights);
    const std::span<const ReflectorRecord> reflectors = view.reflectors();
    if (reflectors.size() > shared::kMaxLights ||
        (!reflectors.empty() && lights != 0 && reflectors.size() != lights))
        return makeError(view, Issue::meaning_range, "reflector", reflectors.size(),
                         "there are " + std::to_string(view.lights().size()) + " lights");
    for (size_t i = 0; i < reflectors.size(); ++i)
    {
        if (!shared::isLegalRadiance(reflectors[i].gain))
            return makeError(view, Issue::meaning_value, "reflector", i, "its gain is not finite");
        if (!NormalCode<8>::legal(reflectors[i].axis))
            return makeError(view, Issue::meaning_value, "reflector", i, "its axis is not a code");
    }
    return success();
}

Status checkCodes(const PackView& view)
{
    for (size_t i = 0; i < view.brickOpacity().size(); ++i)
        if (view.brickOpacity()[i] == 0)
            return makeError(view, Issue::meaning_value, kVoxel, i, "its opacity is 0");
    for (size_t i = 0; i < view.brickNormals().size(); ++i)
    {
        if (!NormalCode<8>::legal(view.brickNormals()[i]))
            return makeError(view, Issue::meaning_value, kFace, i, "its normal is not a code");
        if (!shared::isLegalRadiance(view.brickEmission()[i]))
            return makeError(view, Issue::meaning_value, kFace, i, "its emission is not finite");
        if (!shared::isLegalRadiance(view.brickLighting()[i]))
            return makeError(view, Issue::meaning_value, kFace, i, "its lighting is not finite");
    }
    return success();
}

} // namespace

Status checkBrickTables(const PackView& view)
{
    if (view.brickGrid().empty())
        return checkNoGrid(view);
    if (view.brickGrid().size() > 1)
        return makeError(view, Issue::meaning_value, kGrid, 1, "a pack has one at most");
    HEARTH_TRY(checkGrid(view, view.brickGrid()[0]));
    HEARTH_TRY(checkGroups(view));
    HEARTH_TRY(checkReflectors(view));
    HEARTH_TRY(checkBrickTable(view));
    return checkCodes(view);
}

} // namespace hearth::formats::check
