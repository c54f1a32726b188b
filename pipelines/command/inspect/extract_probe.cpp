// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/extract_probe.h"

#include "formats/base/atomic_file.h"
#include "formats/pack/pack_check.h"
#include "formats/texels/shared_exponent.h"
#include "pipelines/command/inspect/open_pack.h"
#include "pipelines/texture_files/exr_writer.h"
#include "pipelines/texture_files/png_writer.h"

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

struct Picture
{
    uint32_t width = 0, height = 0;
    std::vector<Float3> texels;
};

/// Lay out the six faces of a mip side by side, the mips below each other.
Picture layOut(const ProbeMips& probe)
{
    Picture picture{kFaces * probe.side(0), 0, {}};
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

/// Return the code of sRGB for a radiance x, as x / (1 + x) of white: suns keep their colours.
uint8_t displayCode(double radiance)
{
    const double light = radiance / (1 + radiance);
    const double code = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(255 * code + 0.5);
}

std::vector<std::byte> encodePicture(const Picture& picture)
{
    std::vector<uint8_t> codes;
    for (const Float3& texel : picture.texels)
        for (int c = 0; c < 3; ++c)
            codes.push_back(displayCode(std::numbers::pi * double{texel[c]}));
    return texture_files::writePng(picture.width, picture.height, codes);
}

} // namespace

Status extractProbe(const std::string& path, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    HEARTH_TRY(checkProbes(file)); // openContainer does not check these chunks of a part
    if (file.probes().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkProbes, 0), "the file has no light probe"};
    const ProbeMips probe = decodeMips(file, file.probes()[0]);
    const bool is_table = output.ends_with(".csv"), is_picture = output.ends_with(".png");
    if (!is_table && !is_picture && !output.ends_with(".exr"))
        return Error{Issue::usage, output, "", "a probe is written as .csv, .exr or .png"};
    HEARTH_ASSIGN_OR_RETURN(AtomicFile out, AtomicFile::create(output));
    if (is_table)
        out.write(makeTable(probe));
    else if (const Picture picture = layOut(probe); is_picture)
        out.write(encodePicture(picture));
    else
        out.write(texture_files::writeExr(picture.width, picture.height, picture.texels));
    return out.finish();
}

} // namespace hearth::command
