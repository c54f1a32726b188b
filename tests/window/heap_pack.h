// Builds the small pack as two assets in the same place, without lights and bricks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "tests/support/small_pack.h"

namespace hearth::test
{

/// The strip and the triangle, opaque.
inline PackModel heapModel()
{
    PackModel model = smallPack();
    model.materials[0].alpha_mode = static_cast<uint32_t>(formats::AlphaMode::opaque);
    model.lights.clear();
    formats::AnimationRecord& animation = model.animations.back(); // the only one with channels of lights
    model.channels.resize(animation.light_channels.first);
    animation.light_channels.count = 0;
    model.shadow_spheres.clear();
    model.brick_grids.clear();
    model.bricks = {};
    model.face_atlases.clear();
    model.face_blocks.clear();
    model.face_words.clear();
    formats::AssetRecord strip = model.assets[0], triangle = model.assets[0];
    strip.instances = {0, 1};
    triangle.instances = {1, 1};
    triangle.name.length = 3;
    triangle.box_max = {1, 0.5f, 1};
    model.assets = {strip, triangle};
    return model;
}

/// bytes  must outlive the view, which is not checked
inline formats::PackView makePackView(const AlignedBytes& bytes)
{
    return formats::PackView::read(formats::ContainerReader::fromBytes(bytes.span(), "heap").value()).value();
}

} // namespace hearth::test
