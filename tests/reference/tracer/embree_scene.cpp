// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/embree_scene.h"

#include "formats/base/assert.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <vector>

namespace hearth::reference
{

using namespace formats;

namespace
{

/// One mesh as an Embree scene, with the clusters of its triangles.
struct MeshScene
{
    RTCScene scene = nullptr;
    std::vector<std::pair<uint32_t, uint32_t>> triangles; ///< cluster, triangle
};

} // namespace

struct EmbreeScene::State
{
    /// Query context. Embree passes its context to the filter, so the filter's data is appended to it.
    struct Query : RTCIntersectContext
    {
        const State* state;
        const AcceptHit* accept;
        Query(const State& s, const AcceptHit& a) : state(&s), accept(&a) { rtcInitIntersectContext(this); }
    };

    const Placement* placement;
    AcceptHit accept, blocks;
    RTCDevice device = nullptr;
    RTCScene top = nullptr;
    std::vector<MeshScene> meshes;   ///< object space; meshes that are not deformed
    std::vector<MeshScene> deformed; ///< world space; one for each instance, empty unless it is deformed

    const PackView& view() const { return placement->geometry().view(); }
    const MeshScene& getScene(uint32_t instance) const
    {
        return placement->isDeformed(instance) ? deformed[instance]
                                               : meshes[view().instances()[instance].mesh];
    }
    MeshScene makeScene(uint32_t mesh, std::optional<uint32_t> deformed_instance) const;
    void addInstance(uint32_t index);
    SurfaceHit toHit(uint32_t instance, uint32_t primitive, float u, float v, float distance) const;
    bool isFront(const SurfaceHit& hit, Double3 direction) const;
    static void filter(const RTCFilterFunctionNArguments* arguments);
};

/// Make a mesh's scene in object space, or in world space for a deformed instance.
MeshScene EmbreeScene::State::makeScene(uint32_t index, std::optional<uint32_t> deformed_instance) const
{
    MeshScene mesh;
    const Range clusters = view().meshes()[index].clusters;
    std::vector<Float3> corners;
    for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
    {
        if (view().clusters()[c].level != 0)
            continue;
        const ClusterGeometry cluster = placement->geometry().cluster(c);
        for (uint32_t t = 0; t < cluster.triangleCount(); ++t)
        {
            for (const uint32_t corner : cluster.triangle(t))
            {
                const Double3 world = deformed_instance
                                          ? placement->vertex(*deformed_instance, cluster, corner).position
                                          : Double3(cluster.position(corner));
                corners.push_back(
                    {static_cast<float>(world.x), static_cast<float>(world.y), static_cast<float>(world.z)});
            }
            mesh.triangles.emplace_back(c, t);
        }
    }
    if (corners.empty())
        return mesh;
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
    return mesh;
}

void EmbreeScene::State::addInstance(uint32_t index)
{
    if (placement->isDeformed(index))
        deformed[index] = makeScene(view().instances()[index].mesh, index);
    const MeshScene& mesh = getScene(index);
    if (mesh.scene == nullptr)
        return;
    const Affine3 world_from_scene =
        placement->isDeformed(index) ? Affine3{} : narrowed(placement->worldFromObject(index)).value();
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, mesh.scene);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, world_from_scene.m);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(top, instance, index);
    rtcReleaseGeometry(instance);
}

SurfaceHit EmbreeScene::State::toHit(uint32_t instance, uint32_t primitive, float u, float v,
                                     float distance) const
{
    const auto [cluster, triangle] = getScene(instance).triangles[primitive];
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

bool EmbreeScene::State::isFront(const SurfaceHit& hit, Double3 direction) const
{
    return dot(surfaceAt(*placement, hit, 0).geometric_normal, direction) < 0;
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
    // Embree passes rays to filters in the space of the instance, where mirrors change neither
    // winding nor side.
    const Double3 direction{double{ray.dir_x}, double{ray.dir_y}, double{ray.dir_z}};
    candidate.front = query.state->placement->isDeformed(candidate.instance)
                          ? query.state->isFront(candidate, direction)
                          : dot(Double3{double{hit.Ng_x}, double{hit.Ng_y}, double{hit.Ng_z}}, direction) < 0;
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

EmbreeScene::EmbreeScene(const Placement& placement, AcceptHit accept, AcceptHit blocks)
    : state_(std::make_unique<State>())
{
    state_->placement = &placement;
    state_->blocks = blocks ? std::move(blocks) : accept;
    state_->accept = std::move(accept);
    state_->device = rtcNewDevice(nullptr);
    HEARTH_ASSERT(state_->device != nullptr);
    const PackView& view = state_->view();
    for (uint32_t mesh = 0; mesh < view.meshes().size(); ++mesh)
        state_->meshes.push_back(state_->makeScene(mesh, std::nullopt));
    state_->deformed.resize(view.instances().size());
    state_->top = rtcNewScene(state_->device);
    for (uint32_t instance = 0; instance < view.instances().size(); ++instance)
        state_->addInstance(instance);
    rtcCommitScene(state_->top);
}

EmbreeScene::~EmbreeScene()
{
    rtcReleaseScene(state_->top);
    for (const auto* scenes : {&state_->meshes, &state_->deformed})
        for (const MeshScene& mesh : *scenes)
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
    hit.front = state_->isFront(hit, ray.direction);
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
