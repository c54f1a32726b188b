// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/occluders.h"

#include "formats/base/assert.h"

#include <cstring>
#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <vector>

namespace hearth::visibility
{

namespace
{

/// Filter settings of a mesh. Must not move while Embree holds its address.
struct HitFilter
{
    BackFaces back_faces;
    Mask mask;

    bool isActive() const { return back_faces == BackFaces::let_through || mask; }
};

/// Reject hits in Embree's filter callback, for a single ray or several side by side.
void rejectHits(const RTCFilterFunctionNArguments* arguments)
{
    const auto& filter = *static_cast<const HitFilter*>(arguments->geometryUserPtr);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i)
    {
        if (arguments->valid[i] == 0)
            continue;
        const RTCRay ray = rtcGetRayFromRayN(arguments->ray, count, i);
        const RTCHit hit = rtcGetHitFromHitN(arguments->hit, count, i);
        // both in the space of the mesh, where front faces are the same in mirrored instances
        const bool from_behind = ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z > 0;
        if ((from_behind && filter.back_faces == BackFaces::let_through) ||
            (filter.mask && !filter.mask(hit.primID, hit.u, hit.v)))
            arguments->valid[i] = 0;
    }
}

/// Deleter for Embree's reference-counted objects.
struct EmbreeRelease
{
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename T>
using EmbreePtr = std::unique_ptr<std::remove_pointer_t<T>, EmbreeRelease>;

struct EmbreeMesh
{
    EmbreePtr<RTCGeometry> triangles;
    EmbreePtr<RTCScene> scene; ///< holds the triangles for instances; created for the first one
    std::unique_ptr<HitFilter> filter;
};

struct OccluderInstance
{
    size_t mesh;
    Affine3 world_from_mesh;
};

void commit(RTCScene scene)
{
    // High build quality, which splits triangles, makes rays 2 % faster on a rock and no faster among thin
    // slanted pipes. It takes four to twelve times as long to build, which is then a tenth of the time of the
    // rays.
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    // With several threads the tree may depend on their timing, and so may hits where boxes touch. (Limiting
    // the device to one thread would limit all of TBB.)
    tbb::task_arena(1).execute([scene] { rtcCommitScene(scene); });
}

} // namespace

struct Occluders::State
{
    EmbreePtr<RTCDevice> device{rtcNewDevice(nullptr)};
    EmbreePtr<RTCScene> top{rtcNewScene(device.get())};
    std::vector<EmbreeMesh> meshes;
    std::vector<OccluderInstance> mesh_instances;
    std::vector<EmbreePtr<RTCGeometry>> instances;
    bool finished = false;

    void attach(const OccluderInstance& place);
};

void Occluders::State::attach(const OccluderInstance& place)
{
    EmbreeMesh& mesh = meshes[place.mesh];
    if (mesh.triangles == nullptr)
        return;
    if (place.world_from_mesh == Affine3{})
    {
        rtcAttachGeometry(top.get(), mesh.triangles.get());
        return;
    }
    if (mesh.scene == nullptr)
    {
        mesh.scene.reset(rtcNewScene(device.get()));
        rtcAttachGeometry(mesh.scene.get(), mesh.triangles.get());
    }
    RTCGeometry instance = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    instances.emplace_back(instance);
    rtcSetGeometryInstancedScene(instance, mesh.scene.get());
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, place.world_from_mesh.m);
    rtcAttachGeometry(top.get(), instance);
}

Occluders::Occluders() : state_(std::make_unique<State>())
{
    HEARTH_ASSERT(state_->device != nullptr && state_->top != nullptr);
}
Occluders::~Occluders() = default;
Occluders::Occluders(Occluders&&) noexcept = default;
Occluders& Occluders::operator=(Occluders&&) noexcept = default;

Occluders::Mesh Occluders::add(const OccluderMesh& mesh)
{
    HEARTH_ASSERT(mesh.corners.size() % 3 == 0);
    for (const uint32_t corner : mesh.corners)
        HEARTH_ASSERT(corner < mesh.positions.size());
    EmbreeMesh added;
    added.filter = std::make_unique<HitFilter>(HitFilter{mesh.back_faces, mesh.mask});
    if (!mesh.corners.empty())
    {
        RTCGeometry triangles = rtcNewGeometry(state_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        added.triangles.reset(triangles);
        void* const positions = rtcSetNewGeometryBuffer(
            triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Float3), mesh.positions.size());
        std::memcpy(positions, mesh.positions.data(), mesh.positions.size_bytes());
        void* const corners = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                      3 * sizeof(uint32_t), mesh.corners.size() / 3);
        std::memcpy(corners, mesh.corners.data(), mesh.corners.size_bytes());
        if (added.filter->isActive())
        {
            rtcSetGeometryUserData(triangles, added.filter.get());
            rtcSetGeometryIntersectFilterFunction(triangles, rejectHits);
            rtcSetGeometryOccludedFilterFunction(triangles, rejectHits);
        }
        rtcCommitGeometry(triangles);
    }
    state_->meshes.push_back(std::move(added));
    return static_cast<Mesh>(state_->meshes.size() - 1);
}

void Occluders::place(Mesh mesh, const Affine3& world_from_mesh)
{
    HEARTH_ASSERT(!state_->finished && static_cast<size_t>(mesh) < state_->meshes.size());
    state_->mesh_instances.push_back({static_cast<size_t>(mesh), world_from_mesh});
}

void Occluders::finish()
{
    HEARTH_ASSERT(!state_->finished);
    for (const OccluderInstance& place : state_->mesh_instances)
        state_->attach(place);
    std::vector<RTCScene> instanced;
    for (const EmbreeMesh& mesh : state_->meshes)
        if (mesh.scene != nullptr)
            instanced.push_back(mesh.scene.get());
    tbb::parallel_for(size_t{0}, instanced.size(), [&](size_t i) { commit(instanced[i]); });
    for (const EmbreePtr<RTCGeometry>& instance : state_->instances)
        rtcCommitGeometry(instance.get());
    commit(state_->top.get());
    HEARTH_ASSERT(rtcGetDeviceError(state_->device.get()) == RTC_ERROR_NONE);
    state_->finished = true;
}

RTCSceneTy* Occluders::scene() const
{
    HEARTH_ASSERT(state_->finished);
    return state_->top.get();
}

} // namespace hearth::visibility
