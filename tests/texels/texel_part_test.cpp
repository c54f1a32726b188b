// The record of an encoded image has the target that its format was chosen by.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_part.h"
#include "formats/pack/image_error.h"
#include "formats/pack/pack_view.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace hearth::texels
{

namespace
{

using namespace formats;

class TexelPart : public ::testing::Test
{
protected:
    /// Encode the images of the small pack. paint.png, a cut-out, is full of noise and gets a rule; it is so
    /// large that blocks take fewer bytes than plain texels. Return the records of the part.
    std::vector<ImageRecord> encoded(const TextureChoice& choice, TexelOptions options = {})
    {
        test::PackModel model = test::smallPack();
        model.images[0].width = model.images[0].height = 16;
        model.images[0].mip_count = 1;
        model.image_data[0].resize(size_t{16} * 16 * 4);
        std::mt19937 random(7);
        for (std::byte& byte : model.image_data[0])
            byte = static_cast<std::byte>(random() & 0xFF);
        test::writeParts(model, folder.path(), "small");
        options.families.astc = true;
        options.rules.images.push_back({.name = "paint.png", .choice = choice});
        results = {};
        const Status cooked = cookTexels(folder / "small.import.part", folder / "small.textures.part",
                                         folder / "small.texels.part", options, results);
        EXPECT_TRUE(cooked.ok()) << (cooked.ok() ? "" : formatMessage(cooked.error()));
        Result<ContainerReader> reader =
            ContainerReader::open(folder / "small.texels.part", Check::structure);
        const PackView part = PackView::read(std::move(reader).value()).value();
        return {part.images().begin(), part.images().end()};
    }

    bool holdsTarget() const { return results.images.front().holds_target; }

    test::Sandbox folder;
    TexelResults results;
};

} // namespace

TEST_F(TexelPart, storesTheTargetsOfRoleAndQuality)
{
    const ImageRecord image = encoded({.quality = Effort::high})[0];
    EXPECT_EQ(imageRoleName(image.role), "cutout");
    EXPECT_FLOAT_EQ(image.target, std::pow(10.0F, -49.0F / 20)) << "43 dB, and 6 for a cut-out";
    EXPECT_FLOAT_EQ(image.target_smooth, std::pow(10.0F, -55.0F / 20));
    EXPECT_GT(image.error, image.target) << "noise";
    EXPECT_FALSE(holdsTarget());
    EXPECT_FALSE(holdsTargets(image));
}

TEST_F(TexelPart, storesTheTargetOfARule)
{
    const ImageRecord image = encoded({.target = 12.0})[0];
    EXPECT_FLOAT_EQ(image.target, std::pow(10.0F, -12.0F / 20));
    EXPECT_LE(image.error, image.target);
    EXPECT_GT(image.error, 0);
    EXPECT_TRUE(holdsTarget());
    EXPECT_TRUE(holdsTargets(image));
}

TEST_F(TexelPart, storesNoTargetWhereAFormatIsNamed)
{
    const ImageRecord by_rule = encoded({.format = "astc-8x8"})[0];
    EXPECT_EQ(by_rule.target, 0);
    EXPECT_EQ(by_rule.target_smooth, 0);
    EXPECT_GT(by_rule.error, results.images.front().target.error) << "which nobody asked for";
    EXPECT_TRUE(holdsTarget());

    const ImageRecord by_budget = encoded({}, {.formats = {{0, "astc-8x8-srgb"}}})[0];
    EXPECT_EQ(by_budget.error, by_rule.error);
    EXPECT_EQ(by_budget.target, 0);
    EXPECT_TRUE(holdsTarget());
}

TEST_F(TexelPart, storesNoTargetOfSmoothAreasForRolesWithoutOne)
{
    const ImageRecord glow = encoded({})[1];
    EXPECT_EQ(imageRoleName(glow.role), "light");
    EXPECT_FLOAT_EQ(glow.target, 0.05F) << "stops";
    EXPECT_EQ(glow.target_smooth, 0);
}

} // namespace hearth::texels
