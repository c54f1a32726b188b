// The bricks of a scene on the device: which voxels are solid, what their faces are like and what light they give back.
// See README.md, "The light of bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"
#include "runtime/gpu/draw_layouts.h"
#include "runtime/gpu/uploader.h"

#include <memory>

namespace hearth::gpu
{

struct Scene;

struct BrickOptions
{
    /// Faces that are lit a frame: what changes shows after face_count / faces_per_frame frames and a few more.
    uint32_t faces_per_frame = 1u << 16;
};

/// Of a scene whose pack has bricks.
struct SceneBricks
{
    formats::BrickGridRecord grid;
    Buffer view; ///< shared::BrickView, of the last frame
    Buffer groups, bricks, opacity;
    Buffer surfaces; ///< of the faces: albedo, then emission, then normals
    Buffer lighting; ///< R11G11B10F of each face: what a frame finds, and gathers from
    Buffer fresh;    ///< of the faces of one frame, before they are copied
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorSet fresh_set = VK_NULL_HANDLE;

    uint32_t faces_per_frame = 0;
    uint32_t next_face = 0; ///< the first one of the next frame
    uint32_t frame = 0;     ///< counts up
    uint32_t quick_frames = 0; ///< so many frames more show changed light: what is gathered shall follow
};

/// Into scene.bricks, where the pack has bricks. Needs scene.pool, and the buffers of frames and lights.
/// errors: device_limit, device_failed, those of reading chunks.
Status uploadBricks(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                    const BrickOptions& options, Uploader& uploader, Scene& scene);

} // namespace hearth::gpu
