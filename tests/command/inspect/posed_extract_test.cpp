// Compares posed meshes from hearth extract with a plain implementation of glTF's animation and skinning.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/deformation.h"
#include "tests/support/deformed_model.h"
#include "tests/support/sandbox.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr double kTolerance = 1e-5; ///< relative to the model's size
constexpr size_t kTimes = kSanitized ? 1 : 6;

/// Read the positions of a PLY file that extract writes.
std::vector<Float3> plyPositions(const std::string& bytes)
{
    const std::string end = "end_header\n";
    const size_t data = bytes.find(end) + end.size();
    const std::string header = bytes.substr(0, data);
    const size_t count_at = header.find("element vertex ") + std::strlen("element vertex ");
    const size_t count = std::stoul(header.substr(count_at));
    const size_t stride = 4 * countOccurrences(header, "property float ");
    std::vector<Float3> positions(count);
    for (size_t i = 0; i < count; ++i)
        std::memcpy(&positions[i], bytes.data() + data + i * stride, sizeof(Float3));
    return positions;
}

/// Return the largest distance of a point to the nearest of the others.
double farthest(const std::vector<Float3>& points, std::vector<Float3> others)
{
    const auto byX = [](Float3 a, Float3 b) { return a.x < b.x; };
    std::sort(others.begin(), others.end(), byX);
    double worst = 0;
    for (const Float3 p : points)
    {
        const auto start = std::lower_bound(others.begin(), others.end(), p, byX);
        double nearest = std::numeric_limits<double>::infinity();
        for (auto it = start; it != others.end() && double{it->x} - double{p.x} < nearest; ++it)
            nearest = std::min(nearest, double{length(*it - p)});
        for (auto it = start; it != others.begin() && double{p.x} - double{(it - 1)->x} < nearest; --it)
            nearest = std::min(nearest, double{length(*(it - 1) - p)});
        worst = std::max(worst, nearest);
    }
    return worst;
}

/// Return the vertices that triangles use.
std::vector<Float3> usedPlaces(const mesh::SourceMesh& mesh, const std::vector<Float3>& places)
{
    std::vector<Float3> used;
    std::vector<uint8_t> seen(places.size(), 0);
    for (const uint32_t index : mesh.indices)
        if (std::exchange(seen[index], uint8_t{1}) == 0)
            used.push_back(places[index]);
    return used;
}

/// Return a clip of the scene as the command line names it.
std::string getName(const PackView& scene, uint32_t animation)
{
    const std::string_view name = scene.text(scene.animations()[animation].name);
    return name.empty() ? std::to_string(animation) : std::string(name);
}

class PosedExtract
{
public:
    explicit PosedExtract(const std::string& source) : model_(DeformedModel::importExactly(source))
    {
        if (model_ == nullptr)
            return;
        // exporters write up to eight influences: all of them are compared
        sandbox_.write("all.toml", "[clusters]\ninfluences = 8\n");
        const ProgramEnd end = sandbox_.run({std::string(HEARTH_BIN) + "/hearth", "cook", source, "--profile",
                                             sandbox_ / "all.toml", "-o", sandbox_ / "a.hearth"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
    }

    bool deforms() const { return model_ != nullptr && !model_->meshes().empty(); }

    void check()
    {
        for (const DeformedModel::Mesh& mesh : model_->meshes())
        {
            SCOPED_TRACE("mesh " + std::to_string(mesh.index));
            mesh::SourceMesh reduced = mesh.source;
            if (mesh::reduceInfluences(reduced, 8).vertex_count > 0)
            {
                std::printf("  mesh %u has more than 8 influences: not compared\n", mesh.index);
                continue;
            }
            MeshPoses poses(animationTables(model_->scene()), mesh.node, mesh.index);
            compare(mesh, poses.rest(), {});
            std::mt19937 random(mesh.index);
            const auto clips = static_cast<uint32_t>(model_->scene().animations().size());
            for (size_t i = 0; i < kTimes && clips > 0; ++i)
            {
                const auto clip = static_cast<uint32_t>(random() % clips);
                std::uniform_real_distribution<double> time(
                    -0.1, 1.1 * double{model_->scene().animations()[clip].duration});
                const double seconds = time(random);
                compare(mesh, poses.at(clip, seconds),
                        {"--animation", getName(model_->scene(), clip), "--time", std::to_string(seconds)});
            }
        }
    }

    double worst() const { return worst_; }

private:
    void compare(const DeformedModel::Mesh& mesh, const MeshPose& pose,
                 const std::vector<std::string>& options)
    {
        std::vector<std::string> command{std::string(HEARTH_BIN) + "/hearth",
                                         "extract",
                                         sandbox_ / "a.hearth",
                                         "--mesh",
                                         std::to_string(mesh.index),
                                         "--error",
                                         "0",
                                         "-o",
                                         sandbox_ / "a.ply"};
        command.insert(command.end(), options.begin(), options.end());
        const ProgramEnd end = sandbox_.run(command);
        ASSERT_EQ(end.exit_code, 0) << end.err;
        const std::vector<Float3> extracted = plyPositions(sandbox_.read("a.ply"));
        const std::vector<Float3> wanted = usedPlaces(mesh.source, posed(mesh.source, pose));
        Box3 box;
        for (const Float3 p : wanted)
            box.add(p);
        const double size = double{length(box.max - box.min)};
        // degenerate triangles are dropped: their corners are tested only in one direction
        const double off = farthest(extracted, wanted) / size;
        EXPECT_LE(off, kTolerance) << (options.empty() ? "rest pose" : options[1] + " at " + options[3]);
        worst_ = std::max(worst_, off);
    }

    std::unique_ptr<DeformedModel> model_;
    Sandbox sandbox_;
    double worst_ = 0;
};

} // namespace

TEST(PosedExtract, equalsGltfSkinning)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("character.glb");
    const std::string triangles = kSanitized ? "3000" : "20000";
    ASSERT_EQ(std::system((std::string(HEARTH_BIN) + "/hearth-samples character --triangles " + triangles +
                           " -o '" + file + "'")
                              .c_str()),
              0);
    PosedExtract extract(file);
    ASSERT_TRUE(extract.deforms());
    extract.check();
}

TEST(PosedExtract, equalsGltfSkinningOfRealModels)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS does not name a folder of assets";
    std::vector<std::filesystem::path> sources;
    for (const char* folder : {"animation", "morph", "skinned", "draco-skinned"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(assets) / "good" / folder))
            if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
                sources.push_back(entry.path());
    std::sort(sources.begin(), sources.end());
    size_t count = 0;
    for (const auto& source : sources)
    {
        if (kSanitized && std::filesystem::file_size(source) > kLargeFile)
            continue;
        SCOPED_TRACE(source.string());
        PosedExtract extract(source.string());
        if (!extract.deforms())
            continue;
        extract.check();
        std::printf("%s: off by %.1e of its size at most\n", source.filename().c_str(), extract.worst());
        ++count;
    }
    EXPECT_GE(count, kSanitized ? 5u : 10u);
}

} // namespace hearth::test
