// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/extract_probe.h"

#include "formats/base/atomic_file.h"
#include "formats/pack/pack_check.h"
#include "formats/texels/shared_exponent.h"
#include "pipelines/command/inspect/light_picture.h"
#include "pipelines/command/inspect/open_pack.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hearth::command
{

using namespace formats;

namespace
{

constexpr uint32_t kFaces = 6;

/// Mips of a probe, decoded.
struct ProbeMips
{
    const ProbeRecord& record;
    std::vector<std::vector<Float3>> mips; ///< face, row, column

    uint32_t side(size_t mip) const { return finestProbeSide(record) >> mip; }
    double roughness(size_t mip) const
    {
        return mip < record.sharp_mips
                   ? 0
                   : probeMipRoughness(static_cast<uint32_t>(mip) - record.sharp_mips, record.mip_count);
    }
};

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

/// Return the solid angle of a texel, up to a factor: the density at its middle.
double weighTexel(uint32_t side, size_t texel)
{
    const double a = 2 * (static_cast<double>(texel % side) + 0.5) / side - 1;
    const double b = 2 * (static_cast<double>(texel / side % side) + 0.5) / side - 1;
    return std::pow(1 + a * a + b * b, -1.5);
}

std::string makeTable(const ProbeMips& probe)
{
    std::string text = "mip,side,roughness,mean_r,mean_g,mean_b,least,greatest\n";
    for (size_t mip = 0; mip < probe.mips.size(); ++mip)
    {
        const std::vector<Float3>& texels = probe.mips[mip];
        double sum[3] = {}, weights = 0;
        float least = texels[0].x, greatest = texels[0].x;
        for (size_t i = 0; i < texels.size(); ++i)
        {
            const double weight = weighTexel(probe.side(mip), i);
            weights += weight;
            for (int c = 0; c < 3; ++c)
            {
                sum[c] += weight * double{texels[i][c]};
                least = std::min(least, texels[i][c]);
                greatest = std::max(greatest, texels[i][c]);
            }
        }
        text += fmt::format("{},{},{:.6g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}\n", mip, probe.side(mip),
                            probe.roughness(mip), sum[0] / weights, sum[1] / weights, sum[2] / weights, least,
                            greatest);
    }
    return text;
}

/// Lay out the six faces of a mip side by side, the mips below each other.
LightPicture layOut(const ProbeMips& probe)
{
    LightPicture picture{kFaces * probe.side(0), 0, {}};
    for (size_t mip = 0; mip < probe.mips.size(); ++mip)
        picture.height += probe.side(mip);
    picture.texels.resize(size_t{picture.width} * picture.height);
    size_t top = 0;
    for (size_t mip = 0; mip < probe.mips.size(); ++mip)
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

} // namespace

Status extractProbe(const std::string& path, uint32_t index, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    HEARTH_TRY(checkProbes(file)); // openContainer does not check these chunks of a part
    if (file.probes().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkProbes, 0), "the file has no light probe"};
    if (index >= file.probes().size())
        return Error{
            Issue::usage, path, "",
            fmt::format("there is no probe {}: the last one is {}", index, file.probes().size() - 1)};
    const ProbeMips probe = decodeMips(file, file.probes()[index]);
    if (isPictureName(output))
        return writePicture(output, layOut(probe), std::numbers::pi);
    if (!output.ends_with(".csv"))
        return Error{Issue::usage, output, "", "a probe is written as .csv, .exr or .png"};
    HEARTH_ASSIGN_OR_RETURN(AtomicFile out, AtomicFile::create(output));
    out.write(makeTable(probe));
    return out.finish();
}

} // namespace hearth::command
