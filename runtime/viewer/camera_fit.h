// Default cameras of a pack: one that shows the whole scene, and the cameras that the artist placed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/pack/pose_player.h"
#include "runtime/pack/scene_boxes.h"

namespace hearth::viewer
{

/// Return a three-quarter view from the right, front and above, as close as possible with everything drawn in
/// the frame and a small margin; deformed instances in the player's pose. A scene without triangles gets a
/// view of the origin.
shared::Camera fitCamera(const formats::PackView& pack, const pack::PosePlayer& player, float aspect);

/// Fit a camera to some instances of the pack.
shared::Camera fitCamera(const formats::PackView& pack, const pack::PosePlayer& player,
                         formats::Range instances, float aspect);

/// Fit a camera to boxes.
shared::Camera fitCamera(std::span<const pack::TransformedBox> boxes, float aspect);

/// Fit a camera to a pack at rest.
shared::Camera fitCamera(const formats::PackView& pack, float aspect);

/// Return camera `index` of the pack, which must exist. The image of an orthographic one has its height.
shared::Camera sceneCamera(const formats::PackView& pack, uint32_t index);

/// Near plane for a camera that looks at something `distance` metres away: near enough never to clip it, far
/// enough to use the precision of a reversed float depth.
float nearPlane(float distance);

} // namespace hearth::viewer
