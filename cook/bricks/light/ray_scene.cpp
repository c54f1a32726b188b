// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/ray_scene.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cstring>
#include <embree3/rtcore.h>

namespace hearth::bricks
{

using namespace formats;

/// Triangles of one material, up to those of the next range.
struct MaterialRange
{
    uint32_t first_triangle;
    Float3 albedo;
};

struct RayScene::State
{
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    bool has_holes = false;
    std::vector<MaterialRange> materials; ///< in the order of their triangles

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State()
    {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

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

/// Append the three corners of each triangle of a cluster, in voxels.
void addTriangles(const ClusterGeometry& geometry, const Affine3d& voxels_from_object,
                  std::vector<Float3>& corners)
{
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        for (const uint32_t vertex : geometry.triangle(t))
            corners.push_back(narrow(transformPoint(voxels_from_object, widen(geometry.position(vertex)))));
}

Result<std::vector<Float3>> readTriangleCorners(const StaticScene& scene,
                                                std::span<const InstancedCluster> placed,
                                                const GridFrame& frame, bool& has_holes,
                                                std::vector<MaterialRange>& materials)
{
    std::vector<Float3> corners;
    std::vector<std::byte> page;
    uint32_t page_source = kInvalidIndex, page_number = kInvalidIndex;
    for (const InstancedCluster& at : placed)
    {
        const PackView& part = scene.sources[at.source].clusters;
        const ClusterRecord& record = part.clusters()[at.cluster];
        const SurfaceMaterial& material = scene.material(at.source, record.material);
        if (material.hasHoles())
        {
            has_holes = true;
            continue;
        }
        if (at.source != page_source || at.page != page_number)
        {
            HEARTH_ASSIGN_OR_RETURN(page, part.decodePage(at.page));
            page_source = at.source;
            page_number = at.page;
        }
        const StaticInstance& instance = scene.instances[at.instance];
        const auto geometry = ClusterGeometry::at(page, record, part.meshes()[instance.mesh]);
        if (!geometry)
            return Error{Issue::meaning_geometry, part.name(), "cluster " + std::to_string(at.cluster),
                         "lies outside its page"};
        materials.push_back({static_cast<uint32_t>(corners.size() / 3), meanAlbedo(material)});
        addTriangles(*geometry, voxelsFromObject(frame, instance.world_from_object), corners);
    }
    return corners;
}

} // namespace

RayScene::RayScene(std::unique_ptr<State> state) : state_(std::move(state)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::build(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                 const GridFrame& frame)
{
    auto state = std::make_unique<State>();
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Float3> corners,
                            readTriangleCorners(scene, placed, frame, state->has_holes, state->materials));
    state->device = rtcNewDevice(nullptr);
    HEARTH_ASSERT(state->device != nullptr);
    state->scene = rtcNewScene(state->device);
    // let no ray pass between two triangles with a common edge: a sealed room must stay dark
    rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
    if (!corners.empty())
    {
        RTCGeometry triangles = rtcNewGeometry(state->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* const vertices = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0,
                                                       RTC_FORMAT_FLOAT3, sizeof(Float3), corners.size());
        std::memcpy(vertices, corners.data(), corners.size() * sizeof(Float3));
        auto* const indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
            triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners.size() / 3));
        for (uint32_t i = 0; i < corners.size(); ++i)
            indices[i] = i;
        rtcCommitGeometry(triangles);
        rtcAttachGeometry(state->scene, triangles);
        rtcReleaseGeometry(triangles);
    }
    rtcCommitScene(state->scene);
    return RayScene(std::move(state));
}

std::optional<RayScene::Hit> RayScene::nearest(Float3 position, Float3 direction) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray = rayFrom(position, direction, std::numeric_limits<float>::infinity());
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    const Float3 normal = normalizeOr({ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}, -direction);
    return Hit{position + direction * ray.ray.tfar, dot(normal, direction) > 0 ? -normal : normal,
               ray.hit.primID};
}

Float3 RayScene::albedo(const Hit& hit) const
{
    const auto next =
        std::ranges::upper_bound(state_->materials, hit.triangle, {}, &MaterialRange::first_triangle);
    return std::prev(next)->albedo;
}

bool RayScene::occluded(Float3 position, Float3 direction, float far) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = rayFrom(position, direction, far);
    rtcOccluded1(state_->scene, &context, &ray);
    return ray.tfar < 0;
}

bool RayScene::hasHoles() const
{
    return state_->has_holes;
}

} // namespace hearth::bricks
