// Lights the faces of bricks, frame by frame, as the passes on the GPU do: the same code, formats/gpu_shared/brick_lighting.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"
#include "cook/bricks/grid/face_places.h"
#include "cook/bricks/light/march_lanes.h"
#include "formats/gpu_shared/brick_lighting.h"

#include <vector>

namespace hearth::bricks
{

/// A frame lights the bricks of one of `period` slices, in order, by what the faces sent out before it.
struct FrameShare
{
    uint32_t period = 1; ///< frames in which all are lit once, at least 1
    uint32_t rays = 16;  ///< of each face, at least 1
};

class FaceLighting
{
public:
    /// Begins with the stored lighting. The tables must outlive it.
    explicit FaceLighting(const BrickView& bricks);

    /// One frame. The same to the bit for any number of threads.
    /// lighting  its lights in world space, after exposure
    void light(const shared::Lighting& lighting, const FrameShare& share);

    /// Frames until all have been lit `sweeps` times.
    void sweep(const shared::Lighting& lighting, uint32_t rays, uint32_t sweeps);

    /// Of each face, what it sends out.
    std::span<const shared::BrickLight> faces() const { return faces_; }

    /// The codes alone: chunk BRKL.
    std::vector<uint32_t> codes() const;

    /// What rays read.
    shared::BrickScene scene() const { return {bricks_.masks, bricks_.opacity, faces_}; }

private:
    /// Some faces by so many rays each, into next_.
    void light(const shared::Lighting& lighting, uint32_t rays, size_t first, size_t end);

    BrickView bricks_;
    MarchTable table_;
    std::vector<FacePlace> places_;
    std::vector<shared::BrickLight> faces_;
    std::vector<shared::BrickLight> next_; ///< of the faces that this frame lights
    uint32_t frame_ = 0;
};

/// How many sweeps after a light went out what it caused is below `share` of what it was everywhere, in (0, 1): each sweep
/// leaves at most the albedo of it, and rounding adds a ten-thousandth of that at the most.
/// most_albedo  of any face, in [0, 1]; what is above kBrickMostAlbedo counts as that
uint32_t sweepsToForget(float most_albedo, float share);

} // namespace hearth::bricks
