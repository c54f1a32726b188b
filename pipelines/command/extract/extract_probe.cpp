// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_probe.h"

#include "formats/base/atomic_file.h"
#include "formats/pack/pack_check.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/light_pictures/probe_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hearth::command
{

using namespace formats;

namespace
{

/// Return the solid angle of a texel, up to a factor: the density at its middle.
double weighTexel(uint32_t side, size_t texel)
{
    const double a = 2 * (static_cast<double>(texel % side) + 0.5) / side - 1;
    const double b = 2 * (static_cast<double>(texel / side % side) + 0.5) / side - 1;
    return std::pow(1 + a * a + b * b, -1.5);
}

/// Return a line of the table for each mip.
std::string listMips(uint32_t index, const light_pictures::ProbeMips& probe)
{
    std::string text;
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
        text += fmt::format("{},{},{},{:.6g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}\n", index, mip,
                            probe.side(mip), probe.roughness(mip), sum[0] / weights, sum[1] / weights,
                            sum[2] / weights, least, greatest);
    }
    return text;
}

} // namespace

Status extractProbe(const std::string& path, std::optional<uint32_t> index, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    HEARTH_TRY(checkProbes(file)); // openContainer does not check these chunks of a part
    const auto count = static_cast<uint32_t>(file.probes().size());
    if (count == 0)
        return Error{Issue::chunk_missing, path, chunkName(kChunkProbes, 0), "the file has no light probe"};
    if (index && *index >= count)
        return Error{Issue::usage, path, "",
                     fmt::format("there is no probe {}: the last one is {}", *index, count - 1)};
    const uint32_t first = index.value_or(0), end = index ? first + 1 : count;
    const auto decode = [&file](uint32_t probe)
    { return light_pictures::decodeMips(file, file.probes()[probe]); };
    if (light_pictures::isPictureName(output))
    {
        if (end - first > 1)
            return Error{
                Issue::usage, path, "",
                fmt::format("a picture shows one of the {} probes: add its index to --probe, 0 to {}", count,
                            count - 1)};
        return light_pictures::writePicture(output, light_pictures::drawProbe(decode(first)),
                                            std::numbers::pi);
    }
    if (!output.ends_with(".csv"))
        return Error{Issue::usage, output, "", "probes are written as .csv, one also as .exr or .png"};
    std::string table = "probe,mip,side,roughness,mean_r,mean_g,mean_b,least,greatest\n";
    for (uint32_t probe = first; probe < end; ++probe)
        table += listMips(probe, decode(probe));
    HEARTH_ASSIGN_OR_RETURN(AtomicFile out, AtomicFile::create(output));
    out.write(table);
    return out.finish();
}

} // namespace hearth::command
