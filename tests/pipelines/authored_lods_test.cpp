// Tests authored LODs from files of their own, with hearth-import --lod.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/source_mesh.h"
#include "cook/tools/lod_files.h"
#include "formats/pack/pack_view.h"
#include "runtime/pack/cut.h"
#include "tests/reference/culling/cut_checker.h"
#include "tests/support/sandbox.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr const char* kHearth = HEARTH_BIN "/hearth";
constexpr const char* kSamples = HEARTH_BIN "/hearth-samples";

/// Return a square of n x n quads as OBJ with a material.
std::string square(int n, const std::string& material)
{
    std::string text = "mtllib " + material + ".mtl\nusemtl " + material + "\n";
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            text += "v " + std::to_string(static_cast<double>(x) / n) + " " +
                    std::to_string(static_cast<double>(y) / n) + " 0\n";
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
        {
            const int a = y * (n + 1) + x + 1;
            text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + n + 2) +
                    " " + std::to_string(a + n + 1) + "\n";
        }
    return text;
}

class AuthoredFiles : public ::testing::Test
{
protected:
    AuthoredFiles()
    {
        for (const char* name : {"fine", "mid", "low"})
            sandbox_.write(std::string(name) + ".mtl",
                           std::string("newmtl ") + name + "\nKd 1 0 0\nmap_Kd missing_" + name + ".png\n");
        sandbox_.write("fine.obj", square(20, "fine"));
        sandbox_.write("mid.obj", square(6, "mid"));
        sandbox_.write("low.obj", square(1, "low"));
    }

    ProgramEnd run(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth-import");
        return sandbox_.run(arguments);
    }

    Sandbox sandbox_;
};

} // namespace

TEST_F(AuthoredFiles, bringTheirMeshesMaterialsAndImages)
{
    const std::vector<std::string> before = sandbox_.list();
    const ProgramEnd end = run({"fine.obj", "--lod", "2=low.obj", "--lod", "1=mid.obj", "-o", "out.part"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(sandbox_.list().size(), before.size() + 1) << "nothing is left beside the part";
    auto reader = ContainerReader::open(sandbox_ / "out.part");
    ASSERT_TRUE(reader.ok());
    const auto records = reader->records<AuthoredLodRecord>(kChunkAuthoredLods);
    ASSERT_TRUE(records.ok());
    ASSERT_EQ(records->size(), 2u);
    EXPECT_EQ((*records)[0].lod, 1u);
    EXPECT_EQ((*records)[1].lod, 2u);
    EXPECT_EQ((*records)[1].number, 2u);
    const auto view = PackView::read(*reader);
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(view->text((*records)[0].name), "mid.obj");
    EXPECT_EQ(view->text((*records)[1].name), "low.obj");
    EXPECT_EQ(view->instances().size(), 1u);
    ASSERT_EQ(view->materials().size(), 3u);
    ASSERT_EQ(view->images().size(), 3u);
    const char* names[] = {"fine", "mid", "low"};
    const size_t triangles[] = {800, 72, 2};
    for (uint32_t i = 0; i < 3; ++i)
    {
        const auto mesh = mesh::readSourceMesh(*reader, i);
        ASSERT_TRUE(mesh.ok());
        EXPECT_EQ(mesh->triangleCount(), triangles[i]);
        EXPECT_EQ(mesh->triangle_materials[0], i);
        EXPECT_EQ(view->text(view->materials()[i].name), names[i]);
        EXPECT_EQ(view->materials()[i].base_color_texture.image, i);
        EXPECT_NE(view->text(view->images()[i].name).find(names[i]), std::string::npos);
        EXPECT_NE(view->meta().find(std::string("\"") + names[i] + ".obj\""), std::string::npos)
            << "a source of the part";
    }
}

TEST_F(AuthoredFiles, areCookedIntoAPackThatIsValid)
{
    const ProgramEnd end = sandbox_.run(
        {kHearth, "cook", "fine.obj", "--lod", "1=mid.obj", "--lod", "2=low.obj", "-o", "out.hearth"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(sandbox_.run({kHearth, "verify", "out.hearth"}).exit_code, 0);
    auto reader = ContainerReader::open(sandbox_ / "out.hearth");
    ASSERT_TRUE(reader.ok());
    const auto pack = PackView::read(std::move(*reader));
    ASSERT_TRUE(pack.ok());
    std::vector<bool> drawn(3, false);
    for (const ClusterRecord& cluster : pack->clusters())
    {
        EXPECT_EQ(pack->pages()[cluster.page].mesh, 0u);
        drawn[cluster.material] = true;
    }
    EXPECT_EQ(drawn, std::vector<bool>(3, true)) << "each level has its own material";
    EXPECT_EQ(pack->levels()[pack->levels().size() - 1].triangle_count, 2u);
}

TEST_F(AuthoredFiles, areDrawnOnceByTheRuntimesCut)
{
    const std::pair<const char*, const char*> rocks[] = {{"fine.glb", kSanitized ? "8000" : "100000"},
                                                         {"mid.glb", kSanitized ? "3000" : "30000"},
                                                         {"low.glb", "400"}};
    for (const auto& [name, triangles] : rocks)
        ASSERT_EQ(
            sandbox_.run({kSamples, "rock", "--triangles", triangles, "--texture-size", "4", "-o", name})
                .exit_code,
            0);
    const ProgramEnd end = sandbox_.run(
        {kHearth, "cook", "fine.glb", "--lod", "1=mid.glb", "--lod", "2=low.glb", "-o", "rock.hearth"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    auto reader = ContainerReader::open(sandbox_ / "rock.hearth");
    ASSERT_TRUE(reader.ok());
    const auto pack = PackView::read(std::move(*reader));
    ASSERT_TRUE(pack.ok());
    size_t in_sets = 0;
    std::set<float> errors{0};
    for (const GroupRecord& group : pack->groups())
    {
        in_sets += group.set_offset != 0 ? 1 : 0;
        errors.insert(group.error);
    }
    EXPECT_GT(in_sets, kSanitized ? 0u : 2u);
    for (const float error : errors)
        for (const float threshold : {error, std::nextafter(error, 0.0f)})
        {
            const auto coverage =
                reference::checkCoverage(*pack, 0, pack::selectCut(*pack, 0, std::max(0.0f, threshold)));
            EXPECT_EQ(coverage.missing, 0u) << threshold;
            EXPECT_EQ(coverage.overlapping, 0u) << threshold;
        }
}

TEST_F(AuthoredFiles, thatAreNoUseAreRefusedByName)
{
    const ProgramEnd missing = run({"fine.obj", "--lod", "1=no.obj", "-o", "out.part"});
    EXPECT_EQ(missing.exit_code, 66);
    EXPECT_NE(missing.err.find("no.obj: error"), std::string::npos) << missing.err;

    sandbox_.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    const ProgramEnd broken = run({"fine.obj", "--lod", "1=broken.obj", "-o", "out.part"});
    EXPECT_EQ(broken.exit_code, 65);
    EXPECT_NE(broken.err.find("broken.obj|line 2"), std::string::npos) << broken.err;

    const std::string nothing = R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{"nodes":[0]}]})";
    sandbox_.write("empty.gltf", nothing);
    const ProgramEnd empty = run({"fine.obj", "--lod", "1=empty.gltf", "-o", "out.part"});
    EXPECT_EQ(empty.exit_code, 65);
    EXPECT_NE(empty.err.find("empty.gltf: error: draws 0 meshes"), std::string::npos) << empty.err;
    const ProgramEnd base = run({"empty.gltf", "--lod", "1=mid.obj", "-o", "out.part"});
    EXPECT_EQ(base.exit_code, 65);
    EXPECT_NE(base.err.find("empty.gltf: error: draws 0 meshes"), std::string::npos) << base.err;
    EXPECT_FALSE(sandbox_.has("out.part"));
}

TEST_F(AuthoredFiles, needACookOfOneSource)
{
    const ProgramEnd end =
        sandbox_.run({kHearth, "cook", "fine.obj", "mid.obj", "--lod", "1=low.obj", "-o", "out.hearth"});
    EXPECT_EQ(end.exit_code, 2) << end.err;
    EXPECT_NE(end.err.find("needs a cook of one source"), std::string::npos) << end.err;
}

TEST(LodFiles, areSortedAndChecked)
{
    const auto parse = [](std::vector<std::string> options) { return tools::parseLodFiles(options); };
    const auto files = parse({"3=c=d.glb", "1=a.glb"});
    ASSERT_TRUE(files.ok());
    ASSERT_EQ(files->size(), 2u);
    EXPECT_EQ((*files)[0].level, 1u);
    EXPECT_EQ((*files)[1].path, "c=d.glb");
    for (const char* bad : {"", "1", "1=", "=a", "0=a", "1000=a", "-1=a", "1 =a", "a=b", "99999999999=a"})
    {
        const auto refused = parse({bad});
        ASSERT_FALSE(refused.ok()) << bad;
        EXPECT_EQ(refused.error().issue, Issue::usage);
    }
    EXPECT_FALSE(parse({"1=a", "1=b"}).ok());
}

} // namespace hearth::test
