// Tests parts of wrapped meshes, and the command line of hearth-wrap.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/wrap/thread_time.h"
#include "cook/wrap/wrap_part.h"
#include "formats/base/regular_file.h"
#include "tests/support/sandbox.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using test::ProgramEnd;
using test::Sandbox;

const std::string kProgram = std::string(HEARTH_BIN) + "/hearth-wrap";

void writePart(const std::string& path, const std::vector<mesh::SourceMesh>& meshes)
{
    auto writer = formats::ContainerWriter::create(path, formats::ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    for (uint32_t i = 0; i < meshes.size(); ++i)
        ASSERT_TRUE(mesh::writeSourceMesh(writer.value(), i, meshes[i]).ok());
    ASSERT_TRUE(writer.value().finish().ok());
}

mesh::SourceMesh makeLine()
{
    mesh::SourceMesh mesh;
    mesh.name = "line";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    mesh.indices = {0, 1, 2};
    mesh.triangle_materials = {0};
    return mesh;
}

std::vector<mesh::SourceMesh> makeMeshes()
{
    std::vector<mesh::SourceMesh> meshes = {shapes::rock(8, 0.3f), makeLine(), shapes::foliage(20),
                                            shapes::blocks(4)};
    meshes[0].name = "rock";
    meshes[2].name = "leaves";
    meshes[3].name = "blocks";
    return meshes;
}

std::string readBytes(const std::string& path)
{
    const Result<std::string> bytes = readFile(path);
    EXPECT_TRUE(bytes.ok());
    return bytes.ok() ? bytes.value() : "";
}

/// FNV-1a of the bits of all positions and of the indices.
uint64_t hashMesh(const mesh::SourceMesh& mesh)
{
    uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](uint32_t word)
    {
        for (int byte = 0; byte < 4; ++byte)
            hash = (hash ^ (word >> 8 * byte & 255)) * 0x100000001b3u;
    };
    for (const Float3 p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis)
            add(std::bit_cast<uint32_t>(p[axis]));
    for (const uint32_t index : mesh.indices)
        add(index);
    return hash;
}

TEST(WrapPart, SameBytesForAnyNumberOfThreads)
{
    Sandbox sandbox;
    writePart(sandbox / "in.part", makeMeshes());
    std::string bytes;
    for (const size_t threads : {1u, 2u, 5u})
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto written = wrap::wrapPart(sandbox / "in.part", sandbox / "out.part", {.alpha = 0.05});
        ASSERT_TRUE(written.ok()) << formatMessage(written.error());
        const std::string again = readBytes(sandbox / "out.part");
        EXPECT_TRUE(bytes.empty() || bytes == again) << threads << " threads";
        bytes = again;
    }
}

TEST(WrapPart, SameTrianglesOnEveryMachine)
{
    // recorded by clang on an AMD processor; another compiler or processor must give the same
    const auto wrapped = wrap::wrapMesh(shapes::blocks(6), {.alpha = 0.03}, "", 0);
    ASSERT_TRUE(wrapped.ok());
    EXPECT_EQ(hashMesh(wrapped.value()), 7491517607752851036u);
}

TEST(WrapPart, MeshesKeepTheirNumbersAndNames)
{
    Sandbox sandbox;
    writePart(sandbox / "in.part", makeMeshes());
    const auto written = wrap::wrapPart(sandbox / "in.part", sandbox / "out.part", {.alpha = 0.05});
    ASSERT_TRUE(written.ok());
    const auto part = formats::ContainerReader::open(sandbox / "out.part", formats::Check::structure);
    ASSERT_TRUE(part.ok());
    const std::vector<mesh::SourceMesh> meshes = makeMeshes();
    for (uint32_t i = 0; i < meshes.size(); ++i)
    {
        const auto mesh = mesh::readSourceMesh(part.value(), i);
        ASSERT_TRUE(mesh.ok());
        EXPECT_EQ(mesh.value().name, meshes[i].name);
        EXPECT_EQ(mesh.value().triangleCount(), written.value()[i].triangles);
        EXPECT_EQ(mesh.value().triangleCount() == 0, meshes[i].name == "line");
    }
    EXPECT_EQ(part.value().find(formats::kChunkSourceMesh, static_cast<uint32_t>(meshes.size())), nullptr);
}

TEST(WrapPart, WrapsMeshesOfOneShapeOnce)
{
    mesh::SourceMesh box = shapes::blocks(3);
    box.name = "box";
    mesh::SourceMesh copy = box;
    copy.name = "copy";
    copy.triangle_materials.assign(copy.triangleCount(), 7);
    mesh::SourceMesh larger = box;
    for (Float3& position : larger.positions)
        position = position * 2;
    Sandbox sandbox;
    writePart(sandbox / "in.part", {box, larger, copy, box});
    const auto written = wrap::wrapPart(sandbox / "in.part", sandbox / "out.part", {.alpha = 0.05});
    ASSERT_TRUE(written.ok());
    const auto part = formats::ContainerReader::open(sandbox / "out.part", formats::Check::structure);
    ASSERT_TRUE(part.ok());
    std::vector<uint64_t> hashes;
    for (uint32_t i = 0; i < 4; ++i)
    {
        EXPECT_EQ(written.value()[i].seconds > 0, i < 2) << i;
        const auto mesh = mesh::readSourceMesh(part.value(), i);
        ASSERT_TRUE(mesh.ok());
        hashes.push_back(hashMesh(mesh.value()));
        EXPECT_EQ(mesh.value().name, i == 2 ? "copy" : "box");
        EXPECT_EQ(
            mesh.value().triangle_materials,
            std::vector<uint32_t>(mesh.value().triangleCount(), i == 2 ? 7 : box.triangle_materials[0]));
    }
    EXPECT_NE(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
    EXPECT_EQ(hashes[3], hashes[0]);
}

TEST(WrapProgram, WrapsAndWarnsOfMeshesWithoutArea)
{
    Sandbox sandbox;
    writePart(sandbox / "in.part", makeMeshes());
    const ProgramEnd end = sandbox.run(
        {kProgram, "in.part", "-o", "out.part", "--alpha", "0.05", "--offset", "0.002", "--stats", "-"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(end.err,
              "in.part|mesh 1 \"line\": warning: no triangle has an area: its wrap is empty [W1400]\n");
    const auto statistics = Json::parse(end.out);
    ASSERT_TRUE(statistics);
    EXPECT_EQ(statistics->at("meshes").size(), 4u);
    EXPECT_EQ(statistics->at("meshes").at(0).at("source_triangles").get<int>(), 12 * 8 * 8);
    EXPECT_GT(statistics->at("meshes").at(0).at("triangles").get<int>(), 100);
}

TEST(WrapProgram, SaysNothingOfMeshesWithoutTriangles)
{
    mesh::SourceMesh hull; // as the importer leaves meshes that are proxies
    hull.name = "UCX_box";
    Sandbox sandbox;
    writePart(sandbox / "in.part", {hull, shapes::blocks(3)});
    const ProgramEnd end = sandbox.run({kProgram, "in.part", "-o", "out.part", "--alpha", "0.1"});
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_EQ(end.err, "");
}

TEST(WrapProgram, BadCommandLinesAndInputs)
{
    Sandbox sandbox;
    writePart(sandbox / "in.part", makeMeshes());
    sandbox.write("text.part", "no part");
    const auto exitCode = [&](std::vector<std::string> words)
    {
        words.insert(words.begin(), kProgram);
        return sandbox.run(words).exit_code;
    };
    EXPECT_EQ(exitCode({"in.part"}), 2) << "no output";
    EXPECT_EQ(exitCode({"in.part", "-o", "out.part", "--self-intersections", "-"}), 2);
    EXPECT_EQ(exitCode({"in.part", "-o", "out.part", "--alpha", "0"}), 2);
    EXPECT_EQ(exitCode({"in.part", "-o", "out.part", "--offset", "-1"}), 2);
    EXPECT_EQ(exitCode({"missing.part", "-o", "out.part"}), 66);
    EXPECT_EQ(exitCode({"text.part", "-o", "out.part"}), 65);
    EXPECT_EQ(exitCode({"in.part", "-o", "missing/out.part"}), 73);
    EXPECT_FALSE(sandbox.has("out.part"));
}

TEST(WrapProgram, LimitsNameTheMeshAndTheRemedy)
{
    Sandbox sandbox;
    writePart(sandbox / "in.part", {shapes::rock(16, 0.3f)});
    const std::vector<std::string> words = {kProgram, "in.part", "-o", "out.part"};
    for (const auto& [option, value] : {std::pair("--max-seconds", "0.01"), std::pair("--max-memory", "64")})
    {
        std::vector<std::string> command = words;
        command.insert(command.end(), {"--alpha", "0.001", option, value});
        const ProgramEnd end = sandbox.run(command);
        EXPECT_EQ(end.exit_code, 65) << option << end.err;
        EXPECT_EQ(test::countOccurrences(end.err, "in.part|mesh 0 \"\""), 1u) << end.err;
        EXPECT_EQ(test::countOccurrences(end.err, "set a larger proxy.alpha"), 1u) << end.err;
        EXPECT_FALSE(sandbox.has("out.part"));
    }
}

TEST(WrapPart, TimeForSelfIntersectionsIsThatOfAllMeshes)
{
    Sandbox sandbox;
    writePart(sandbox / "one.part", {shapes::tangle(40, 500)});
    writePart(sandbox / "many.part", std::vector(50, shapes::tangle(40, 500)));
    const double start = wrap::threadSeconds();
    ASSERT_TRUE(wrap::describeSelfIntersections(sandbox / "one.part", 60).ok());
    const double limit = 10 * (wrap::threadSeconds() - start);
    EXPECT_TRUE(wrap::describeSelfIntersections(sandbox / "one.part", limit).ok());
    const auto many = wrap::describeSelfIntersections(sandbox / "many.part", limit);
    ASSERT_FALSE(many.ok());
    EXPECT_EQ(many.error().issue, Issue::input_too_large);
    EXPECT_NE(many.error().detail.find("processor time"), std::string::npos) << many.error().detail;
}

TEST(WrapProgram, ListsSelfIntersectionsByTheTrianglesOfTheSource)
{
    mesh::SourceMesh crossing = makeLine(); // its triangle 0 has no area
    crossing.name = "crossing";
    crossing.positions.insert(crossing.positions.end(), {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    crossing.positions.insert(crossing.positions.end(), {{1, 1, -1}, {1, 1, 1}, {2, 1, 1}});
    crossing.positions.insert(crossing.positions.end(),
                              {{4, 0, 0}, {0, 4, 0}, {4, 4, 0}}); // beside the first
    crossing.indices.insert(crossing.indices.end(), {3, 4, 5, 6, 7, 8, 9, 11, 10});
    crossing.indices.insert(crossing.indices.end(), {4, 3, 5}); // a copy of the first
    crossing.triangle_materials.insert(crossing.triangle_materials.end(), 4, 0);
    Sandbox sandbox;
    writePart(sandbox / "in.part", {makeLine(), crossing});
    const ProgramEnd end = sandbox.run({kProgram, "in.part", "--self-intersections", "out.json"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(sandbox.read("out.json"),
              "{\"meshes\":[{\"mesh\":0,\"name\":\"line\",\"intersecting_triangle_pairs\":0,\"pairs\":[]},"
              "{\"mesh\":1,\"name\":\"crossing\",\"intersecting_triangle_pairs\":1,\"pairs\":[[1,2]]}]}\n");
}

} // namespace
