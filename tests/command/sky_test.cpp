// Tests the sky of a pack with the real cookers: that of --sky, and a source's image-based light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/environment/environment.h"
#include "cook/json/json.h"
#include "formats/pack/pack_view.h"
#include "formats/texels/shared_exponent.h"
#include "tests/command/sky_source.h"
#include "tests/pipelines_scans/ktx2_builder.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;

/// Radiance from 0.6 to 4.2 that tells all directions apart.
Double3 brightSky(Double3 d)
{
    d = d * (1 / length(d));
    return Double3{2 + 1.4 * d.x, 2.4 + 1.8 * d.y, 2 + 1.3 * d.z};
}

/// Return a KTX2 cube of floats of the sky.
std::string makeCube(const Sky& sky)
{
    using environment::Layout;
    import::test::Ktx2 cube;
    cube.vk_format = 106; // R32G32B32_SFLOAT
    cube.width = cube.height = kSkySourceSide;
    cube.faces = 6;
    cube.channels = {0, 1, 2};
    cube.levels = {{}};
    for (uint32_t i = 0; i < 6 * kSkySourceSide * kSkySourceSide; ++i)
    {
        const Double3 color =
            sky(panelDirection(Layout::cube, i / (kSkySourceSide * kSkySourceSide),
                               {(i % kSkySourceSide + 0.5) / kSkySourceSide,
                                (i / kSkySourceSide % kSkySourceSide + 0.5) / kSkySourceSide}));
        for (const double channel : {color.x, color.y, color.z})
            import::test::append(cube.levels[0], std::bit_cast<uint32_t>(static_cast<float>(channel)), 4);
    }
    cube.uncompressed = {cube.levels[0].size()};
    const import::test::Bytes bytes = cube.file();
    return {bytes.begin(), bytes.end()};
}

class CookSky : public ::testing::Test
{
protected:
    CookSky()
    {
        writeObj(folder, "crate");
        std::string file = "#?RADIANCE\n\n-Y 4 +X 8\n";
        for (int i = 0; i < 32; ++i)
            file += "\x50\x50\x40\x81";
        folder.write("sky.hdr", file);
    }

    ProgramEnd cook(const std::vector<std::string>& options,
                    const std::vector<std::string>& sources = {"crate.obj"})
    {
        std::vector<std::string> words{std::string(HEARTH_BIN) + "/hearth",
                                       "cook",
                                       "-o",
                                       "crate.hearth",
                                       "--visibility=off",
                                       "--bricks=off",
                                       "--cache",
                                       folder.cacheSpec()};
        words.insert(words.end(), options.begin(), options.end());
        words.insert(words.end(), sources.begin(), sources.end());
        return folder.run(words);
    }

    formats::PackView openPack() const
    {
        return formats::PackView::read(formats::ContainerReader::open(folder / "crate.hearth").value())
            .value();
    }

    /// Expect two packs with one probe, the sky, which differ by the rounding of codes of 8 bits.
    static void expectSameSky(const formats::PackView& a, const formats::PackView& b)
    {
        constexpr double kRounding = 0.02; // half a step of the darkest code, 96, is 1.3 % of its light
        ASSERT_EQ(a.probes().size(), 1u);
        ASSERT_EQ(b.probes().size(), 1u);
        const formats::ProbeRecord &probe = a.probes()[0], &other = b.probes()[0];
        EXPECT_EQ(probe.flags, formats::kProbeIsSky);
        EXPECT_EQ(other.flags, formats::kProbeIsSky);
        ASSERT_EQ(a.probeTexels().size(), b.probeTexels().size());
        for (size_t i = 0; i < a.probeTexels().size(); ++i)
        {
            const auto texel = formats::decodeSharedExponent(a.probeTexels()[i]);
            const auto expected = formats::decodeSharedExponent(b.probeTexels()[i]);
            for (size_t c = 0; c < 3; ++c)
            {
                const double radiance = double{texel[c]} * double{probe.irradiance_luminance};
                const double wanted = double{expected[c]} * double{other.irradiance_luminance};
                ASSERT_NEAR(radiance, wanted, kRounding * wanted) << "texel " << i;
            }
        }
    }

    Json probes()
    {
        const ProgramEnd end =
            folder.run({std::string(HEARTH_BIN) + "/hearth", "inspect", "crate.hearth", "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return Json::parse(end.out).value()["scene"]["probes"];
    }

    Sandbox folder;
};

} // namespace

TEST_F(CookSky, givesThePackTheProbeOfTheFile)
{
    ASSERT_EQ(cook({}).exit_code, 0);
    EXPECT_EQ(probes().size(), 0u);
    const ProgramEnd first = cook({"--sky", "sky.hdr"});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    ASSERT_EQ(probes().size(), 1u);
    EXPECT_NEAR(probes()[0]["irradiance"][0].get<double>(), 3.14159265 * 80 / 128, 1e-5);
    EXPECT_EQ(probes()[0]["bytes"], 524160);
}

TEST_F(CookSky, isTheImageBasedLightOfASourceUnlessAnImageIsNamed)
{
    writeGltfUnderSky(folder, "house", brightSky);
    folder.write("bright.ktx2", makeCube(brightSky));
    ASSERT_EQ(cook({"--sky", "bright.ktx2"}).exit_code, 0);
    const formats::PackView expected = openPack();
    const ProgramEnd end = cook({}, {"crate.obj", "house.gltf"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(end.err.find("[W1400]"), std::string::npos) << end.err;
    expectSameSky(openPack(), expected);

    folder.write("dark.ktx2", makeCube([](Double3 d) { return brightSky(d) * 0.25; }));
    const ProgramEnd named = cook({"--sky", "dark.ktx2"}, {"house.gltf"});
    ASSERT_EQ(named.exit_code, 0) << named.err;
    EXPECT_THAT(named.err, HasSubstr("house.gltf: warning: its image-based light is not the sky of the pack: "
                                     "environment.file names another [W1400]"));
    const formats::PackView pack = openPack();
    ASSERT_EQ(pack.probes().size(), 1u);
    EXPECT_NEAR(pack.probes()[0].irradiance.x, 0.25f * expected.probes()[0].irradiance.x, 1e-4);
}

TEST_F(CookSky, ofSourcesMustBeTheSame)
{
    writeGltfUnderSky(folder, "house", brightSky);
    writeGltfUnderSky(folder, "shed", brightSky);
    const ProgramEnd same = cook({}, {"house.gltf", "shed.gltf"});
    ASSERT_EQ(same.exit_code, 0) << same.err;
    EXPECT_EQ(openPack().probes().size(), 1u);

    writeGltfUnderSky(folder, "shed", [](Double3 d) { return brightSky(d) * 0.5; });
    const ProgramEnd different = cook({}, {"house.gltf", "shed.gltf"});
    EXPECT_EQ(different.exit_code, 78) << different.err;
    EXPECT_THAT(different.err, HasSubstr("shed.gltf|import.sky: error: its image-based light is not that of "
                                         "house.gltf, and a pack has one sky"));

    folder.write("hearth.toml", "[[rule]]\nmatch = \"shed.gltf\"\nimport.sky = \"off\"\n");
    const ProgramEnd mended = cook({}, {"house.gltf", "shed.gltf"});
    ASSERT_EQ(mended.exit_code, 0) << mended.err;
    const formats::PackView pack = openPack();
    ASSERT_EQ(pack.probes().size(), 1u);
    EXPECT_NEAR(pack.probes()[0].irradiance.x, 2 * 3.14159, 0.06) << "that of the house";
}

TEST_F(CookSky, lightsWhatCookersOfTheSceneBake)
{
    // codes of 0 and 255 over an alpha of 51: RGBD has these numbers without rounding
    const auto exactSky = [](Double3 d) {
        return Double3{d.x > std::abs(d.z) ? 5.0 : 0.0, 5, d.y > std::abs(d.x) ? 5.0 : 0.0};
    };
    writeGltfUnderSky(folder, "house", exactSky);
    folder.write("sky.ktx2", makeCube(exactSky));
    const auto hashChunks = [&](const std::vector<std::string>& options)
    {
        std::vector<std::string> all{"--probe", "0.3,0.3,2", "--receivers", "--bricks=on"};
        all.insert(all.end(), options.begin(), options.end());
        const ProgramEnd end = cook(all, {"house.gltf"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        std::map<uint32_t, uint64_t> hashes;
        const formats::PackView pack = openPack();
        for (const formats::ChunkEntry& entry : pack.container().chunks())
            if (entry.type != formats::kChunkMeta)
                hashes[entry.type] += entry.hash;
        return hashes;
    };
    std::map<uint32_t, uint64_t> of_source = hashChunks({});
    EXPECT_EQ(of_source, hashChunks({"--sky", "sky.ktx2"})) << "all bytes are the same, under either";
    std::map<uint32_t, uint64_t> of_default = hashChunks({"--set", "import.sky=off"});
    for (const uint32_t chunk :
         {formats::kChunkProbes, formats::kChunkBrickLighting, formats::kChunkReceiverWords})
        EXPECT_NE(of_source[chunk], of_default[chunk]) << "without it the default sky lights them";
}

TEST_F(CookSky, namesAFileThatIsNoEnvironment)
{
    const ProgramEnd missing = cook({"--sky", "none.hdr"});
    EXPECT_EQ(missing.exit_code, 66);
    EXPECT_NE(missing.err.find("none.hdr: error: "), std::string::npos) << missing.err;
    const ProgramEnd other = cook({"--sky", "crate.obj"});
    EXPECT_EQ(other.exit_code, 65);
    EXPECT_NE(other.err.find("crate.obj: error: an environment is an image"), std::string::npos) << other.err;
    EXPECT_FALSE(folder.has("crate.hearth"));
}

} // namespace hearth::test
