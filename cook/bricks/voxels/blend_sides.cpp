// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/blend_sides.h"

#include "cook/bricks/voxels/for_each_voxel.h"
#include "formats/gpu_shared/brick_codes.h"

#include <algorithm>
#include <bit>

namespace hearth::bricks
{

namespace
{

constexpr int kSamples = static_cast<int>(kSamplesPerEdge * kSamplesPerEdge);

const SolidVoxel* voxelAt(const SolidGrid& grid, const Cell& cell)
{
    const uint32_t voxel = isInside(grid.frame, cell) ? grid.voxelAt(cell) : kInvalidIndex;
    return voxel == kInvalidIndex ? nullptr : &grid.voxels[voxel];
}

uint64_t coverageAlong(const SolidVoxel* voxel, size_t axis)
{
    return voxel == nullptr ? 0 : voxel->coverage[axis];
}

bool showsFront(const SolidVoxel* voxel, uint32_t face)
{
    return voxel != nullptr && (voxel->front_visible >> face & 1) != 0;
}

/// Weights of a side's own light and of the light of the same side of the voxel behind it.
struct SideWeights
{
    float own = 1, behind = 0;
};

SideWeights computeSideWeights(const SolidGrid& grid, const Cell& cell, const SolidVoxel& voxel,
                               uint32_t face)
{
    const size_t axis = face / 2;
    const SolidVoxel* const next = voxelAt(grid, across(cell, face ^ 1));
    const uint64_t own = voxel.coverage[axis];
    const int own_count = std::popcount(own);
    if (voxel.opacity < 255)
    {
        const float stopped = static_cast<float>(voxel.opacity) / 255.0f * kSamples;
        return {std::min(1.0f, static_cast<float>(own_count) / stopped), 0};
    }
    const uint64_t behind = coverageAlong(next, axis) & ~own;
    const uint64_t before = coverageAlong(voxelAt(grid, across(cell, face)), axis) & ~own & ~behind;
    // samples that the voxel in front covers are not visible here
    const int seen = kSamples - std::popcount(before);
    if (seen == 0)
        return {};
    return {static_cast<float>(own_count) / static_cast<float>(seen),
            showsFront(next, face) ? static_cast<float>(std::popcount(behind)) / static_cast<float>(seen)
                                   : 0};
}

SolidVoxel blendVoxel(const SolidGrid& grid, const Cell& cell, const SolidVoxel& voxel)
{
    SolidVoxel result = voxel;
    for (uint32_t face = 0; face < kFaces; ++face)
    {
        if (!showsFront(&voxel, face))
            continue;
        const SideWeights shares = computeSideWeights(grid, cell, voxel, face);
        const float sum = shares.own + shares.behind;
        if (sum == 0)
        {
            result.emission[face] = 0;
            continue;
        }
        Float3 albedo = shared::decodeAlbedo(voxel.albedo[face]) * (shares.own / sum);
        Float3 emission = shared::decodeRadiance(voxel.emission[face]) * shares.own;
        if (shares.behind > 0)
        {
            const SolidVoxel& next = *voxelAt(grid, across(cell, face ^ 1));
            albedo += shared::decodeAlbedo(next.albedo[face]) * (shares.behind / sum);
            emission += shared::decodeRadiance(next.emission[face]) * shares.behind;
        }
        const float depth = shared::decodeFaceDepth(voxel.albedo[face]);
        result.albedo[face] = shared::encodeAlbedo(albedo) | shared::encodeFaceDepth(depth);
        result.emission[face] = shared::encodeRadiance(emission);
    }
    return result;
}

} // namespace

void blendSides(SolidGrid& grid)
{
    std::vector<SolidVoxel> voxels(grid.voxels.size());
    forEachVoxel(grid, [&](uint32_t voxel, const Cell& cell)
                 { voxels[voxel] = blendVoxel(grid, cell, grid.voxels[voxel]); });
    grid.voxels = std::move(voxels);
}

} // namespace hearth::bricks
