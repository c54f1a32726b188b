// Tests the import of lights that change: channels of KHR_animation_pointer, and flicker from extras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/records/animation_paths.h"
#include "pipelines/import/gltf/import_gltf.h"
#include "pipelines/import/source/file_bytes.h"
#include "tests/pipelines/gltf_fixture.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <numbers>

namespace hearth::import::test
{

using namespace formats;
using testing::HasSubstr;

namespace
{

using Floats = std::vector<float>;

/// Lights: a spot, which two nodes have, a lamp, and one that no node has. A fourth node is empty.
constexpr const char* kScene = R"("extensionsUsed":["KHR_lights_punctual","KHR_animation_pointer"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","name":"beam"},{"type":"point"},{"type":"point"}]}},
    "materials":[{}],"nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}},
    {"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":0}}},{}],)";

std::string channel(int sampler, const std::string& pointer)
{
    return fmt::format(
        R"({{"sampler":{},"target":{{"path":"pointer","extensions":{{"KHR_animation_pointer":{{"pointer":"{}"}}}}}}}})",
        sampler, pointer);
}

std::string lightPointer(int light, const std::string& property)
{
    return fmt::format("/extensions/KHR_lights_punctual/lights/{}/{}", light, property);
}

/// Import the scene with a clip.
/// channels  JSON, comma-separated
Imported importClip(const GltfData& data, const std::string& samplers, const std::string& channels)
{
    return data.import(std::string(kScene) + R"("animations":[{"samplers":[)" + samplers +
                       R"(],"channels":[)" + channels + "]}]");
}

/// Import the scene with a channel of two keys.
Imported importChannel(const std::string& json, const std::string& type = "SCALAR",
                       const Floats& values = {1, 2})
{
    GltfData data;
    data.add("SCALAR", Floats{0, 1});
    data.add(type, values);
    return importClip(data, R"({"input":0,"output":1})", json);
}

/// Return the values of a channel, with its tangents.
Floats keyValues(const Imported& result, const AnimationChannelRecord& record)
{
    const Floats keys = result.records<float>(kChunkKeys);
    const size_t count = size_t{record.key_count} * record.components * (record.interpolation == 2 ? 3 : 1);
    const auto first = keys.begin() + static_cast<std::ptrdiff_t>(record.first_value);
    return {first, first + static_cast<std::ptrdiff_t>(count)};
}

/// Import a lamp with these extras.
Imported importExtras(const std::string& extras)
{
    return GltfData().import(
        R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","name":"torch","extras":)" +
        extras + R"(}]}},"nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])");
}

} // namespace

TEST(GltfLights, channelsOfAllPropertiesAndInterpolationsAreKept)
{
    struct Property
    {
        AnimationPath path;
        Floats values; ///< three keys, for a spline with tangents
    };
    const std::vector<Property> properties{
        {AnimationPath::light_color, {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {AnimationPath::light_intensity, {5, 0, 1000}},
        {AnimationPath::light_range, {1, 2.5f, 9}},
        {AnimationPath::light_inner_cone, {0, 0.25f, 0.5f}},
        {AnimationPath::light_outer_cone, {0.5f, 1, 1.5f}},
    };
    const std::pair<const char*, Interpolation> interpolations[] = {
        {"STEP", Interpolation::step},
        {"LINEAR", Interpolation::linear},
        {"CUBICSPLINE", Interpolation::cubic_spline}};
    for (const auto& [name, interpolation] : interpolations)
        for (const Property& property : properties)
        {
            const AnimationPathInfo& info = kAnimationPaths[static_cast<size_t>(property.path)];
            Floats values;
            for (size_t key = 0; key < 3; ++key)
            {
                const bool spline = interpolation == Interpolation::cubic_spline;
                const auto first =
                    property.values.begin() + static_cast<std::ptrdiff_t>(key * info.components);
                values.insert(values.end(), spline ? info.components : 0, -7); // tangents may be negative
                values.insert(values.end(), first, first + info.components);
                values.insert(values.end(), spline ? info.components : 0, 8);
            }
            GltfData data;
            data.add("SCALAR", Floats{0, 1, 4});
            data.add(info.components == 3 ? "VEC3" : "SCALAR", values);
            const Imported result =
                importClip(data, fmt::format(R"({{"input":0,"output":1,"interpolation":"{}"}})", name),
                           channel(0, lightPointer(0, std::string(info.name))));
            ASSERT_TRUE(result.ok()) << result.message();
            EXPECT_FALSE(result.hasWarning(Issue::dropped, "") || result.hasWarning(Issue::repaired, ""));
            const auto animation = result.records<AnimationRecord>(kChunkAnimations)[0];
            EXPECT_EQ(animation.channels.count, 0u);
            ASSERT_EQ(animation.light_channels.count, 2u) << "two nodes have the light";
            EXPECT_EQ(animation.duration, 4);
            const auto channels = result.records<AnimationChannelRecord>(kChunkChannels);
            EXPECT_EQ(channels[0].target, 0u);
            EXPECT_EQ(channels[1].target, 2u);
            EXPECT_EQ(channels[0].first_value, channels[1].first_value) << "the keys are shared";
            EXPECT_EQ(channels[0].path, static_cast<uint32_t>(property.path));
            EXPECT_EQ(channels[0].interpolation, static_cast<uint32_t>(interpolation));
            EXPECT_EQ(channels[0].components, info.components);
            EXPECT_EQ(keyValues(result, channels[0]), values);
        }
}

TEST(GltfLights, channelsOfLightsFollowThoseOfNodes)
{
    GltfData data;
    data.add("SCALAR", Floats{0, 1});
    data.add("SCALAR", Floats{0, 1});
    data.add("VEC3", Floats(6));
    const Imported result = importClip(data, R"({"input":0,"output":1},{"input":0,"output":2})",
                                       channel(0, lightPointer(1, "intensity")) +
                                           R"(,{"sampler":1,"target":{"node":3,"path":"translation"}})");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto animation = result.records<AnimationRecord>(kChunkAnimations)[0];
    EXPECT_EQ(animation.channels.first, 0u);
    EXPECT_EQ(animation.channels.count, 1u);
    EXPECT_EQ(animation.light_channels.first, 1u);
    EXPECT_EQ(animation.light_channels.count, 1u);
    const auto channels = result.records<AnimationChannelRecord>(kChunkChannels);
    EXPECT_EQ(channels[0].target, 3u);
    EXPECT_EQ(channels[1].target, 1u);
}

TEST(GltfLights, keysOutsideTheirRangeAreClamped)
{
    const auto clamped = [](const std::string& property, const std::string& type, const Floats& values)
    {
        const Imported result = importChannel(channel(0, lightPointer(0, property)), type, values);
        EXPECT_TRUE(result.ok()) << result.message();
        EXPECT_TRUE(result.hasWarning(Issue::repaired, "outside their range")) << property;
        return keyValues(result, result.records<AnimationChannelRecord>(kChunkChannels)[0]);
    };
    constexpr float kRightAngle = std::numbers::pi_v<float> / 2;
    EXPECT_EQ(clamped("intensity", "SCALAR", {-1, 2}), (Floats{0, 2}));
    EXPECT_EQ(clamped("range", "SCALAR", {0, 2}), (Floats{0.001f, 2}));
    EXPECT_EQ(clamped("spot/innerConeAngle", "SCALAR", {-1, 2}), (Floats{0, kRightAngle}));
    EXPECT_EQ(clamped("spot/outerConeAngle", "SCALAR", {1, 3}), (Floats{1, kRightAngle}));
    EXPECT_EQ(clamped("color", "VEC3", {1, -1, 0, 2, 1, 0}), (Floats{1, 0, 0, 2, 1, 0}));
}

TEST(GltfLights, pointersToOtherPropertiesAreDroppedByName)
{
    const std::string others[] = {"/materials/0/pbrMetallicRoughness/baseColorFactor",
                                  "/nodes/0/translation",
                                  lightPointer(0, "name"),
                                  lightPointer(0, "spot"),
                                  lightPointer(0, ""),
                                  lightPointer(1, "spot/innerConeAngle")};
    for (const std::string& pointer : others)
    {
        const Imported result = importChannel(channel(0, pointer));
        ASSERT_TRUE(result.ok()) << result.message();
        EXPECT_TRUE(result.hasWarning(Issue::dropped, fmt::format("animation of \"{}\"", pointer)));
        EXPECT_TRUE(result.records<AnimationChannelRecord>(kChunkChannels).empty());
    }
    const Imported unused = importChannel(channel(0, lightPointer(2, "intensity")));
    ASSERT_TRUE(unused.ok()) << unused.message();
    EXPECT_TRUE(unused.hasWarning(Issue::dropped, "a light that no drawn node has"));
}

TEST(GltfLights, pointersThatCannotBeAreRefused)
{
    const auto refusal = [](const std::string& json)
    {
        const Imported result = importChannel(json);
        EXPECT_FALSE(result.ok()) << json;
        return result.message();
    };
    EXPECT_THAT(refusal(channel(0, lightPointer(3, "color"))), HasSubstr("names light 3, but there are 3"));
    for (const char* index : {"", "x", "-1", "01", "1x", "99999999999"})
        EXPECT_THAT(
            refusal(channel(0, fmt::format("/extensions/KHR_lights_punctual/lights/{}/color", index))),
            HasSubstr(fmt::format("has \"{}\" where the index of a light belongs", index)));
    EXPECT_THAT(refusal(channel(0, "extensions")), HasSubstr("\"extensions\" is not a JSON pointer"));
    EXPECT_THAT(
        refusal(R"({"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{}}}})"),
        HasSubstr("pointer"));
    EXPECT_THAT(refusal(channel(0, lightPointer(0, "color"))), HasSubstr("cannot be a SCALAR of FLOAT"));
}

/// Imports UnityGLTF's sample of the extension.
TEST(GltfLights, channelsOfAnExporterAreKept)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    const std::string path = std::string(assets == nullptr ? "" : assets) +
                             "/good/animation/animation_pointer/24_animation_pointer.gltf";
    std::ifstream file(path, std::ios::binary);
    if (!file)
        GTEST_SKIP() << "HEARTH_ASSETS does not name a folder with the sample";
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto content = std::as_bytes(std::span(text));
    const TemporaryFolder folder;
    auto part = PartBuilder::create(folder.path("out.part"), "sample.gltf");
    ASSERT_TRUE(part.ok());
    const Status status = importGltf(path, FileBytes({content.begin(), content.end()}), {}, *part);
    ASSERT_TRUE(status.ok()) << formatMessage(status.error());
    ASSERT_EQ(part->animations.size(), 1u);
    ASSERT_EQ(part->animations[0].light_channels.count, 11u);
    std::map<std::string, uint32_t> keys; ///< of the spot with a range
    for (const AnimationChannelRecord& record : part->channels)
        if (kAnimationPaths[record.path].of_light &&
            part->text(part->lights[record.target].name) == "KHR_lights_punctual-spot2")
            keys[std::string(kAnimationPaths[record.path].name)] = record.key_count;
    EXPECT_EQ(keys, (std::map<std::string, uint32_t>{{"color", 301},
                                                     {"intensity", 208},
                                                     {"range", 99},
                                                     {"spot/innerConeAngle", 208},
                                                     {"spot/outerConeAngle", 208}}));
}

TEST(GltfLights, flickerIsReadFromExtras)
{
    const Imported result = importExtras(R"({"flicker":{"rate":8.5,"amplitude":0.25,"seed":4294967295}})");
    ASSERT_TRUE(result.ok()) << result.message();
    const auto light = result.records<LightRecord>(kChunkLights)[0];
    EXPECT_EQ(light.flicker_rate, 8.5f);
    EXPECT_EQ(light.flicker_amplitude, 0.25f);
    EXPECT_EQ(light.flicker_seed, 4294967295u);
    const Imported seedless = importExtras(R"({"flicker":{"rate":1,"amplitude":1},"other":2})");
    ASSERT_TRUE(seedless.ok()) << seedless.message();
    EXPECT_EQ(seedless.records<LightRecord>(kChunkLights)[0].flicker_seed, 0u);
    for (const char* extras : {"{}", "[1]", "\"flicker\""})
    {
        const Imported steady = importExtras(extras);
        ASSERT_TRUE(steady.ok()) << steady.message();
        EXPECT_EQ(steady.records<LightRecord>(kChunkLights)[0].flicker_rate, 0.0f);
    }
}

TEST(GltfLights, flickerThatCannotBeIsRefusedWithItsRemedy)
{
    const std::pair<const char*, const char*> wrong[] = {
        {"true", "a rate above 0 Hz"},
        {"{}", "a rate above 0 Hz"},
        {R"({"rate":0,"amplitude":1})", "a rate above 0 Hz"},
        {R"({"rate":"fast","amplitude":1})", "a rate above 0 Hz"},
        {R"({"rate":1e39,"amplitude":1})", "a rate above 0 Hz"},
        {R"({"rate":1})", "an amplitude from 0 to 1"},
        {R"({"rate":1,"amplitude":1.5})", "an amplitude from 0 to 1"},
        {R"({"rate":1,"amplitude":-0.5})", "an amplitude from 0 to 1"},
        {R"({"rate":1,"amplitude":1,"seed":-1})", "an integer from 0 to 4294967295"},
        {R"({"rate":1,"amplitude":1,"seed":0.5})", "an integer from 0 to 4294967295"},
        {R"({"rate":1,"amplitude":1,"seed":4294967296})", "an integer from 0 to 4294967295"},
    };
    for (const auto& [flicker, needs] : wrong)
    {
        const Imported result = importExtras(fmt::format(R"({{"flicker":{}}})", flicker));
        ASSERT_FALSE(result.ok()) << flicker;
        const std::string message = result.message();
        EXPECT_THAT(message, HasSubstr("test.glb"));
        EXPECT_THAT(message, HasSubstr("/extensions/KHR_lights_punctual/lights/0/extras/flicker"));
        EXPECT_THAT(message, HasSubstr(fmt::format("the flicker of light \"torch\" needs {}", needs)));
        EXPECT_THAT(message, HasSubstr("write {\"rate\": 8, \"amplitude\": 0.5, \"seed\": 1}"));
    }
}

} // namespace hearth::import::test
