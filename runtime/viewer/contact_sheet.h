// A contact sheet: the assets of a pack side by side, each in a cell of its own with its name and size below, where a camera
// on the scene would show them on top of each other.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::viewer
{

/// Returns the numbers of the assets that draw something, in their order.
std::vector<uint32_t> drawnAssets(const formats::PackView& pack);

/// Returns whether the assets were never placed, so that they hide each other: three quarters of those that draw something,
/// and two at least, have boxes around the origin of the world that overlap heavily with half of the others there. Props
/// that stand side by side do not, nor those in a house, nor tiles that meet.
bool standInOnePlace(const formats::PackView& pack);

/// Where the cells of a sheet are, in pixels from its top left corner: row by row, in the order of the assets.
struct SheetLayout
{
    uint32_t width = 0, height = 0; ///< of the sheet
    uint32_t columns = 0, rows = 0;
    uint32_t cell_width = 0, cell_height = 0; ///< of the picture in a cell
    uint32_t letter_scale = 1;                ///< of the names below

    uint32_t cellX(size_t cell) const;
    uint32_t cellY(size_t cell) const;
};

/// Returns the layout whose pictures are largest; cell_width is 0 where there is no room for so many.
SheetLayout layOutSheet(uint32_t width, uint32_t height, size_t cells);

/// What a sheet shows.
struct Sheet
{
    std::vector<uint32_t> assets; ///< of each cell
    std::vector<std::string> names;
    std::vector<float> sides; ///< largest of each, metres
    SheetLayout layout;
};

/// Returns the sheet of all assets that draw something.
/// errors: usage, where none does, or a picture of that size has no room for them.
Result<Sheet> makeSheet(const formats::PackView& pack, uint32_t width, uint32_t height);

/// A sheet that is filled cell by cell.
class SheetPicture
{
public:
    explicit SheetPicture(const Sheet& sheet);

    /// rgba  of the picture in the cell: RGBA8, cell_width x cell_height
    void place(size_t cell, std::span<const std::byte> rgba);

    /// RGBA8, width x height of the layout.
    std::span<const std::byte> pixels() const { return pixels_; }

private:
    SheetLayout layout_;
    std::vector<std::byte> pixels_;
};

} // namespace hearth::viewer
