// Queries about a pack's instances where they stand: rays against their triangles, on the CPU.
// See runtime/pack/README.md, "Queries".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/queries/box_tree.h"
#include "runtime/pack/queries/instance_states.h"
#include "runtime/pack/queries/page_cache.h"
#include "runtime/pack/resident_groups.h"

#include <functional>
#include <optional>

namespace hearth::pack
{

/// Triangle of an instance.
struct TriangleId
{
    uint32_t instance = kInvalidIndex;
    uint32_t cluster = kInvalidIndex; ///< of the pack
    uint32_t triangle = 0;            ///< of the cluster
    friend bool operator==(const TriangleId&, const TriangleId&) = default;
};

/// Point of a triangle that a ray meets.
struct SurfacePoint
{
    TriangleId id;
    double t = 0;                    ///< of the ray
    std::array<double, 2> weights{}; ///< barycentric, of the second and third corner
    Double3 position;                ///< world
    Double3 normal;                  ///< of the triangle's front side: unit; 0 where it has no area
    bool faces_ray = false;          ///< its front side does
};

struct CastOptions
{
    bool any_hit = false;    ///< any point in place of the nearest
    bool culls_back = false; ///< pass the back sides of materials that are not double-sided, as frames do
    /// Groups of the pack: rays meet the finest level of these. Null: the source's triangles.
    const ResidentGroups* resident = nullptr;
    /// Called for points in no order, nearer than those it has accepted; false: the ray goes on. Empty: all
    /// are.
    std::function<bool(const SurfacePoint&)> accept{};
};

/// Queries of one pack. Only the constructor allocates. Not thread-safe.
class SceneQueries
{
public:
    /// pack        checked; outlives the queries
    /// page_bytes  of decoded pages that are kept
    SceneQueries(const formats::PackView& pack, uint64_t page_bytes);

    const InstanceStates& states() const { return states_; }

    /// Take a move or a pose that InstanceStates has checked.
    void move(uint32_t instance, const Affine3& world_from_object);
    void pose(const InstancePose& pose);

    /// Find the nearest point in which a ray meets a triangle, or any; nullopt if there is none. Triangles
    /// that share an edge leave no gap. errors: those of PackView::decodePage, of pages that the ray needs.
    Result<std::optional<SurfacePoint>> cast(const Ray& ray, const CastOptions& options);

    /// Find the point of a triangle where a ray meets its plane, moved into the triangle: what a pixel shows
    /// whose center the ray goes through. errors: usage, if there is no such triangle; those of
    /// PackView::decodePage.
    Result<SurfacePoint> findPoint(const TriangleId& id, const Ray& ray);

    /// Return the bounds of instances [first, first + count) in the world; empty where there is nothing to
    /// draw.
    Box3 bounds(uint32_t first, uint32_t count) const;

private:
    struct Search;
    struct Corners;
    bool searchInstance(Search& search, uint32_t instance);
    bool searchMesh(Search& search, uint32_t instance, const Affine3d& object_from_world);
    bool searchGroup(Search& search, uint32_t instance, formats::Range clusters, const Ray& ray,
                     const BoxRay& box_ray);
    bool searchPlaced(Search& search, uint32_t instance);
    bool searchCluster(Search& search, uint32_t instance, uint32_t cluster, const Ray& ray);
    SurfacePoint makePoint(const TriangleId& id, const Corners& corners, double t,
                           const std::array<double, 2>& weights, const Ray& ray) const;
    Box3 placedClusterBox(uint32_t instance, uint32_t cluster);
    Result<formats::ClusterGeometry> readCluster(uint32_t cluster);
    /// Write the positions of a cluster's vertices: in the world, or in the object space of a rigid instance.
    void readPositions(const formats::ClusterGeometry& geometry, uint32_t instance, bool in_object,
                       std::span<Double3> positions) const;

    const formats::PackView* pack_;
    InstanceStates states_;
    PageCache pages_;
    BoxTree instance_tree_;         ///< instances that have not changed
    std::vector<uint32_t> changed_; ///< instances that have
    /// Vertices of the cluster that is searched, and the same as TriangleRay converts them.
    std::array<Double3, formats::kMaxClusterVertices> positions_, converted_;
    std::vector<BoxTree> group_trees_; ///< for each mesh that rigid instances draw
};

} // namespace hearth::pack
