// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/inspect/inspect_bounds.h"

#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class InspectBounds : public ::testing::Test
{
protected:
    InspectBounds() { writePackFile(smallPack(), sandbox / "small.hearth"); }

    Json bounds(const std::optional<command::ClipTime>& clip)
    {
        const Result<std::string> text = command::boundsJson(sandbox / "small.hearth", clip);
        return text.ok() ? Json::parse(*text).value() : Json(formatMessage(text.error()));
    }

    static void expectBox(const Json& box, Float3 min, Float3 max)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            EXPECT_FLOAT_EQ(box["min"][static_cast<size_t>(axis)].get<float>(), min[axis]);
            EXPECT_FLOAT_EQ(box["max"][static_cast<size_t>(axis)].get<float>(), max[axis]);
        }
    }

    Sandbox sandbox;
};

} // namespace

TEST_F(InspectBounds, saysLevelsAndTrianglesOfTheExtract)
{
    const Json json = bounds(std::nullopt);
    ASSERT_EQ(json["meshes"].size(), 3u);
    const Json& strip = json["meshes"][0];
    EXPECT_EQ(strip["mesh"], 0);
    ASSERT_EQ(strip["clusters"].size(), 6u);
    EXPECT_EQ(strip["clusters"][0]["level"], 1);
    EXPECT_TRUE(strip["clusters"][0]["triangles"].is_null());
    EXPECT_EQ(strip["clusters"][2]["level"], 0);
    EXPECT_EQ(strip["clusters"][2]["triangles"], (Json{{"first", 0}, {"count", 2}}));
    EXPECT_EQ(strip["clusters"][5]["triangles"], (Json{{"first", 6}, {"count", 2}}));
    EXPECT_EQ(json["meshes"][1]["clusters"].size(), 0u);
}

TEST_F(InspectBounds, deformedClustersHaveTheirBoxInTheMainBone)
{
    PackModel model = smallPack();
    model.nodes[2].parent_from_node.m[1][3] = 10; // of joint 1, the main bone
    writePackFile(model, sandbox / "small.hearth");
    expectBox(bounds(std::nullopt)["meshes"][2]["clusters"][0]["box"], {0, 10, 0}, {1.5f, 10.5f, 1});
}

TEST_F(InspectBounds, aClipMovesWhatItMoves)
{
    const Json still = bounds(std::nullopt), moved = bounds(command::ClipTime{"move", 1});
    const Json& box = still["meshes"][0]["clusters"][2]["box"];
    const Json& moved_box = moved["meshes"][0]["clusters"][2]["box"];
    EXPECT_FLOAT_EQ(moved_box["min"][0].get<float>(), box["min"][0].get<float>() + 1);
    EXPECT_FLOAT_EQ(moved_box["max"][0].get<float>(), box["max"][0].get<float>() + 1);
    EXPECT_FLOAT_EQ(moved_box["max"][2].get<float>(), box["max"][2].get<float>());
}

TEST_F(InspectBounds, saysWhichClipsThereAre)
{
    const auto text = command::boundsJson(sandbox / "small.hearth", command::ClipTime{"dance", 1});
    ASSERT_FALSE(text.ok());
    EXPECT_EQ(text.error().issue, Issue::usage);
    EXPECT_NE(text.error().detail.find("move"), std::string::npos);
}

} // namespace hearth::test
