// Marches packets of rays side by side on the CPU. Finds the same as brickMarch of
// formats/gpu_shared/brick_march.h, with the same bits, in half of the time. See cook/bricks/README.md, "Ray
// marching", for the reasons and measurements.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/brick_march.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::bricks
{

/// Masks of a grid in a layout where finding a voxel needs no bit counting: 4 to 16 bytes a group, and 512
/// for each group that has bricks.
class MarchTable
{
public:
    /// Build the table. The tables of `bricks` must outlive it.
    explicit MarchTable(const shared::BrickMasks& bricks);

    const shared::BrickMasks& bricks() const { return bricks_; }

    /// Result of groupAt for groups without bricks.
    static constexpr uint32_t kEmptyGroup = 0;

    /// Return the index of the first of the 64 brick masks of a group, in bit order.
    /// place  of group (x, y, z): x | y << shiftY() | z << shiftZ()
    uint32_t groupAt(uint32_t place) const { return groups_[place]; }
    int shiftY() const { return shift_y_; }
    int shiftZ() const { return shift_z_; }

    /// Return the solid voxels of a brick as a mask: 0 where there is no brick, and in kEmptyGroup.
    /// place  groupAt + bit of the brick in its group
    uint64_t voxelsAt(uint32_t place) const { return voxels_[place]; }

private:
    shared::BrickMasks bricks_;
    int shift_y_;
    int shift_z_;
    std::vector<uint32_t> groups_;
    std::vector<uint64_t> voxels_;
};

/// March each ray as brickMarch does. For rays that end in no solid voxel only `inside`, `t`, `face` and
/// `steps` are the same; the other members are meaningless in both.
///
/// rays  as brickRay, brickRayInVoxels or brickSkipVoxel leave them; 256 at once take little more than half
///       of the time of brickMarch, 64 two thirds
void marchRays(const MarchTable& table, std::span<shared::BrickRay> rays);

} // namespace hearth::bricks
