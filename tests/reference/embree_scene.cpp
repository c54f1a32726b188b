// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/embree_scene.h"

#include "formats/assert.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <vector>

namespace hearth::reference
{

using namespace formats;

namespace
{

/// One mesh as an Embree scene, and what its triangles are.
struct MeshScene
{
    RTCScene scene = nullptr;
    std::vector<std::pair<uint32_t, uint32_t>> triangles; ///< cluster, triangle
};

} // namespace

struct EmbreeScene::State
{
    /// Embree hands its context to the filter: what the filter needs rides along.
    struct Query : RTCIntersectContext
    {
        const State* state;
        const AcceptHit* accept;
        Query(const State& s, const AcceptHit& a) : state(&s), accept(&a) { rtcInitIntersectContext(this); }
    };

    const PackGeometry* geometry;
    AcceptHit accept, blocks;
    RTCDevice device = nullptr;
    RTCScene top = nullptr;
    std::vector<MeshScene> meshes;

    void addMesh(uint32_t index);
    void addInstance(uint32_t index);
    SurfaceHit toHit(uint32_t instance, uint32_t primitive, float u, float v, float distance) const;
    bool isFront(const SurfaceHit& hit, Double3 object_direction) const;
    static void filter(const RTCFilterFunctionNArguments* arguments);
};

void EmbreeScene::State::addMesh(uint32_t index)
{
    MeshScene& mesh = meshes[index];
    const Range clusters = geometry->view().meshes()[index].clusters;
    std::vector<Float3> corners;
    for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
    {
        if (geometry->view().clusters()[c].level != 0)
            continue;
        uint32_t number = 0;
        for (const auto& triangle : geometry->triangles(c))
        {
            corners.insert(corners.end(), triangle.begin(), triangle.end());
            mesh.triangles.emplace_back(c, number++);
        }
    }
    if (corners.empty())
        return;
    RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof(Float3), corners.size());
    std::memcpy(vertices, corners.data(), corners.size() * sizeof(Float3));
    auto* const indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners.size() / 3));
    for (uint32_t i = 0; i < corners.size(); ++i)
        indices[i] = i;
    rtcSetGeometryIntersectFilterFunction(triangles, filter);
    rtcSetGeometryOccludedFilterFunction(triangles, filter);
    rtcCommitGeometry(triangles);
    mesh.scene = rtcNewScene(device);
    rtcAttachGeometry(mesh.scene, triangles);
    rtcReleaseGeometry(triangles);
    rtcCommitScene(mesh.scene);
}

void EmbreeScene::State::addInstance(uint32_t index)
{
    const InstanceRecord& record = geometry->view().instances()[index];
    if (meshes[record.mesh].scene == nullptr)
        return;
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, meshes[record.mesh].scene);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, record.world_from_object.m);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(top, instance, index);
    rtcReleaseGeometry(instance);
}

SurfaceHit EmbreeScene::State::toHit(uint32_t instance, uint32_t primitive, float u, float v,
                                     float distance) const
{
    const auto [cluster, triangle] = meshes[geometry->view().instances()[instance].mesh].triangles[primitive];
    SurfaceHit hit;
    hit.instance = instance;
    hit.cluster = cluster;
    hit.triangle = triangle;
    hit.weights[0] = 1 - double{u} - double{v};
    hit.weights[1] = double{u};
    hit.weights[2] = double{v};
    hit.distance = double{distance};
    return hit;
}

/// In object space, where a mirrored instance has the front that its mesh has.
bool EmbreeScene::State::isFront(const SurfaceHit& hit, Double3 object_direction) const
{
    const ClusterGeometry cluster = geometry->cluster(hit.cluster);
    const auto corner = cluster.triangle(hit.triangle);
    const Double3 a(cluster.position(corner[0]));
    const Double3 normal =
        cross(Double3(cluster.position(corner[1])) - a, Double3(cluster.position(corner[2])) - a);
    return dot(normal, object_direction) < 0;
}

void EmbreeScene::State::filter(const RTCFilterFunctionNArguments* arguments)
{
    HEARTH_ASSERT(arguments->N == 1);
    if (arguments->valid[0] == 0)
        return;
    const auto& query = *static_cast<const Query*>(arguments->context);
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    SurfaceHit candidate = query.state->toHit(query.instID[0], hit.primID, hit.u, hit.v, ray.tfar);
    candidate.front =
        query.state->isFront(candidate, {double{ray.dir_x}, double{ray.dir_y}, double{ray.dir_z}});
    if (!(*query.accept)(candidate))
        arguments->valid[0] = 0;
}

namespace
{

RTCRay toEmbree(const Ray& ray)
{
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    r.tnear = static_cast<float>(ray.least);
    r.tfar = static_cast<float>(ray.greatest);
    r.mask = ~0u;
    return r;
}

} // namespace

EmbreeScene::EmbreeScene(const PackGeometry& geometry, AcceptHit accept, AcceptHit blocks)
    : state_(std::make_unique<State>())
{
    state_->geometry = &geometry;
    state_->blocks = blocks ? std::move(blocks) : accept;
    state_->accept = std::move(accept);
    state_->device = rtcNewDevice(nullptr);
    HEARTH_ASSERT(state_->device != nullptr);
    state_->meshes.resize(geometry.view().meshes().size());
    for (uint32_t mesh = 0; mesh < state_->meshes.size(); ++mesh)
        state_->addMesh(mesh);
    state_->top = rtcNewScene(state_->device);
    for (uint32_t instance = 0; instance < geometry.view().instances().size(); ++instance)
        state_->addInstance(instance);
    rtcCommitScene(state_->top);
}

EmbreeScene::~EmbreeScene()
{
    rtcReleaseScene(state_->top);
    for (const MeshScene& mesh : state_->meshes)
        if (mesh.scene != nullptr)
            rtcReleaseScene(mesh.scene);
    rtcReleaseDevice(state_->device);
}

std::optional<SurfaceHit> EmbreeScene::nearest(const Ray& ray) const
{
    State::Query query(*state_, state_->accept);
    RTCRayHit ray_hit{};
    ray_hit.ray = toEmbree(ray);
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->top, &query, &ray_hit);
    if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    const uint32_t instance = ray_hit.hit.instID[0];
    SurfaceHit hit =
        state_->toHit(instance, ray_hit.hit.primID, ray_hit.hit.u, ray_hit.hit.v, ray_hit.ray.tfar);
    const DoubleAffine world(state_->geometry->view().instances()[instance].world_from_object);
    hit.front = state_->isFront(hit, world.solve(ray.direction));
    return hit;
}

bool EmbreeScene::occluded(const Ray& ray) const
{
    State::Query query(*state_, state_->blocks);
    RTCRay r = toEmbree(ray);
    rtcOccluded1(state_->top, &query, &r);
    return r.tfar < 0;
}

} // namespace hearth::reference
