// Tests that frames of moving and flickering lights are the same bytes whatever the threads of the driver,
// and whichever processor lists the lights. The renderer itself starts no thread.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <sstream>

namespace hearth::test
{

namespace
{

constexpr size_t kFrames = 200;
constexpr int kLamps = 40;

std::string floatBytes(const std::vector<float>& values)
{
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Add a square from a corner along two edges.
void addSquare(std::vector<float>& positions, const float (&corner)[3], const float (&a)[3],
               const float (&b)[3])
{
    constexpr int kSteps[6][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (const auto& step : kSteps)
        for (int axis = 0; axis < 3; ++axis)
            positions.push_back(corner[axis] + static_cast<float>(step[0]) * a[axis] +
                                static_cast<float>(step[1]) * b[axis]);
}

std::string number(double value)
{
    return std::to_string(value);
}

/// Write a floor and walls below lamps and spots, all of which flicker. Clip "carry" moves the node of the
/// first one to and fro.
void writeScene(const Sandbox& folder)
{
    std::vector<float> positions;
    addSquare(positions, {-8, 0, -8}, {16, 0, 0}, {0, 0, 16});
    for (int wall = 0; wall < 6; ++wall)
    {
        const auto place = static_cast<float>(wall);
        addSquare(positions, {2.4f * place - 7, 0, place - 5}, {1.5f, 0, 0.5f}, {0, 2, 0});
    }
    const size_t vertices = positions.size() / 3;
    std::string bytes = floatBytes(positions);
    const size_t times = bytes.size(), places = times + 12;
    bytes += floatBytes({0, 2, 4}) + floatBytes({-6, 1, 0, 6, 1, 2, -6, 1, 0});
    std::string lights, nodes = R"({"mesh":0})", separator;
    for (int i = 0; i < kLamps; ++i)
    {
        lights += separator + R"({"type":")" + (i % 3 == 0 ? "spot" : "point") +
                  R"(","intensity":6,"range":)" + number(1.5 + 0.1 * i) + R"(,"color":[1,)" +
                  number(0.02 * i) + R"(,0.5],)" + (i % 3 == 0 ? R"("spot":{"outerConeAngle":0.9},)" : "") +
                  R"("extras":{"flicker":{"rate":)" + number(3 + i % 9) + R"(,"amplitude":0.6,"seed":)" +
                  std::to_string(i) + "}}}";
        nodes += R"(,{"translation":[)" + number(7 * std::sin(i)) + "," + number(0.4 + 0.04 * i) + "," +
                 number(7 * std::cos(2.3 * i)) + R"(],"rotation":[-0.6,0,0,0.8],"extensions":)" +
                 R"({"KHR_lights_punctual":{"light":)" + std::to_string(i) + "}}}";
        separator = ",";
    }
    const auto view = [](size_t offset, size_t length)
    {
        return R"({"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" +
               std::to_string(length) + "}";
    };
    folder.write("scene.bin", bytes);
    folder.write("scene.gltf",
                 R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],)"
                 R"("extensions":{"KHR_lights_punctual":{"lights":[)" +
                     lights + R"(]}},"buffers":[{"uri":"scene.bin","byteLength":)" +
                     std::to_string(bytes.size()) + R"(}],"bufferViews":[)" + view(0, times) + "," +
                     view(times, 12) + "," + view(places, 36) +
                     R"(],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
                     std::to_string(vertices) +
                     R"(,"min":[-8,0,-8],"max":[8,2,8]},
{"bufferView":1,"componentType":5126,"type":"SCALAR","count":3,"min":[0],"max":[4]},
{"bufferView":2,"componentType":5126,"type":"VEC3","count":3}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[)" +
                     nodes + R"(],"animations":[{"name":"carry","samplers":[{"input":1,"output":2}],
"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}]})");
}

std::string imageName(size_t frame)
{
    const std::string digits = std::to_string(frame);
    return "out-" + std::string(4 - digits.size(), '0') + digits + ".png";
}

class LightThreads : public ::testing::Test
{
protected:
    void SetUp() override
    {
        writeScene(folder_);
        std::string path;
        for (size_t frame = 0; frame < kFrames; ++frame)
            path += number(0.01 * static_cast<double>(frame)) + ",3,9,0,0.5,0,50\n";
        folder_.write("path.txt", path);
        const ProgramEnd end = folder_.run({HEARTH_BIN "/hearth", "cook", "scene.gltf", "-o", "scene.hearth",
                                            "--visibility", "off", "--bricks", "off"});
        ASSERT_EQ(end.exit_code, 0) << end.err;
    }

    /// Draw the frames in a process of its own, and return their files. None if there is no device.
    /// threads  that the software driver draws with; 0: the one that submits
    std::vector<std::string> draw(const std::string& threads, const std::string& method,
                                  const std::string& lister)
    {
        std::istringstream words(
            "scene.hearth --size 48x32 --samples 1 --shadows off -o out.png --camera-path "
            "path.txt --time 0 --time-step 0.03 --animation carry --lights " +
            method + " --light-lists " + lister);
        std::vector<std::string> command{HEARTH_BIN "/hearth-render"};
        for (std::string word; words >> word;)
            command.push_back(word);
        const ProgramEnd end = folder_.run(command, {"LP_NUM_THREADS=" + threads});
        if (end.err.find("[E4002]") != std::string::npos)
            return {};
        EXPECT_EQ(end.exit_code, 0) << end.err;
        std::vector<std::string> images;
        for (size_t frame = 0; frame < kFrames; ++frame)
            images.push_back(folder_.read(imageName(frame)));
        return images;
    }

    Sandbox folder_;
};

} // namespace

TEST_F(LightThreads, framesAreTheSameBytesWhateverTheThreads)
{
    const std::vector<std::string> expected = draw("0", "practical", "gpu");
    if (expected.empty())
        GTEST_SKIP() << "no device";
    size_t changes = 0;
    for (size_t frame = 1; frame < kFrames; ++frame)
        changes += expected[frame] != expected[frame - 1] ? 1 : 0;
    EXPECT_EQ(changes, kFrames - 1) << "lights flicker from frame to frame";
    const auto expectSame =
        [&](const std::string& threads, const std::string& method, const std::string& lister)
    {
        const std::vector<std::string> drawn = draw(threads, method, lister);
        for (size_t frame = 0; frame < kFrames; ++frame)
            ASSERT_TRUE(drawn[frame] == expected[frame])
                << "frame " << frame << ", " << threads << " threads, " << method << ", lists by " << lister;
    };
    expectSame("2", "practical", "gpu");
    expectSame("5", "practical", "cpu");
    expectSame("1", "forward", "gpu");
}

} // namespace hearth::test
