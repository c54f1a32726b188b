// Compares the ambient occlusion of two bakes at the vertices of the finest level. Measures the error due to
// noise if the other bake has many times the rays or samples. `./dev bench visibility` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/open_part.h"
#include "cook/visibility/scene/level_meshes.h"
#include "formats/base/issues.h"
#include "formats/base/program.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

using namespace hearth;

constexpr int kExceeded = 1;

/// Ambient occlusion of each vertex of a mesh's finest level, cluster by cluster.
std::vector<float> computeOcclusion(const visibility::MeshPages& pages)
{
    std::vector<float> occlusion;
    for (const auto& part : visibility::extractFinestLevel(pages).parts)
    {
        const formats::ClusterGeometry geometry = pages.cluster(part.cluster);
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            occlusion.push_back(dot(geometry.normal(v), geometry.visibility(v).m1) / shared::kVisibilityPi);
    }
    return occlusion;
}

/// Print the differences and return their root mean square.
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

/// Compare all meshes and return the largest root mean square.
Result<double> compare(const std::string& baked_path, const std::string& reference_path)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView baked, tools::openPart(baked_path));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView reference, tools::openPart(reference_path));
    double largest = 0;
    for (uint32_t mesh = 0; mesh < std::min(baked.meshes().size(), reference.meshes().size()); ++mesh)
    {
        const formats::MeshRecord& record = baked.meshes()[mesh];
        if (record.clusters.count == 0 || (record.attributes & formats::kVertexVisibility) == 0)
            continue;
        HEARTH_ASSIGN_OR_RETURN(const auto pages, visibility::MeshPages::read(baked, mesh));
        HEARTH_ASSIGN_OR_RETURN(const auto reference_pages, visibility::MeshPages::read(reference, mesh));
        largest = std::max(largest, print(std::string(baked.text(record.name)).c_str(),
                                          computeOcclusion(pages), computeOcclusion(reference_pages)));
    }
    return largest;
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Compares the ambient occlusion of two clusters parts of one source.");
    std::string baked, reference;
    double max_rms = 0;
    app.addOption("baked", baked, "clusters part with visibility").required();
    app.addOption("reference", reference, "the same, baked better").required();
    app.addOption("--max-rms", max_rms, "exit with 1 if a mesh's root mean square is larger")
        .range(0.0, 1.0, "FLOAT");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<double> rms = compare(baked, reference);
    if (!rms.ok())
        return reportFailure(rms.error());
    return max_rms > 0 && *rms > max_rms ? kExceeded : 0;
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_compare_occlusion", [&] { return program(argc, argv); });
}
