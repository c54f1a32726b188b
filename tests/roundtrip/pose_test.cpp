// Tests that culling changes no pixel of characters cooked by the real programs, in poses of their clips and
// between them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "runtime/pack/pose_player.h"
#include "runtime/viewer/camera_fit.h"
#include "tests/roundtrip/cooked_sample.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace hearth::test
{

namespace
{

using namespace shared;

/// Random times of clips, some beyond their ends, some of two clips at once.
class RandomPoses
{
public:
    RandomPoses(const formats::PackView& pack, uint32_t seed) : pack_(pack), player_(pack), random_(seed) {}

    /// Inputs of a frame.
    struct Frame
    {
        std::vector<gpu::InstanceMove> moves;
        std::vector<gpu::InstancePose> poses;
    };
    Frame next(const gpu::Scene& scene)
    {
        if (random_() % 2 == 0)
            player_.play(clip());
        else
            player_.blend(clip(), clip(), static_cast<double>(uniform(random_, 0, 1)));
        Frame frame;
        for (const pack::MovedInstance& moved : player_.moved())
        {
            const auto move = gpu::moveInstance(scene, moved.instance, moved.world_from_object);
            HEARTH_ASSERT(move.ok());
            frame.moves.push_back(*move);
        }
        for (const pack::PosedInstance& posed : player_.posed())
            frame.poses.push_back({.instance = posed.instance,
                                   .world_from_bind = posed.world_from_bind,
                                   .morph_weights = posed.morph_weights});
        return frame;
    }

    /// Random camera near or within the current geometry.
    Camera camera()
    {
        Camera camera = viewer::fitCamera(pack_, player_, 1);
        const float distance = length(camera.position - camera.target);
        const Float3 way = normalizeOr(
            {uniform(random_, -1, 1), uniform(random_, -0.6f, 1), uniform(random_, -1, 1)}, {0, 0, 1});
        camera.position = camera.target + way * (distance * uniform(random_, 0.1f, 1.5f));
        camera.target += way * uniform(random_, -0.2f, 0.2f);
        camera.y_fov_rad = uniform(random_, 0.3f, 1.4f);
        return camera;
    }

private:
    pack::ClipTime clip()
    {
        const auto number = static_cast<uint32_t>(random_() % pack_.animations().size());
        const float seconds = pack_.animations()[number].duration;
        return {number, static_cast<double>(uniform(random_, -0.1f, 1.1f) * seconds)};
    }

    const formats::PackView& pack_;
    pack::PosePlayer player_;
    std::mt19937 random_;
};

/// Add a level of detail (MSFT_lod) to the character of a GLB: the first half of its triangles. Returns their
/// number.
uint32_t addLevelOfHalf(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    constexpr size_t kJson = 20; // behind the header and the chunk's own
    uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, sizeof(size));
    Json json = Json::parse(bytes.substr(kJson, size)).value();
    const auto node = static_cast<size_t>(std::find_if(json["nodes"].begin(), json["nodes"].end(),
                                                       [](const Json& n) { return n.contains("skin"); }) -
                                          json["nodes"].begin());
    Json mesh = json["meshes"][json["nodes"][node]["mesh"].get<size_t>()];
    Json accessor = json["accessors"][mesh["primitives"][0]["indices"].get<size_t>()];
    const uint32_t triangles = accessor["count"].get<uint32_t>() / 6;
    accessor["count"] = triangles * 3;
    accessor.erase("min");
    accessor.erase("max");
    mesh["primitives"] = Json::array({mesh["primitives"][0]});
    mesh["primitives"][0]["indices"] = json["accessors"].size();
    json["accessors"].push_back(accessor);
    json["nodes"].push_back({{"mesh", json["meshes"].size()}, {"skin", json["nodes"][node]["skin"]}});
    json["meshes"].push_back(mesh);
    json["nodes"][node]["extensions"]["MSFT_lod"]["ids"] = {json["nodes"].size() - 1};
    json["extensionsUsed"].push_back("MSFT_lod");

    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string changed = bytes.substr(0, kJson) + text + bytes.substr(kJson + size);
    const auto put = [&](size_t at, size_t value)
    {
        const auto word = static_cast<uint32_t>(value);
        std::memcpy(changed.data() + at, &word, sizeof(word));
    };
    put(8, changed.size());
    put(12, text.size());
    std::ofstream(file, std::ios::binary) << changed;
    return triangles;
}

class PoseTest : public GpuTest
{
protected:
    void expectLossless(const formats::PackView& pack, int frames, uint32_t seed)
    {
        ASSERT_FALSE(pack.animations().empty());
        ASSERT_FALSE(pack.deformedMeshes().empty());
        RandomPoses poses(pack, seed);
        const auto scene = upload(pack);
        gpu::FrameTargets targets = makeTargets(96, 96);
        Camera camera;
        for (int frame = 0; frame < frames; ++frame)
        {
            const RandomPoses::Frame now = poses.next(*scene);
            if (frame % 5 == 0)
                camera = poses.camera();
            DrawOptions options{.width = 96,
                                .height = 96,
                                .error_pixels = frame % 3 == 0 ? 0.0f : 2.0f,
                                .moves = now.moves,
                                .poses = now.poses};
            const Image some = draw(*scene, targets, camera, options);
            options.flags = 0;
            const Image whole = draw(*scene, camera, options);
            ASSERT_EQ(some.seen(), whole.seen()) << "frame " << frame;
            drawn_ += some.list.slots.size();
            all_ += whole.list.slots.size();
        }
    }

    size_t drawn_ = 0, all_ = 0;
};

} // namespace

TEST_F(PoseTest, cullingIsLosslessOnTheSampleCharacter)
{
    const roundtrip::CookedSample& sample = roundtrip::cookedSample({"character", 20000});
    expectLossless(sample.pack(), 300, 81);
    EXPECT_LT(drawn_, all_);
    std::printf("character: %zu of %zu clusters drawn\n", drawn_, all_);
}

TEST_F(PoseTest, levelsMadeByHandSwitchAsAWholeInEveryPose)
{
    // The authored level has half of the triangles; the missing half is a hole, and determines its error.
    const roundtrip::ScratchFolder folder;
    const std::string source = folder.path("character.glb"), cooked = folder.path("character.hearth");
    ASSERT_EQ(
        roundtrip::runProgram(roundtrip::Program::samples, {"character", "--triangles", "6000", "-o", source})
            .exit_code,
        0);
    const uint32_t by_hand = addLevelOfHalf(source);
    const auto end = roundtrip::runProgram(roundtrip::Program::hearth, {"cook", source, "-o", cooked});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    const auto opened = pack::Pack::open(cooked);
    ASSERT_TRUE(opened.ok());
    const formats::PackView& pack = opened->view();
    const auto levels = formats::recordsInRange(pack.levels(), pack.meshes()[0].levels);
    const auto found =
        std::find_if(levels.begin(), levels.end(),
                     [&](const formats::LevelRecord& level) { return level.triangle_count == by_hand; });
    ASSERT_NE(found, levels.end());
    const auto authored = static_cast<uint8_t>(found - levels.begin());

    RandomPoses poses(pack, 84);
    const auto scene = upload(pack);
    gpu::FrameTargets targets = makeTargets(96, 96);
    size_t before = 0, at = 0;
    for (int frame = 0; frame < 60; ++frame)
    {
        const RandomPoses::Frame now = poses.next(*scene);
        const Camera camera = poses.camera();
        DrawOptions options{.width = 96,
                            .height = 96,
                            .error_pixels = std::exp2(static_cast<float>(frame % 12) - 2),
                            .moves = now.moves,
                            .poses = now.poses};
        const Image some = draw(*scene, targets, camera, options);
        options.flags = 0;
        const Image whole = draw(*scene, camera, options);
        ASSERT_EQ(some.seen(), whole.seen()) << "frame " << frame;
        size_t finer = 0;
        for (const auto& slot : whole.list.slots)
            finer += pack.clusters()[slot.cluster].level < authored ? 1u : 0u;
        EXPECT_TRUE(finer == 0 || finer == whole.list.slots.size())
            << "frame " << frame << " mixes both sides";
        (finer == 0 ? at : before) += whole.list.slots.empty() ? 0u : 1u;
    }
    EXPECT_GT(before, 5u);
    EXPECT_GT(at, 5u);
}

TEST_F(PoseTest, cullingIsLosslessOnRealAssets)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    const roundtrip::ScratchFolder folder;
    uint32_t seed = 90;
    for (const char* file :
         {"skinned/fox/Fox.glb", "skinned/kaykit_mage", "skinned/tube_300joints", "morph/morph_stress"})
    {
        SCOPED_TRACE(file);
        std::filesystem::path source = std::filesystem::path(assets) / "good" / file;
        if (std::filesystem::is_directory(source))
            for (const auto& entry : std::filesystem::directory_iterator(source))
                if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
                    source = entry.path();
        const std::string cooked = folder.path(std::to_string(seed) + ".hearth");
        const auto end =
            roundtrip::runProgram(roundtrip::Program::hearth, {"cook", source.string(), "-o", cooked});
        ASSERT_EQ(end.exit_code, 0) << end.errors;
        const auto opened = pack::Pack::open(cooked);
        ASSERT_TRUE(opened.ok());
        expectLossless(opened->view(), 60, seed++);
    }
    EXPECT_LT(drawn_, all_);
    std::printf("real assets: %zu of %zu clusters drawn\n", drawn_, all_);
}

} // namespace hearth::test
