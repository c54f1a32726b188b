// Fills the GPU records of a frame and of a scene (FrameView, OcclusionView, ...) from a camera and the
// tables of a pack. C++ only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/decisions.h"
#include "formats/records/mesh.h"
#include "formats/records/scene.h"

#include <span>
#include <vector>

namespace hearth::shared
{

struct Camera
{
    Float3 position;
    Float3 target{0, 0, -1};
    Float3 up{0, 1, 0};
    float y_fov_rad = 0.8f; ///< full vertical angle; ignored if the camera is orthographic
    float z_near = 0.01f;   ///< metres
    /// Off-centre images: place of the view axis in the image, from its middle, in halves of its width to the
    /// right and of its height upwards.
    Float2 shift{};
    /// Half the height of an orthographic image, metres; 0: the camera is a perspective one.
    float half_height = 0;
    float z_far = 0; ///< of an orthographic camera, metres, above z_near: nothing is drawn beyond
};

/// Return the constants of a frame. `error_pixels` is the projected LOD error that need not be refined; 0
/// selects the source triangles, even where a coarser level has no error. Errors count equally at all
/// distances: setLodCurve (lod_curve.h) changes that, but for orthographic cameras.
FrameView makeFrameView(const Camera& camera, uint32_t width, uint32_t height, float error_pixels,
                        uint32_t instance_count, uint32_t flags = kCullEverything);

/// Return the view of the depth pyramid that a frame with this view leaves.
OcclusionView makeOcclusionView(const FrameView& view);

/// Return the inverse of the linear part, computed in double.
InstanceInverse makeInstanceInverse(const formats::InstanceRecord& instance);

/// Return the bounding box of all clusters of each mesh: simplified vertices may leave the box of the source.
std::vector<MeshBounds> makeMeshBounds(std::span<const formats::MeshRecord> meshes,
                                       std::span<const formats::ClusterRecord> clusters);

} // namespace hearth::shared
