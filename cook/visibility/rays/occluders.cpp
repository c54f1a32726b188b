// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/occluders.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cstring>
#include <embree3/rtcore.h>
#include <limits>
#include <set>
#include <string_view>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unordered_map>
#include <vector>

namespace hearth::visibility
{

namespace
{

// Meshes with so many instances, such as tufts of grass, are copied into one mesh in the world, up to a
// number of triangles, so that rays need not be transformed for each instance that they come near.
constexpr size_t kMinMergedInstances = 64;
constexpr size_t kMaxMergedTriangles = size_t{1} << 21;

/// Filter settings of a mesh. Must not move while Embree holds its address.
struct HitFilter
{
    BackFaces back_faces;
    Mask mask;
    size_t triangle_count; ///< of one copy of the mesh

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
            (filter.mask &&
             !filter.mask(static_cast<uint32_t>(hit.primID % filter.triangle_count), hit.u, hit.v)))
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

/// Triangles and their buffers, which Embree owns.
struct EmbreeTriangles
{
    EmbreePtr<RTCGeometry> geometry;
    std::span<Float3> positions;
    std::span<uint32_t> corners;
};

EmbreeTriangles createTriangles(RTCDevice device, size_t position_count, size_t triangle_count)
{
    EmbreeTriangles triangles;
    triangles.geometry.reset(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    void* const positions = rtcSetNewGeometryBuffer(triangles.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                                    RTC_FORMAT_FLOAT3, sizeof(Float3), position_count);
    triangles.positions = {static_cast<Float3*>(positions), position_count};
    void* const corners = rtcSetNewGeometryBuffer(triangles.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
                                                  RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangle_count);
    triangles.corners = {static_cast<uint32_t*>(corners), triangle_count * 3};
    return triangles;
}

struct EmbreeMesh
{
    EmbreeTriangles triangles;
    EmbreePtr<RTCScene> scene; ///< holds the triangles for instances; created for the first one
    std::unique_ptr<HitFilter> filter;
    std::vector<uint32_t> colors;         ///< of each triangle, or empty
    std::vector<Affine3> world_from_mesh; ///< of each instance

    bool isMerged() const
    {
        return world_from_mesh.size() >= kMinMergedInstances && filter->back_faces == BackFaces::block &&
               world_from_mesh.size() * filter->triangle_count <= kMaxMergedTriangles;
    }
};

/// Geometry of the top scene: an instance of a mesh, or the copies of all instances in the world.
struct TopGeometry
{
    uint32_t mesh;
    bool is_merged;
    Affine3 world_from_positions;
    std::span<const Float3> positions;
    std::span<const uint32_t> corners;
};

/// Set the filter and commit the triangles.
void commit(const EmbreeTriangles& triangles, HitFilter& filter)
{
    if (filter.isActive())
    {
        rtcSetGeometryUserData(triangles.geometry.get(), &filter);
        rtcSetGeometryIntersectFilterFunction(triangles.geometry.get(), rejectHits);
        rtcSetGeometryOccludedFilterFunction(triangles.geometry.get(), rejectHits);
    }
    rtcCommitGeometry(triangles.geometry.get());
}

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

size_t hashTriangles(const OccluderMesh& mesh)
{
    const auto hash = [](const auto& values)
    {
        const std::span<const std::byte> bytes = std::as_bytes(values);
        return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    };
    return hash(mesh.positions) * 31 + hash(mesh.corners);
}

/// Keep the first of equal transforms: rays would test all, and meet all at the same distance.
void removeRepetitions(std::vector<Affine3>& transforms)
{
    const auto before = [](const Affine3& a, const Affine3& b)
    { return std::memcmp(&a, &b, sizeof(Affine3)) < 0; };
    std::set<Affine3, decltype(before)> seen(before);
    std::erase_if(transforms, [&](const Affine3& transform) { return !seen.insert(transform).second; });
}

/// Return the unit normal of a triangle's front in the world; 0 of a triangle without area.
/// triangle  of all copies of the mesh
Float3 frontNormal(const TopGeometry& geometry, const EmbreeMesh& mesh, uint32_t triangle)
{
    const uint32_t* corner = &geometry.corners[size_t{triangle} * 3];
    const Affine3& world = geometry.world_from_positions;
    const Float3 a = geometry.positions[corner[0]];
    const Float3 normal = normalizeOr(cross(transformVector(world, geometry.positions[corner[1]] - a),
                                            transformVector(world, geometry.positions[corner[2]] - a)),
                                      {});
    const Affine3& placed =
        geometry.is_merged ? mesh.world_from_mesh[triangle / mesh.filter->triangle_count] : world;
    return determinant(placed) < 0 ? -normal : normal;
}

} // namespace

struct Occluders::State
{
    EmbreePtr<RTCDevice> device{rtcNewDevice(nullptr)};
    EmbreePtr<RTCScene> top{rtcNewScene(device.get())};
    std::vector<EmbreeMesh> meshes;
    std::unordered_multimap<size_t, uint32_t> unmasked; ///< meshes without a mask, by hashTriangles
    std::vector<EmbreePtr<RTCGeometry>> instances;
    std::vector<TopGeometry> geometries; ///< by Embree's number
    bool finished = false;

    /// Find a mesh that occludes exactly as another one would.
    std::optional<uint32_t> findEqual(const OccluderMesh& mesh, size_t hash) const;
    void attach(uint32_t number, const Affine3& world_from_mesh);
    void attachMerged(uint32_t number);
    /// Attach to the top scene.
    void attach(RTCGeometry geometry, const TopGeometry& record)
    {
        const uint32_t id = rtcAttachGeometry(top.get(), geometry);
        HEARTH_ASSERT(id == geometries.size()); // numbers rise from 0
        geometries.push_back(record);
    }
};

std::optional<uint32_t> Occluders::State::findEqual(const OccluderMesh& mesh, size_t hash) const
{
    const auto [first, last] = unmasked.equal_range(hash);
    for (auto found = first; found != last; ++found)
    {
        const EmbreeMesh& other = meshes[found->second];
        if (other.filter->back_faces == mesh.back_faces &&
            std::ranges::equal(other.triangles.positions, mesh.positions) &&
            std::ranges::equal(other.triangles.corners, mesh.corners) &&
            std::ranges::equal(other.colors, mesh.colors))
            return found->second;
    }
    return std::nullopt;
}

/// Attach one mesh with the triangles of all instances.
void Occluders::State::attachMerged(uint32_t number)
{
    const EmbreeMesh& mesh = meshes[number];
    const std::span<const Float3> positions = mesh.triangles.positions;
    const std::span<const uint32_t> corners = mesh.triangles.corners;
    const size_t count = mesh.world_from_mesh.size();
    const EmbreeTriangles merged =
        createTriangles(device.get(), positions.size() * count, corners.size() / 3 * count);
    for (size_t i = 0; i < count; ++i)
    {
        for (size_t v = 0; v < positions.size(); ++v)
            merged.positions[i * positions.size() + v] =
                transformPoint(mesh.world_from_mesh[i], positions[v]);
        for (size_t c = 0; c < corners.size(); ++c)
            merged.corners[i * corners.size() + c] = static_cast<uint32_t>(i * positions.size()) + corners[c];
    }
    commit(merged, *mesh.filter);
    attach(merged.geometry.get(), {number, true, {}, merged.positions, merged.corners});
}

void Occluders::State::attach(uint32_t number, const Affine3& world_from_mesh)
{
    EmbreeMesh& mesh = meshes[number];
    const EmbreeTriangles& triangles = mesh.triangles;
    if (world_from_mesh == Affine3{})
    {
        attach(triangles.geometry.get(), {number, false, {}, triangles.positions, triangles.corners});
        return;
    }
    if (mesh.scene == nullptr)
    {
        mesh.scene.reset(rtcNewScene(device.get()));
        rtcAttachGeometry(mesh.scene.get(), mesh.triangles.geometry.get());
    }
    RTCGeometry instance = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    instances.emplace_back(instance);
    rtcSetGeometryInstancedScene(instance, mesh.scene.get());
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, world_from_mesh.m);
    attach(instance, {number, false, world_from_mesh, triangles.positions, triangles.corners});
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
    const size_t hash = hashTriangles(mesh);
    if (!mesh.mask)
        if (const std::optional<uint32_t> equal = state_->findEqual(mesh, hash))
            return static_cast<Mesh>(*equal);
    EmbreeMesh added;
    added.filter =
        std::make_unique<HitFilter>(HitFilter{mesh.back_faces, mesh.mask, mesh.corners.size() / 3});
    HEARTH_ASSERT(mesh.colors.empty() || mesh.colors.size() == mesh.corners.size() / 3);
    added.colors.assign(mesh.colors.begin(), mesh.colors.end());
    if (!mesh.corners.empty())
    {
        added.triangles =
            createTriangles(state_->device.get(), mesh.positions.size(), mesh.corners.size() / 3);
        std::ranges::copy(mesh.positions, added.triangles.positions.begin());
        std::ranges::copy(mesh.corners, added.triangles.corners.begin());
        commit(added.triangles, *added.filter);
    }
    if (!mesh.mask)
        state_->unmasked.emplace(hash, static_cast<uint32_t>(state_->meshes.size()));
    state_->meshes.push_back(std::move(added));
    return static_cast<Mesh>(state_->meshes.size() - 1);
}

void Occluders::place(Mesh mesh, const Affine3& world_from_mesh)
{
    HEARTH_ASSERT(!state_->finished && static_cast<size_t>(mesh) < state_->meshes.size());
    state_->meshes[static_cast<size_t>(mesh)].world_from_mesh.push_back(world_from_mesh);
}

void Occluders::finish()
{
    HEARTH_ASSERT(!state_->finished);
    for (uint32_t number = 0; number < state_->meshes.size(); ++number)
    {
        EmbreeMesh& mesh = state_->meshes[number];
        if (mesh.triangles.geometry == nullptr)
            continue;
        removeRepetitions(mesh.world_from_mesh);
        if (mesh.isMerged())
            state_->attachMerged(number);
        else
            for (const Affine3& world_from_mesh : mesh.world_from_mesh)
                state_->attach(number, world_from_mesh);
    }
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

std::optional<Occluders::Hit> Occluders::nearest(Float3 origin, Float3 direction) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    const bool is_instance = ray.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const TopGeometry& geometry = state_->geometries[is_instance ? ray.hit.instID[0] : ray.hit.geomID];
    const EmbreeMesh& mesh = state_->meshes[geometry.mesh];
    const size_t triangle = ray.hit.primID % mesh.filter->triangle_count;
    const uint32_t code = mesh.colors.empty() ? encodeSurfaceColor({1, 1, 1}, true) : mesh.colors[triangle];
    const Float3 front = frontNormal(geometry, mesh, ray.hit.primID);
    const bool from_behind = dot(front, direction) > 0;
    return Hit{ray.ray.tfar, from_behind ? -front : front, shared::decodeAlbedo(code),
               from_behind && code >> 30 == 0};
}

RTCSceneTy* Occluders::scene() const
{
    HEARTH_ASSERT(state_->finished);
    return state_->top.get();
}

} // namespace hearth::visibility
