// A grid of bricks as the tables of a pack or a part hold it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_tables.h"
#include "formats/gpu_shared/brick_march.h"
#include "formats/pack/pack_view.h"

#include <span>

namespace hearth::bricks
{

/// All as the checker accepts them: every index in range.
struct BrickView
{
    shared::BrickMasks masks;
    std::span<const uint8_t> opacity;
    std::span<const uint32_t> albedo;
    std::span<const uint16_t> normals;
    std::span<const uint32_t> emission;
    std::span<const uint32_t> lighting;
};

/// Of a file that has a grid. The view must outlive it.
inline BrickView brickViewOf(const formats::PackView& view)
{
    return {{formats::brickGridOf(view.brickGrid()[0]), view.brickGroups(), view.bricks()},
            view.brickOpacity(),
            view.brickAlbedo(),
            view.brickNormals(),
            view.brickEmission(),
            view.brickLighting()};
}

/// The tables must outlive the view.
inline BrickView brickViewOf(const BrickTables& tables)
{
    return {tables.masks(), tables.opacity, tables.albedo, tables.normals, tables.emission, tables.lighting};
}

} // namespace hearth::bricks
