// View of a brick grid in the tables of a pack, a part or BrickTables.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_tables.h"
#include "formats/gpu_shared/brick_march.h"
#include "formats/pack/pack_view.h"

#include <span>

namespace hearth::bricks
{

/// Spans of a grid that the checker has accepted: every index is in range.
struct BrickView
{
    shared::BrickMasks masks;
    std::span<const uint8_t> opacity;
    std::span<const uint32_t> albedo;
    std::span<const uint16_t> normals;
    std::span<const uint32_t> emission;
    std::span<const uint32_t> lighting;
};

/// Make a view of a file that has a grid. `view` must outlive the result.
inline BrickView makeBrickView(const formats::PackView& view)
{
    return {{formats::toBrickGrid(view.brickGrid()[0]), view.brickGroupsAlongAxis(), view.bricks()},
            view.brickOpacity(),
            view.brickAlbedo(),
            view.brickNormals(),
            view.brickEmission(),
            view.brickLighting()};
}

/// Make a view of tables. `tables` must outlive the result.
inline BrickView makeBrickView(const BrickTables& tables)
{
    return {tables.masks(), tables.opacity, tables.albedo, tables.normals, tables.emission, tables.lighting};
}

} // namespace hearth::bricks
