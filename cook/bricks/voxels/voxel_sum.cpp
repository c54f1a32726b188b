// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/voxel_sum.h"

#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_codes.h"

namespace hearth::bricks
{

namespace
{

Double3 sideNormal(uint32_t face)
{
    const double sign = isPositiveFace(face) ? 1 : -1;
    return {faceAxis(face) == 0 ? sign : 0, faceAxis(face) == 1 ? sign : 0, faceAxis(face) == 2 ? sign : 0};
}

uint16_t normalCode(const Double3& normal, uint32_t face)
{
    // use the side's normal where the sum cancels out, so that the result does not depend on rounding
    const double size = length(normal);
    const Double3 chosen = size > 1e-12 ? normal * (1 / size) : sideNormal(face);
    return static_cast<uint16_t>(formats::NormalCode<8>::encode(narrow(chosen)));
}

} // namespace

void VoxelSum::add(const Double3& middle, const Double3& double_area, const SurfaceSample& look,
                   bool double_sided)
{
    const double size = length(double_area);
    const Double3 unit = double_area * (1 / size);
    const double piece = size / 2 * look.coverage;
    area += piece;
    const Double3 piece_albedo = widen(look.albedo);
    albedo = albedo + piece_albedo * piece;
    normal = normal + unit * piece;
    for (uint32_t face = 0; face < kFaces; ++face)
    {
        const double along = coordinate(unit, faceAxis(face)) * (isPositiveFace(face) ? 1 : -1);
        if (along == 0 || (along < 0 && !double_sided))
            continue;
        const double weight = piece * std::abs(along);
        SideSum& side = sides[face];
        side.weight += weight;
        side.albedo = side.albedo + piece_albedo * weight;
        side.normal = side.normal + unit * (along < 0 ? -weight : weight);
        const double place = coordinate(middle, faceAxis(face));
        side.depth += weight * (isPositiveFace(face) ? 1 - place : place);
    }
}

SolidVoxel encodeVoxel(const VoxelSum& sum)
{
    SolidVoxel voxel{};
    voxel.coverage = sum.coverage;
    for (uint32_t face = 0; face < kFaces; ++face)
    {
        const SideSum& side = sum.sides[face];
        if (side.weight > 0)
        {
            voxel.front_visible |= static_cast<uint8_t>(1u << face);
            voxel.albedo[face] = shared::encodeAlbedo(narrow(side.albedo * (1 / side.weight))) |
                                 shared::encodeFaceDepth(static_cast<float>(side.depth / side.weight));
            voxel.normal[face] = normalCode(side.normal, face);
        }
        else
        {
            const Double3 back = sum.normal * -1;
            const bool is_behind = dot(back, sideNormal(face)) > 0;
            voxel.albedo[face] =
                shared::encodeAlbedo(narrow(sum.albedo * (1 / sum.area))) | shared::encodeFaceDepth(0.5f);
            voxel.normal[face] = normalCode(is_behind ? back : sideNormal(face), face);
        }
    }
    return voxel;
}

} // namespace hearth::bricks
