// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/culling_oracle.h"

#include <algorithm>
#include <limits>

namespace hearth::reference
{

using namespace formats;

namespace
{

/// Axes of the camera; a point at depth d is inside if |x| <= d * slope_x, |y| <= d * slope_y and d >= near.
struct OracleCamera
{
    Double3 eye, right, up, forward;
    double slope_x, slope_y, near;
    double pixels_per_slope; ///< K = H / (2 tan(fovy / 2))

    explicit OracleCamera(const OracleView& view)
        : eye(view.camera.position),
          forward(normalize(Double3(view.camera.target) - Double3(view.camera.position)))
    {
        right = normalize(cross(forward, Double3(view.camera.up)));
        up = cross(right, forward);
        slope_y = std::tan(double{view.camera.y_fov_rad} / 2);
        slope_x = slope_y * view.width / view.height;
        near = double{view.camera.z_near};
        pixels_per_slope = view.height / (2 * slope_y);
    }

    /// Signed distances, not normalised, of a world point to the five planes; positive inside.
    std::array<double, 5> distances(Double3 world) const
    {
        const Double3 p = world - eye;
        const double x = dot(p, right), y = dot(p, up), depth = dot(p, forward);
        return {depth * slope_x + x, depth * slope_x - x, depth * slope_y + y, depth * slope_y - y,
                depth - near};
    }

    /// Factor for lengths that are compared with the side planes' distances, which are not normalised.
    double planeScale() const { return std::max(slope_x, slope_y) + 1; }
};

/// Relative rounding error of the float code: an intended slack of 2^-20, plus a few units in the last place.
constexpr double kRelativeBand = 4e-6;
/// Margin of formats/gpu_shared: 1e-3 in the sine, and a tenth of the checker's tolerance.
constexpr double kConeBand = 1.3e-3;
constexpr double kApexBand = 1.5e-4;

/// Minimum over the planes of the greatest distance of any point. Negative: all points are outside one plane.
double reachInside(const OracleCamera& camera, const std::array<Double3, 8>& points)
{
    double worst = std::numeric_limits<double>::infinity();
    for (size_t plane = 0; plane < 5; ++plane)
    {
        double nearest = -std::numeric_limits<double>::infinity();
        for (const Double3& p : points)
            nearest = std::max(nearest, camera.distances(p)[plane]);
        worst = std::min(worst, nearest);
    }
    return worst;
}

std::array<Double3, 8> getCorners(Double3 low, Double3 high)
{
    std::array<Double3, 8> corners;
    for (size_t i = 0; i < 8; ++i)
        corners[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    return corners;
}

/// Test if a box, moved by `transform`, is wholly outside one plane. A moved box that reaches inside by any
/// amount must be drawn. If its world-axis-aligned bounding box, which the design tests, is outside, it must
/// be culled.
Answer boxOutside(const OracleCamera& camera, const DoubleAffine& transform, Float3 box_min, Float3 box_max)
{
    std::array<Double3, 8> moved = getCorners(Double3(box_min), Double3(box_max));
    double magnitude = 0;
    Double3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (Double3& p : moved)
    {
        for (const Double3& row : transform.row)
            magnitude = std::max(magnitude, dot(abs(row), abs(p)));
        p = transform.point(p);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (reachInside(camera, moved) >= 0)
        return Answer::no;
    const Double3 offset = abs(transform.translation - camera.eye);
    magnitude = 3 * (magnitude + offset.x + offset.y + offset.z) + camera.near;
    const double band = kRelativeBand * magnitude * camera.planeScale();
    return reachInside(camera, getCorners(low, high)) < -band ? Answer::yes : Answer::either;
}

/// E(g) = s e K / max(|M c - eye| - s r, near) > threshold.
Answer exceeds(const OracleCamera& camera, const OracleView& view, const InstanceRecord& instance,
               const GroupRecord& group)
{
    if (group.error == std::numeric_limits<float>::infinity() || view.error_pixels <= 0)
        return Answer::yes;
    const double stretch = double{instance.scale_max};
    const Double3 center = DoubleAffine(instance.world_from_object).point(Double3(group.sphere_center));
    const double distance =
        std::max(length(center - camera.eye) - stretch * double{group.sphere_radius}, camera.near);
    const double ratio =
        stretch * double{group.error} * camera.pixels_per_slope / distance / double{view.error_pixels};
    // A distance that is a small difference of large numbers carries their rounding errors.
    const double band =
        1e-6 +
        1e-6 * (length(center) + length(camera.eye) + stretch * double{group.sphere_radius}) / distance;
    return ratio > 1 + band ? Answer::yes : ratio < 1 - band ? Answer::no : Answer::either;
}

Answer notAnswer(Answer a)
{
    return a == Answer::yes ? Answer::no : a == Answer::no ? Answer::yes : a;
}

Answer both(Answer a, Answer b)
{
    if (a == Answer::no || b == Answer::no)
        return Answer::no;
    return a == Answer::yes && b == Answer::yes ? Answer::yes : Answer::either;
}

Answer coneAway(const OracleCamera& camera, const DoubleAffine& transform, const ClusterRecord& cluster,
                float grid_step)
{
    if (cluster.cone_cutoff == kNoCone)
        return Answer::no;
    const double stretch2 = dot(transform.row[0], transform.row[0]) +
                            dot(transform.row[1], transform.row[1]) + dot(transform.row[2], transform.row[2]);
    if (std::abs(transform.determinant()) < 1e-30 * stretch2 * std::sqrt(stretch2))
        return Answer::either; // inversion of such a matrix in floats is not tested here
    const Double3 eye = transform.solve(camera.eye - transform.translation);
    const Box3 box = clusterBox(cluster, grid_step);
    const Double3 middle = (Double3(box.min) + Double3(box.max)) * 0.5;
    const Double3 axis = normalize(Double3(coneAxis(cluster)));
    const double back = coneBack(cluster, grid_step);
    const Double3 apex = middle - axis * back;
    const Double3 to_apex = apex - eye;
    const double along = dot(to_apex, axis);
    const double distance = length(to_apex);
    const double reach = length(Double3(box.max) - middle) + back;
    const double cutoff = double{coneCutoff(cluster)};
    // The eye in object space inherits the rounding errors of the inverse matrix.
    const Double3 offset = abs(camera.eye - transform.translation);
    const double conditioning = std::pow(stretch2, 1.5) / std::abs(transform.determinant());
    const double eye_rounding = 1e-5 * conditioning * (length(offset) / std::sqrt(stretch2) + length(eye));
    const double certain =
        (cutoff + kConeBand) * distance + kApexBand * reach + 1e-5 * length(apex) + eye_rounding;
    if (along < cutoff * distance)
        return Answer::no;
    return along > certain ? Answer::yes : Answer::either;
}

bool contains(std::span<const DrawnCluster> sorted, DrawnCluster which)
{
    return std::binary_search(sorted.begin(), sorted.end(), which);
}

Answer meshOutside(const OracleCamera& camera, const PackView& view, const InstanceRecord& instance)
{
    Box3 box;
    const Range clusters = view.meshes()[instance.mesh].clusters;
    for (const ClusterRecord& cluster : recordsInRange(view.clusters(), clusters))
        box.add(clusterBox(cluster, view.meshes()[instance.mesh].grid_step));
    return boxOutside(camera, DoubleAffine(instance.world_from_object), box.min, box.max);
}

} // namespace

Answer Judgement::drawn() const
{
    return both(in_cut, both(notAnswer(outside_frustum), notAnswer(faces_away)));
}

Judgement judgeCluster(const PackView& view, const OracleView& oracle, DrawnCluster which)
{
    const OracleCamera camera(oracle);
    const InstanceRecord& instance = view.instances()[which.instance];
    const ClusterRecord& cluster = view.clusters()[which.cluster];
    const DoubleAffine transform(instance.world_from_object);
    const float grid_step = view.meshes()[instance.mesh].grid_step;

    Judgement judgement;
    judgement.in_cut = exceeds(camera, oracle, instance, view.groups()[cluster.group]);
    if (cluster.refined_group != kInvalidIndex)
        judgement.in_cut =
            both(judgement.in_cut,
                 notAnswer(exceeds(camera, oracle, instance, view.groups()[cluster.refined_group])));

    judgement.outside_frustum = Answer::no;
    if (oracle.flags & shared::kCullFrustum)
    {
        const Box3 box = clusterBox(cluster, grid_step);
        judgement.outside_frustum = boxOutside(camera, transform, box.min, box.max);
    }
    else if (oracle.flags & shared::kCullInstances)
        judgement.outside_frustum = meshOutside(camera, view, instance);

    const bool cone =
        (oracle.flags & shared::kCullCone) && !isDoubleSided(view.materials(), cluster.material);
    judgement.faces_away = cone ? coneAway(camera, transform, cluster, grid_step) : Answer::no;
    // Bounds over all poses are wider than those of the bind pose, and the cones differ.
    if (isDeformed(view, which.instance))
    {
        if (judgement.outside_frustum == Answer::yes)
            judgement.outside_frustum = Answer::either;
        if (cone)
            judgement.faces_away = Answer::either;
    }
    return judgement;
}

CullingComparison compareWithOracle(const PackView& view, const OracleView& oracle,
                                    std::span<const DrawnCluster> drawn)
{
    CullingComparison comparison;
    comparison.drawn = drawn.size();
    for (uint32_t i = 0; i < view.instances().size(); ++i)
    {
        const Range clusters = view.meshes()[view.instances()[i].mesh].clusters;
        for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
        {
            const Judgement judgement = judgeCluster(view, oracle, {i, c});
            const Answer right = judgement.drawn();
            const bool is_drawn = contains(drawn, {i, c});
            ++comparison.pairs;
            comparison.either += right == Answer::either;
            comparison.wrongly_drawn += is_drawn && right == Answer::no;
            comparison.wrongly_culled += !is_drawn && right == Answer::yes;
            if (!is_drawn && judgement.in_cut == Answer::yes)
            {
                comparison.outside_frustum += judgement.outside_frustum == Answer::yes;
                comparison.facing_away +=
                    judgement.outside_frustum == Answer::no && judgement.faces_away == Answer::yes;
            }
        }
    }
    return comparison;
}

namespace
{

/// True if the triangle might cover a pixel: inside the frustum's planes and front-facing.
bool couldBeSeen(const OracleCamera& camera, const DoubleAffine& transform,
                 const std::array<Float3, 3>& corners, bool double_sided)
{
    std::array<double, 5> nearest;
    nearest.fill(-std::numeric_limits<double>::infinity());
    Double3 world[3];
    for (size_t i = 0; i < 3; ++i)
    {
        world[i] = transform.point(Double3(corners[i]));
        const std::array<double, 5> distances = camera.distances(world[i]);
        for (size_t plane = 0; plane < 5; ++plane)
            nearest[plane] = std::max(nearest[plane], distances[plane]);
    }
    if (*std::min_element(nearest.begin(), nearest.end()) < 0)
        return false;
    if (double_sided)
        return true;
    const Double3 normal = cross(world[1] - world[0], world[2] - world[0]);
    const double facing = dot(normal, camera.eye - world[0]) * (transform.determinant() < 0 ? -1.0 : 1.0);
    return facing > 0;
}

} // namespace

uint64_t countUnjustlyCulled(const PackGeometry& geometry, const OracleView& oracle,
                             std::span<const DrawnCluster> drawn)
{
    const PackView& view = geometry.view();
    const OracleCamera camera(oracle);
    uint64_t unjust = 0;
    for (uint32_t i = 0; i < view.instances().size(); ++i)
    {
        const DoubleAffine transform(view.instances()[i].world_from_object);
        const Range clusters = view.meshes()[view.instances()[i].mesh].clusters;
        for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
        {
            if (contains(drawn, {i, c}) || judgeCluster(view, oracle, {i, c}).in_cut != Answer::yes)
                continue;
            const bool double_sided = isDoubleSided(view.materials(), view.clusters()[c].material);
            const auto triangles = geometry.triangles(c);
            unjust += std::any_of(triangles.begin(), triangles.end(),
                                  [&](const auto& corners)
                                  { return couldBeSeen(camera, transform, corners, double_sided); });
        }
    }
    return unjust;
}

double largestStretch(const Affine3& affine)
{
    // Power iteration on M^T M, started from the three axes; the largest eigenvalue wins.
    const DoubleAffine m(affine);
    const Double3 columns[3] = {{m.row[0].x, m.row[1].x, m.row[2].x},
                                {m.row[0].y, m.row[1].y, m.row[2].y},
                                {m.row[0].z, m.row[1].z, m.row[2].z}};
    double largest = 0;
    for (const Double3 start : {Double3{1, 0.1, 0.01}, Double3{0.01, 1, 0.1}, Double3{0.1, 0.01, 1}})
    {
        Double3 v = normalize(start);
        for (int step = 0; step < 2000; ++step)
        {
            const Double3 w = m.vector(v);
            const Double3 next{dot(columns[0], w), dot(columns[1], w), dot(columns[2], w)};
            if (length(next) == 0)
                break;
            v = normalize(next);
        }
        largest = std::max(largest, length(m.vector(v)));
    }
    return largest;
}

} // namespace hearth::reference
