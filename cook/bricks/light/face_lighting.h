// Lights the brick faces frame by frame on the CPU, with the code of the GPU passes
// (formats/gpu_shared/brick_lighting.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"
#include "cook/bricks/grid/face_locations.h"
#include "cook/bricks/light/march_lanes.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "formats/scene/scene_lighting.h"

#include <vector>

namespace hearth::bricks
{

/// Work of one frame: it lights the bricks of one of `period` slices, in order, from the previous radiance of
/// the faces.
struct FrameBudget
{
    uint32_t period = 1; ///< frames until all faces are lit once, at least 1
    uint32_t rays = 16;  ///< per face, at least 1
};

/// Lighting of all faces, iterated frame by frame.
class FaceLighting
{
public:
    /// Start from the stored lighting. The tables must outlive this.
    explicit FaceLighting(const BrickView& bricks);

    /// Light one frame. The result has the same bits for any number of threads.
    /// lighting  lights in world space, after exposure
    void light(const shared::SceneLighting& lighting, const FrameBudget& share);

    /// Light frames until all faces have been lit `sweeps` times.
    void sweep(const shared::SceneLighting& lighting, uint32_t rays, uint32_t sweeps);

    /// Return the outgoing radiance of each face.
    std::span<const shared::BrickLight> faces() const { return faces_; }

    /// Return the codes alone: chunk BRKL.
    std::vector<uint32_t> codes() const;

    /// Return the scene that rays read.
    shared::BrickScene scene() const { return {bricks_.masks, bricks_.opacity, faces_}; }

private:
    /// Light the faces first to end - 1 into next_, with so many rays each.
    void light(const shared::SceneLighting& lighting, uint32_t rays, size_t first, size_t end);

    BrickView bricks_;
    MarchTable table_;
    std::vector<FaceLocation> places_;
    std::vector<shared::BrickLight> faces_;
    std::vector<shared::BrickLight> next_; ///< results of the current frame
    uint32_t frame_ = 0;
};

/// Return the number of sweeps after which light from a removed lamp is below `share`, in (0, 1), of its
/// value everywhere. Each sweep leaves at most the albedo of it; rounding adds at most a ten-thousandth of
/// that.
/// max_albedo  largest albedo of all faces, in [0, 1]; clamped to kMaxBrickAlbedo
uint32_t sweepsToDecay(float max_albedo, float share);

} // namespace hearth::bricks
