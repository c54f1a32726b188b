// Rules for textures: the more specific one wins; wrong ones are named with what is right.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/rules/texture_rules.h"

#include <gtest/gtest.h>

namespace hearth::texels
{

namespace
{

using namespace formats;

TextureRules parse(const std::string& text)
{
    const Result<TextureRules> rules = parseTextureRules(text, "rules");
    EXPECT_TRUE(rules.ok()) << (rules.ok() ? "" : formatMessage(rules.error()));
    return rules.ok() ? *rules : TextureRules{};
}

std::string fault(const std::string& text)
{
    const Result<TextureRules> rules = parseTextureRules(text, "rules");
    return rules.ok() ? "" : rules.error().where + ": " + rules.error().detail;
}

const TextureChoice kAll{.quality = Effort::normal, .families = Families{.astc = true}};

TEST(TextureRules, nameWinsOverRoleOverAll)
{
    const TextureRules rules = parse("textures.role=[{role='normal',target=2},{role='data',quality='high'}]\n"
                                     "textures.image=[{name='ui_*',format='plain'},"
                                     "{name='ui_b*',format='astc-4x4'},{name='*_n',quality='draft'},"
                                     "{name='old',families=['etc2']}]");
    const auto resolve = [&](ImageRole role, const char* name)
    { return resolveChoice(rules, kAll, role, name); };

    const TextureChoice untouched = resolve(ImageRole::color, "wood");
    EXPECT_EQ(untouched.quality, Effort::normal);
    EXPECT_FALSE(untouched.target);
    EXPECT_EQ(untouched.format, "");

    EXPECT_EQ(resolve(ImageRole::normal, "wood").target, 2);
    EXPECT_EQ(resolve(ImageRole::normal, "wood").quality, Effort::normal);
    EXPECT_EQ(resolve(ImageRole::data, "wood").quality, Effort::high);
    EXPECT_EQ(resolve(ImageRole::color, "ui_bar").format, "plain") << "the first that matches";
    EXPECT_EQ(resolve(ImageRole::data, "ui_bar").quality, Effort::high) << "what it does not set stays";
    const TextureChoice draft = resolve(ImageRole::normal, "wood_n");
    EXPECT_EQ(draft.quality, Effort::draft);
    EXPECT_FALSE(draft.target) << "a quality by name replaces a target by role";
    EXPECT_EQ(resolve(ImageRole::normal, "old").families, (Families{.etc2 = true}));
    EXPECT_EQ(resolve(ImageRole::normal, "old").target, 2) << "other families may hold the same target";
    EXPECT_FALSE(resolve(ImageRole::normal, "ui_n").target) << "a format by name replaces a target by role";
}

TEST(TextureRules, haveANameOrAPathOrBoth)
{
    const auto rules = parseTextureRules("textures.image=[{path='assets/ui/**',format='plain'},"
                                         "{name='a*',path='b',target=38}]",
                                         "");
    ASSERT_TRUE(rules.ok());
    EXPECT_EQ(rules->images[0].name, "*");
    EXPECT_EQ(rules->images[0].path, "assets/ui/**");
    EXPECT_EQ(rules->images[1].name, "a*");
    EXPECT_EQ(rules->images[1].path, "b");
}

TEST(TextureRules, formatsAreNamedInFullOrWithoutTheMeaningOfTheirNumbers)
{
    const TexelFormatTraits& srgb = texelTraits(astcFormat(TexelFormat::astc_srgb, 4));
    EXPECT_TRUE(matchesFormat("astc-6x6-srgb", srgb));
    EXPECT_TRUE(matchesFormat("astc-6x6", srgb));
    EXPECT_FALSE(matchesFormat("astc-6x6-unorm", srgb));
    EXPECT_FALSE(matchesFormat("astc-6x5", srgb));
    EXPECT_FALSE(matchesFormat("plain", srgb));
    EXPECT_TRUE(matchesFormat("plain", texelTraits(TexelFormat::rg8_unorm)));
    for (const char* name : {"eac-rg11", "bc7", "bc1-rgb", "rgba8", "rgb9e5", "etc2-rgba8-srgb", "plain"})
        EXPECT_EQ(fault(std::string("textures.image=[{name='*',format='") + name + "'}]"), "");
}

TEST(TextureRules, faultsNameTheirPlaceAndWhatIsRight)
{
    EXPECT_EQ(fault("textures.image=[{name='a',target=38},{name='*',format='astc-6x7'}]"),
              "textures.image[1].format: \"astc-6x7\" is not known: did you mean 'astc-6x5'?");
    EXPECT_EQ(fault("textures.role=[{role='normals',target=2}]"),
              "textures.role[0].role: \"normals\" is not known: did you mean 'normal'?");
    EXPECT_EQ(fault("textures.role=[{role='wood',target=2}]"),
              "textures.role[0].role: \"wood\" is none of color, cutout, emissive, data, normal, light");
    EXPECT_EQ(fault("textures.role=[{role='data',target=38,format='plain'}]"),
              "textures.role[0]: has a format and a target: a format is not searched");
    EXPECT_EQ(fault("textures.role=[{role='data'}]"),
              "textures.role[0]: sets nothing: give it target, quality, families or format");
    EXPECT_EQ(fault("textures.role=[{role='data',target=-1}]"),
              "textures.role[0].target: must be a number above 0, at most 100");
    EXPECT_EQ(
        fault("textures.image=[{target=38}]"),
        "textures.image[0].name: is missing: the names, or with path the sources, that the rule is for");
    EXPECT_EQ(fault("textures.image=[{name='a',quality='best'}]"),
              "textures.image[0].quality: \"best\" is none of draft, normal, high");
    EXPECT_EQ(fault("textures.image=[{name='a',families=['pvrtc']}]"),
              "textures.image[0].families: \"pvrtc\" is none of astc, astc-hdr, etc2, bc");
    EXPECT_EQ(fault("textures.image=[{name='a',targets=3}]"),
              "textures.image[0]: \"targets\" is not known: did you mean 'target'?");
    EXPECT_EQ(fault("textures.image=[]"), "textures.image: must be an array of at least one table");
}

} // namespace

} // namespace hearth::texels
