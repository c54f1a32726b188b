// Compares the ambient occlusion of two bakes at the vertices of the finest level, with an aim for the rms
// difference. Measures the error due to noise if the other bake has many times the rays or samples. `./dev
// bench visibility` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/open_part.h"
#include "cook/visibility/scene/level_meshes.h"
#include "formats/base/issues.h"
#include "formats/base/program.h"
#include "tests/bench/aims.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

using namespace hearth;

/// Ambient occlusion of each vertex of a mesh's finest level, cluster by cluster.
std::vector<float> computeOcclusion(const visibility::MeshPages& pages)
{
    std::vector<float> occlusion;
    for (const auto& part : visibility::extractLevel(pages, 0).parts)
    {
        const formats::ClusterGeometry geometry = pages.cluster(part.cluster);
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            occlusion.push_back(dot(geometry.normal(v), geometry.visibility(v).m1) / shared::kVisibilityPi);
    }
    return occlusion;
}

/// returns  the rms difference
double print(const char* name, const std::vector<float>& baked, const std::vector<float>& reference)
{
    std::vector<double> squares;
    double sum = 0;
    for (size_t v = 0; v < std::min(baked.size(), reference.size()); ++v)
    {
        const double difference = double{baked[v]} - double{reference[v]};
        squares.push_back(difference * difference);
        sum += squares.back();
    }
    std::sort(squares.begin(), squares.end());
    const auto at = [&](double share)
    { return std::sqrt(squares[static_cast<size_t>(share * static_cast<double>(squares.size() - 1))]); };
    const double rms = std::sqrt(sum / static_cast<double>(squares.size()));
    std::printf("%-32s %8zu vertices  rms %.4f  median %.4f  95 %% %.4f  largest %.4f\n", name,
                squares.size(), rms, at(0.5), at(0.95), at(1));
    return rms;
}

/// returns  exit code: 1 if an aim is missed
Result<int> compare(const std::string& baked_path, const std::string& reference_path)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView baked, tools::openPart(baked_path));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView reference, tools::openPart(reference_path));
    bench::Judgement judgement("occlusion");
    for (uint32_t mesh = 0; mesh < std::min(baked.meshes().size(), reference.meshes().size()); ++mesh)
    {
        const formats::MeshRecord& record = baked.meshes()[mesh];
        if (record.clusters.count == 0 || (record.attributes & formats::kVertexVisibility) == 0)
            continue;
        HEARTH_ASSIGN_OR_RETURN(const auto pages, visibility::MeshPages::read(baked, mesh));
        HEARTH_ASSIGN_OR_RETURN(const auto reference_pages, visibility::MeshPages::read(reference, mesh));
        judgement.record("rms difference of ambient occlusion",
                         print(std::string(baked.text(record.name)).c_str(), computeOcclusion(pages),
                               computeOcclusion(reference_pages)));
    }
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Compares the ambient occlusion of two clusters parts of one source.");
    std::string baked, reference;
    app.addOption("baked", baked, "clusters part with visibility").required();
    app.addOption("reference", reference, "the same, baked better").required();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> compared = compare(baked, reference);
    return compared.ok() ? *compared : reportFailure(compared.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_compare_occlusion", [&] { return program(argc, argv); });
}
