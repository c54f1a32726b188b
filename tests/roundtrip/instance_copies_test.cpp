// Tests that instances which see too different a part of the sky get a copy of their mesh, with the real
// hearth and its cookers. The oracle is the same scene with a mesh for each instance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_view.h"
#include "sample_assets/shapes/glb_writer.h"
#include "tests/roundtrip/occlusion_bake.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// A cube that stands somewhere.
struct Place
{
    Float3 corner;
    float scale;
};

/// Two cubes in the open, a large and a small one below a roof.
const std::vector<Place> kPlaces{{{0, 0, 0}, 1}, {{40, 0, 0}, 1}, {{79, 0, -1}, 2}, {{76.5f, 0, 0}, 1}};

// Rms difference of two independent bakes at quality default: noise of rays below a roof, where most are
// stopped.
constexpr double kNoise = .006 * 1.4143;

/// Write a roof and cubes, which are instances of one mesh, or each a mesh. The roof is mesh 0.
void writeScene(const Sandbox& folder, const std::string& name, bool is_apart)
{
    samples::Document document;
    document.materials.emplace_back();
    document.meshes.push_back({"roof", {makePrimitive(makeBox({10, 1, 10}), 0)}});
    samples::Node roof;
    roof.mesh = 0;
    roof.placement.translation = {74, 2.5f, -5};
    samples::addRoot(document, roof);
    for (const Place& place : kPlaces)
    {
        if (is_apart || document.meshes.size() == 1)
            document.meshes.push_back({"cube", {makePrimitive(makeBox({1, 1, 1}), 0)}});
        samples::Node cube;
        cube.mesh = static_cast<int>(document.meshes.size()) - 1;
        cube.placement.translation = place.corner;
        cube.placement.scale = {place.scale, place.scale, place.scale};
        samples::addRoot(document, cube);
    }
    ASSERT_TRUE(samples::writeFile(folder / name, samples::encodeGlb(document)).ok());
}

class InstanceCopies : public ::testing::Test
{
protected:
    InstanceCopies()
    {
        writeScene(folder, "shared.glb", false);
        writeScene(folder, "apart.glb", true);
    }

    /// Cook a source; return the mesh that each cube draws.
    std::vector<uint32_t> cook(const std::string& source, const std::string& pack, const std::string& copies)
    {
        const ProgramEnd cooked = folder.run({HEARTH_BIN "/hearth", "cook", source, "-o", pack, "--bricks",
                                              "off", "--no-cache", "--visibility-copies", copies});
        EXPECT_EQ(cooked.exit_code, 0) << cooked.err;
        auto reader = formats::ContainerReader::open(folder / pack);
        if (!reader.ok())
            return {};
        const auto view = formats::PackView::read(std::move(*reader));
        std::vector<uint32_t> meshes;
        for (const formats::InstanceRecord& instance : view->instances().subspan(1)) // behind the roof
            meshes.push_back(instance.mesh);
        return meshes;
    }

    Sandbox folder;
};

} // namespace

TEST_F(InstanceCopies, seeWhatMeshesOfTheirOwnSee)
{
    const std::vector<uint32_t> copied = cook("shared.glb", "copied.hearth", "64");
    EXPECT_EQ(copied, (std::vector<uint32_t>{1, 1, 2, 3})) << "both cubes below the roof have a copy";
    const std::vector<uint32_t> shared = cook("shared.glb", "shared.hearth", "0");
    EXPECT_EQ(shared, (std::vector<uint32_t>{1, 1, 1, 1}));
    const std::vector<uint32_t> apart = cook("apart.glb", "apart.hearth", "64");
    EXPECT_EQ(apart, (std::vector<uint32_t>{1, 2, 3, 4}));
    for (size_t cube = 0; cube < kPlaces.size(); ++cube)
    {
        const auto truth = extractVertices(folder, "apart.hearth", apart[cube]);
        EXPECT_LT(rmsDifference(extractVertices(folder, "copied.hearth", copied[cube]), truth), kNoise)
            << cube;
        EXPECT_GT(rmsDifference(extractVertices(folder, "shared.hearth", shared[cube]), truth), 5 * kNoise)
            << cube;
    }
}

TEST_F(InstanceCopies, keepWithinTheirBytes)
{
    // roof and cube are alike: a copy takes half of the bytes of the pages, and records
    EXPECT_EQ(cook("shared.glb", "one.hearth", "0.9"), (std::vector<uint32_t>{1, 1, 2, 1}))
        << "the larger one has more to gain";
    EXPECT_EQ(cook("shared.glb", "none.hearth", "0.1"), (std::vector<uint32_t>{1, 1, 1, 1}));
}

TEST_F(InstanceCopies, areTheSameToTheByteEachTime)
{
    cook("shared.glb", "a.hearth", "64");
    cook("shared.glb", "b.hearth", "64");
    EXPECT_TRUE(folder.read("a.hearth") == folder.read("b.hearth"));
}

} // namespace hearth::test
