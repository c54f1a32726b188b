// First-person fly camera.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"

namespace hearth::viewer
{

/// Equals its start camera, bit for bit, until it is moved. The target moves with the eye, at its distance.
class FlyCamera
{
public:
    /// speed  metres per second, > 0
    FlyCamera(const shared::Camera& start, float speed) : camera_(start), speed_(speed) {}

    const shared::Camera& camera() const { return camera_; }
    float speed() const { return speed_; }

    /// Turn to the right and upwards, up to the zenith and the nadir; makes the horizon level.
    void look(float right_rad, float up_rad);

    /// Fly for a time step.
    /// push     to the right, up (world) and forwards, -1 to 1 each
    /// seconds  >= 0
    void fly(Float3 push, float seconds);

    /// Change the speed by a fifth per step.
    void changeSpeed(float steps);

private:
    shared::Camera camera_;
    float speed_;
};

} // namespace hearth::viewer
