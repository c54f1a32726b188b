// Runs hearth-bricks on sources made here, imported and clustered by the real programs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/brick_tables.h"
#include "cook/json/json.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/pack/pack_check.h"
#include "sample_assets/samples.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/support/sandbox.h"
#include "tests/support/sanitized.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>

namespace hearth::test
{

using namespace samples;

namespace
{

constexpr uint32_t kUp = 3, kDown = 2;

std::string bin(const std::string& program)
{
    return HEARTH_BIN "/" + program;
}

/// Return what a dielectric of roughness 1 and a base colour gives back of the light from all sides: its
/// specular part is .01996, by integration of the BRDF over light and views.
float reflected(float base)
{
    return base * (1 - 0.01996f) + 0.01996f;
}

/// Contents of a bricks part by voxel.
struct Voxels
{
    struct Face
    {
        Float3 albedo, emission, lighting, normal;
    };
    struct Voxel
    {
        uint8_t opacity = 0;
        std::map<uint32_t, Face> faces;
    };
    formats::BrickGridRecord grid{};
    std::map<std::array<uint32_t, 3>, Voxel> voxels;
};

class BricksCook : public ::testing::Test
{
protected:
    ProgramEnd bricks(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), bin("hearth-bricks"));
        return folder.run(arguments);
    }

    /// Import and cluster a source; return the paths of its three parts.
    std::vector<std::string> parts(const std::string& name, const Document& document)
    {
        EXPECT_TRUE(writeFile(folder / (name + ".glb"), encodeGlb(document)).ok());
        return partsFromFile(name, name + ".glb");
    }
    std::vector<std::string> partsFromFile(const std::string& name, const std::string& source)
    {
        const std::string import = name + ".import", clusters = name + ".clusters",
                          textures = name + ".textures";
        EXPECT_EQ(folder.run({bin("hearth-import"), source, "-o", import}).exit_code, 0);
        EXPECT_EQ(folder.run({bin("hearth-clusters"), import, "-o", clusters}).exit_code, 0);
        EXPECT_EQ(folder.run({bin("hearth-textures"), import, "-o", textures}).exit_code, 0);
        return {import, clusters, textures};
    }
    std::vector<std::string> parts(const std::string& kind, const SampleOptions& options)
    {
        return parts(kind, generateSample(kind, options).value());
    }

    /// Return the room's parts, made once for all tests: its textures take a second.
    const std::vector<std::string>& room()
    {
        static Sandbox shared;
        static const std::vector<std::string> paths = [&]
        {
            std::vector<std::string> made;
            for (const std::string& name : parts("room", SampleOptions{}))
            {
                made.push_back(shared / name);
                std::filesystem::rename(folder / name, made.back());
            }
            return made;
        }();
        return paths;
    }

    Voxels read(const std::string& name)
    {
        auto reader = formats::ContainerReader::open(folder / name);
        EXPECT_TRUE(reader.ok());
        const auto view = formats::PackView::read(std::move(reader).value());
        EXPECT_TRUE(view.ok() && formats::checkBricks(*view).ok());
        Voxels result;
        result.grid = view->brickGrid()[0];
        const uint32_t gx = shared::brickGroupsAlongAxis(result.grid.voxels[0]),
                       gy = shared::brickGroupsAlongAxis(result.grid.voxels[1]);
        for (uint32_t g = 0; g < view->brickGroupsAlongAxis().size(); ++g)
        {
            const formats::BrickGroupRecord& group = view->brickGroupsAlongAxis()[g];
            uint32_t brick = group.first_brick;
            for (uint32_t b = 0; b < 64; ++b)
                if (shared::maskHas(group.brick_mask_low, group.brick_mask_high, b))
                    addBrick(*view, view->bricks()[brick++],
                             {g % gx * 16 + (b & 3) * 4, g / gx % gy * 16 + (b >> 2 & 3) * 4,
                              g / gx / gy * 16 + (b >> 4) * 4},
                             result);
        }
        return result;
    }

    static void addBrick(const formats::PackView& view, const formats::BrickRecord& brick,
                         const std::array<uint32_t, 3>& least, Voxels& result)
    {
        for (uint32_t bit = 0; bit < 64; ++bit)
        {
            if (!shared::maskHas(brick.voxel_mask_low, brick.voxel_mask_high, bit))
                continue;
            Voxels::Voxel& voxel =
                result.voxels[{least[0] + (bit & 3), least[1] + (bit >> 2 & 3), least[2] + (bit >> 4)}];
            voxel.opacity = view.brickOpacity()[shared::brickVoxel(brick, bit)];
            for (uint32_t side = 0; side < shared::kVoxelFaces; ++side)
            {
                const uint32_t face = shared::brickFace(brick, bit, side);
                if (face != shared::kNoFace)
                    voxel.faces[side] = {shared::decodeAlbedo(view.brickAlbedo()[face]),
                                         shared::decodeRadiance(view.brickEmission()[face]),
                                         shared::decodeRadiance(view.brickLighting()[face]),
                                         shared::decodeFaceNormal(view.brickNormals()[face])};
            }
        }
    }

    Json statistics() { return Json::parse(folder.read("stats.json")).value(); }

    Sandbox folder;
};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Square of `size` m about the origin, facing up, with its texture once over it.
TriangleMesh square(float size, float height)
{
    TriangleMesh mesh = makeGrid(1, 1,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     position = {(uv.x - 0.5f) * size, height, (0.5f - uv.y) * size};
                                     texture_uv = {uv.x, 1 - uv.y};
                                 });
    setFlatNormals(mesh);
    return mesh;
}

void addObject(Document& document, const char* name, TriangleMesh mesh, Material material)
{
    Node node;
    node.name = name;
    node.mesh =
        add(document.meshes, Mesh{name, {{std::move(mesh), add(document.materials, std::move(material))}}});
    addRoot(document, node);
}

Float3 chooseColor(uint32_t x, uint32_t z)
{
    return {static_cast<float>((x * 37 + z * 11) % 97) / 97, static_cast<float>((x * 5 + z * 61) % 89) / 89,
            static_cast<float>((x * 71 + z * 29) % 83) / 83};
}

float linear(float srgb)
{
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

} // namespace

TEST_F(BricksCook, showsATextureVoxelByVoxel)
{
    // 16 x 16 squares of 8 x 8 texels, each as large as a voxel
    Document document;
    Image image{"squares", 128, 128, {}};
    for (uint32_t row = 0; row < 128; ++row)
        for (uint32_t column = 0; column < 128; ++column)
        {
            const Float3 c = chooseColor(column / 8, row / 8);
            for (const float channel : {c.x, c.y, c.z, 1.0f})
                image.texels.push_back(static_cast<uint8_t>(std::lround(channel * 255)));
        }
    Material material;
    material.base_color_image = add(document.images, std::move(image));
    addObject(document, "square", square(16, 0.5f), material);
    const auto arguments = parts("squares", document);
    ASSERT_EQ(
        bricks(joined(arguments, {"-o", "a.part", "--voxel-size", "1", "--min", "-8,0,-8", "--max", "8,2,8"}))
            .exit_code,
        0);
    const Voxels voxels = read("a.part");
    ASSERT_EQ(voxels.voxels.size(), 256u);
    Box3 lit; // range of irradiance over pi
    for (const auto& [cell, voxel] : voxels.voxels)
    {
        EXPECT_EQ(cell[1], 0u);
        EXPECT_EQ(voxel.opacity, 255);
        const Voxels::Face& face = voxel.faces.at(kUp);
        const Float3 stored = chooseColor(cell[0], cell[2]);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(face.albedo[channel], reflected(linear(std::round(stored[channel] * 255) / 255)),
                        0.0015f);
        EXPECT_EQ(face.normal, (Float3{0, 1, 0}));
        // the default sun and the whole sky give all faces the same
        const Float3 irradiance{face.lighting.x / face.albedo.x, face.lighting.y / face.albedo.y,
                                face.lighting.z / face.albedo.z};
        for (int channel = 0; channel < 3; ++channel)
        {
            lit.min[channel] = std::min(lit.min[channel], irradiance[channel]);
            lit.max[channel] = std::max(lit.max[channel], irradiance[channel]);
        }
        EXPECT_EQ(voxel.faces.at(kDown).albedo, face.albedo);
    }
    for (int channel = 0; channel < 3; ++channel)
    {
        EXPECT_GT(lit.min[channel], 0.5f);
        EXPECT_LT(lit.max[channel], 1.05f * lit.min[channel])
            << "codes of light are a 64th apart, of blue a 32nd";
    }
}

TEST_F(BricksCook, multipliesFactorsColoursAndStrengths)
{
    Document document;
    TriangleMesh mesh = square(4, 0.5f);
    mesh.colors.assign(mesh.positions.size(), {0.5f, 1, 0.25f, 1});
    Material material;
    material.base_color = {0.8f, 0.4f, 0.2f, 1};
    material.emissive = {1, 0.5f, 0.25f};
    material.emissive_strength = 20;
    addObject(document, "lamp", mesh, material);
    const auto arguments = parts("lamp", document);
    ASSERT_EQ(bricks(joined(arguments, {"-o", "a.part", "--voxel-size", "1"})).exit_code, 0);
    const Voxels voxels = read("a.part");
    EXPECT_EQ(voxels.voxels.size(), 16u);
    for (const auto& [cell, voxel] : voxels.voxels)
    {
        const Voxels::Face& face = voxel.faces.at(kUp);
        EXPECT_NEAR(face.albedo.x, reflected(0.4f), 0.003f);
        EXPECT_NEAR(face.albedo.y, reflected(0.4f), 0.003f);
        EXPECT_NEAR(face.albedo.z, reflected(0.05f), 0.003f);
        EXPECT_NEAR(face.emission.x, 2 * face.emission.y, face.emission.x / 32);
        EXPECT_NEAR(face.emission.x, 4 * face.emission.z, face.emission.x / 16);
        // light of the rim leaves its voxels by their sides, too
        if (voxel.faces.size() == 2)
            EXPECT_NEAR(face.emission.x, 20, 2);
        EXPECT_GT(face.lighting.x, face.emission.x) << "sun and sky add to it";
        EXPECT_EQ(voxel.faces.at(kDown).emission, Float3{});
    }
}

/// A room needs bricks, open land does not; whoever asks for them gets them.
TEST_F(BricksCook, areMadeWhereTheyAreNeeded)
{
    ASSERT_EQ(bricks(joined(room(), {"-o", "room.part", "--voxel-size", "0.2", "--if-needed"})).exit_code, 0);
    EXPECT_GT(read("room.part").voxels.size(), 1000u);
    const auto land = parts("terrain", {.triangles = 2000, .texture_size = 16});
    const auto cookLand = [&](const std::vector<std::string>& options)
    {
        EXPECT_EQ(bricks(joined(joined(land, {"-o", "land.part", "--voxel-size", "2"}), options)).exit_code,
                  0);
        auto reader = formats::ContainerReader::open(folder / "land.part");
        return formats::PackView::read(std::move(reader).value()).value();
    };
    EXPECT_EQ(cookLand({}).brickGrid().size(), 1u);
    const formats::PackView open = cookLand({"--if-needed"});
    EXPECT_TRUE(open.brickGrid().empty());
    EXPECT_NE(
        std::string(open.meta()).find(" of 4096 points on surfaces and 0 of 0 cameras see less than a tenth"),
        std::string::npos)
        << open.meta();
}

/// A room of 4 m whose walls face in, with a hole of 1 m. Cleaning fills it, and the proxy keeps the sun out.
TEST_F(BricksCook, letsNoLightThroughGapsThatProxiesClose)
{
    std::string obj;
    const auto addCorner = [&](double x, double y, double z)
    { obj += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n"; };
    for (int corner = 0; corner < 8; ++corner)
        addCorner(corner & 1 ? 2 : -2, corner & 2 ? 2 : -2, corner & 4 ? 2 : -2);
    for (const auto& [y, z] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        addCorner(2, y, z);
    obj += "f 1 3 7 5\nf 1 5 6 2\nf 3 4 8 7\nf 1 2 4 3\nf 5 7 8 6\n"
           "f 2 6 12 9\nf 4 2 9 10\nf 8 4 10 11\nf 6 8 11 12\n"; // around the hole
    folder.write("leaky.obj", obj);
    const std::vector<std::string> source = partsFromFile("leaky", "leaky.obj");
    ASSERT_EQ(folder.run({bin("hearth-proxy"), source[0], source[1], "-o", "leaky.proxy", "--holes", "1"})
                  .exit_code,
              0);
    const auto lightOfFloor = [&](const std::vector<std::string>& options)
    {
        EXPECT_EQ(
            bricks(joined(joined(source, {"-o", "a.part", "--voxel-size", "0.25", "--min", "-4,-4,-4",
                                          "--max", "4,4,4", "--seed", "0,0,0", "--stats", "stats.json"}),
                          options))
                .exit_code,
            0);
        const Voxels voxels = read("a.part");
        float light = 0;
        for (uint32_t x = 8; x < 24; ++x)
            for (uint32_t z = 8; z < 24; ++z)
                light = std::max(light, voxels.voxels.at({x, 7, z}).faces.at(kUp).lighting.y);
        return light;
    };
    EXPECT_GT(lightOfFloor({}), 0.02f);
    EXPECT_EQ(statistics()["leaks"]["voxels"], 0);
    EXPECT_EQ(lightOfFloor({"--proxies", "0=leaky.proxy"}), 0);
    EXPECT_EQ(statistics()["leaks"]["surfaces"], 1);
    EXPECT_GT(statistics()["leaks"]["voxels"].get<int>(), 15);
    // convex parts contain what is outside of the mesh, too
    ASSERT_EQ(folder
                  .run({bin("hearth-proxy"), source[0], source[1], "-o", "convex.proxy", "--holes", "1",
                        "--convex-parts", "4"})
                  .exit_code,
              0);
    EXPECT_GT(lightOfFloor({"--proxies", "0=convex.proxy"}), 0.02f);
    EXPECT_EQ(statistics()["leaks"]["surfaces"], 0);
}

TEST_F(BricksCook, leavesHolesInGrass)
{
    const auto arguments = parts("grass", {.triangles = 20000, .texture_size = 64});
    ASSERT_EQ(bricks(joined(arguments, {"-o", "a.part", "--voxel-size", "0.2"})).exit_code, 0);
    const Voxels voxels = read("a.part");
    size_t partly = 0;
    for (const auto& [cell, voxel] : voxels.voxels)
        partly += voxel.opacity < 255 ? 1 : 0;
    EXPECT_GT(partly, 100u);
    EXPECT_LT(partly, voxels.voxels.size() / 4); // the ground has no emissive faces
}

TEST_F(BricksCook, takesOnlyWhatStandsStill)
{
    const auto character = parts("character", {.triangles = kSanitized ? 1000u : 3000u});
    ASSERT_EQ(bricks(joined(room(), {"-o", "room.part"})).exit_code, 0);
    const ProgramEnd both =
        bricks(joined(joined(room(), character), {"-o", "both.part", "--stats", "stats.json"}));
    ASSERT_EQ(both.exit_code, 0);
    EXPECT_EQ(countOccurrences(both.err, "both.part: warning: "), 1u) << both.err;
    EXPECT_NE(both.err.find("1 deformed instances have no bricks [W1400]"), std::string::npos) << both.err;
    EXPECT_EQ(statistics()["left_out"]["deformed"], 1);
    EXPECT_EQ(folder.read("room.part"), folder.read("both.part"));
}

TEST_F(BricksCook, putsSourcesSideBySide)
{
    const auto rock = parts("rock", {.triangles = 3000, .texture_size = 16});
    const std::vector<std::string> grid{"--voxel-size", "0.25", "--min", "-5,-3,-5", "--max", "5,5,5", "-o"};
    ASSERT_EQ(bricks(joined(joined(room(), grid), {"room.part"})).exit_code, 0);
    ASSERT_EQ(bricks(joined(joined(rock, grid), {"rock.part"})).exit_code, 0);
    ASSERT_EQ(bricks(joined(joined(joined(room(), rock), grid), {"both.part"})).exit_code, 0);
    const Voxels a = read("room.part"), b = read("rock.part"), both = read("both.part");
    auto expected = a.voxels;
    expected.insert(b.voxels.begin(), b.voxels.end());
    ASSERT_EQ(both.voxels.size(), expected.size());
    EXPECT_LT(both.voxels.size(), a.voxels.size() + b.voxels.size());
    for (const auto& [cell, voxel] : both.voxels)
        EXPECT_TRUE(expected.contains(cell));
}

TEST_F(BricksCook, makesTheSameBytesWithAnyNumberOfThreads)
{
    const auto arguments =
        joined(parts("grass", {.triangles = kSanitized ? 4000u : 20000u, .texture_size = 64}), room());
    for (const char* threads : {"1", "2", "3", "7"})
        ASSERT_EQ(bricks(joined(arguments, {"-o", threads, "--voxel-size", "0.1", "-j", threads})).exit_code,
                  0);
    for (const char* threads : {"2", "3", "7"})
        EXPECT_EQ(folder.read("1"), folder.read(threads)) << threads;
}

TEST_F(BricksCook, staysWithinItsMemory)
{
    const auto bytes = [&]() { return statistics()["memory"].back()["bytes"].get<uint64_t>(); };
    ASSERT_EQ(
        bricks(joined(room(), {"-o", "a.part", "--voxel-size", "0.1", "--stats", "stats.json"})).exit_code,
        0);
    const uint64_t whole = bytes();
    const std::string half = std::to_string(whole / 2);
    // the voxel size stays, and the voxels nearest to the camera are kept
    const ProgramEnd dropped = bricks(
        joined(room(), {"-o", "b.part", "--voxel-size", "0.1", "--stats", "stats.json", "--memory", half}));
    ASSERT_EQ(dropped.exit_code, 0);
    EXPECT_NE(dropped.err.find("bricks do not fit the memory: those from "), std::string::npos)
        << dropped.err;
    EXPECT_LE(bytes(), whole / 2);
    EXPECT_GT(bytes(), whole / 2 - 1000);
    const Voxels a = read("a.part"), b = read("b.part");
    for (const auto& [cell, voxel] : b.voxels)
    {
        ASSERT_TRUE(a.voxels.contains(cell));
        EXPECT_EQ(a.voxels.at(cell).faces.size(), voxel.faces.size());
    }
    EXPECT_GT(statistics()["dropped"]["bricks"].get<double>(), 0);
    // without a requested size, the voxels grow instead
    ASSERT_EQ(bricks(joined(room(), {"-o", "c.part", "--stats", "stats.json", "--memory", half})).exit_code,
              0);
    EXPECT_EQ(statistics()["dropped"]["bricks"], 0);
    EXPECT_LE(bytes(), whole / 2);
    const double chosen = statistics()["voxel_size"].get<double>();
    EXPECT_GT(chosen, 0.12);
    // and no further than they must: R10 has ten numbers a decade
    ASSERT_EQ(bricks(joined(room(), {"-o", "d.part", "--stats", "stats.json", "--voxel-size",
                                     std::to_string(chosen * 0.8)}))
                  .exit_code,
              0);
    EXPECT_GT(bytes(), whole / 2);
}

TEST_F(BricksCook, boundsItsWorkWhereTrianglesLieUponEachOther)
{
    if (kSanitized)
        GTEST_SKIP() << "the bound is four million pieces, and the other tests cut some";
    ASSERT_EQ(bricks(joined(room(), {"-o", "one.part", "--stats", "stats.json"})).exit_code, 0);
    const auto size = statistics()["voxel_size"].get<double>();
    const auto pieces = statistics()["pieces"].get<double>();
    constexpr double kBound = 4e6;
    ASSERT_LT(pieces, kBound / 2);
    std::vector<std::string> many;
    for (int copies = 0; copies < 1.25 * kBound / pieces; ++copies)
        many = joined(many, room());
    ASSERT_EQ(bricks(joined(many, {"-o", "many.part", "--stats", "stats.json"})).exit_code, 0);
    EXPECT_LT(statistics()["pieces"].get<double>(), kBound);
    EXPECT_GT(statistics()["pieces"].get<double>(), kBound / 4);
    EXPECT_GT(statistics()["voxel_size"].get<double>(), size);
}

TEST_F(BricksCook, makesAnEmptyGridWhereNothingStandsStill)
{
    const auto character = parts("character", {.triangles = 1000});
    ASSERT_EQ(bricks(joined(character, {"-o", "a.part"})).exit_code, 0);
    const Voxels voxels = read("a.part");
    EXPECT_TRUE(voxels.voxels.empty());
    EXPECT_EQ(voxels.grid.group_count, 1u);
}

TEST_F(BricksCook, refusesWhatMakesNoSenseAndWritesNothing)
{
    const auto refuse = [&](const std::vector<std::string>& options, int exit_code)
    {
        const ProgramEnd end = bricks(joined(joined(room(), options), {"-o", "a.part"}));
        EXPECT_EQ(end.exit_code, exit_code) << end.err;
        EXPECT_NE(end.err, "");
        EXPECT_FALSE(folder.has("a.part"));
    };
    for (const char* size : {"0", "-1", "nan", "inf", "1e-6", "1e-50", "much"})
        refuse({"--voxel-size", size}, 2);
    refuse({"--min", "0,0,0"}, 2);
    refuse({"--min", "0,0,0", "--max", "1,0,1"}, 2);
    refuse({"--min", "0,0,0", "--max", "1,nan,1"}, 2);
    refuse({"--min", "0,0", "--max", "1,1,1"}, 2);
    refuse({"--memory", "0"}, 2);
    refuse({"--memory", "-5"}, 2);
    refuse({"--memory", "100"}, 2);
    refuse({"--error", "-1"}, 2);
    refuse({"one-more.part"}, 2);
    refuse({"--proxies", "a.proxy"}, 2);
    refuse({"--proxies", "1=a.proxy"}, 2);
    refuse({"--proxies", "0="}, 2);
    refuse({"--proxies", "0=missing.proxy"}, 66);
    EXPECT_EQ(bricks({room()[0], room()[1], "missing.part", "-o", "a.part"}).exit_code, 66);
    folder.write("bad.part", "no container");
    EXPECT_EQ(bricks({room()[0], "bad.part", room()[2], "-o", "a.part"}).exit_code, 65);
    EXPECT_EQ(bricks(joined(room(), {"-o", "nowhere/a.part"})).exit_code, 73);
    // parts of another source
    const auto rock = parts("rock", {.triangles = 1000, .texture_size = 16});
    EXPECT_EQ(bricks({room()[0], rock[1], room()[2], "-o", "a.part"}).exit_code, 65);
    EXPECT_EQ(bricks({room()[0], room()[1], rock[1], "-o", "a.part"}).exit_code, 65);
    EXPECT_FALSE(folder.has("a.part"));
}

} // namespace hearth::test
