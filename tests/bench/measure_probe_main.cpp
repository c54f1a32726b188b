// Measures the probe cooker on environments: time, mips beside sums over many points, the mean that they
// keep.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/probes/harmonics.h"
#include "cook/probes/probe.h"
#include "formats/base/program.h"
#include "pipelines/environments/read_environment.h"
#include "tests/bench/aims.h"
#include "tests/environments/lobe_sum.h"

#include <tbb/parallel_for.h>

#include <cstdio>
#include <ctime>
#include <numeric>
#include <random>

namespace
{

using namespace hearth;
using environment::Environment;
using probes::ProbeMip;

double processorSeconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Points along an edge of a texel so that they are a quarter of alpha apart, or closer.
uint32_t chooseSteps(const Environment& sky, double roughness)
{
    const double texel = std::numbers::pi / sky.height;
    return static_cast<uint32_t>(std::ceil(texel / (roughness * roughness / 4)));
}

/// Return the error of texels of a mip against sums, as a share of the rms of the sums: the brightest
/// ones and as many random ones.
double measureMip(const Environment& sky, const ProbeMip& mip, double roughness, size_t count)
{
    std::vector<size_t> order(mip.texels.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return mip.texels[a].y > mip.texels[b].y; });
    std::mt19937 random(1);
    for (size_t i = 0; i < count; ++i)
        order[count + i] = random() % mip.texels.size();
    std::vector<Double3> sums(2 * count);
    const uint32_t steps = chooseSteps(sky, roughness);
    tbb::parallel_for(size_t{0}, sums.size(),
                      [&](size_t i) {
                          sums[i] = test::sumLobe(sky, steps, test::texelDirection(mip, order[i]), roughness);
                      });
    double error = 0, size = 0;
    for (size_t i = 0; i < sums.size(); ++i)
    {
        const Double3 difference = mip.texels[order[i]] - sums[i];
        error += dot(difference, difference);
        size += dot(sums[i], sums[i]);
    }
    return std::sqrt(error / size);
}

/// errors: those of reading the file and of cookProbe
Status measureFile(const std::string& path, size_t samples, bench::Judgement& judgement)
{
    HEARTH_ASSIGN_OR_RETURN(const Environment sky, environments::readEnvironment(path));
    if (sky.layout != environment::Layout::lat_long)
        return Error{Issue::image_unsupported, path, "", "the bench sums lat-long images alone"};
    const double start = processorSeconds();
    HEARTH_ASSIGN_OR_RETURN(const probes::Probe probe, probes::cookProbe(sky, path));
    const double seconds = processorSeconds() - start;
    std::printf("%s, %u x %u: %.2f s of processor, window %.4f, stored within %.2f %% rms\n",
                path.substr(path.rfind('/') + 1).c_str(), sky.width, sky.height, seconds,
                double{probe.record.window}, 100 * double{probe.record.error});
    judgement.record("s of processor", seconds);
    judgement.record("error of storing, rms", double{probe.record.error});

    // the mips before they are stored
    const Double3 irradiance = probes::meanIrradiance(probes::projectRadiance(sky));
    const auto mips =
        probes::prefilter(probes::buildRadianceTree(sky, 1, probes::kTreeRowsOfSide * probes::kProbeSide),
                          probes::kProbeSide, probes::kProbeMips);
    for (uint32_t mip = 0; mip < probes::kProbeMips; ++mip)
    {
        const double kept = test::averageMip(mips[mip]).y * std::numbers::pi / irradiance.y - 1;
        std::printf("  mip %u: mean off by %+.3f %%", mip, 100 * kept);
        judgement.record("mean of a mip off the environment's", std::abs(kept));
        if (mip > 0)
        {
            const double roughness = 1 - std::sqrt(1 - mip / 5.0);
            const double error = measureMip(sky, mips[mip], roughness, samples);
            std::printf(", %.3f %% rms from sums over many points", 100 * error);
            judgement.record("error of a mip, rms", error);
        }
        std::puts("");
    }
    return success();
}

} // namespace

int main(int argc, char** argv)
{
    cli::CommandLine app("Measures the probe cooker on lat-long environments.");
    std::vector<std::string> files;
    uint32_t samples = 16;
    app.addOption("FILES", files, "environments").required();
    app.addOption("--samples", samples, "brightest texels of a mip, and random ones, that are compared")
        .range(1u, 48u);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    bench::Judgement judgement("probe");
    std::puts("anchor: cmgen 2.5 s; its mips lose 1 to 7 % of the light of a sunset, and are 7 % rms off at "
              "roughness 1");
    for (const std::string& file : files)
        if (const Status status = measureFile(file, samples, judgement); !status.ok())
            return reportFailure(status.error());
    return judgement.finish();
}
