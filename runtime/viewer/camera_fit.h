// Cameras that a pack suggests: one that shows the whole scene, and those that the artist placed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/gpu/scene/scene_boxes.h"
#include "runtime/pack/pose_player.h"

namespace hearth::viewer
{

/// Three-quarter view from the right, front and above, as close as all that is drawn fits into the picture with a
/// small margin: deformed instances in the player's pose. A scene without triangles gets a view of the origin.
shared::Camera fitCamera(const formats::PackView& pack, const pack::PosePlayer& player, float aspect);

/// The same for some instances of the pack.
shared::Camera fitCamera(const formats::PackView& pack, const pack::PosePlayer& player,
                         formats::Range instances, float aspect);

/// The same for what is in boxes.
shared::Camera fitCamera(std::span<const gpu::PlacedBox> boxes, float aspect);

/// Of a pack at rest.
shared::Camera fitCamera(const formats::PackView& pack, float aspect);

/// Camera `index` of the pack, which must exist and be a perspective one.
shared::Camera sceneCamera(const formats::PackView& pack, uint32_t index);

/// The near plane for a camera that looks at something `distance` metres away: near enough never to cut what is looked
/// at, far enough to keep all bits of a reversed float depth useful.
float nearPlane(float distance);

} // namespace hearth::viewer
