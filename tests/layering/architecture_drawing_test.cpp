// The drawing of docs/ARCHITECTURE.md is that of the includes as they are.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/layering/architecture_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace hearth::test
{

TEST(ArchitectureDrawing, isTheOneInTheDocuments)
{
    std::ifstream file(std::string(HEARTH_SOURCE_DIR) + "/docs/architecture.svg", std::ios::binary);
    const std::string drawn{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(drawn, drawFolderGraph(readFolderGraph(HEARTH_SOURCE_DIR)))
        << "draw it again: ./dev build release draw_architecture && "
           "build/release/bin/draw_architecture . > docs/architecture.svg";
}

TEST(ArchitectureDrawing, leavesOutArrowsThatFollowFromOthers)
{
    const std::string svg = drawFolderGraph({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {}}});
    size_t arrows = 0;
    for (size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1))
        ++arrows;
    EXPECT_EQ(arrows, 2u);
    EXPECT_THAT(svg, ::testing::HasSubstr(">a</text>"));
}

TEST(ArchitectureDrawing, readsIncludesOfFoldersTwoLevelsDeep)
{
    const FolderGraph graph = readFolderGraph(HEARTH_SOURCE_DIR);
    EXPECT_TRUE(graph.at("cook/clusters").contains("cook/mesh"));
    EXPECT_TRUE(graph.at("runtime/gpu").contains("runtime/shaders"));
    EXPECT_FALSE(graph.contains("tests/layering"));
    EXPECT_TRUE(graph.at("formats/base").empty());
}

} // namespace hearth::test
