// Checks the bounds of every deformed mesh of the asset corpus and of the generated character, cooked by the
// real programs, in ten thousand poses each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_reader.h"
#include "tests/cook/animation/posed_models.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

constexpr size_t kPoses = 10'000;
constexpr size_t kPosesOfCharacter = 2'500; ///< of the generated one, which every run of the tests checks
constexpr double kMaxVolume = 1.5;

// Assets whose clusters have many joints, on coarse levels all of them, and the largest volume of their
// boxes.
constexpr std::array<std::string_view, 3> kManyJoints{"Fox", "Mage", "tube_300joints"};
constexpr double kMaxVolumeOfManyJoints = 2.0;

/// True if a glTF or GLB file has skins or morph targets. Both formats keep their JSON as text.
bool isDeformed(const std::filesystem::path& path)
{
    if (path.extension() != ".gltf" && path.extension() != ".glb")
        return false;
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return text.find("\"skins\"") != std::string::npos || text.find("\"targets\"") != std::string::npos;
}

std::vector<std::string> deformedAssets(const std::string& folder)
{
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && isDeformed(entry.path()))
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

class SkinningCorpus : public ::testing::Test
{
protected:
    /// Check the bounds in the pack of a source.
    BoundsFigures check(const std::string& source, size_t poses = kPoses)
    {
        const std::string pack = sandbox_ / "asset.hearth";
        const ProgramEnd end = sandbox_.run({HEARTH_BIN "/hearth", "cook", "-q", source, "-o", pack});
        EXPECT_EQ(end.exit_code, 0) << source << ": " << end.err;
        if (end.exit_code != 0)
            return {};
        const formats::PackView view =
            formats::PackView::read(formats::ContainerReader::open(pack).value()).value();
        const Result<std::vector<PosedMesh>> meshes = posedMeshes(view);
        EXPECT_TRUE(meshes.ok()) << source;
        BoundsFigures figures;
        if (!meshes.ok())
            return figures;
        for (const PosedMesh& mesh : *meshes)
            figures += checkBounds(formats::animationTables(view), mesh, poses, 1);
        EXPECT_EQ(figures.violations, 0u) << source << ": by up to " << figures.worst;
        EXPECT_EQ(figures.facing_wrong, 0u) << source;
        std::printf("%s: %zu clusters, %zu with cones, volume %.3f x the tightest box, finest level %.3f\n",
                    source.c_str(), figures.clusters, figures.cones, volumeOfAll(figures),
                    volumeOfFinest(figures));
        return figures;
    }

    static double volumeOfAll(const BoundsFigures& figures)
    {
        return figures.volume_ratio / static_cast<double>(std::max(figures.clusters, size_t{1}));
    }
    static double volumeOfFinest(const BoundsFigures& figures)
    {
        return figures.finest_volume_ratio /
               static_cast<double>(std::max(figures.finest_clusters, size_t{1}));
    }

    Sandbox sandbox_;
};

} // namespace

TEST_F(SkinningCorpus, generatedCharacter)
{
    const std::string source = sandbox_ / "character.glb";
    ASSERT_EQ(sandbox_.run({HEARTH_BIN "/hearth-samples", "character", "-o", source}).exit_code, 0);
    const BoundsFigures figures = check(source, kPosesOfCharacter);
    ASSERT_GT(figures.clusters, 0u);
    EXPECT_GT(figures.cones, figures.clusters / 10) << "most of a character hardly bends";
    EXPECT_LE(volumeOfAll(figures), kMaxVolume);
}

TEST_F(SkinningCorpus, everyDeformedAsset)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS does not name a folder of assets";
    BoundsFigures figures;
    for (const std::string& path : deformedAssets(std::string(assets) + "/good"))
    {
        const BoundsFigures asset = check(path);
        if (std::ranges::find(kManyJoints, std::filesystem::path(path).stem().string()) != kManyJoints.end())
        {
            EXPECT_LE(volumeOfAll(asset), kMaxVolumeOfManyJoints) << path;
        }
        figures += asset;
    }
    ASSERT_GT(figures.clusters, 0u);
    std::printf("%zu clusters: volume %.3f x the tightest box, finest level %.3f\n", figures.clusters,
                volumeOfAll(figures), volumeOfFinest(figures));
    EXPECT_LE(volumeOfAll(figures), kMaxVolume);
    EXPECT_LE(volumeOfFinest(figures), kMaxVolume);
}

} // namespace hearth::test
