// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/face_lighting.h"

#include "formats/assert.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>

namespace hearth::bricks
{

using namespace shared;

namespace
{

uint64_t maskOf(uint32_t low, uint32_t high)
{
    return uint64_t{high} << 32 | low;
}

} // namespace

FaceLighting::FaceLighting(const BrickView& bricks)
    : bricks_(bricks), corners_(bricks.masks.bricks.size()), next_(bricks.lighting.size())
{
    faces_.reserve(bricks.lighting.size());
    for (const uint32_t code : bricks.lighting)
        faces_.push_back({code, 0});
    const uint32_t groups_x = brickGroups(bricks.masks.grid.voxels_x);
    const uint32_t groups_y = brickGroups(bricks.masks.grid.voxels_y);
    for (uint32_t g = 0; g < bricks.masks.groups.size(); ++g)
    {
        const BrickGroup& group = bricks.masks.groups[g];
        uint32_t brick = group.first_brick;
        for (uint64_t mask = maskOf(group.brick_mask_low, group.brick_mask_high); mask != 0; mask &= mask - 1)
        {
            const auto bit = static_cast<uint32_t>(std::countr_zero(mask));
            corners_[brick++] = {kGroupVoxels * (g % groups_x) + kBrickVoxels * (bit & 3),
                                 kGroupVoxels * (g / groups_x % groups_y) + kBrickVoxels * (bit >> 2 & 3),
                                 kGroupVoxels * (g / groups_x / groups_y) + kBrickVoxels * (bit >> 4)};
        }
    }
}

void FaceLighting::light(const Lighting& lighting, const FrameShare& share)
{
    HEARTH_ASSERT(share.period > 0 && share.rays > 0);
    const auto bricks = static_cast<uint32_t>(corners_.size());
    const uint32_t first = brickSliceBegin(bricks, frame_, share.period);
    const uint32_t end = brickSliceEnd(bricks, frame_, share.period);
    ++frame_;
    tbb::parallel_for(first, end, [&](uint32_t brick) { lightBrick(lighting, share.rays, brick); });
    if (first == end)
        return;
    const uint32_t first_face = bricks_.masks.bricks[first].first_face;
    const auto end_face = end < bricks ? bricks_.masks.bricks[end].first_face : faces_.size();
    std::copy(next_.begin() + first_face, next_.begin() + static_cast<ptrdiff_t>(end_face),
              faces_.begin() + first_face);
}

void FaceLighting::sweep(const Lighting& lighting, uint32_t rays, uint32_t sweeps)
{
    for (uint32_t i = 0; i < sweeps; ++i)
        light(lighting, {.period = 1, .rays = rays});
}

std::vector<uint32_t> FaceLighting::codes() const
{
    std::vector<uint32_t> codes;
    codes.reserve(faces_.size());
    for (const BrickLight& face : faces_)
        codes.push_back(face.code);
    return codes;
}

void FaceLighting::lightBrick(const Lighting& lighting, uint32_t rays, uint32_t brick)
{
    const Brick& record = bricks_.masks.bricks[brick];
    uint32_t face = record.first_face;
    for (uint32_t side = 0; side < kVoxelFaces; ++side)
        for (uint64_t mask = maskOf(record.face_masks[2 * side], record.face_masks[2 * side + 1]); mask != 0;
             mask &= mask - 1)
        {
            const auto bit = static_cast<uint32_t>(std::countr_zero(mask));
            next_[face] = encodeBrickLight(lightFace(lighting, rays, brick, bit, side, face));
            ++face;
        }
}

Float3 FaceLighting::lightFace(const Lighting& lighting, uint32_t rays, uint32_t brick, uint32_t bit,
                               uint32_t side, uint32_t face) const
{
    const Corner& corner = corners_[brick];
    const uint32_t x = corner.x + (bit & 3), y = corner.y + (bit >> 2 & 3), z = corner.z + (bit >> 4);
    const BrickScene scene = this->scene();
    const BrickStart start = brickFaceStart(scene, x, y, z, side, decodeFaceNormal(bricks_.normals[face]));
    const Float3 middle = brickFaceMiddle(x, y, z, side);
    const BrickSky sky{lighting.sky_zenith, lighting.sky_horizon, lighting.sky_ground};
    Float3 arrived = brickGather(scene, sky, start, rays, brickFaceSeed(x, y, z, side));
    for (uint32_t i = 0; i < lighting.light_count; ++i)
        arrived += brickDirect(scene, start, middle, lighting.lights[i]);
    return brickSentOut(decodeRadiance(bricks_.emission[face]), decodeAlbedo(bricks_.albedo[face]), arrived);
}

uint32_t sweepsToForget(float most_albedo, float share)
{
    const double kept = double{std::min(most_albedo, kBrickMostAlbedo)} * 1.0001;
    return std::max(1u, static_cast<uint32_t>(std::ceil(std::log(double{share}) / std::log(kept))));
}

} // namespace hearth::bricks
