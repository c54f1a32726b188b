// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/local_probes.h"

#include "formats/scene/scene_lighting.h"

#include <algorithm>

namespace hearth::shared
{

using formats::ProbeRecord;

namespace
{

std::vector<ProbeRecord> findLocalProbes(std::span<const ProbeRecord> probes)
{
    std::vector<ProbeRecord> found;
    for (const ProbeRecord& probe : probes)
        if (formats::isLocalProbe(probe) && found.size() < kMaxLocalProbes)
            found.push_back(probe);
    return found;
}

/// Return the direction of a point of a face's plane; a and b are within -1 and 1 on the face itself.
/// source  Vulkan 1.3, section "Cube Map Face Selection"
Float3 faceDirection(uint32_t face, float a, float b)
{
    const float sign = face % 2 == 0 ? 1.0f : -1.0f;
    switch (face / 2)
    {
    case 0:
        return {sign, -b, -sign * a};
    case 1:
        return {a, sign, sign * b};
    default:
        return {sign * a, -b, sign};
    }
}

/// Copy a face with a margin of one texel, whose texels are the nearest ones of the faces beside it.
/// faces  of the mip, side x side texels each
void copyFace(std::span<const uint32_t> faces, uint32_t face, uint32_t side, uint32_t stride,
              std::span<uint32_t> target)
{
    const auto texels = static_cast<float>(side);
    const auto index = [&](float at)
    { return static_cast<uint32_t>(std::clamp((at + 1) * 0.5f * texels, 0.0f, texels - 1)); };
    for (uint32_t y = 0; y < side + 2; ++y)
        for (uint32_t x = 0; x < side + 2; ++x)
        {
            const float a = (2 * static_cast<float>(x) - 1) / texels - 1;
            const float b = (2 * static_cast<float>(y) - 1) / texels - 1;
            const CubePlace place = findCubePlace(faceDirection(face, a, b));
            target[size_t{y} * stride + x] =
                faces[(size_t{place.panel} * side + index(place.down / place.depth)) * side +
                      index(place.across / place.depth)];
        }
}

} // namespace

LocalProbes makeLocalProbes(std::span<const ProbeRecord> probes)
{
    LocalProbes local;
    for (const ProbeRecord& record : findLocalProbes(probes))
    {
        local.side = record.face_size;
        local.mip_count = record.mip_count;
        LocalProbeTable table{};
        const auto number = static_cast<uint32_t>(local.tables.size());
        table.probe = {.position = record.position,
                       .irradiance_red = record.irradiance_luminance,
                       .box_min = record.box_min,
                       .atlas_row = number * probeAtlasRows(record.face_size),
                       .box_max = record.box_max,
                       .fade = record.fade,
                       .influence_min = record.influence_min,
                       .irradiance_green = record.irradiance_luminance,
                       .influence_max = record.influence_max,
                       .irradiance_blue = record.irradiance_luminance,
                       .sky_share = {record.sky_share[0], record.sky_share[1], record.sky_share[2],
                                     record.sky_share[3]}};
        for (size_t i = 0; i < table.harmonics.size(); ++i)
        {
            const Float3 color{record.harmonics[3 * i], record.harmonics[3 * i + 1],
                               record.harmonics[3 * i + 2]};
            table.harmonics[i] = {color.x, color.y, color.z, luminance(color) + record.lamp_harmonics[i]};
        }
        local.tables.push_back(table);
    }
    return local;
}

ProbeAtlas makeProbeAtlas(std::span<const ProbeRecord> probes, std::span<const uint32_t> texels)
{
    const std::vector<ProbeRecord> local = findLocalProbes(probes);
    if (local.empty())
        return {};
    const uint32_t side = local[0].face_size, rows = probeAtlasRows(side);
    ProbeAtlas atlas{.width = probeAtlasColumns(side, local[0].mip_count),
                     .height = rows * static_cast<uint32_t>(local.size()),
                     .texels = {}};
    atlas.texels.resize(size_t{atlas.width} * atlas.height);
    for (uint32_t i = 0; i < local.size(); ++i)
        for (uint32_t mip = 0; mip < local[i].mip_count; ++mip)
        {
            const uint32_t own = side >> mip;
            const auto first = local[i].texels.first + formats::cubeTexelCount(side, mip);
            const auto faces = texels.subspan(static_cast<size_t>(first), size_t{6} * own * own);
            for (uint32_t face = 0; face < 6; ++face)
            {
                const uint32_t column = probeMipColumn(side, mip) + face * (own + 2);
                const uint32_t row = i * rows + (mip == 0 ? 0 : side + 2);
                copyFace(faces, face, own, atlas.width,
                         std::span(atlas.texels).subspan(size_t{row} * atlas.width + column));
            }
        }
    return atlas;
}

} // namespace hearth::shared
