// Finished pictures: every view shows something, and the final one is what rays and the specification's formulas give.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/flip.h"
#include "tests/reference/reference_renderer.h"
#include "tests/roundtrip/draw_fixture.h"

#include <cstdio>
#include <cstdlib>
#include <set>

namespace hearth::roundtrip
{
namespace
{

using PictureTest = DrawTest;
using reference::Picture;

size_t colorCount(const Picture& picture)
{
    std::set<std::array<uint8_t, 3>> colors;
    for (size_t i = 0; i < picture.rgb.size(); i += 3)
        colors.insert({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
    return colors.size();
}

/// Mean of two by two pixels in linear light.
Picture halved(const Picture& picture)
{
    Picture half(picture.width / 2, picture.height / 2);
    for (size_t y = 0; y < half.height; ++y)
        for (size_t x = 0; x < half.width; ++x)
            for (size_t c = 0; c < 3; ++c)
            {
                double sum = 0;
                for (const size_t dy : {0u, 1u})
                    for (const size_t dx : {0u, 1u})
                        sum += reference::linearFromSrgb(picture.at(2 * x + dx, 2 * y + dy)[c] / 255.0);
                half.at(x, y)[c] = static_cast<uint8_t>(reference::srgbFromLinear(sum / 4) * 255 + 0.5);
            }
    return half;
}

/// Where HEARTH_KEEP_PICTURES names a folder, keep a picture for people to look at.
void keep(const Picture& picture, const std::string& name)
{
    const char* const folder = std::getenv("HEARTH_KEEP_PICTURES");
    if (folder == nullptr)
        return;
    EXPECT_TRUE(reference::writePng(std::string(folder) + "/" + name + ".png", picture).ok());
}

TEST_F(PictureTest, everyViewShowsItsOwn)
{
    const CookedSample& sample = cookedSample({"room"});
    const GpuScene scene = device().upload(sample.pack());
    const NamedView named = viewsOf(sample.pack())[3];
    std::vector<Picture> pictures;
    for (const uint32_t view : {shared::kViewFinal, shared::kViewClusters, shared::kViewLod,
                                shared::kViewTriangles, shared::kViewNormals, shared::kViewDepth})
    {
        const DrawnFrame drawn = scene.draw(named.frame(sample.pack()), view);
        EXPECT_GT(colorCount(drawn.picture), 30u) << "view " << view;
        for (const Picture& other : pictures)
            EXPECT_NE(other.rgb, drawn.picture.rgb) << "view " << view;
        pictures.push_back(drawn.picture);
        keep(drawn.picture, "view_" + std::to_string(view));
    }
}

TEST_F(PictureTest, theFinalViewIsWhatRaysGive)
{
    for (const SampleSpec& spec : {SampleSpec{"rock", 40000, 256},
                                   {"room", 0, 256},
                                   {"character", 20000},
                                   {"transforms", 3000},
                                   {"terrain", 30000, 256},
                                   {"grass", 60000}})
    {
        const CookedSample& sample = cookedSample(spec);
        const GpuScene scene = device().upload(sample.pack());
        NamedView named = viewsOf(sample.pack())[spec.kind == "room" ? 3 : 0];
        named.view.width = 512;
        named.view.height = 512;
        named.view.error_pixels = 1;
        const Picture drawn = halved(scene.draw(named.frame(sample.pack())).picture);

        reference::ReferenceOptions options;
        options.camera = named.view.camera;
        options.width = 256;
        options.height = 256;
        const auto expected = reference::renderReference(sample.pack(), options);
        ASSERT_TRUE(expected.ok()) << formatMessage(expected.error());
        const reference::FlipMap map = reference::flip(*expected, drawn);
        keep(drawn, spec.kind + "_gpu");
        keep(*expected, spec.kind + "_rays");
        keep(reference::showFlip(map), spec.kind + "_flip");
        std::printf("%-10s FLIP %.4f\n", spec.kind.c_str(), map.mean());
        EXPECT_LT(map.mean(), 0.05) << spec.kind;
    }
}

} // namespace
} // namespace hearth::roundtrip
