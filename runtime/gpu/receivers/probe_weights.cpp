// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/receivers/probe_weights.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/brick_rays.h"
#include "formats/pack/for_each_brick.h"

namespace hearth::gpu
{

namespace
{

/// Voxels by which faces of the walls of a box may lie outside of it.
constexpr float kBoxMargin = 1.5f;

bool isInside(const shared::LocalProbe& probe, Float3 position, float margin)
{
    const Float3 low = probe.box_min - Float3{margin, margin, margin};
    const Float3 high = probe.box_max + Float3{margin, margin, margin};
    return position.x >= low.x && position.y >= low.y && position.z >= low.z && position.x <= high.x &&
           position.y <= high.y && position.z <= high.z;
}

/// Return the probes that may see each face, by bits: the face lies in the box, and looks to the probe. The
/// other sides of the room's walls are as near.
std::vector<uint32_t> findProbesOfFaces(const formats::PackView& pack, const shared::LocalProbes& probes)
{
    static_assert(shared::kMaxLocalProbes <= 32);
    const formats::BrickGridRecord& grid = pack.brickGrid()[0];
    std::vector<uint32_t> found(pack.brickAlbedo().size());
    const auto findProbes = [&](Float3 middle, uint32_t side)
    {
        uint32_t bits = 0;
        for (size_t i = 0; i < probes.tables.size(); ++i)
        {
            const shared::LocalProbe& probe = probes.tables[i].probe;
            if (isInside(probe, middle, kBoxMargin * grid.voxel_size) &&
                dot(shared::brickFaceAxis(side), probe.position - middle) > 0)
                bits |= 1u << i;
        }
        return bits;
    };
    formats::forEachBrickOfGrid(
        grid, pack.brickGroupsAlongAxis(),
        [&](uint32_t number, const formats::VoxelCoordinates& first)
        {
            const formats::BrickRecord& brick = pack.bricks()[number];
            uint32_t face = brick.first_face;
            for (uint32_t side = 0; side < shared::kVoxelFaces; ++side)
                for (uint32_t bit = 0; bit < 64; ++bit)
                    if (shared::maskHas(brick.face_masks[2 * side], brick.face_masks[2 * side + 1], bit))
                    {
                        const formats::VoxelCoordinates v = formats::voxelAtBit(first, bit, 1);
                        const Float3 middle = shared::brickFaceMiddle(v.x, v.y, v.z, side);
                        found[face++] = findProbes(grid.origin + middle * grid.voxel_size, side);
                    }
        });
    return found;
}

} // namespace

ProbeWeights::ProbeWeights(const formats::PackView& pack, const shared::LocalProbes& probes)
{
    if (pack.faceAtlases().empty() || probes.tables.empty())
        return;
    const formats::ReceiverTables tables = pack.faceReceivers();
    const std::vector<uint32_t> probes_of_faces = findProbesOfFaces(pack, probes);
    lamp_count_ = tables.lamps.size();
    light_.resize(probes.tables.size() * lamp_count_);
    for (const formats::ReceiverBlockRecord& block : tables.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t* const word = &tables.words[block.first_word + i];
            for (uint32_t bits = probes_of_faces[*word], probe = 0; bits != 0; bits >>= 1, ++probe)
                for (uint32_t color = 0; (bits & 1) != 0 && color < block.color_count; ++color)
                {
                    Double3& sum = light_[probe * lamp_count_ + shared::receiverLamp(block, color)];
                    sum = sum + widen(shared::decodeReceiverColor(word[(color + 1) * block.texel_count],
                                                                  tables.atlas.codec));
                }
        }
}

Float3 ProbeWeights::weigh(size_t probe, std::span<const Float3> weights) const
{
    HEARTH_ASSERT(weights.size() == lamp_count_);
    Double3 now{}, baked{};
    for (size_t lamp = 0; lamp < lamp_count_; ++lamp)
    {
        const Double3& light = light_[probe * lamp_count_ + lamp];
        const Double3 weight = widen(weights[lamp]);
        now = now + Double3{light.x * weight.x, light.y * weight.y, light.z * weight.z};
        baked = baked + light;
    }
    const auto ratio = [](double a, double b) { return b > 0 ? static_cast<float>(a / b) : 1.0f; };
    return {ratio(now.x, baked.x), ratio(now.y, baked.y), ratio(now.z, baked.z)};
}

} // namespace hearth::gpu
