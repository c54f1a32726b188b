// Tests that the sources of a pack occlude each other as the meshes of one source do, and that an asset far
// away bakes no other one again, with the real hearth and all its cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/document.h"
#include "sample_assets/shapes/glb_writer.h"
#include "tests/roundtrip/occlusion_bake.h"

#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace hearth::test
{

namespace
{

using Cookers = std::multiset<std::string>;

/// A box that stands somewhere in the world.
struct Model
{
    Float3 size;
    Float3 place;
    float grey = 1;
};

const Model kHouse{{4, 3, 4}, {-4, 0, -2}};
const Model kTree{{1, 5, 1}, {.5f, 0, -.5f}};

/// Write a glTF file with a mesh for each model.
void writeGlb(const Sandbox& folder, const std::string& name, const std::vector<Model>& models)
{
    samples::Document document;
    for (const Model& model : models)
    {
        const auto index = static_cast<int>(document.meshes.size());
        samples::Node node;
        node.placement.translation = model.place;
        node.mesh = index;
        samples::Material material;
        material.base_color = {model.grey, model.grey, model.grey, 1};
        document.materials.push_back(material);
        document.meshes.push_back({"mesh", {makePrimitive(makeBox(model.size), index)}});
        samples::addRoot(document, node);
    }
    ASSERT_TRUE(samples::writeFile(folder / name, samples::encodeGlb(document)).ok());
}

class NeighbourOcclusion : public ::testing::Test
{
protected:
    NeighbourOcclusion()
    {
        writeGlb(folder, "house.glb", {kHouse});
        writeGlb(folder, "tree.glb", {kTree});
    }

    /// Cook without bricks; return the cookers that ran, as "visibility house.glb".
    Cookers cook(const std::vector<std::string>& sources, const std::string& pack,
                 const std::vector<std::string>& more = {}, int exit_code = 0)
    {
        std::vector<std::string> command{HEARTH_BIN "/hearth", "cook"};
        command.insert(command.end(), sources.begin(), sources.end());
        command.insert(command.end(), {"-o", pack, "--bricks", "off"});
        command.insert(command.end(), more.begin(), more.end());
        const ProgramEnd end = folder.run(command, {"HEARTH_LOG=verbose"});
        EXPECT_EQ(end.exit_code, exit_code) << end.err;
        Cookers ran;
        std::istringstream lines(end.err);
        for (std::string line; std::getline(lines, line);)
            for (const char* cooker : {"import", "textures", "clusters", "skinning", "neighbours",
                                       "visibility", "specular", "link"})
                if (line.starts_with(std::string(cooker) + " ") && line.find(" s ") != std::string::npos)
                    ran.insert(std::string(cooker) + " " + line.substr(line.rfind(' ') + 1));
        return ran;
    }

    Sandbox folder;
};

/// Return the sources of which a cooker ran.
Cookers selectSources(const std::string& cooker, const Cookers& ran)
{
    Cookers sources;
    for (const std::string& action : ran)
        if (action.starts_with(cooker + " "))
            sources.insert(action.substr(cooker.size() + 1));
    return sources;
}

// Noise of rays at quality default, rms, of two independent bakes.
constexpr double kNoise = .004 * 1.4143;

} // namespace

TEST_F(NeighbourOcclusion, isThatOfOneSourceWithBoth)
{
    writeGlb(folder, "both.glb", {kHouse, kTree});
    cook({"both.glb"}, "both.hearth");
    cook({"house.glb", "tree.glb"}, "pack.hearth");
    cook({"house.glb", "tree.glb"}, "alone.hearth", {"--visibility-occluders", "source"});
    for (const uint32_t mesh : {0u, 1u})
    {
        const auto both = extractVertices(folder, "both.hearth", mesh);
        EXPECT_LE(rmsDifference(extractVertices(folder, "pack.hearth", mesh), both), kNoise) << mesh;
        EXPECT_GT(rmsDifference(extractVertices(folder, "alone.hearth", mesh), both), 5 * kNoise) << mesh;
    }
}

TEST_F(NeighbourOcclusion, leavesSourcesAloneOnRequest)
{
    for (const char* scope : {"source", "mesh"})
    {
        const std::vector<std::string> option{"--visibility-occluders", scope};
        cook({"house.glb"}, "house.hearth", option);
        const Cookers ran = cook({"house.glb", "tree.glb"}, "pack.hearth", option);
        EXPECT_EQ(selectSources("visibility", ran), Cookers{"tree.glb"})
            << "the house's is that of its own pack";
        EXPECT_EQ(selectSources("neighbours", ran), Cookers{});
    }
}

TEST_F(NeighbourOcclusion, ofAnAssetFarAwayBakesNoOtherAgain)
{
    const Model far{{2, 2, 2}, {100, 0, 0}};
    writeGlb(folder, "far.glb", {far});
    const std::vector<std::string> sources{"far.glb", "house.glb", "tree.glb"};
    EXPECT_EQ(selectSources("visibility", cook(sources, "a.hearth")).size(), 3u);
    EXPECT_EQ(cook(sources, "a.hearth"), Cookers{}) << "nothing has changed";

    writeGlb(folder, "far.glb", {{far.size, {120, 0, 10}}});
    const Cookers moved = cook(sources, "a.hearth");
    EXPECT_EQ(selectSources("neighbours", moved).size(), 1u);
    EXPECT_EQ(selectSources("visibility", moved), Cookers{"far.glb"});

    writeGlb(folder, "another.glb", {{far.size, {-200, 0, 0}}});
    const Cookers added = cook({"another.glb", "far.glb", "house.glb", "tree.glb"}, "a.hearth");
    EXPECT_EQ(selectSources("visibility", added), Cookers{"another.glb"});

    writeGlb(folder, "tree.glb", {{kTree.size, {1, 0, -.5f}}});
    EXPECT_EQ(selectSources("visibility", cook(sources, "a.hearth")), (Cookers{"house.glb", "tree.glb"}));

    // into reach: 16 times the radius of the far model, and the other two are larger
    writeGlb(folder, "far.glb", {{far.size, {20, 0, 0}}});
    EXPECT_EQ(selectSources("visibility", cook(sources, "a.hearth")).size(), 3u);
}

TEST_F(NeighbourOcclusion, doesNotReachUnplacedSources)
{
    const std::vector<std::string> names{"a.glb", "b.glb", "c.glb"};
    for (size_t i = 0; i < names.size(); ++i)
    {
        writeGlb(folder, names[i], {{{2, 2 + .1f * static_cast<float>(i), 2}, {-1, 0, -1}}});
        cook({names[i]}, names[i] + ".hearth");
    }
    const Cookers ran = cook(names, "library.hearth");
    EXPECT_EQ(selectSources("visibility", ran), Cookers{}) << "each has the key of a pack of its own";
    EXPECT_EQ(selectSources("neighbours", ran).size(), 1u);
}

TEST_F(NeighbourOcclusion, isNotBySkippedSources)
{
    writeGlb(folder, "shed.glb", {{{2, 2, 2}, {3, 0, 0}}});
    cook({"house.glb", "tree.glb"}, "two.hearth");
    const auto house = extractVertices(folder, "two.hearth");
    const std::string whole = folder.read("shed.glb");
    folder.write("shed.glb", whole.substr(0, whole.size() / 2));
    const Cookers ran = cook({"house.glb", "shed.glb", "tree.glb"}, "pack.hearth", {"--missing", "skip"}, 1);
    EXPECT_EQ(selectSources("visibility", ran), Cookers{})
        << "the keys are those of a cook of the two others";
    EXPECT_EQ(rmsDifference(extractVertices(folder, "pack.hearth"), house), 0);
    folder.write("shed.glb", whole);
    cook({"house.glb", "shed.glb", "tree.glb"}, "pack.hearth");
    EXPECT_GT(rmsDifference(extractVertices(folder, "pack.hearth"), house), 0);
}

} // namespace hearth::test
