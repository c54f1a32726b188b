// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/contact_sheet.h"

#include "formats/scene/asset_placement.h"
#include "runtime/viewer/pixel_font.h"

#include <algorithm>
#include <cstdio>

namespace hearth::viewer
{

namespace
{

constexpr uint32_t kGap = 4;        // pixels between cells, and around them
constexpr uint32_t kLetterRoom = 3; // rows of a label besides its letters, in pixels of letters
constexpr uint32_t kMinCell = 8;    // pixels: nobody recognizes a smaller image

// Pixels of a cell's width per pixel of a letter: 17 letters have room.
constexpr uint32_t kCellForLetter = 104;

constexpr std::byte kBackgroundGrey{26};
constexpr std::byte kTextGrey{214};

uint32_t labelHeight(uint32_t letter_scale)
{
    return (kLetterHeight + kLetterRoom) * letter_scale;
}

SheetLayout layOut(uint32_t width, uint32_t height, uint32_t columns, uint32_t rows)
{
    SheetLayout layout{.width = width, .height = height, .columns = columns, .rows = rows};
    const auto share = [](uint32_t size, uint32_t count)
    { return size > kGap * (count + 1) ? (size - kGap * (count + 1)) / count : 0; };
    const uint32_t cell_width = share(width, columns), cell_height = share(height, rows);
    layout.letter_scale = std::max(1u, cell_width / kCellForLetter);
    const uint32_t label = labelHeight(layout.letter_scale);
    if (cell_width < kMinCell || cell_height < kMinCell + label)
        return layout;
    layout.cell_width = cell_width;
    layout.cell_height = cell_height - label;
    return layout;
}

/// Return the name, truncated with dots if it is too long.
std::string truncateName(const std::string& name, size_t max_letters)
{
    constexpr std::string_view kDots = "..";
    if (countLetters(name) <= max_letters || max_letters < kDots.size())
        return std::string(firstLetters(name, max_letters));
    return std::string(firstLetters(name, max_letters - kDots.size())).append(kDots);
}

/// Return the name and the size of the asset, "rock 2.1 m"; the name alone if little of it would be left.
std::string labelText(const std::string& name, float side, size_t max_letters)
{
    constexpr size_t kMinName = 6;
    char size[32];
    std::snprintf(size, sizeof(size), " %.3g m", double{side});
    const size_t taken = countLetters(size);
    return max_letters < taken + std::min(kMinName, countLetters(name))
               ? truncateName(name, max_letters)
               : truncateName(name, max_letters - taken) + size;
}

} // namespace

std::vector<uint32_t> drawnAssets(const formats::PackView& pack)
{
    std::vector<uint32_t> assets;
    for (uint32_t i = 0; i < pack.assets().size(); ++i)
        if (formats::largestSide(pack.assets()[i]) > 0)
            assets.push_back(i);
    return assets;
}

bool areUnplaced(const formats::PackView& pack)
{
    std::vector<Box3> boxes;
    for (const uint32_t asset : drawnAssets(pack))
        boxes.push_back({pack.assets()[asset].box_min, pack.assets()[asset].box_max});
    return formats::areUnplaced(boxes);
}

uint32_t SheetLayout::cellX(size_t cell) const
{
    return kGap + static_cast<uint32_t>(cell % columns) * (cell_width + kGap);
}

uint32_t SheetLayout::cellY(size_t cell) const
{
    return kGap + static_cast<uint32_t>(cell / columns) * (cell_height + labelHeight(letter_scale) + kGap);
}

SheetLayout layOutSheet(uint32_t width, uint32_t height, size_t cells)
{
    HEARTH_ASSERT(cells > 0);
    const auto side = [](const SheetLayout& layout)
    { return std::min(layout.cell_width, layout.cell_height); };
    SheetLayout best;
    // more columns than pixels have no room
    for (uint32_t columns = 1; columns <= std::min<size_t>(cells, width); ++columns)
    {
        const auto rows = static_cast<uint32_t>((cells + columns - 1) / columns);
        const SheetLayout layout = layOut(width, height, columns, rows);
        if (best.columns == 0 || side(layout) > side(best))
            best = layout;
    }
    return best;
}

Result<Sheet> makeSheet(const formats::PackView& pack, uint32_t width, uint32_t height)
{
    Sheet sheet{.assets = drawnAssets(pack), .names = {}, .sides = {}, .layout = {}};
    if (sheet.assets.empty())
        return Error{Issue::usage, pack.name(), "",
                     pack.assets().empty()
                         ? "--sheet: the pack does not say what its assets are: link it again"
                         : "--sheet: no asset of the pack draws anything"};
    for (const uint32_t asset : sheet.assets)
    {
        sheet.names.emplace_back(pack.text(pack.assets()[asset].name));
        sheet.sides.push_back(formats::largestSide(pack.assets()[asset]));
    }
    sheet.layout = layOutSheet(width, height, sheet.assets.size());
    if (sheet.layout.cell_width == 0)
        return Error{Issue::usage, pack.name(), "",
                     "--size: a sheet of " + std::to_string(sheet.assets.size()) + " assets has no room in " +
                         std::to_string(width) + "x" + std::to_string(height)};
    return sheet;
}

SheetImage::SheetImage(const Sheet& sheet)
    : layout_(sheet.layout), pixels_(size_t{layout_.width} * layout_.height * 4, kBackgroundGrey)
{
    for (size_t i = 3; i < pixels_.size(); i += 4)
        pixels_[i] = std::byte{255};
    const uint32_t scale = layout_.letter_scale;
    const Raster raster{pixels_, layout_.width, layout_.height};
    for (size_t cell = 0; cell < sheet.names.size(); ++cell)
        drawText(
            raster, layout_.cellX(cell),
            layout_.cellY(cell) + layout_.cell_height + (kLetterRoom - 1) * scale, scale,
            labelText(sheet.names[cell], sheet.sides[cell], layout_.cell_width / (kLetterAdvance * scale)),
            kTextGrey);
}

void SheetImage::place(size_t cell, std::span<const std::byte> rgba)
{
    const size_t row_bytes = size_t{layout_.cell_width} * 4;
    HEARTH_ASSERT(rgba.size() == row_bytes * layout_.cell_height);
    for (uint32_t row = 0; row < layout_.cell_height; ++row)
    {
        const size_t to = (size_t{layout_.cellY(cell) + row} * layout_.width + layout_.cellX(cell)) * 4;
        std::copy_n(rgba.begin() + static_cast<ptrdiff_t>(row * row_bytes), row_bytes,
                    pixels_.begin() + static_cast<ptrdiff_t>(to));
    }
}

} // namespace hearth::viewer
