// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/march_lanes.h"

#include "cook/bricks/grid/brick_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::bricks
{

using namespace shared;

namespace
{

/// Rays side by side: enough to hide latency, few enough for the first-level cache.
constexpr uint32_t kLanes = 16;

/// Number of active rays below which marching one after the other is faster.
constexpr uint32_t kMinActiveLanes = 6;

/// One coordinate of all rays. Rays that move down are mirrored at 0: the voxel is ~voxel and floats change
/// their sign, so all rays move up. Results have the same bits except for that sign.
struct Axis
{
    alignas(64) float start[kLanes];
    float direction[kLanes];
    float inverse[kLanes];
    int32_t voxel[kLanes];
    int32_t mirror[kLanes]; ///< -1: mirrored, 0: not

    void setRay(uint32_t lane, float ray_start, float ray_direction, float ray_inverse, int ray_voxel)
    {
        const bool up = ray_inverse > 0;
        start[lane] = up ? ray_start : -ray_start;
        direction[lane] = std::abs(ray_direction);
        inverse[lane] = std::abs(ray_inverse);
        mirror[lane] = up ? 0 : -1;
        voxel[lane] = ray_voxel ^ mirror[lane];
    }

    int32_t voxelIn(uint32_t lane) const { return voxel[lane] ^ mirror[lane]; }
};

/// Rays in flight with their state. A lane whose ray has ended rests until it gets another ray.
class Lanes
{
public:
    Lanes(const MarchTable& table, std::span<BrickRay> rays) : table_(table), rays_(rays) {}

    void march()
    {
        for (uint32_t lane = 0; lane < kLanes; ++lane)
            next(lane);
        while (active_count_ >= kMinActiveLanes)
        {
            classifyVoxels();
            stepRays();
            for (uint32_t lane = 0; lane < kLanes; ++lane)
                if (ended_[lane] != 0)
                {
                    storeRay(lane);
                    next(lane);
                }
        }
        for (uint32_t lane = 0; lane < kLanes; ++lane)
            if (idle_[lane] == 0)
            {
                storeRay(lane);
                rays_[ray_[lane]] = brickMarch(table_.bricks(), rays_[ray_[lane]]);
            }
    }

private:
    /// Give a lane the next ray that is inside the grid, or let it rest.
    void next(uint32_t lane)
    {
        while (next_ < rays_.size() && rays_[next_].inside == 0)
            ++next_;
        idle_[lane] = next_ < rays_.size() ? 0 : -1;
        if (next_ == rays_.size())
        {
            // reset, because the lane's last ray may have left the grid
            x_.voxel[lane] = x_.mirror[lane] = 0;
            y_.voxel[lane] = y_.mirror[lane] = 0;
            z_.voxel[lane] = z_.mirror[lane] = 0;
            return;
        }
        const BrickRay& ray = rays_[next_];
        x_.setRay(lane, ray.start.x, ray.direction.x, ray.inverse.x, ray.x);
        y_.setRay(lane, ray.start.y, ray.direction.y, ray.inverse.y, ray.y);
        z_.setRay(lane, ray.start.z, ray.direction.z, ray.inverse.z, ray.z);
        t_[lane] = ray.t;
        end_[lane] = ray.end;
        axis_[lane] = ray.face == kNoFace ? -1 : static_cast<int32_t>(ray.face >> 1);
        steps_[lane] = ray.steps;
        ray_[lane] = next_++;
        ++active_count_;
    }

    /// Find the size of the empty cell around each ray's voxel, or that the voxel is solid.
    void classifyVoxels()
    {
        for (uint32_t lane = 0; lane < kLanes; ++lane)
        {
            const auto x = static_cast<uint32_t>(x_.voxelIn(lane));
            const auto y = static_cast<uint32_t>(y_.voxelIn(lane));
            const auto z = static_cast<uint32_t>(z_.voxelIn(lane));
            group_[lane] = x >> 4 | y >> 4 << table_.shiftY() | z >> 4 << table_.shiftZ();
            brick_bit_[lane] = brickBit(x >> 2, y >> 2, z >> 2);
            voxel_bit_[lane] = brickBit(x, y, z);
        }
        for (uint32_t lane = 0; lane < kLanes; ++lane)
        {
            const uint32_t group = table_.groupAt(group_[lane]);
            const uint64_t voxels = table_.voxelsAt(group + brick_bit_[lane]);
            edge_[lane] = group == MarchTable::kEmptyGroup ? 16 : voxels == 0 ? 4 : 1;
            solid_[lane] = -static_cast<int32_t>(voxels >> voxel_bit_[lane] & 1);
        }
    }

    /// Step as brickLeaveCell and updateBrickVoxel do. Catching up after each step, instead of when it
    /// matters, does not change the result: a position along a ray never moves back, not by rounding either.
    void stepRays()
    {
        for (uint32_t lane = 0; lane < kLanes; ++lane)
        {
            const int32_t edge = edge_[lane];
            const int32_t x = x_.voxel[lane], y = y_.voxel[lane], z = z_.voxel[lane];
            const int32_t plane_x = (x & -edge) + edge, plane_y = (y & -edge) + edge,
                          plane_z = (z & -edge) + edge;
            const float t_x = (static_cast<float>(plane_x) - x_.start[lane]) * x_.inverse[lane];
            const float t_y = (static_cast<float>(plane_y) - y_.start[lane]) * y_.inverse[lane];
            const float t_z = (static_cast<float>(plane_z) - z_.start[lane]) * z_.inverse[lane];
            const float nearest = min(t_x, min(t_y, t_z));
            const bool over_x = t_x <= nearest;
            const bool over_y = !over_x & (t_y <= nearest);
            const bool over_z = !(over_x | over_y);
            const float t = max(t_[lane], nearest);
            const int32_t to_x =
                static_cast<int32_t>(x_.start[lane] + t * x_.direction[lane]) + x_.mirror[lane];
            const int32_t to_y =
                static_cast<int32_t>(y_.start[lane] + t * y_.direction[lane]) + y_.mirror[lane];
            const int32_t to_z =
                static_cast<int32_t>(z_.start[lane] + t * z_.direction[lane]) + z_.mirror[lane];
            const bool stays = (solid_[lane] | idle_[lane]) != 0;
            const int32_t in_x = std::min(std::max(to_x, x), plane_x - 1);
            const int32_t in_y = std::min(std::max(to_y, y), plane_y - 1);
            const int32_t in_z = std::min(std::max(to_z, z), plane_z - 1);
            x_.voxel[lane] = stays ? x : over_x ? plane_x : in_x;
            y_.voxel[lane] = stays ? y : over_y ? plane_y : in_y;
            z_.voxel[lane] = stays ? z : over_z ? plane_z : in_z;
            axis_[lane] = stays ? axis_[lane] : over_x ? 0 : over_y ? 1 : 2;
            t_[lane] = stays ? t_[lane] : t;
            steps_[lane] += stays ? 0u : 1u;
            const bool ends = (solid_[lane] != 0) | (t >= end_[lane]);
            ended_[lane] = ends & (idle_[lane] == 0);
        }
    }

    void storeRay(uint32_t lane)
    {
        BrickRay& ray = rays_[ray_[lane]];
        --active_count_;
        ray.x = x_.voxelIn(lane);
        ray.y = y_.voxelIn(lane);
        ray.z = z_.voxelIn(lane);
        ray.t = t_[lane];
        ray.steps = steps_[lane];
        const int32_t axis = axis_[lane];
        const Axis& crossed = axis == 0 ? x_ : axis == 1 ? y_ : z_;
        ray.face = axis < 0 ? kNoFace
                            : 2 * static_cast<uint32_t>(axis) - static_cast<uint32_t>(crossed.mirror[lane]);
        ray.inside = ray.t < ray.end ? 1 : 0;
        if (solid_[lane] != 0)
            findBrick(ray);
    }

    void findBrick(BrickRay& ray) const
    {
        const auto x = static_cast<uint32_t>(ray.x), y = static_cast<uint32_t>(ray.y),
                   z = static_cast<uint32_t>(ray.z);
        const BrickGrid& grid = table_.bricks().grid;
        const BrickGroup& group =
            table_.bricks()
                .groups[(x >> 4) + brickGroupsAlongAxis(grid.voxels_x) *
                                       ((y >> 4) + brickGroupsAlongAxis(grid.voxels_y) * (z >> 4))];
        ray.brick = group.first_brick + maskCountBelow(group.brick_mask_low, group.brick_mask_high,
                                                       brickBit(x >> 2, y >> 2, z >> 2));
        ray.bit = brickBit(x, y, z);
    }

    const MarchTable& table_;
    std::span<BrickRay> rays_;
    size_t next_ = 0;           ///< index into rays_
    uint32_t active_count_ = 0; ///< number of lanes that do not rest
    Axis x_{}, y_{}, z_{};
    float t_[kLanes]{};
    float end_[kLanes]{};
    int32_t axis_[kLanes]{}; ///< axis along which the voxel was entered, -1 for none
    uint32_t steps_[kLanes]{};
    int32_t solid_[kLanes]{}; ///< -1: the voxel is solid
    int32_t idle_[kLanes]{};  ///< -1: the lane has no ray
    int32_t ended_[kLanes]{};
    int32_t edge_[kLanes]{}; ///< size of the cell that the ray leaves, voxels
    uint32_t group_[kLanes]{};
    uint32_t brick_bit_[kLanes]{};
    uint32_t voxel_bit_[kLanes]{};
    size_t ray_[kLanes]{};
};

} // namespace

MarchTable::MarchTable(const BrickMasks& bricks) : bricks_(bricks)
{
    const uint32_t x = brickGroupsAlongAxis(bricks.grid.voxels_x),
                   y = brickGroupsAlongAxis(bricks.grid.voxels_y),
                   z = brickGroupsAlongAxis(bricks.grid.voxels_z);
    shift_y_ = static_cast<int>(std::bit_width(x - 1));
    shift_z_ = shift_y_ + static_cast<int>(std::bit_width(y - 1));
    groups_.resize(size_t{z} << shift_z_);
    voxels_.resize(64);
    for (uint32_t i = 0; i < bricks.groups.size(); ++i)
    {
        const BrickGroup& group = bricks.groups[i];
        if ((group.brick_mask_low | group.brick_mask_high) == 0)
            continue;
        groups_[i % x | i / x % y << shift_y_ | i / x / y << shift_z_] =
            static_cast<uint32_t>(voxels_.size());
        uint32_t brick = group.first_brick;
        for (uint32_t bit = 0; bit < 64; ++bit)
        {
            const bool is = maskHas(group.brick_mask_low, group.brick_mask_high, bit);
            voxels_.push_back(
                is ? joinMask(bricks.bricks[brick].voxel_mask_low, bricks.bricks[brick].voxel_mask_high) : 0);
            brick += is ? 1 : 0;
        }
    }
}

void marchRays(const MarchTable& table, std::span<BrickRay> rays)
{
    Lanes(table, rays).march();
}

} // namespace hearth::bricks
