// Environment as a tree of areas, from texels up, for sums over all of it that need few terms.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"

#include <vector>

namespace hearth::probes
{

struct RadianceNode
{
    Float3 direction;       ///< unit; the middle of the area
    float solid_angle = 0;  ///< exact; the sum over a level is 4 pi
    Float3 light_direction; ///< unit; the middle of the light: of a sun in the area, if there is one
    float size = 0;         ///< longest edge, radians
    Float3 light;           ///< radiance times solid angle
};

/// Level of a panel: nodes row by row. Node (x, y) consists of the nodes (2 x, 2 y) to (2 x + 1, 2 y + 1)
/// of the next finer level, as far as there are.
struct RadianceLevel
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<RadianceNode> nodes;

    const RadianceNode& at(uint32_t x, uint32_t y) const { return nodes[size_t{y} * width + x]; }
};

struct RadiancePanel
{
    std::vector<RadianceLevel> levels; ///< finest first; the last is one node
};

struct RadianceTree
{
    environment::Layout layout;
    std::vector<RadiancePanel> panels;
};

/// Rows of the finest level for a cube of one texel a side. Those of 128 are 0.18 degrees then, a quarter
/// of alpha of the first filtered mip of six, 0.011.
inline constexpr uint32_t kTreeRowsOfSide = 8;

/// Build the tree of an environment times `scale`. Its finest level has min_rows to 2 min_rows - 1 rows
/// from zenith to nadir: means of several texels, or equal parts of one. The same for any number of
/// threads.
RadianceTree buildRadianceTree(const environment::Environment& environment, double scale, uint32_t min_rows);

} // namespace hearth::probes
