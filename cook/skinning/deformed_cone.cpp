// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/deformed_cone.h"

#include "cook/skinning/middle_pose.h"
#include "formats/base/rounding.h"
#include "formats/codecs/vertex_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hearth::skinning
{

namespace
{

// Margins as for static clusters: the rasteriser snaps corners to 1/256 pixel, which can turn thin triangles
// that are edge-on to the viewer; cones wider than about 84 degrees cull next to nothing.
constexpr double kConeMargin = 1e-3;
constexpr double kMinConeCosine = 0.1;

/// Triangle in the space of the main bone: a middle pose, and the maximum deviation of all poses.
struct DeformedTriangle
{
    Double3 corner;      ///< in the middle pose
    double corner_slack; ///< maximum distance of the corner from there
    Double3 normal;      ///< unit, in the middle pose
    double turn;         ///< maximum rotation of the normal, radians
};

/// Compute the triangle's bounds; nothing if it can face in any direction.
std::optional<DeformedTriangle> boundTriangle(const MiddlePose& pose, const uint32_t (&corners)[3])
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

/// Return the code of the unit vector along the sum of the normals.
std::optional<uint16_t> coneAxisCode(std::span<const DeformedTriangle> triangles)
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

/// Return the largest value of v * n over normals n of the triangle.
double maxAlong(const DeformedTriangle& triangle, Double3 v)
{
    const double angle = angleBetween(v, triangle.normal);
    return length(v) * std::cos(std::max(0.0, angle - triangle.turn));
}

} // namespace

StoredCone computeCone(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                       std::span<const MorphedVertex> vertices, Float3 middle)
{
    StoredCone none;
    if (deformation.skin != nullptr && deformation.skin->canMirror(main))
        return none;
    const std::optional<MiddlePose> pose = MiddlePose::in(main, cluster, deformation, vertices);
    if (!pose)
        return none;
    std::vector<DeformedTriangle> triangles;
    for (size_t i = 0; i < cluster.indices.size(); i += 3)
    {
        const auto triangle =
            boundTriangle(*pose, {cluster.indices[i], cluster.indices[i + 1], cluster.indices[i + 2]});
        if (!triangle)
            return none;
        triangles.push_back(*triangle);
    }
    const std::optional<uint16_t> code = coneAxisCode(triangles);
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
        back = std::max(back, (maxAlong(triangle, away) + triangle.corner_slack) / std::cos(angle));
    }
    // margin for the runtime's single precision
    const double magnitude = length(widen(middle)) + reach + back;
    const double cutoff = std::ceil((std::sin(widest) + kConeMargin) * 65536);
    if (!(cutoff < formats::kNoCone))
        return none;
    return {*code, static_cast<uint16_t>(cutoff),
            roundUp(back + 1e-5 * (reach + back) + magnitude * 2e-6 / std::cos(widest))};
}

} // namespace hearth::skinning
