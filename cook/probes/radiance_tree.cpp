// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/radiance_tree.h"

#include "cook/probes/direction_grid.h"

#include <tbb/parallel_for.h>

#include <numbers>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;
using environment::PanelArea;

/// Texels of the environment beside nodes of the finest level: one of both numbers is 1.
struct Resampling
{
    uint32_t texels_of_node = 1; ///< along each axis
    uint32_t nodes_of_texel = 1;
};

Resampling chooseResampling(const Environment& environment, uint32_t min_rows)
{
    const uint32_t rows = environment.layout == Layout::cube ? 2 * environment.height : environment.height;
    Resampling resampling;
    if (rows < min_rows)
        resampling.nodes_of_texel = (min_rows + rows - 1) / rows;
    else
        while (rows / (2 * resampling.texels_of_node) >= min_rows)
            resampling.texels_of_node *= 2;
    return resampling;
}

/// Return the longest edge of an area, in radians.
float longestEdge(Layout layout, const PanelArea& area)
{
    const double across = area.u1 - area.u0, down = area.v1 - area.v0;
    if (layout == Layout::lat_long)
        return static_cast<float>(
            std::max(std::numbers::pi * down,
                     2 * std::numbers::pi * across * std::sin(std::numbers::pi / 2 * (area.v0 + area.v1))));
    // edges are longest in the middle of the face
    return static_cast<float>(2 * std::max(across, down));
}

/// Sums over an area.
struct Sums
{
    Double3 direction;       ///< times solid angle
    Double3 light_direction; ///< times light, of all channels
    Double3 light;
    double solid_angle = 0;

    /// direction, light_direction  unit
    void add(Double3 direction_, Double3 light_direction_, double solid_angle_, Double3 light_)
    {
        direction = direction + direction_ * solid_angle_;
        light_direction = light_direction + light_direction_ * (light_.x + light_.y + light_.z);
        light = light + light_;
        solid_angle += solid_angle_;
    }
};

/// Return a unit vector, or `other` for a vector without direction.
Float3 unitVector(Double3 vector, Float3 other)
{
    const double distance = length(vector);
    return distance > 0 ? narrow(vector * (1 / distance)) : other;
}

RadianceNode makeNode(const Sums& sums, float size)
{
    const Float3 direction = unitVector(sums.direction, {0, 1, 0});
    return {direction, static_cast<float>(sums.solid_angle), unitVector(sums.light_direction, direction),
            size, narrow(sums.light)};
}

/// Make a row of the finest level of a panel.
void makeRow(const Environment& environment, uint32_t panel, const Resampling& resampling, double scale,
             const DirectionGrid& grid, uint32_t row, RadianceLevel& level)
{
    const uint32_t step = resampling.texels_of_node, parts = resampling.nodes_of_texel;
    const uint32_t cells_x = environment.width * parts, cells_y = environment.height * parts;
    for (uint32_t column = 0; column < level.width; ++column)
    {
        const uint32_t x0 = column * step, y0 = row * step;
        const uint32_t x1 = std::min(x0 + step, cells_x), y1 = std::min(y0 + step, cells_y);
        Sums sums;
        for (uint32_t y = y0; y < y1; ++y)
            for (uint32_t x = x0; x < x1; ++x)
            {
                const double solid_angle = grid.solidAngle(x, y);
                const Double3 along = grid.direction(x, y), direction = along * (1 / length(along));
                const Float3 radiance = environment.texels[environment.index(panel, x / parts, y / parts)];
                sums.add(direction, direction, solid_angle, widen(radiance) * (solid_angle * scale));
            }
        const PanelArea area{double(x0) / cells_x, double(y0) / cells_y, double(x1) / cells_x,
                             double(y1) / cells_y};
        const double exact = panelSolidAngle(environment.layout, area);
        sums.light = sums.light * (exact / sums.solid_angle);
        sums.solid_angle = exact;
        level.nodes[size_t{row} * level.width + column] =
            makeNode(sums, longestEdge(environment.layout, area));
    }
}

RadianceLevel makeFinestLevel(const Environment& environment, uint32_t panel, const Resampling& resampling,
                              double scale)
{
    const uint32_t step = resampling.texels_of_node, parts = resampling.nodes_of_texel;
    const uint32_t cells_x = environment.width * parts, cells_y = environment.height * parts;
    const DirectionGrid grid(environment.layout, panel, cells_x, cells_y);
    RadianceLevel level{(cells_x + step - 1) / step, (cells_y + step - 1) / step, {}};
    level.nodes.resize(size_t{level.width} * level.height);
    tbb::parallel_for(uint32_t{0}, level.height,
                      [&](uint32_t row)
                      { makeRow(environment, panel, resampling, scale, grid, row, level); });
    return level;
}

RadianceLevel makeCoarser(const RadianceLevel& finer)
{
    RadianceLevel level{(finer.width + 1) / 2, (finer.height + 1) / 2, {}};
    level.nodes.resize(size_t{level.width} * level.height);
    const auto makeRowOfNodes = [&](uint32_t row)
    {
        for (uint32_t column = 0; column < level.width; ++column)
        {
            Sums sums;
            float size = 0;
            for (uint32_t y = 2 * row; y < std::min(2 * row + 2, finer.height); ++y)
                for (uint32_t x = 2 * column; x < std::min(2 * column + 2, finer.width); ++x)
                {
                    const RadianceNode& node = finer.at(x, y);
                    sums.add(widen(node.direction), widen(node.light_direction), double{node.solid_angle},
                             widen(node.light));
                    size = std::max(size, node.size);
                }
            level.nodes[size_t{row} * level.width + column] = makeNode(sums, 2 * size);
        }
    };
    tbb::parallel_for(uint32_t{0}, level.height, makeRowOfNodes);
    return level;
}

} // namespace

RadianceTree buildRadianceTree(const Environment& environment, double scale, uint32_t min_rows)
{
    const Resampling resampling = chooseResampling(environment, min_rows);
    RadianceTree tree{environment.layout, {}};
    for (uint32_t panel = 0; panel < environment.panelCount(); ++panel)
    {
        RadiancePanel& built = tree.panels.emplace_back();
        built.levels.push_back(makeFinestLevel(environment, panel, resampling, scale));
        while (built.levels.back().nodes.size() > 1)
            built.levels.push_back(makeCoarser(built.levels.back()));
    }
    return tree;
}

} // namespace hearth::probes
