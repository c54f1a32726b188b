// Tests that rays within a budget go where visibility varies, with the real hearth and its cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "sample_assets/shapes/glb_writer.h"
#include "tests/roundtrip/occlusion_bake.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// Write two equal sheets: one in the open, and one close below a grating.
void writeScene(const Sandbox& folder)
{
    constexpr float kSize = 10, kBar = 0.1f, kStep = 0.4f;
    samples::Document document;
    document.materials.emplace_back();
    Shape sheet, bars;
    sheet.addGrid({0, 0, 0}, {0, 0, kSize}, {kSize, 0, 0}, 256, 256);
    for (float x = 0; x < kSize; x += kStep)
        bars.addGrid({x, 0.08f, 0}, {kBar, 0, 0}, {0, 0, kSize}, 1, 1);
    document.meshes = {{"open", {makePrimitive(sheet, 0)}},
                       {"covered", {makePrimitive(sheet, 0)}},
                       {"bars", {makePrimitive(bars, 0)}}};
    for (int mesh = 0; mesh < 3; ++mesh)
    {
        samples::Node node;
        node.mesh = mesh;
        node.placement.translation = {mesh == 0 ? 1000.0f : 0.0f, 0, 0};
        samples::addRoot(document, node);
    }
    ASSERT_TRUE(samples::writeFile(folder / "sheets.glb", samples::encodeGlb(document)).ok());
}

} // namespace

TEST(VisibilityBudget, goesWhereVisibilityVaries)
{
    Sandbox folder;
    writeScene(folder);
    const ProgramEnd cooked =
        folder.run({HEARTH_BIN "/hearth", "cook", "sheets.glb", "-o", "sheets.hearth", "--bricks", "off",
                    "--no-cache", "--visibility-quality", "draft", "--report", "report.json"});
    ASSERT_EQ(cooked.exit_code, 0) << cooked.err;
    const Json report = Json::parse(folder.read("report.json")).value();
    const Json& meshes = report.at("assets").at(0).at("visibility").at("meshes");
    const double open = meshes.at(0).at("rays").get<double>(),
                 covered = meshes.at(1).at("rays").get<double>();
    EXPECT_GT(covered, 2 * open);
    // levels halve the triangles, and the nearest one is taken
    EXPECT_LT(open + covered, 1.42 * 0x1p22) << "the budget";
    EXPECT_GT(open + covered, 0.7 * 0x1p22);
}

} // namespace hearth::test
