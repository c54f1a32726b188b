// The bricks of a scene on the device: which voxels are solid, what their faces are like and what light they give back.
// See runtime/gpu/README.md, "The light of bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/brick_view.h"
#include "formats/pack/pack_view.h"
#include "runtime/gpu/scene/draw_layouts.h"
#include "runtime/gpu/vulkan/uploader.h"

#include <vector>

namespace hearth::gpu
{

struct Scene;

struct BrickOptions
{
    /// Faces that are lit a frame, about: all of them take face_count / faces_per_frame frames, the period. See runtime/gpu/README.md for
    /// the frames after which changed light has settled.
    uint32_t faces_per_frame = 1u << 16;

    uint32_t rays = 16; ///< of each face that is lit, at least 1
};

/// Bricks whose faces a frame lights, and these faces: one behind the other, as they lie in the tables.
struct BrickShare
{
    uint32_t first_brick = 0, brick_count = 0;
    uint32_t first_face = 0, face_count = 0;
};

/// Of a scene whose pack has bricks.
struct SceneBricks
{
    formats::BrickGridRecord grid;
    Buffer view; ///< shared::BrickView, of the last frame
    Buffer groups, bricks, places, opacity;
    Buffer surfaces; ///< of the faces: albedo, then emission, then normals
    Buffer lighting; ///< shared::BrickLight of each face: what a frame finds, and gathers from
    Buffer fresh;    ///< of the faces of one frame, before they are copied
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorSet fresh_set = VK_NULL_HANDLE;

    std::vector<uint32_t> first_faces; ///< of each brick, and behind the last one
    uint32_t rays = 16;                ///< of a face
    uint32_t period = 1;               ///< frames that light all faces once
    uint32_t frame = 0;                ///< that light faces, so far
    BrickShare share{};                ///< of the last frame
    shared::BrickView last_view{};     ///< the same
    uint32_t quick_frames = 0;         ///< so many more frames follow changed light quickly
};

/// What a frame lights.
BrickShare brickShare(const SceneBricks& bricks, uint32_t frame);

/// Into scene.bricks, where the pack has bricks. Needs scene.pool, and the buffers of frames and lights.
/// errors: device_limit, device_failed, those of reading chunks.
Status uploadBricks(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                    const BrickOptions& options, Uploader& uploader, Scene& scene);

} // namespace hearth::gpu
