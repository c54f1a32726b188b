// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/obj_materials.h"

#include <gtest/gtest.h>

namespace hearth::import
{

namespace
{

MtlLibrary read(std::string_view text)
{
    MtlLibrary library;
    readMtl(text, "a.mtl", library);
    return library;
}

MtlMaterial material(const std::string& statements)
{
    const MtlLibrary library = read("newmtl m\n" + statements);
    return library.materials.at("m");
}

TEST(ReadMtl, readsColoursAndScalars)
{
    const MtlMaterial m = material("Kd 0.1 0.2 0.3\nKe 4 5 6\nd 0.25\nNs 98\n");
    EXPECT_EQ(m.diffuse, (Float3{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(m.emissive, (Float3{4, 5, 6}));
    EXPECT_EQ(m.opacity, 0.25f);
    EXPECT_EQ(m.shininess, 98);
    EXPECT_EQ(material("Kd 0.5\n").diffuse, (Float3{0.5f, 0.5f, 0.5f}));
}

TEST(ReadMtl, trIsTheOppositeOfD)
{
    EXPECT_EQ(material("Tr 0.75\n").opacity, 0.25f);
    EXPECT_EQ(material("d -halo 0.5\n").opacity, 0.5f);
    // as written by programs that confuse the two
    EXPECT_EQ(material("Tr 1.0\n").opacity, 1);
    EXPECT_EQ(material("d 0\n").opacity, 1);
}

TEST(ReadMtl, namesMayHaveBlanks)
{
    const MtlLibrary library = read("newmtl  Red Plastic \nKd 1 0 0\nnewmtl b\nnewmtl b\nKd 9 9 9\n");
    EXPECT_EQ(library.materials.at("Red Plastic").diffuse, (Float3{1, 0, 0}));
    EXPECT_FALSE(library.materials.at("b").has_diffuse); // the first of two counts
}

TEST(ReadMtl, readsTextureOptionsOnBothSidesOfTheName)
{
    const MtlTexture a =
        material("map_Kd -blendu on -s 2 3 1 -o 0.5 0.25 -clamp on -mm 0 1 folder\\my file.png\n")
            .diffuse_map;
    EXPECT_EQ(a.file, "folder/my file.png");
    EXPECT_EQ(a.scale, (Float2{2, 3}));
    EXPECT_EQ(a.offset, (Float2{0.5f, 0.25f}));
    EXPECT_TRUE(a.clamp);
    const MtlMaterial b = material("map_bump -imfchan r bump.jpg -bm 1.5\n");
    EXPECT_EQ(b.normal_map.file, "bump.jpg");
    EXPECT_EQ(b.normal_map.bump_multiplier, 1.5f);
    EXPECT_TRUE(b.normal_is_bump);
    EXPECT_EQ(material("map_Kd -s 2 7.png\n").diffuse_map.file, "7.png");
    EXPECT_EQ(material("map_Kd -type sphere 3.jpg\n").diffuse_map.file, "3.jpg");
}

TEST(ReadMtl, aNormalMapWinsOverABumpMap)
{
    for (const char* text : {"norm n.png\nmap_Bump b.png\n", "map_Bump b.png\nnorm n.png\n"})
    {
        const MtlMaterial m = material(text);
        EXPECT_EQ(m.normal_map.file, "n.png");
        EXPECT_FALSE(m.normal_is_bump);
    }
}

TEST(ReadMtl, damageIsNotedAndSkipped)
{
    const MtlLibrary library = read("Kd 1 1 1\nnewmtl m\nKd x\nNs\nmap_refl r.png\nfoo 1\nKa 1 1 1\n");
    EXPECT_EQ(library.materials.size(), 1u);
    ASSERT_EQ(library.notes.size(), 4u);
    EXPECT_EQ(library.notes[0].where, "a.mtl line 3");
    EXPECT_EQ(library.notes[0].issue, Issue::repaired);
    EXPECT_EQ(library.notes[2].issue, Issue::dropped);
    EXPECT_NE(library.notes[2].detail.find("map_refl"), std::string::npos);
}

TEST(RoughnessFromShininess, fallsFromOneAsHighlightsNarrow)
{
    EXPECT_EQ(roughnessFromShininess(0), 1);
    EXPECT_NEAR(roughnessFromShininess(30), 0.5f, 1e-6f); // (2 / 32)^(1/4)
    EXPECT_LT(roughnessFromShininess(1000), 0.25f);
    EXPECT_EQ(roughnessFromShininess(-5), 1);
}

} // namespace

} // namespace hearth::import
