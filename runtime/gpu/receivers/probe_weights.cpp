// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/receivers/probe_weights.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/brick_rays.h"
#include "formats/pack/for_each_brick.h"

#include <algorithm>

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

struct PlacedFace
{
    Float3 middle; ///< world space
    uint32_t side;
};

std::vector<PlacedFace> placeFaces(const formats::PackView& pack)
{
    const formats::BrickGridRecord& grid = pack.brickGrid()[0];
    std::vector<PlacedFace> faces(pack.brickAlbedo().size());
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
                        faces[face++] = {grid.origin + middle * grid.voxel_size, side};
                    }
        });
    return faces;
}

/// Return the solid angle of a face at a probe, up to a factor that all faces have; 0 outside of its box, and
/// for faces that look away, as those of the other sides of the room's walls.
double measureSolidAngle(const shared::LocalProbe& probe, const PlacedFace& face, float voxel_size)
{
    if (!isInside(probe, face.middle, kBoxMargin * voxel_size))
        return 0;
    const Float3 offset = probe.position - face.middle;
    const float distance = std::max(length(offset), voxel_size);
    return std::max(double{dot(shared::brickFaceAxis(face.side), offset)}, 0.0) /
           (double{distance} * distance * distance);
}

/// Add the light of a face of a block to that of each lamp.
/// light  [lamps]
void addFace(const formats::ReceiverTables& tables, const formats::ReceiverBlockRecord& block,
             uint32_t number, double weight, Double3* light)
{
    if (weight <= 0)
        return;
    for (uint32_t color = 0; color < block.color_count; ++color)
    {
        const uint32_t word = tables.words[block.first_word + (color + 1) * block.texel_count + number];
        Double3& sum = light[shared::receiverLamp(block, color)];
        sum = sum + widen(shared::decodeReceiverColor(word, tables.atlas.codec)) * weight;
    }
}

} // namespace

ProbeWeights::ProbeWeights(const formats::PackView& pack, const shared::LocalProbes& probes)
{
    if (pack.faceAtlases().empty() || probes.tables.empty())
        return;
    const formats::ReceiverTables tables = pack.faceReceivers();
    const std::vector<PlacedFace> faces = placeFaces(pack);
    lamp_count_ = tables.lamps.size();
    light_.resize(probes.tables.size() * lamp_count_);
    for (const formats::ReceiverBlockRecord& block : tables.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
            for (size_t probe = 0; probe < probes.tables.size(); ++probe)
                addFace(tables, block, i,
                        measureSolidAngle(probes.tables[probe].probe,
                                          faces[shared::receiverFace(tables.words[block.first_word + i])],
                                          pack.brickGrid()[0].voxel_size),
                        &light_[probe * lamp_count_]);
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
