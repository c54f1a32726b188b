// Bricks of a scene on the device (GI): solid voxels, and surface and light of their faces. See
// runtime/gpu/README.md, "Global illumination".
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
    /// Approximate number of faces that are lit per frame: all of them take face_count / faces_per_frame
    /// frames, the period. See runtime/gpu/README.md for the number of frames after which a light change has
    /// settled.
    uint32_t faces_per_frame = 1u << 16;

    uint32_t rays = 16; ///< per face that is lit, at least 1
};

/// Bricks whose faces a frame lights, and the range of these faces in the tables.
struct BrickShare
{
    uint32_t first_brick = 0, brick_count = 0;
    uint32_t first_face = 0, face_count = 0;
};

/// Bricks of a scene whose pack has them.
struct SceneBricks
{
    formats::BrickGridRecord grid;
    Buffer groups, bricks, places, opacity;
    Buffer surfaces; ///< of the faces: albedo, then emission, then normals
    /// Light of faces, read by lighting and gathering: a shared::BrickLight for each, and where lamps are
    /// baked into faces a word for each behind them.
    Buffer lighting;
    Buffer fresh; ///< new light of one frame's faces, before the copy
    VkDescriptorSet fresh_set = VK_NULL_HANDLE;

    std::vector<uint32_t> first_faces; ///< per brick, and the end of the last one
    uint32_t rays = 16;                ///< per face
    uint32_t period = 1;               ///< frames that light all faces once
    uint32_t frame = 0;                ///< frames that have lit faces so far
    BrickShare share{};                ///< of the last frame
    shared::BrickView last_view{};     ///< of the last frame
    uint32_t quick_frames = 0;         ///< number of further frames that follow a light change quickly
    bool is_shown = false;             ///< the last frame's fragments read the light: a view of bricks
    float baked_scale = 0;             ///< shared::BrickView::baked_scale
    uint32_t live_frames = 0;          ///< further frames with light that is not baked into the faces

    /// Word of `lighting` with the baked light of face 0.
    uint32_t firstBakedWord() const { return 2 * grid.face_count; }
};

/// Return the bricks that a frame lights.
BrickShare nextBrickShare(const SceneBricks& bricks, uint32_t frame);

/// Largest number of words of light that a frame copies.
uint64_t maxFreshLightWords(const formats::PackView& pack, const BrickOptions& options);

/// Create scene.bricks if the pack has bricks. Needs scene.pool, and the buffers of frames and lights.
/// errors: device_limit, device_failed, and the errors of reading chunks.
Status uploadBricks(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                    const BrickOptions& options, Uploader& uploader, Scene& scene);

} // namespace hearth::gpu
