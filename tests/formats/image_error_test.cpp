// Errors of images in words, beside their targets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_error.h"

#include <gtest/gtest.h>

namespace hearth::formats
{

TEST(ImageError, isToldBesideItsTarget)
{
    EXPECT_EQ(imageErrorText(ImageRole::color, 0.01, 0.0112), "40.0 dB (target 39.0)");
    EXPECT_EQ(imageErrorText(ImageRole::data, 0.02, 0.01), "34.0 dB (target 40.0, missed)");
    EXPECT_EQ(imageErrorText(ImageRole::normal, 0.0175, 0.0262), "1.00 degrees (target 1.50)");
    EXPECT_EQ(imageErrorText(ImageRole::light, 0.06, 0.05), "0.060 stops (target 0.050, missed)");
    EXPECT_EQ(imageErrorText(ImageRole::color, 0, 0.01), "exact (target 40.0 dB)");
    EXPECT_EQ(imageErrorText(ImageRole::color, 0.01, 0), "40.0 dB") << "there is no target";
}

TEST(ImageError, missesATargetOfAllOrOfSmoothTexels)
{
    const auto holds = [](float error, float target, float smooth, float smooth_target)
    {
        ImageRecord image{};
        image.error = error;
        image.target = target;
        image.error_smooth = smooth;
        image.target_smooth = smooth_target;
        return holdsTargets(image);
    };
    EXPECT_TRUE(holds(0.01F, 0.01F, 0.002F, 0.003F));
    EXPECT_FALSE(holds(0.0101F, 0.01F, 0.002F, 0.003F));
    EXPECT_FALSE(holds(0.01F, 0.01F, 0.004F, 0.003F));
    EXPECT_TRUE(holds(0.01F, 0.01F, 0.004F, 0)) << "smooth areas have no target";
    EXPECT_TRUE(holds(1, 0, 1, 0)) << "nothing has";
}

} // namespace hearth::formats
