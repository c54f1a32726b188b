// Tests contact sheets: which packs are drawn as one, the layout of the cells, and the letters. No device is
// needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/contact_sheet.h"

#include "runtime/viewer/pixel_font.h"
#include "tests/support/sanitized.h"
#include "tests/support/small_pack.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace hearth::test
{

namespace
{

using namespace formats;

/// A pack whose assets have these boxes; it is not checked.
PackView makePack(const std::vector<Box3>& boxes)
{
    PackModel model = smallPack();
    model.assets.clear();
    for (const Box3& box : boxes)
    {
        AssetRecord asset{};
        asset.box_min = box.min;
        asset.box_max = box.max;
        model.assets.push_back(asset);
    }
    static std::vector<AlignedBytes> kept; // must live as long as the views
    kept.push_back(model.bytes());
    return PackView::read(ContainerReader::fromBytes(kept.back().span(), "test").value()).value();
}

/// A box on the ground with its centre at x and z.
Box3 standing(float side, float x = 0, float z = 0)
{
    return {{x - side / 2, 0, z - side / 2}, {x + side / 2, side, z + side / 2}};
}

bool inOnePlace(const std::vector<Box3>& boxes)
{
    return viewer::areUnplaced(makePack(boxes));
}

/// Text as lines of # and spaces.
std::vector<std::string> drawn(std::string_view text, uint32_t width, uint32_t height, uint32_t scale = 1)
{
    std::vector<std::byte> pixels(size_t{width} * height * 4);
    viewer::drawText({pixels, width, height}, 0, 0, scale, text, std::byte{200});
    std::vector<std::string> lines(height, std::string(width, ' '));
    for (size_t i = 0; i < pixels.size(); i += 4)
        if (pixels[i] == std::byte{200})
            lines[i / 4 / width][i / 4 % width] = '#';
    return lines;
}

} // namespace

TEST(OnePlace, isWhereModelsStandThatNobodyPlaced)
{
    EXPECT_TRUE(inOnePlace({standing(1), standing(1), standing(500)}));
    EXPECT_TRUE(inOnePlace({standing(1), standing(0.02f)}));
    const Box3 centered{{-1, -1, -1}, {1, 1, 1}};
    const Box3 by_its_corner{{0, 0, 0}, {2, 3, 0.2f}}; // a wall of a kit
    const Box3 flat{{-1, 0, -1}, {1, 0, 1}};
    EXPECT_TRUE(inOnePlace({centered, standing(2), by_its_corner, flat}));
    // a single scan far away does not make the others a scene
    EXPECT_TRUE(inOnePlace({standing(1), standing(2), standing(3), standing(1, 300, 0)}));
}

TEST(OnePlace, isNoneWhereTheyStandSideBySide)
{
    EXPECT_FALSE(inOnePlace({standing(1, -1.1f), standing(1), standing(1, 1.1f)}));
    EXPECT_FALSE(inOnePlace({standing(1, -0.55f), standing(1, 0.55f)})) << "nearly around the origin";
    EXPECT_FALSE(inOnePlace({standing(1, -0.5f, -0.5f), standing(1, 0.5f, -0.5f), standing(1, -0.5f, 0.5f),
                             standing(1, 0.5f, 0.5f)}))
        << "tiles that meet there";
    std::vector<Box3> house{standing(10)};
    for (int i = 0; i < 6; ++i)
        house.push_back(standing(0.5f, static_cast<float>(i) - 2.5f, 2));
    EXPECT_FALSE(inOnePlace(house)) << "props in it";
    EXPECT_FALSE(inOnePlace({standing(100), standing(1, 20, 30)})) << "a tree on its ground";
    EXPECT_FALSE(inOnePlace({standing(1), standing(1), standing(1, 300), standing(1, 310)}));
    EXPECT_FALSE(inOnePlace({standing(1)}));
    EXPECT_FALSE(inOnePlace({standing(1), Box3{{0, 0, 0}, {0, 0, 0}}})) << "that draws nothing";
    EXPECT_FALSE(inOnePlace({}));
}

TEST(Sheet, hasACellForEachAssetThatDrawsSomething)
{
    const PackView pack = makePack({standing(1), Box3{{0, 0, 0}, {0, 0, 0}}, standing(2)});
    const auto sheet = viewer::makeSheet(pack, 640, 360);
    ASSERT_TRUE(sheet.ok());
    EXPECT_EQ(sheet->assets, (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(viewer::makeSheet(makePack({}), 640, 360).error().issue, Issue::usage);
    EXPECT_EQ(viewer::makeSheet(pack, 16, 16).error().issue, Issue::usage) << "no room";
}

TEST(Sheet, cellsLieInTheImageAndApart)
{
    for (const auto& [width, height] : {std::pair{480u, 270u}, {1280u, 720u}, {300u, 900u}, {64u, 48u}})
        for (size_t cells = 1; cells < 40; cells += kSanitized ? 6 : 1)
        {
            const viewer::SheetLayout layout = viewer::layOutSheet(width, height, cells);
            if (layout.cell_width == 0)
                continue;
            SCOPED_TRACE(testing::Message() << cells << " in " << width << " x " << height);
            std::vector<uint8_t> covered(size_t{width} * height, 0);
            for (size_t cell = 0; cell < cells; ++cell)
            {
                const uint32_t label = viewer::kLetterHeight * layout.letter_scale;
                ASSERT_LE(layout.cellX(cell) + layout.cell_width, width);
                ASSERT_LE(layout.cellY(cell) + layout.cell_height + label, height);
                for (uint32_t y = 0; y < layout.cell_height + label; ++y)
                    for (uint32_t x = 0; x < layout.cell_width; ++x)
                        ASSERT_EQ(covered[size_t{layout.cellY(cell) + y} * width + layout.cellX(cell) + x]++,
                                  0);
            }
        }
    const viewer::SheetLayout twenty = viewer::layOutSheet(1280, 720, 20);
    EXPECT_GE(uint64_t{twenty.cell_width} * twenty.cell_height * 20, 1280u * 720 * 7 / 10)
        << "most of the image is images";
    EXPECT_EQ(viewer::layOutSheet(640, 480, 2000).cell_width, 0u);
}

TEST(Sheet, imagesAreCopiedIntoTheirCells)
{
    const auto sheet = viewer::makeSheet(makePack({standing(1), standing(2), standing(3)}), 200, 100);
    ASSERT_TRUE(sheet.ok());
    const viewer::SheetLayout& layout = sheet->layout;
    viewer::SheetImage image(*sheet);
    std::vector<std::byte> cell(size_t{layout.cell_width} * layout.cell_height * 4);
    for (size_t i = 0; i < cell.size(); ++i)
        cell[i] = static_cast<std::byte>(i * 7);
    image.place(2, cell);
    for (uint32_t y = 0; y < layout.cell_height; ++y)
        for (uint32_t i = 0; i < layout.cell_width * 4; ++i)
            ASSERT_EQ(image.pixels()[(size_t{layout.cellY(2) + y} * 200 + layout.cellX(2)) * 4 + i],
                      cell[size_t{y} * layout.cell_width * 4 + i]);
}

TEST(PixelFont, drawsLettersAndBoxes)
{
    EXPECT_EQ(drawn("L1", 11, 7),
              (std::vector<std::string>{"#       #  ", "#      ##  ", "#       #  ", "#       #  ",
                                        "#       #  ", "#       #  ", "#####  ### "}));
    EXPECT_EQ(drawn("l", 6, 7), drawn("L", 6, 7)) << "in capitals";
    EXPECT_EQ(drawn("\xC3\xA4", 12, 7), drawn("?", 12, 7)) << "one box for one character";
    const std::vector<std::string> twice = drawn("T", 12, 14, 2);
    EXPECT_EQ(twice[0], "##########  ");
    EXPECT_EQ(twice[13], "    ##      ");
    EXPECT_EQ(drawn("WW", 8, 4)[0], "#   # # ") << "what does not fit is left out";
    std::set<std::vector<std::string>> letters;
    for (const char letter : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+() ?"))
        EXPECT_TRUE(letters.insert(drawn(std::string(1, letter), 6, 7)).second)
            << letter << " reads as another";
}

TEST(PixelFont, cutsBetweenCharacters)
{
    EXPECT_EQ(viewer::countLetters("a\xC3\xA4"
                                   "b"),
              3u);
    EXPECT_EQ(viewer::firstLetters("a\xC3\xA4"
                                   "b",
                                   2),
              "a\xC3\xA4");
    EXPECT_EQ(viewer::firstLetters("ab", 5), "ab");
    EXPECT_EQ(viewer::firstLetters("ab", 0), "");
}

} // namespace hearth::test
