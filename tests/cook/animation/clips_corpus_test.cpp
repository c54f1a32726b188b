// Compares compressed clips of real models, as hearth-import writes them, with the source's clips: every
// vertex in whole poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/source_mesh.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr size_t kTimesOfClip = trials(40);

struct ImportPart
{
    PackView view;
    std::map<uint32_t, mesh::SourceMesh> meshes;
};

/// Import a source with a clip tolerance of `error` metres; negative: the default.
ImportPart imported(const std::string& source, double error)
{
    const TemporaryFolder folder;
    const std::string part = folder.file("import.part"), profile = folder.file("profile.toml");
    if (error >= 0)
        std::ofstream(profile) << "[animation]\nerror = " << std::fixed << error << "\n";
    else
        std::ofstream(profile) << "";
    const std::string command = std::string(HEARTH_BIN) + "/hearth-import '" + source + "' -o '" + part +
                                "' --profile '" + profile + "' 2> /dev/null";
    HEARTH_ASSERT(std::system(command.c_str()) == 0);
    auto reader = ContainerReader::open(part);
    HEARTH_ASSERT(reader.ok());
    std::map<uint32_t, mesh::SourceMesh> meshes;
    for (uint32_t i = 0; reader->find(kChunkSourceMesh, i) != nullptr; ++i)
        meshes.emplace(i, mesh::readSourceMesh(*reader, i).value());
    return {PackView::read(std::move(reader).value()).value(), std::move(meshes)};
}

/// World transforms of nodes and joints in a pose.
class Placed
{
public:
    Placed(const AnimationTables& tables, const AnimationRecord& animation, double time)
        : tables_(tables), pose_(restPose(tables)), world_(tables.nodes.size())
    {
        sampleAnimation(tables, animation, time, pose_);
        poseNodes(tables, pose_, nodesParentsFirst(tables.nodes), world_);
    }

    std::vector<Double3> vertices(const mesh::SourceMesh& mesh, uint32_t node) const
    {
        const NodeRecord& record = tables_.nodes[node];
        std::vector<Affine3d> palette{world_[node]};
        if (record.skin != kInvalidIndex && !mesh.joint_sets.empty())
        {
            palette.resize(tables_.skins[record.skin].joints.count);
            skinPalette(tables_, tables_.skins[record.skin], world_, palette);
        }
        std::vector<Double3> places;
        for (size_t v = 0; v < mesh.vertexCount(); ++v)
            places.push_back(place(mesh, v, record, palette));
        return places;
    }

private:
    Double3 place(const mesh::SourceMesh& mesh, size_t v, const NodeRecord& node,
                  std::span<const Affine3d> palette) const
    {
        Double3 bound = widen(mesh.positions[v]);
        for (size_t t = 0; t < std::min<size_t>(mesh.morph_targets.size(), node.morph_weights.count); ++t)
            if (!mesh.morph_targets[t].positions.empty())
                bound = bound + widen(mesh.morph_targets[t].positions[v]) *
                                    pose_.morph_weights[node.morph_weights.first + t];
        if (mesh.joint_sets.empty())
            return transformPoint(palette[0], bound);
        Double3 sum;
        for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
        {
            const Float4 w = mesh.weight_sets[set][v];
            const std::array<float, 4> weights{w.x, w.y, w.z, w.w};
            for (size_t i = 0; i < weights.size(); ++i)
                if (weights[i] > 0)
                    sum = sum + transformPoint(palette[mesh.joint_sets[set][v].joint[i]], bound) *
                                    double{weights[i]};
        }
        return sum;
    }

    const AnimationTables& tables_;
    ScenePose pose_;
    std::vector<Affine3d> world_;
};

/// Compressed size of a model's clips, and the used share of their stated error.
struct Figures
{
    size_t source_bytes = 0, bytes = 0;
    double worst_share = 0;
};

size_t clipBytes(const PackView& view)
{
    return view.channels().size_bytes() + view.keys().size_bytes() + view.keyBits().size_bytes();
}

Figures compare(const ImportPart& source, const ImportPart& compressed)
{
    const AnimationTables wanted = animationTables(source.view), is = animationTables(compressed.view);
    Figures figures{clipBytes(source.view), clipBytes(compressed.view), 0};
    std::mt19937 random(1);
    for (size_t clip = 0; clip < wanted.animations.size(); ++clip)
    {
        const double error = double{is.animations[clip].error};
        std::uniform_real_distribution<double> any(-0.1, double{wanted.animations[clip].duration} * 1.1);
        for (size_t i = 0; i < kTimesOfClip; ++i)
        {
            const double time = any(random);
            const Placed source_pose(wanted, wanted.animations[clip], time);
            const Placed pose(is, is.animations[clip], time);
            double worst = 0;
            for (uint32_t node = 0; node < wanted.nodes.size(); ++node)
            {
                if (wanted.nodes[node].mesh == kInvalidIndex)
                    continue;
                const mesh::SourceMesh& mesh = source.meshes.at(wanted.nodes[node].mesh);
                const std::vector<Double3> a = source_pose.vertices(mesh, node),
                                           b = pose.vertices(mesh, node);
                for (size_t v = 0; v < a.size(); ++v)
                    worst = std::max(worst, length(a[v] - b[v]) - 1e-13 * length(a[v]));
            }
            EXPECT_LE(worst, error) << "clip " << clip << " at " << time;
            if (error > 0)
                figures.worst_share = std::max(figures.worst_share, worst / error);
        }
    }
    return figures;
}

std::vector<std::string> animatedSources(const std::string& assets)
{
    std::vector<std::string> sources;
    for (const char* folder : {"animation", "morph", "skinned", "draco-skinned"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(assets) / "good" / folder))
            if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
                sources.push_back(entry.path().string());
    std::sort(sources.begin(), sources.end());
    return sources;
}

} // namespace

TEST(ClipsOfRealModels, stayWithinTheErrorThatTheySay)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS does not name a folder of assets";
    size_t models = 0;
    double most_share = 0;
    for (const std::string& source : animatedSources(assets))
    {
        SCOPED_TRACE(source);
        if (kSanitized && std::filesystem::file_size(source) > kLargeFile)
            continue;
        const ImportPart exact = imported(source, 0);
        if (exact.view.animations().empty())
            continue;
        ++models;
        for (const double error : {-1.0, 0.01})
        {
            const Figures figures = compare(exact, imported(source, error));
            EXPECT_LE(figures.bytes, figures.source_bytes);
            most_share = std::max(most_share, figures.worst_share);
            std::printf("%s, %s: %zu bytes of %zu, off by %.2f of the proven error at most\n",
                        std::filesystem::path(source).filename().c_str(), error < 0 ? "default" : "0.01 m",
                        figures.bytes, figures.source_bytes, figures.worst_share);
        }
    }
    EXPECT_GE(models, kSanitized ? 8u : 15u);
    // if all bounds were far too wide, clips would be larger than necessary
    EXPECT_GT(most_share, 0.1);
}

} // namespace hearth::test
