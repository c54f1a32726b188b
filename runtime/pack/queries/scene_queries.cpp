// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/scene_queries.h"

#include "runtime/pack/queries/triangle_test.h"
#include "runtime/pack/scene_boxes.h"

#include <algorithm>

namespace hearth::pack
{

namespace
{

using formats::ClusterGeometry;
using formats::ClusterRecord;

/// Box around the clusters of each group of a mesh.
std::vector<Box3> groupBoxes(const formats::PackView& pack, const formats::MeshRecord& mesh)
{
    std::vector<Box3> boxes;
    for (const formats::GroupRecord& group : recordsInRange(pack.groups(), mesh.groups))
    {
        Box3 box;
        for (const ClusterRecord& cluster : recordsInRange(pack.clusters(), group.clusters))
            box.add(formats::clusterBox(cluster, mesh.grid_step));
        boxes.push_back(box);
    }
    return boxes;
}

bool isResident(uint32_t group, const ResidentGroups* resident)
{
    return resident == nullptr || resident->isResident(group);
}

/// True if a cluster is of the finest level that is resident: the cut (cut.h) of a threshold below all
/// errors.
bool isFinest(const ClusterRecord& cluster, const ResidentGroups* resident)
{
    return isResident(cluster.group, resident) &&
           (cluster.refined_group == kInvalidIndex || !isResident(cluster.refined_group, resident));
}

bool isDoubleSided(const formats::PackView& pack, uint32_t material)
{
    return material != kInvalidIndex &&
           (pack.materials()[material].flags & formats::kMaterialDoubleSided) != 0;
}

Double3 toUnit(Double3 vector)
{
    const double norm = length(vector);
    return norm > 0 ? vector * (1 / norm) : Double3{};
}

/// Return the weights of the second and third corner of the point of a triangle that is nearest to a point of
/// its plane, roughly: negative weights become 0.
std::array<double, 2> clampWeights(std::array<double, 2> weights)
{
    const double first = std::max(1 - weights[0] - weights[1], 0.0), second = std::max(weights[0], 0.0),
                 third = std::max(weights[1], 0.0);
    const double sum = first + second + third;
    return sum > 0 ? std::array{second / sum, third / sum} : std::array{1.0 / 3, 1.0 / 3};
}

} // namespace

/// Corners of a triangle in the world.
struct SceneQueries::Corners
{
    std::array<Double3, 3> points;

    Double3 at(const std::array<double, 2>& weights) const
    {
        return points[0] + (points[1] - points[0]) * weights[0] + (points[2] - points[0]) * weights[1];
    }
    Double3 normal() const { return cross(points[1] - points[0], points[2] - points[0]); }
};

/// One ray.
struct SceneQueries::Search
{
    Search(const Ray& wanted, const CastOptions& wanted_options)
        : ray(wanted), options(wanted_options), box_ray(wanted), end(wanted.end)
    {
    }

    /// Take a point that is nearer than `end`. Returns false if it ends the search.
    bool take(const SurfacePoint& point)
    {
        if (options.accept && !options.accept(point))
            return true;
        found = point;
        end = point.t;
        return !options.any_hit;
    }

    const Ray& ray;
    const CastOptions& options;
    BoxRay box_ray;
    double end; ///< t beyond which nothing is looked for
    std::optional<SurfacePoint> found{};
    Status status = success();
};

SceneQueries::SceneQueries(const formats::PackView& pack, uint64_t page_bytes)
    : pack_(&pack), states_(pack), pages_(pack, page_bytes), group_trees_(pack.meshes().size())
{
    changed_.reserve(states_.count());
    std::vector<bool> has_tree(pack.meshes().size());
    std::vector<Box3> boxes(states_.count());
    for (uint32_t i = 0; i < states_.count(); ++i)
    {
        const uint32_t mesh = pack.instances()[i].mesh;
        if (states_.isDeformed(i))
        {
            changed_.push_back(i);
            continue;
        }
        boxes[i] = states_.box(i);
        if (!has_tree[mesh])
            group_trees_[mesh] = BoxTree(groupBoxes(pack, pack.meshes()[mesh]));
        has_tree[mesh] = true;
    }
    instance_tree_ = BoxTree(boxes);
}

void SceneQueries::move(uint32_t instance, const Affine3& world_from_object)
{
    if (!states_.hasChanged(instance))
        changed_.push_back(instance);
    states_.move(instance, world_from_object);
}

void SceneQueries::pose(const InstancePose& pose)
{
    states_.pose(pose);
}

Result<std::optional<SurfacePoint>> SceneQueries::cast(const Ray& ray, const CastOptions& options)
{
    Search search(ray, options);
    const auto visit = [&](uint32_t instance, double&)
    { return states_.hasChanged(instance) || searchInstance(search, instance); };
    if (instance_tree_.visit(search.box_ray, search.end, visit))
        for (const uint32_t instance : changed_)
            if (!searchInstance(search, instance))
                break;
    HEARTH_TRY(search.status);
    return search.found;
}

/// The searches return false if nothing more is to be looked for.
bool SceneQueries::searchInstance(Search& search, uint32_t instance)
{
    if (states_.box(instance).empty() ||
        !(findEntry(search.box_ray, states_.box(instance), search.end) < search.end))
        return true;
    if (states_.isDeformed(instance))
        return searchPlaced(search, instance);
    const auto object_from_world = inverted(widened(states_.worldFromObject(instance)));
    return object_from_world ? searchMesh(search, instance, *object_from_world)
                             : searchPlaced(search, instance);
}

/// Search a rigid instance in its object space.
bool SceneQueries::searchMesh(Search& search, uint32_t instance, const Affine3d& object_from_world)
{
    const Ray ray{transformPoint(object_from_world, search.ray.origin),
                  transformVector(object_from_world, search.ray.direction), search.ray.begin, search.ray.end};
    const BoxRay box_ray(ray);
    const formats::MeshRecord& mesh = states_.mesh(instance);
    const auto visit = [&](uint32_t number, double&)
    {
        const uint32_t group = mesh.groups.first + number;
        return !isResident(group, search.options.resident) ||
               searchGroup(search, instance, pack_->groups()[group].clusters, ray, box_ray);
    };
    return group_trees_[pack_->instances()[instance].mesh].visit(box_ray, search.end, visit);
}

/// Search clusters of a group from near to far: a hit in a near one hides far ones.
bool SceneQueries::searchGroup(Search& search, uint32_t instance, formats::Range clusters, const Ray& ray,
                               const BoxRay& box_ray)
{
    const float grid_step = states_.mesh(instance).grid_step;
    std::array<std::pair<double, uint32_t>, 32> met; // more than nearly all groups have
    for (uint32_t done = 0; done < clusters.count;)
    {
        size_t count = 0;
        for (; done < clusters.count && count < met.size(); ++done)
        {
            const uint32_t number = clusters.first + done;
            const ClusterRecord& cluster = pack_->clusters()[number];
            if (!isFinest(cluster, search.options.resident))
                continue;
            const double entry = findEntry(box_ray, formats::clusterBox(cluster, grid_step), search.end);
            if (entry < search.end)
                met[count++] = {entry, number};
        }
        std::sort(met.begin(), met.begin() + static_cast<std::ptrdiff_t>(count));
        for (size_t i = 0; i < count && met[i].first < search.end; ++i)
            if (!searchCluster(search, instance, met[i].second, ray))
                return false;
    }
    return true;
}

/// Search an instance in the world, cluster by cluster: one that is deformed, or flat.
bool SceneQueries::searchPlaced(Search& search, uint32_t instance)
{
    const formats::Range clusters = states_.mesh(instance).clusters;
    for (uint32_t i = 0; i < clusters.count; ++i)
        if (isFinest(pack_->clusters()[clusters.first + i], search.options.resident) &&
            findEntry(search.box_ray, placedClusterBox(instance, i), search.end) < search.end &&
            !searchCluster(search, instance, clusters.first + i, search.ray))
            return false;
    return true;
}

Box3 SceneQueries::placedClusterBox(uint32_t instance, uint32_t cluster)
{
    if (states_.isDeformed(instance))
        return states_.posedClusterBox(instance, cluster);
    const formats::MeshRecord& mesh = states_.mesh(instance);
    return transformBox(
        widened(states_.worldFromObject(instance)),
        formats::clusterBox(pack_->clusters()[mesh.clusters.first + cluster], mesh.grid_step));
}

Result<ClusterGeometry> SceneQueries::readCluster(uint32_t cluster)
{
    const ClusterRecord& record = pack_->clusters()[cluster];
    const formats::MeshRecord& mesh = pack_->meshes()[pack_->pages()[record.page].mesh];
    HEARTH_ASSIGN_OR_RETURN(const std::span<const std::byte> page, pages_.get(record.page));
    const auto geometry = ClusterGeometry::at(page, record, mesh);
    HEARTH_ASSERT(geometry.has_value()); // the page has been checked
    return *geometry;
}

void SceneQueries::readPositions(const ClusterGeometry& geometry, uint32_t instance, bool in_object,
                                 std::span<Double3> positions) const
{
    if (states_.isDeformed(instance))
    {
        const PosedInstance posed = states_.posed(instance);
        for (uint32_t v = 0; v < positions.size(); ++v)
            positions[v] = posedPosition(geometry, v, posed);
        return;
    }
    const Affine3d world_from_object = widened(states_.worldFromObject(instance));
    for (uint32_t v = 0; v < positions.size(); ++v)
    {
        const Double3 position = widen(geometry.position(v));
        positions[v] = in_object ? position : transformPoint(world_from_object, position);
    }
}

bool SceneQueries::searchCluster(Search& search, uint32_t instance, uint32_t cluster, const Ray& ray)
{
    const auto geometry = readCluster(cluster);
    if (!geometry.ok())
    {
        search.status = geometry.error();
        return false;
    }
    const bool in_object = &ray != &search.ray;
    const auto positions = std::span(positions_).first(geometry->vertexCount());
    readPositions(*geometry, instance, in_object, positions);
    const TriangleRay triangle_ray(ray);
    std::transform(positions.begin(), positions.end(), converted_.begin(),
                   [&](Double3 position) { return triangle_ray.convert(position); });
    for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
    {
        const auto [a, b, c] = geometry->triangle(t);
        TrianglePoint met;
        if (!triangle_ray.meets(converted_[a], converted_[b], converted_[c], search.end, met))
            continue;
        Corners corners{{positions[a], positions[b], positions[c]}};
        if (in_object)
            for (Double3& point : corners.points)
                point = transformPoint(widened(states_.worldFromObject(instance)), point);
        const SurfacePoint point = makePoint({instance, cluster, t}, corners, met.t, met.weights, search.ray);
        const bool is_passed = search.options.culls_back && !point.faces_ray &&
                               !isDoubleSided(*pack_, pack_->clusters()[cluster].material);
        if (!is_passed && !search.take(point))
            return false;
    }
    return true;
}

/// A mirror turns triangles round, and frames draw their other side as the front.
SurfacePoint SceneQueries::makePoint(const TriangleId& id, const Corners& corners, double t,
                                     const std::array<double, 2>& weights, const Ray& ray) const
{
    const bool is_mirrored = states_.isDeformed(id.instance)
                                 ? (pack_->instances()[id.instance].flags & formats::kInstanceMirrored) != 0
                                 : determinant(states_.worldFromObject(id.instance)) < 0;
    const Double3 normal = toUnit(corners.normal()) * (is_mirrored ? -1 : 1);
    return {.id = id,
            .t = t,
            .weights = weights,
            .position = corners.at(weights),
            .normal = normal,
            .faces_ray = dot(normal, ray.direction) < 0};
}

Result<SurfacePoint> SceneQueries::findPoint(const TriangleId& id, const Ray& ray)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "instance " + std::to_string(id.instance), detail};
    };
    if (id.instance >= states_.count())
        return fail("there are " + std::to_string(states_.count()));
    const formats::Range clusters = states_.mesh(id.instance).clusters;
    if (id.cluster < clusters.first || id.cluster - clusters.first >= clusters.count)
        return fail("its mesh has no cluster " + std::to_string(id.cluster));
    if (id.triangle >= pack_->clusters()[id.cluster].triangle_count)
        return fail("its cluster " + std::to_string(id.cluster) + " has no triangle " +
                    std::to_string(id.triangle));
    HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry, readCluster(id.cluster));
    std::array<Double3, formats::kMaxClusterVertices> positions;
    readPositions(geometry, id.instance, false, std::span(positions).first(geometry.vertexCount()));
    const auto [a, b, c] = geometry.triangle(id.triangle);
    const Corners corners{{positions[a], positions[b], positions[c]}};
    // the weights are of the areas that the ray's point on the plane cuts off
    const Double3 normal = corners.normal();
    const double slope = dot(ray.direction, normal), area2 = dot(normal, normal);
    std::array<double, 2> weights{1.0 / 3, 1.0 / 3};
    if (slope != 0 && area2 > 0)
    {
        const Double3 met = ray.origin +
                            ray.direction * (dot(corners.points[0] - ray.origin, normal) / slope) -
                            corners.points[0];
        weights = clampWeights({dot(cross(met, corners.points[2] - corners.points[0]), normal) / area2,
                                dot(cross(corners.points[1] - corners.points[0], met), normal) / area2});
    }
    const double t = dot(corners.at(weights) - ray.origin, ray.direction) / dot(ray.direction, ray.direction);
    return makePoint(id, corners, t, weights, ray);
}

Box3 SceneQueries::bounds(uint32_t first, uint32_t count) const
{
    Box3 box;
    for (uint32_t i = first; i < first + count; ++i)
        box.add(states_.box(i));
    return box;
}

} // namespace hearth::pack
