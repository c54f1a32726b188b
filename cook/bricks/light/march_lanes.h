// Marches many rays side by side on the CPU: what brickMarch of formats/gpu_shared/brick_march.h finds, to the same bits, in half
// of the time. cook/bricks/README.md, "The march", says why and has what was measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/brick_march.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::bricks
{

/// The masks of a grid, laid out so that no bits are counted on the way to a voxel: 4 to 16 bytes a group, and 512 for each
/// group that has bricks.
class MarchTable
{
public:
    /// The tables of `bricks` must outlive it.
    explicit MarchTable(const shared::BrickMasks& bricks);

    const shared::BrickMasks& bricks() const { return bricks_; }

    /// What groupAt says of groups without bricks.
    static constexpr uint32_t kEmptyGroup = 0;

    /// Where the masks of a group's 64 places for bricks begin, in the order of their bits.
    /// place  of group (x, y, z): x | y << shiftY() | z << shiftZ()
    uint32_t groupAt(uint32_t place) const { return groups_[place]; }
    int shiftY() const { return shift_y_; }
    int shiftZ() const { return shift_z_; }

    /// The solid voxels of a place for a brick: none where there is no brick, nor in kEmptyGroup.
    /// place  groupAt + bit of the brick in its group
    uint64_t voxelsAt(uint32_t place) const { return voxels_[place]; }

private:
    shared::BrickMasks bricks_;
    int shift_y_;
    int shift_z_;
    std::vector<uint32_t> groups_;
    std::vector<uint64_t> voxels_;
};

/// Each ray becomes what brickMarch makes of it. Of rays that end in no solid voxel `inside`, `t`, `face` and `steps` alone are
/// the same; their other numbers mean nothing there either.
///
/// rays  as brickRay, brickRayInVoxels or brickPass leave them; 256 at once take little more than half of the time of
///       brickMarch, 64 two thirds
void marchRays(const MarchTable& table, std::span<shared::BrickRay> rays);

} // namespace hearth::bricks
