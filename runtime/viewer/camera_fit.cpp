// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/camera_fit.h"

#include <algorithm>
#include <cmath>

namespace hearth::viewer
{

namespace
{

constexpr float kFieldOfView = 0.6f; // 34 degrees: a portrait lens, little distortion
constexpr float kMargin = 1.08f;
constexpr Float3 kViewDirection{0.55f, 0.42f, 0.8f};

// Scenes with more clusters use the boxes of whole instances.
constexpr size_t kMaxClusterBoxes = size_t{1} << 18;

size_t countClusters(const formats::PackView& pack, formats::Range instances)
{
    size_t count = 0;
    for (const formats::InstanceRecord& instance : formats::recordsInRange(pack.instances(), instances))
        count += pack.meshes()[instance.mesh].clusters.count;
    return count;
}

/// Call `visit` with the corners of the boxes in world space.
template <typename Visitor>
void forEachCorner(std::span<const pack::TransformedBox> boxes, const Visitor& visit)
{
    for (const auto& [box, world_from_box] : boxes)
        for (int corner = 0; corner < 8; ++corner)
            visit(transformPoint(world_from_box,
                                 {(corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
                                  (corner & 4) ? box.max.z : box.min.z}));
}

/// bounds  bounds of the boxes
shared::Camera fitToBoxes(std::span<const pack::TransformedBox> boxes, const Box3& bounds, float aspect)
{
    shared::Camera camera;
    camera.y_fov_rad = kFieldOfView;
    if (bounds.empty())
    {
        camera.position = kViewDirection * 3.0f;
        camera.target = {};
        camera.z_near = nearPlane(3);
        return camera;
    }
    const Float3 back = normalizeOr(kViewDirection, {0, 0, 1});
    const Float3 right = normalizeOr(cross({0, 1, 0}, back), {1, 0, 0});
    const Float3 up = cross(back, right);
    const float tan_y = std::tan(0.5f * kFieldOfView);
    const float tan_x = tan_y * aspect;

    // Find the nearest eye that sees everything: shift the view so that left and right, then top and bottom,
    // bind at once. Each side plane of the frustum gives one bound; p . side <= eye . side for all points.
    const Float3 center = bounds.center();
    float left = 0, rightmost = 0, bottom = 0, top = 0;
    forEachCorner(boxes,
                  [&](Float3 corner)
                  {
                      const Float3 p = corner - center;
                      const float z = dot(p, back);
                      rightmost = std::max(rightmost, dot(p, right) + z * tan_x);
                      left = std::max(left, -dot(p, right) + z * tan_x);
                      top = std::max(top, dot(p, up) + z * tan_y);
                      bottom = std::max(bottom, -dot(p, up) + z * tan_y);
                  });
    const float distance = kMargin * std::max((rightmost + left) / (2 * tan_x), (top + bottom) / (2 * tan_y));
    const Float3 shift = right * (0.5f * (rightmost - left)) + up * (0.5f * (top - bottom));
    const float size = std::max(distance, 1e-6f);
    camera.target = center + shift;
    camera.position = camera.target + back * size;
    camera.z_near = nearPlane(size);
    return camera;
}

} // namespace

float nearPlane(float distance)
{
    return std::max(distance * 1e-3f, 1e-12f);
}

shared::Camera fitCamera(const formats::PackView& pack, float aspect)
{
    return fitCamera(pack, pack::PosePlayer(pack), aspect);
}

shared::Camera fitCamera(const formats::PackView& pack, const pack::PosePlayer& player, float aspect)
{
    return fitCamera(pack, player, pack::allInstances(pack), aspect);
}

shared::Camera fitCamera(const formats::PackView& pack, const pack::PosePlayer& player,
                         formats::Range instances, float aspect)
{
    // the corners of the finest clusters' boxes fit round shapes tighter than the boxes of whole instances
    const bool by_clusters = countClusters(pack, instances) <= kMaxClusterBoxes;
    return fitToBoxes(by_clusters ? pack::clusterBoxes(pack, player, instances)
                                  : pack::instanceBoxes(pack, player, instances),
                      pack::instanceBounds(pack, player, instances), aspect);
}

shared::Camera fitCamera(std::span<const pack::TransformedBox> boxes, float aspect)
{
    Box3 bounds;
    forEachCorner(boxes, [&](Float3 corner) { bounds.add(corner); });
    return fitToBoxes(boxes, bounds, aspect);
}

shared::Camera sceneCamera(const formats::PackView& pack, uint32_t index)
{
    const formats::CameraRecord& record = pack.cameras()[index];
    const Affine3& world_from_camera = record.world_from_camera;
    shared::Camera camera;
    camera.position = transformPoint(world_from_camera, {});
    camera.target = camera.position + transformVector(world_from_camera, {0, 0, -1});
    camera.up = transformVector(world_from_camera, {0, 1, 0});
    camera.y_fov_rad = record.y_fov_rad;
    camera.z_near = record.z_near > 0 ? record.z_near : nearPlane(1);
    if (record.type == static_cast<uint32_t>(formats::CameraType::orthographic))
    {
        camera.half_height = std::abs(record.y_magnification);
        camera.z_far = std::max(record.z_far, 2 * camera.z_near);
    }
    return camera;
}

} // namespace hearth::viewer
