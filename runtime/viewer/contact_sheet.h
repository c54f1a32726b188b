// Contact sheet: the assets of a pack side by side, each in a cell with its name and size below. For packs
// whose assets would otherwise be drawn on top of each other.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::viewer
{

/// Return the indices of the assets that draw something, in order.
std::vector<uint32_t> drawnAssets(const formats::PackView& pack);

/// True if the assets that draw something were never placed (formats/scene/asset_placement.h).
bool areUnplaced(const formats::PackView& pack);

/// Layout of the cells of a sheet, in pixels from its top left corner: row by row, in the order of the
/// assets.
struct SheetLayout
{
    uint32_t width = 0, height = 0; ///< of the sheet
    uint32_t columns = 0, rows = 0;
    uint32_t cell_width = 0, cell_height = 0; ///< of the image in a cell
    uint32_t letter_scale = 1;                ///< of the names below

    uint32_t cellX(size_t cell) const;
    uint32_t cellY(size_t cell) const;
};

/// Return the layout with the largest images; cell_width is 0 if there is no room for that many cells.
SheetLayout layOutSheet(uint32_t width, uint32_t height, size_t cells);

/// Content of a sheet.
struct Sheet
{
    std::vector<uint32_t> assets; ///< asset of each cell
    std::vector<std::string> names;
    std::vector<float> sides; ///< largest side of each asset, metres
    SheetLayout layout;
};

/// Return the sheet of all assets that draw something. errors: usage if none does, or if an image of that
/// size has no room for them.
Result<Sheet> makeSheet(const formats::PackView& pack, uint32_t width, uint32_t height);

/// Sheet image that is filled cell by cell.
class SheetImage
{
public:
    explicit SheetImage(const Sheet& sheet);

    /// rgba  image of the cell: RGBA8, cell_width x cell_height
    void place(size_t cell, std::span<const std::byte> rgba);

    /// Return the image: RGBA8, width x height of the layout.
    std::span<const std::byte> pixels() const { return pixels_; }

private:
    SheetLayout layout_;
    std::vector<std::byte> pixels_;
};

} // namespace hearth::viewer
