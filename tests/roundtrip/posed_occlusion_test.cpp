// Tests ambient occlusion of deformed meshes in the poses of a clip, from glTF through the pack and back,
// against a closed form: a ceiling that descends on a floor while both are rotated.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/visibility/scene/poses.h"
#include "tests/roundtrip/occlusion_bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hearth::test
{

namespace
{

const std::string kBin = HEARTH_BIN;
constexpr double kPi = std::numbers::pi;

constexpr float kHalf = 1;              ///< half the side of the ceiling, which is as large as the floor
constexpr double kHigh = 3, kLow = 0.5; ///< heights of the ceiling: at rest and at the clip's end
// limits of the root mean square error, as in cook/visibility/README.md
constexpr double kMaxError = 0.006, kMaxErrorAtHigh = 0.002;
constexpr uint32_t kQuads = 20; ///< quads along a side

/// Arrays of a glTF file, one behind the other in one buffer.
class Buffer
{
public:
    template <typename T>
    void add(const std::vector<T>& values, int component_type, const char* type, size_t count)
    {
        views_.push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
        accessors_.push_back({{"bufferView", views_.size() - 1},
                              {"componentType", component_type},
                              {"type", type},
                              {"count", count}});
        const auto* data = reinterpret_cast<const char*>(values.data());
        bytes_.append(data, values.size() * sizeof(T));
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
    }

    /// Set the range of the last array.
    void setRange(const Json& least, const Json& greatest)
    {
        accessors_.back()["min"] = least;
        accessors_.back()["max"] = greatest;
    }

    const std::string& bytes() const { return bytes_; }
    const Json& views() const { return views_; }
    const Json& accessors() const { return accessors_; }

private:
    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array();
};

/// Write a floor at y = 0 on joint 1 and a ceiling on joint 2, both joints below joint 0. In one second the
/// clip lowers the ceiling from kHigh to kLow and rotates joint 0 about z by a right angle.
void writeModel(const Sandbox& sandbox)
{
    std::vector<Float3> positions;
    std::vector<uint8_t> joints;
    std::vector<float> weights;
    std::vector<uint32_t> indices;
    for (const bool ceiling : {false, true})
    {
        const auto first = static_cast<uint32_t>(positions.size());
        for (uint32_t i = 0; i <= kQuads; ++i)
            for (uint32_t j = 0; j <= kQuads; ++j)
            {
                const auto place = [](uint32_t k)
                { return kHalf * (2 * static_cast<float>(k) / kQuads - 1); };
                positions.push_back({place(i), ceiling ? static_cast<float>(kHigh) : 0.0f, place(j)});
                joints.insert(joints.end(), {static_cast<uint8_t>(ceiling ? 2 : 1), 0, 0, 0});
                weights.insert(weights.end(), {1, 0, 0, 0});
            }
        for (uint32_t i = 0; i < kQuads; ++i)
            for (uint32_t j = 0; j < kQuads; ++j)
            {
                const uint32_t a = first + i * (kQuads + 1) + j, b = a + kQuads + 1;
                if (ceiling)
                    indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
                else
                    indices.insert(indices.end(), {a, b + 1, b, a, a + 1, b + 1});
            }
    }
    Buffer buffer;
    buffer.add(positions, 5126, "VEC3", positions.size());
    buffer.setRange({-kHalf, 0, -kHalf}, {kHalf, kHigh, kHalf});
    buffer.add(joints, 5121, "VEC4", positions.size());
    buffer.add(weights, 5126, "VEC4", positions.size());
    buffer.add(indices, 5125, "SCALAR", indices.size());
    buffer.add(std::vector<float>{0, 1}, 5126, "SCALAR", 2);
    buffer.setRange({0}, {1});
    buffer.add(std::vector<float>{0, 0, 0, 0, static_cast<float>(kLow - kHigh), 0}, 5126, "VEC3", 2);
    const auto half = static_cast<float>(std::sqrt(0.5));
    buffer.add(std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, 5126, "VEC4", 2);
    const Json model{
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0, 1}}}}},
        {"nodes",
         {{{"mesh", 0}, {"skin", 0}}, {{"children", {2, 3}}}, {{"name", "floor"}}, {{"name", "ceiling"}}}},
        {"skins", {{{"joints", {1, 2, 3}}}}},
        {"meshes",
         {{{"primitives",
            {{{"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}}}, {"indices", 3}}}}}}},
        {"animations",
         {{{"name", "press"},
           {"samplers", {{{"input", 4}, {"output", 5}}, {{"input", 4}, {"output", 6}}}},
           {"channels",
            {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}},
             {{"sampler", 1}, {"target", {{"node", 1}, {"path", "rotation"}}}}}}}}},
        {"buffers", {{{"uri", "model.bin"}, {"byteLength", buffer.bytes().size()}}}},
        {"bufferViews", buffer.views()},
        {"accessors", buffer.accessors()}};
    sandbox.write("model.bin", buffer.bytes());
    sandbox.write("model.gltf", model.dump());
}

/// Part of the hemisphere that a floor point sees past the ceiling: four rectangles with a corner above the
/// point.
double openBelow(double x, double z, double height)
{
    double hidden = 0;
    for (const double a : {kHalf - x, kHalf + x})
        for (const double b : {kHalf - z, kHalf + z})
        {
            const double u = a / height, v = b / height;
            hidden += (u / std::hypot(1, u) * std::atan(v / std::hypot(1, u)) +
                       v / std::hypot(1, v) * std::atan(u / std::hypot(1, v))) /
                      (2 * kPi);
        }
    return 1 - hidden;
}

class PosedOcclusion : public testing::Test
{
protected:
    PosedOcclusion() { writeModel(sandbox_); }

    ProgramEnd cook(const std::vector<std::string>& flags)
    {
        std::vector<std::string> command{kBin + "/hearth", "cook", "model.gltf",   "-o",
                                         "model.hearth",   "-q",   "--visibility", "--report",
                                         "report.json"};
        command.insert(command.end(), flags.begin(), flags.end());
        return sandbox_.run(command);
    }

    void expectMean(const std::vector<double>& heights, double max_error)
    {
        double sum = 0;
        size_t count = 0;
        for (const SeenVertex& vertex : extractVertices(sandbox_, "model.hearth"))
        {
            if (vertex.normal.y < 0.99f)
                continue;
            double wanted = 0;
            for (const double height : heights)
                wanted += openBelow(vertex.position.x, vertex.position.z, height) /
                          static_cast<double>(heights.size());
            sum += (vertex.ao - wanted) * (vertex.ao - wanted);
            ++count;
            if (std::abs(vertex.position.x) < 0.01f && std::abs(vertex.position.z) < 0.01f)
            {
                EXPECT_GT(vertex.axis.y, 0.98f) << "turned back";
            }
        }
        EXPECT_GT(count, 100u);
        EXPECT_LT(std::sqrt(sum / static_cast<double>(count)), max_error);
    }

    std::vector<std::string> posesReported()
    {
        const auto report = Json::parse(sandbox_.read("report.json")).value();
        return report["assets"][0]["visibility"]["meshes"][0]["poses"].get<std::vector<std::string>>();
    }

    Sandbox sandbox_;
};

} // namespace

TEST_F(PosedOcclusion, isThatOfTheBindPoseWhereNoneIsNamed)
{
    const ProgramEnd end = cook({});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    expectMean({kHigh}, kMaxError);
    EXPECT_EQ(posesReported(), std::vector<std::string>{"bind"});
}

TEST_F(PosedOcclusion, isTheMeanOverNamedPoses)
{
    for (const std::string quality : {"default", "high"})
    {
        const ProgramEnd end = cook({"--visibility-poses", "press@0,1", "--visibility-quality", quality});
        ASSERT_EQ(end.exit_code, 0) << end.err;
        expectMean({kHigh, kLow}, quality == "high" ? kMaxErrorAtHigh : kMaxError);
        EXPECT_EQ(posesReported(), (std::vector<std::string>{"press@0", "press@1"}));
    }
}

TEST_F(PosedOcclusion, isThatOfFourTimesOfAClipWithoutTimes)
{
    const ProgramEnd end = cook({"--visibility-poses", "press"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    std::vector<double> heights;
    for (const double time : {0.125, 0.375, 0.625, 0.875})
        heights.push_back(kHigh + time * (kLow - kHigh));
    expectMean(heights, kMaxError);
    EXPECT_EQ(posesReported().size(), 4u);
}

TEST_F(PosedOcclusion, needsAClipThatIsThere)
{
    const ProgramEnd end = cook({"--visibility-poses", "dance@1"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_NE(end.err.find("animation \"dance\": error: "), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("press"), std::string::npos) << end.err;
}

TEST(ParseClipTimes, readsWhatUsersWrite)
{
    using visibility::parseClipTimes;
    EXPECT_EQ(parseClipTimes("walk")->clip, "walk");
    EXPECT_TRUE(parseClipTimes("walk")->seconds.empty());
    EXPECT_EQ(parseClipTimes("a@b@0.5,2")->clip, "a@b");
    EXPECT_EQ(parseClipTimes("a@b@0.5,2")->seconds, (std::vector<double>{0.5, 2}));
    for (const char* wrong :
         {"walk@", "walk@x", "walk@1,", "walk@,1", "walk@-1", "walk@nan", "walk@1;2", "walk@1e999"})
        EXPECT_FALSE(parseClipTimes(wrong)) << wrong;
}

} // namespace hearth::test
