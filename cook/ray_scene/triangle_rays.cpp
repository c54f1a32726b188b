// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/ray_scene/triangle_rays.h"

#include "formats/base/assert.h"

#include <cstring>
#include <embree3/rtcore.h>

namespace hearth::ray_scene
{

namespace
{

RTCRay rayFrom(Float3 position, Float3 direction, float far)
{
    RTCRay ray{};
    ray.org_x = position.x;
    ray.org_y = position.y;
    ray.org_z = position.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = far;
    ray.mask = ~0u;
    return ray;
}

/// Add triangles of three corners each.
void attachTriangles(RTCDevice device, RTCScene scene, const std::vector<Float3>& corners)
{
    RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof(Float3), corners.size());
    std::memcpy(vertices, corners.data(), corners.size() * sizeof(Float3));
    auto* const indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners.size() / 3));
    for (uint32_t i = 0; i < corners.size(); ++i)
        indices[i] = i;
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene, triangles);
    rtcReleaseGeometry(triangles);
}

} // namespace

struct TriangleRays::State
{
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<Float3> corners;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State()
    {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

TriangleRays::TriangleRays(std::vector<Float3> corners) : state_(std::make_unique<State>())
{
    state_->corners = std::move(corners);
    state_->device = rtcNewDevice(nullptr);
    HEARTH_ASSERT(state_->device != nullptr);
    state_->scene = rtcNewScene(state_->device);
    // let no ray pass between two triangles with a common edge: a sealed room must stay dark
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    if (!state_->corners.empty())
        attachTriangles(state_->device, state_->scene, state_->corners);
    rtcCommitScene(state_->scene);
}

TriangleRays::TriangleRays(TriangleRays&&) noexcept = default;
TriangleRays& TriangleRays::operator=(TriangleRays&&) noexcept = default;
TriangleRays::~TriangleRays() = default;

std::optional<TriangleHit> TriangleRays::nearest(Float3 position, Float3 direction) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray = rayFrom(position, direction, std::numeric_limits<float>::infinity());
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    return TriangleHit{ray.hit.primID, ray.ray.tfar, {ray.hit.u, ray.hit.v}};
}

bool TriangleRays::occluded(Float3 position, Float3 direction, float far) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = rayFrom(position, direction, far);
    rtcOccluded1(state_->scene, &context, &ray);
    return ray.tfar < 0;
}

std::span<const Float3> TriangleRays::corners() const
{
    return state_->corners;
}

} // namespace hearth::ray_scene
