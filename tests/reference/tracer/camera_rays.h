// Rays from a camera through the pixels of an image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/reference/tracer/embree_scene.h"

namespace hearth::reference
{

class CameraRays
{
public:
    CameraRays(const shared::Camera& camera, uint32_t width, uint32_t height)
        : eye_(camera.position),
          forward_(normalize(Double3(camera.target) - eye_)),
          right_(normalize(cross(forward_, Double3(camera.up)))),
          up_(cross(right_, forward_)),
          slope_(std::tan(double{camera.y_fov_rad} / 2)),
          near_(double{camera.z_near}),
          width_(double{1} * width),
          height_(double{1} * height)
    {
    }

    /// Return the ray through a point of the image, in pixels from its left upper corner; it begins at the
    /// near plane.
    Ray through(double x, double y) const
    {
        const Double3 across = right_ * ((2 * x / width_ - 1) * slope_ * width_ / height_);
        const Double3 upwards = up_ * ((1 - 2 * y / height_) * slope_);
        const Double3 ray = forward_ + across + upwards; // depth 1
        return {eye_, normalize(ray), near_ * length(ray), 1e30};
    }

    /// Return the footprint of a pixel at a distance of one metre.
    double pixelAngle() const { return 2 * slope_ / height_; }

private:
    Double3 eye_, forward_, right_, up_;
    double slope_, near_, width_, height_;
};

} // namespace hearth::reference
