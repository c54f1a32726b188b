// Tests lights that change, from a glTF file to images, with the real programs on any Vulkan device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"

#include <cstring>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

std::string floatBytes(const std::vector<float>& values)
{
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// A floor below a lamp that flickers. Clip "dim" lowers its intensity from 40 to 4 in two seconds, "carry"
/// moves its node two metres aside.
constexpr const char* kScene = R"({"asset":{"version":"2.0"},
"extensionsUsed":["KHR_lights_punctual","KHR_animation_pointer"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","name":"torch","intensity":40,
    "extras":{"flicker":{"rate":8,"amplitude":0.5,"seed":5}}}]}},
"buffers":[{"uri":"scene.bin","byteLength":112}],
"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":8},
    {"buffer":0,"byteOffset":80,"byteLength":8},{"buffer":0,"byteOffset":88,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":6,"min":[-4,0,-4],"max":[4,0,4]},
    {"bufferView":1,"componentType":5126,"type":"SCALAR","count":2,"min":[0],"max":[2]},
    {"bufferView":2,"componentType":5126,"type":"SCALAR","count":2},
    {"bufferView":3,"componentType":5126,"type":"VEC3","count":2}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"nodes":[{"mesh":0},{"translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}}],
"animations":[{"name":"dim","samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"path":"pointer",
    "extensions":{"KHR_animation_pointer":{"pointer":"/extensions/KHR_lights_punctual/lights/0/intensity"}}}}]},
  {"name":"carry","samplers":[{"input":1,"output":3}],
    "channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}]})";

constexpr const char* kCamera = "0,3,7,0,0,0,50";

class LightAnimation : public ::testing::Test
{
protected:
    void SetUp() override
    {
        folder_.write("scene.gltf", kScene);
        folder_.write("scene.bin",
                      floatBytes({-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, 4, 4, 0, -4, -4, 0, -4, // floor
                                  0,  2,                                                      // times
                                  40, 4,                                                      // intensity
                                  0,  2, 0,  2,  2, 0}));                                     // translation
        folder_.write("path.txt", kCamera + std::string("\n") + kCamera + "\n" + kCamera + "\n");
        const ProgramEnd end = folder_.run({HEARTH_BIN "/hearth", "cook", "scene.gltf", "-o", "scene.hearth",
                                            "--visibility", "off", "--bricks", "off"});
        ASSERT_EQ(end.exit_code, 0) << end.err;
    }

    /// Write images of the scene. False if there is no device.
    bool render(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {HEARTH_BIN "/hearth-render", "scene.hearth", "--size", "48x32",
                                             "--samples", "1", "-o", "out.png"});
        const ProgramEnd end = folder_.run(arguments);
        if (end.err.find("[E4002]") != std::string::npos)
            return false;
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return true;
    }

    /// Return the image half a second from the start, as PNG.
    std::string draw(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.end(), {"--camera", kCamera, "--time", "0.5"});
        render(arguments);
        return folder_.read("out.png");
    }

    Sandbox folder_;
};

} // namespace

TEST_F(LightAnimation, equalTimesGiveEqualImagesAndOthersDiffer)
{
    if (!render({"--camera-path", "path.txt", "--time", "0.25", "--time-step", "0.125"}))
        GTEST_SKIP() << "no device";
    const std::string first = folder_.read("out-0000.png"), second = folder_.read("out-0001.png"),
                      third = folder_.read("out-0002.png"), still = draw({});
    EXPECT_FALSE(first == second) << "the torch flickers without a clip";
    EXPECT_FALSE(second == third);
    EXPECT_TRUE(third == still) << "the same time";

    const std::string dimmed = draw({"--animation", "dim"}), carried = draw({"--animation", "carry"});
    EXPECT_FALSE(dimmed == still);
    EXPECT_FALSE(carried == still);
    EXPECT_FALSE(carried == dimmed);
}

} // namespace hearth::test
