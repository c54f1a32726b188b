// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/light_pictures/probe_picture.h"

#include "formats/texels/shared_exponent.h"

namespace hearth::light_pictures
{

using namespace formats;

namespace
{

constexpr uint32_t kFaces = 6;

} // namespace

double ProbeMips::roughness(size_t mip) const
{
    return mip < record.sharp_mips
               ? 0
               : probeMipRoughness(static_cast<uint32_t>(mip) - record.sharp_mips, record.mip_count);
}

ProbeMips decodeMips(const PackView& file, const ProbeRecord& record)
{
    ProbeMips decoded{record, {}};
    const uint32_t* word = file.probeTexels().data() + record.texels.first;
    for (uint32_t mip = 0; mip < countProbeMips(record); ++mip)
    {
        std::vector<Float3>& texels = decoded.mips.emplace_back();
        for (size_t count = size_t{kFaces} * decoded.side(mip) * decoded.side(mip); count > 0; --count)
        {
            const std::array<float, 3> color = decodeSharedExponent(*word++);
            texels.push_back({color[0], color[1], color[2]});
        }
    }
    return decoded;
}

LightPicture drawProbe(const ProbeMips& probe, size_t first_mip)
{
    LightPicture picture{kFaces * probe.side(first_mip), 0, {}};
    for (size_t mip = first_mip; mip < probe.mips.size(); ++mip)
        picture.height += probe.side(mip);
    picture.texels.resize(size_t{picture.width} * picture.height);
    size_t top = 0;
    for (size_t mip = first_mip; mip < probe.mips.size(); ++mip)
    {
        const size_t side = probe.side(mip);
        for (size_t i = 0; i < probe.mips[mip].size(); ++i)
        {
            const size_t face = i / (side * side), row = i / side % side, column = i % side;
            picture.texels[(top + row) * picture.width + face * side + column] = probe.mips[mip][i];
        }
        top += side;
    }
    return picture;
}

} // namespace hearth::light_pictures
