// Character that the player moves, and the camera behind it: it walks over the ground, runs, stops at walls.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "check.h"
#include "input.h"
#include "vec.h"

#include <vector>

namespace game
{

class Hero
{
public:
    explicit Hero(const hearth::Pack& pack);
    void step(const Input& input, float seconds);
    /// Set the poses and the camera of a frame, which refers to this object until the next step.
    void show(hearth_frame& frame);

private:
    struct Clip
    {
        uint32_t animation;
        double seconds;
    };
    Clip findClip(const hearth::Pack& pack, const char* name);
    /// Return how far a ray goes before it meets what stops a walker; `reach` if nothing does.
    float castRay(Vec origin, Vec direction, float reach);
    void walk(Vec way, float seconds);
    void animate(bool is_waving, float seconds);

    hearth::Queries queries_;
    hearth::Player player_;
    Clip idle_, walk_, run_, wave_;
    uint32_t passable_[2]; ///< meshes: the hero itself and grass
    std::vector<hearth_pose> poses_;
    std::vector<hearth_transform> joints_;

    Vec position_{1.35f, 0, 4.2f};
    float heading_ = kPi, speed_ = 0, stride_ = 0; ///< radians, metres a second, share of a clip
    float waving_ = 0, stood_seconds_ = 0;         ///< share of the wave in the pose
    float camera_heading_ = kPi + 0.12f, camera_tilt_ = 0.16f;
};

} // namespace game
