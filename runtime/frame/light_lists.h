// Lists the lights of each cell of a light grid on the CPU: the twin of the compute passes
// (runtime/shaders/light), word for word. C++ only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/light_cells.h"
#include "runtime/frame/light_grid.h"

#include <span>
#include <vector>

namespace hearth::shared
{

/// Lights of a frame, as shaders read them.
struct LightListView
{
    LightListCounts* counts;
    std::span<uint32_t> frame;   ///< rows of common lights, then of ranged ones; room for all lights
    std::span<uint32_t> cells;   ///< lightCellWord of each cell of the grid
    std::span<uint32_t> indices; ///< words of two 16-bit indices
};

/// Assigns lights to cells. Keeps its memory from frame to frame.
class LightLists
{
public:
    /// Write the lists of a frame: first of the lights that it has at all, then of each cell.
    /// lights  at most kMaxLights
    void assign(const LightGridLayout& layout, std::span<const Light> lights, const LightListView& lists);

private:
    /// Columns of a ball in the rows of a cascade, slab by slab. What rows and slabs share is computed once.
    class BallRows
    {
    public:
        void begin(const LightGrid& grid, const CellLight& light);
        void beginCascade(const LightCascade& cascade);
        void beginSlab() { last_rows_ = rows_, rows_ = {}; }
        LightColumns find(const LightGrid& grid, const LightCascade& cascade, const LightSlab& slab,
                          uint32_t number, const LightRow& row);

    private:
        struct Rows
        {
            uint32_t first = 0, end = 0;
        };
        CellLight light_{};
        LightBall ball_{};
        LightTangents ball_tangents_{};
        std::vector<LightTangents> edge_tangents_; ///< of the edges of rows
        std::vector<LightTangents> row_tangents_;  ///< of the whole ball, as far as they touch it in a row
        std::vector<LightSpan> chords_;            ///< of each row, at the end of the slab
        Rows rows_, last_rows_;                    ///< whose chords are of this slab and of the one before
    };

    struct Run
    {
        uint32_t first_cell;
        uint16_t cells;
        uint16_t light; ///< place among the ranged lights of the frame
    };
    void listLights(const LightGridLayout& layout, std::span<const Light> lights, const LightListView& lists);
    void addLight(const LightGridLayout& layout, const CellLight& light, uint16_t place);
    void addRow(const LightGridLayout& layout, const LightCascade& cascade, const CellLight& light,
                const LightSlab& slab, uint32_t first_cell, uint32_t row, LightColumns columns,
                uint16_t place);
    void writeIndices(const LightListView& lists);

    std::vector<CellLight> ranged_;
    std::vector<Run> runs_;
    std::vector<uint32_t> counts_; ///< of each cell
    std::vector<uint32_t> ends_;   ///< next free index of each cell

    BallRows ball_, range_ball_;          ///< of one light
    std::vector<uint8_t> beside_columns_; ///< of the edges of columns: bits kBehind* of a cone
    std::vector<uint8_t> beside_rows_;
};

} // namespace hearth::shared
