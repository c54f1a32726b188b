// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/camera.h"

#include "formats/base/affine3d.h"

#include <cmath>
#include <limits>
#include <numbers>

using namespace hearth;
using namespace hearth::c;

namespace
{

/// Return the ray whose points appear at a place of the image; t is the distance along the view's axis.
/// x, y  pixels
Result<hearth_ray> makeRay(const shared::FrameView& view, float x, float y)
{
    const bool is_orthographic = shared::isOrthographic(view);
    Affine3d clip_from_world{};
    const Float4 rows[] = {view.clip_x, view.clip_y, view.clip_w};
    for (int row = 0; row < 3; ++row)
    {
        auto& to = clip_from_world.m[row];
        to[0] = rows[row].x, to[1] = rows[row].y, to[2] = rows[row].z;
    }
    const auto world_from_clip = inverted(clip_from_world);
    if (!world_from_clip)
        return usage("the camera has no ray");
    const double across = 2 * double{x} / view.width - 1, down = 2 * double{y} / view.height - 1;
    Double3 origin{}, direction{};
    if (is_orthographic)
    {
        origin = transformVector(*world_from_clip,
                                 {across - double{view.clip_x.w}, down - double{view.clip_y.w}, 0});
        direction = transformVector(*world_from_clip, {0, 0, 1});
    }
    else
        direction = transformVector(*world_from_clip, {across, down, 1});
    const Float3 from = narrow(widen(view.eye) + origin), along = narrow(direction);
    return hearth_ray{.origin = {from.x, from.y, from.z},
                      .direction = {along.x, along.y, along.z},
                      .t_min = view.z_near,
                      .t_max = is_orthographic ? view.clip_w.w : std::numeric_limits<float>::infinity()};
}

Status checkOrthographic(const hearth_frame& frame)
{
    if (!(frame.half_height > 0) || !std::isfinite(frame.half_height))
        return usage("y_fov_rad is 0, for an orthographic camera, and half_height is not above 0");
    if (!(frame.z_far > frame.camera.z_near) || !std::isfinite(frame.z_far))
        return usage("y_fov_rad is 0, for an orthographic camera, and z_far is not above z_near");
    if (frame.lod_knot_count > 0)
        return usage("an orthographic camera has no lod_knots: errors count equally at all distances");
    return success();
}

} // namespace

Status hearth::c::checkCamera(const hearth_frame& frame)
{
    const hearth_camera& camera = frame.camera;
    if (!isFinite(toFloat3(camera.position)) || !isFinite(toFloat3(camera.target)) ||
        !isFinite(toFloat3(camera.up)))
        return usage("the camera's position, target or up is not finite");
    if (!(camera.y_fov_rad >= 0 && camera.y_fov_rad < std::numbers::pi_v<float>))
        return usage("the camera's y_fov_rad is neither 0 nor above 0 and below pi");
    if (!(camera.z_near > 0) || !std::isfinite(camera.z_near))
        return usage("the camera's z_near is not above 0");
    if (camera.y_fov_rad == 0)
        HEARTH_TRY(checkOrthographic(frame));
    constexpr float kMaxShift = 1024;
    if (!(std::abs(frame.shift[0]) <= kMaxShift && std::abs(frame.shift[1]) <= kMaxShift))
        return usage("shift is not from -1024 to 1024");
    return success();
}

shared::Camera hearth::c::toCamera(const hearth_frame& frame)
{
    const hearth_camera& camera = frame.camera;
    return {.position = toFloat3(camera.position),
            .target = toFloat3(camera.target),
            .up = toFloat3(camera.up),
            .y_fov_rad = camera.y_fov_rad,
            .z_near = camera.z_near,
            .shift = {frame.shift[0], frame.shift[1]},
            .half_height = camera.y_fov_rad == 0 ? frame.half_height : 0,
            .z_far = frame.z_far};
}

Result<hearth_ray> hearth::c::makePixelRay(const hearth_frame& frame, uint32_t width, uint32_t height,
                                           float x, float y)
{
    HEARTH_TRY(checkCamera(frame));
    if (width == 0 || height == 0 || !std::isfinite(x) || !std::isfinite(y))
        return usage("width or height is 0, or x or y is not finite");
    return makeRay(shared::makeFrameView(toCamera(frame), width, height, 1, 0, 0), x, y);
}

hearth_result hearth_frame_get_ray(const hearth_frame* frame, uint32_t width, uint32_t height, float x,
                                   float y, hearth_ray* ray, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStruct("frame", frame));
                    if (ray == nullptr)
                        return usage("ray is NULL");
                    HEARTH_ASSIGN_OR_RETURN(*ray, makePixelRay(*frame, width, height, x, y));
                    return success();
                });
}
