// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/fly_camera.h"

#include "runtime/viewer/camera_fit.h"

#include <algorithm>
#include <cmath>

namespace hearth::viewer
{

namespace
{

constexpr Float3 kWorldUp{0, 1, 0};
constexpr float kMaxPitch = 1.55f; // 89 degrees: keeps the horizon defined

} // namespace

void FlyCamera::look(float right_rad, float up_rad)
{
    const float distance = length(camera_.target - camera_.position);
    const Float3 forward = normalizeOr(camera_.target - camera_.position, {0, 0, -1});
    // a camera that looks straight up or down faces the direction of the frame's top edge
    const bool steep = std::abs(forward.y) > 0.9999f;
    const Float3 facing = steep ? camera_.up * (forward.y > 0 ? -1.0f : 1.0f) : forward;
    const float yaw = std::atan2(facing.x, -facing.z) + right_rad;
    const float pitch =
        std::clamp(std::asin(std::clamp(forward.y, -1.0f, 1.0f)) + up_rad, -kMaxPitch, kMaxPitch);
    const Float3 turned{std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
    camera_.target = camera_.position + turned * distance;
    camera_.up = kWorldUp;
}

void FlyCamera::fly(Float3 push, float seconds)
{
    if (push == Float3{} || seconds <= 0)
        return;
    const Float3 forward = normalizeOr(camera_.target - camera_.position, {0, 0, -1});
    const Float3 right = normalizeOr(cross(forward, camera_.up), {1, 0, 0});
    const Float3 way = (right * push.x + kWorldUp * push.y + forward * push.z) * (speed_ * seconds);
    camera_.position += way;
    camera_.target += way;
    // a slow camera is near to something
    camera_.z_near = std::min(camera_.z_near, nearPlane(speed_));
}

void FlyCamera::changeSpeed(float steps)
{
    constexpr float kStep = 1.2f;
    speed_ = std::clamp(speed_ * std::pow(kStep, steps), 1e-4f, 1e6f);
}

} // namespace hearth::viewer
