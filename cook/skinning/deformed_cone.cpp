// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/deformed_cone.h"

#include "cook/skinning/rounding.h"
#include "formats/vertex_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hearth::skinning
{

namespace
{

// As static clusters have them: the rasteriser snaps corners to 1/256 pixel, which can turn slivers that are seen
// edge-on; and cones wider than about 84 degrees cull next to nothing.
constexpr double kConeMargin = 1e-3;
constexpr double kMinConeCosine = 0.1;

/// A triangle in the main bone: a middle pose, and how far all poses are from it.
struct DeformedTriangle
{
    Double3 corner;      ///< in the middle pose
    double corner_slack; ///< how far the corner comes from there
    Double3 normal;      ///< unit, in the middle pose
    double turn;         ///< radians: how far the normal turns at most
};

/// The middle pose of a cluster and what is left of its motion.
class MiddlePose
{
public:
    MiddlePose(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
               std::span<const MorphedVertex> vertices)
        : cluster_(cluster), vertices_(vertices)
    {
        for (size_t v = 0; v < vertices.size(); ++v)
        {
            const Double3 bound = vertices[v].middle;
            Double3 place = deformation.skin == nullptr ? bound : bound * weightOf(cluster, v, main);
            double slack = length(vertices[v].half);
            double stretch = deformation.skin == nullptr ? 1.0 : weightOf(cluster, v, main);
            for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
            {
                const double weight = cluster.weights[i];
                if (!(weight > 0) || cluster.joints[i] == main)
                    continue;
                const motion::JointMotion& motion = *deformation.skin->relative(main, cluster.joints[i]);
                place = place + transformPoint(motion.ball().center, bound) * weight;
                stretch += weight * motion.set().norm;
                add(cluster.joints[i], motion.ball());
            }
            places_.push_back(place);
            morph_slack_.push_back(slack * stretch);
        }
    }

    Double3 place(size_t vertex) const { return places_[vertex]; }

    /// How far at most a vertex comes from its place.
    double slack(size_t vertex) const
    {
        double slack = morph_slack_[vertex];
        for (const Part& part : parts_)
            slack += weightOf(cluster_, vertex, part.joint) * part.ball->slackAt(vertices_[vertex].middle);
        return slack;
    }

    /// How far at most the edge between two vertices comes from that between their places: what both do alike does not
    /// count.
    double edgeSlack(size_t a, size_t b) const
    {
        double slack = morph_slack_[a] + morph_slack_[b];
        for (const Part& part : parts_)
        {
            const double weight_a = weightOf(cluster_, a, part.joint);
            const double weight_b = weightOf(cluster_, b, part.joint);
            const Double3 arm = (vertices_[a].middle - part.ball->pivot) * weight_a -
                                (vertices_[b].middle - part.ball->pivot) * weight_b;
            slack += part.ball->linear_slack * length(arm) +
                     part.ball->point_slack * std::abs(weight_a - weight_b);
        }
        return slack;
    }

private:
    struct Part
    {
        uint32_t joint;
        const motion::MatrixBall* ball;
    };

    void add(uint32_t joint, const motion::MatrixBall& ball)
    {
        if (std::none_of(parts_.begin(), parts_.end(), [&](const Part& p) { return p.joint == joint; }))
            parts_.push_back({joint, &ball});
    }

    const DeformedCluster& cluster_;
    std::span<const MorphedVertex> vertices_;
    std::vector<Part> parts_;
    std::vector<Double3> places_;
    std::vector<double> morph_slack_;
};

/// Nothing where the triangle can face anywhere.
std::optional<DeformedTriangle> triangleOf(const MiddlePose& pose, const uint32_t (&corners)[3])
{
    const Double3 a = pose.place(corners[0]);
    const Double3 ab = pose.place(corners[1]) - a, ac = pose.place(corners[2]) - a;
    const Double3 normal = cross(ab, ac);
    const double area2 = length(normal);
    const double ab_slack = pose.edgeSlack(corners[0], corners[1]);
    const double ac_slack = pose.edgeSlack(corners[0], corners[2]);
    const double normal_slack = length(ab) * ac_slack + length(ac) * ab_slack + ab_slack * ac_slack;
    if (!(area2 > 0) || !(normal_slack < area2))
        return std::nullopt;
    return DeformedTriangle{a, pose.slack(corners[0]), normal * (1 / area2), std::asin(normal_slack / area2)};
}

/// The unit vector along the sum of the normals, as it is stored.
std::optional<uint16_t> axisOf(std::span<const DeformedTriangle> triangles)
{
    Double3 sum;
    for (const DeformedTriangle& triangle : triangles)
        sum = sum + triangle.normal;
    if (!(length(sum) > 1e-4))
        return std::nullopt;
    return static_cast<uint16_t>(formats::NormalCode<8>::encode(narrow(sum * (1 / length(sum)))));
}

double angleBetween(Double3 a, Double3 b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// The largest value of v * n over normals n of the triangle.
double mostAlong(const DeformedTriangle& triangle, Double3 v)
{
    const double angle = angleBetween(v, triangle.normal);
    return length(v) * std::cos(std::max(0.0, angle - triangle.turn));
}

} // namespace

double weightOf(const DeformedCluster& cluster, size_t vertex, uint32_t joint)
{
    double weight = 0;
    for (size_t i = vertex * cluster.influences; i < (vertex + 1) * cluster.influences; ++i)
        if (cluster.joints[i] == joint)
            weight += cluster.weights[i];
    return weight;
}

StoredCone coneIn(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                  std::span<const MorphedVertex> vertices, Float3 middle)
{
    StoredCone none;
    if (deformation.skin != nullptr && deformation.skin->canMirror(main))
        return none;
    const MiddlePose pose(main, cluster, deformation, vertices);
    std::vector<DeformedTriangle> triangles;
    for (size_t i = 0; i < cluster.indices.size(); i += 3)
    {
        const auto triangle =
            triangleOf(pose, {cluster.indices[i], cluster.indices[i + 1], cluster.indices[i + 2]});
        if (!triangle)
            return none;
        triangles.push_back(*triangle);
    }
    const std::optional<uint16_t> code = axisOf(triangles);
    if (!code)
        return none;
    Double3 axis = widen(formats::NormalCode<8>::decode(*code));
    axis = axis * (1 / length(axis));
    double widest = 0, reach = 0, back = 0;
    for (const DeformedTriangle& triangle : triangles)
    {
        const double angle = angleBetween(axis, triangle.normal) + triangle.turn;
        if (!(std::cos(angle) > kMinConeCosine) || angle > 2)
            return none;
        widest = std::max(widest, angle);
        const Double3 away = widen(middle) - triangle.corner;
        reach = std::max(reach, length(away) + triangle.corner_slack);
        back = std::max(back, (mostAlong(triangle, away) + triangle.corner_slack) / std::cos(angle));
    }
    // room for the runtime's arithmetic
    const double magnitude = length(widen(middle)) + reach + back;
    const double cutoff = std::ceil((std::sin(widest) + kConeMargin) * 65536);
    if (!(cutoff < formats::kNoCone))
        return none;
    return {*code, static_cast<uint16_t>(cutoff),
            roundUp(back + 1e-5 * (reach + back) + magnitude * 2e-6 / std::cos(widest))};
}

} // namespace hearth::skinning
