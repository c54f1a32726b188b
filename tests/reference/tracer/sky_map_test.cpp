// Radiance of an image between the centres of its texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/sky_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hearth::reference
{

namespace
{

using environment::Environment;
using environment::Layout;

/// Image whose texels all differ, by about as much as neighbours of a photograph do.
Environment makeImage(Layout layout)
{
    const uint32_t side = 16;
    Environment image{layout, layout == Layout::cube ? side : 2 * side, side, {}};
    for (uint32_t i = 0; i < image.panelCount() * image.width * image.height; ++i)
        image.texels.push_back(Float3{1, 2, 4} * (0.2f + 0.1f * static_cast<float>(i * 7 % 31)));
    return image;
}

double radiance(const SkyMap& sky, const Environment& image, uint32_t panel, double x, double y)
{
    const auto d = panelDirection(image.layout, panel, {x / image.width, y / image.height});
    return sky.radiance({d.x, d.y, d.z}).y;
}

TEST(SkyMapTest, isLinearBetweenTheCentresOfTexels)
{
    for (const Layout layout : {Layout::lat_long, Layout::cube})
    {
        const Environment image = makeImage(layout);
        const SkyMap sky(image);
        for (uint32_t panel = 0; panel < image.panelCount(); ++panel)
            for (uint32_t y = 0; y + 1 < image.height; ++y)
                for (uint32_t x = 0; x + 1 < image.width; ++x)
                {
                    const double here = double{image.texels[image.index(panel, x, y)].y};
                    const double right = double{image.texels[image.index(panel, x + 1, y)].y};
                    const double below = double{image.texels[image.index(panel, x, y + 1)].y};
                    ASSERT_NEAR(radiance(sky, image, panel, x + 0.5, y + 0.5), here, 1e-6);
                    ASSERT_NEAR(radiance(sky, image, panel, x + 0.75, y + 0.5), 0.75 * here + 0.25 * right,
                                1e-6);
                    ASSERT_NEAR(radiance(sky, image, panel, x + 0.5, y + 1.0), 0.5 * here + 0.5 * below,
                                1e-6);
                }
    }
}

TEST(SkyMapTest, goesAroundTheSeamOfALatLongImage)
{
    const Environment image = makeImage(Layout::lat_long);
    const SkyMap sky(image);
    for (uint32_t y = 1; y + 1 < image.height; ++y)
    {
        const double first = double{image.texels[image.index(0, 0, y)].y};
        const double last = double{image.texels[image.index(0, image.width - 1, y)].y};
        EXPECT_NEAR(radiance(sky, image, 0, 0.25, y + 0.5), 0.75 * first + 0.25 * last, 1e-6);
        EXPECT_NEAR(radiance(sky, image, 0, image.width - 0.25, y + 0.5), 0.75 * last + 0.25 * first, 1e-6);
    }
}

} // namespace

} // namespace hearth::reference
