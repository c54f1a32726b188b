// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_faces.h"

#include "formats/base/double3.h"

#include <algorithm>
#include <array>

namespace hearth::shared
{

namespace
{

/// Margin above which all faces count as shown: that of a coarse cut moves points far.
constexpr double kMaxMargin = 0.1;

/// Pyramid with four sides.
struct Pyramid
{
    Double3 apex;                 ///< relative to the eye
    std::array<Double3, 4> edges; ///< from the apex
};

/// Return the tangent of the angle by which the view is wider than its image: what is moved by the error of
/// its cluster, and the points between the centres of the outermost pixels and the edge.
double findMargin(const FrameView& view)
{
    float factor = 1;
    for (const Float4& segment : view.lod_curve)
        factor = std::min({factor, segment.y, segment.z});
    constexpr double kMinFactor = 1e-3;
    constexpr double kPixels = 2;
    const double error_pixels = double{std::max(view.threshold, 0.0f)} / std::max(double{factor}, kMinFactor);
    return (error_pixels + kPixels) / double{view.lod_scale};
}

Pyramid makeFace(const FrameView& view, const ShadowLight& face, float range, double margin)
{
    const Double3 along = widen(face.direction);
    const Double3 right = widen(face.right);
    const Double3 down = widen(face.down);
    const Double3 apex = widen(face.origin) - widen(view.eye);
    // edges as long as the pyramid reaches, for points that are moved; of any length if it has no end
    const double reach = range > 0 ? double{range} + margin * (length(apex) + double{range}) : 1;
    return {apex,
            {(along + right + down) * reach, (along - right + down) * reach, (along + right - down) * reach,
             (along - right - down) * reach}};
}

/// Return the planes of the view through the eye, as unit normals to the inside: its sides, and the plane
/// across its direction.
std::array<Double3, 5> makeViewPlanes(const FrameView& view)
{
    const Double3 x = widen(row3(view.clip_x));
    const Double3 y = widen(row3(view.clip_y));
    const Double3 w = widen(row3(view.clip_w));
    std::array<Double3, 5> planes{w + x, w - x, w + y, w - y, w};
    for (Double3& plane : planes)
        plane = plane * (1 / length(plane));
    return planes;
}

/// True if all of a pyramid, or the ball around its apex, lies behind a plane through the eye, and as far
/// from it as the margin asks for, which grows with the distance from the eye. A pyramid does if its corners
/// do.
bool isBehind(const Pyramid& pyramid, float range, Double3 plane, double margin)
{
    const auto reach = [&](Double3 p) { return dot(plane, p) + margin * length(p); };
    const double end = double{range} * (1 + 2 * margin) + margin * length(pyramid.apex);
    if (range > 0 && reach(pyramid.apex) + end < 0)
        return true;
    return reach(pyramid.apex) < 0 &&
           std::all_of(pyramid.edges.begin(), pyramid.edges.end(),
                       [&](Double3 edge) { return reach(range > 0 ? pyramid.apex + edge : edge) < 0; });
}

/// True if all that the view shows lies behind a plane.
/// plane  normal to the inside, unit
/// apex   a point of the plane, relative to the eye
bool isViewBehind(const std::array<Double3, 4>& rays, Double3 plane, Double3 apex, double margin)
{
    return dot(plane, apex) > 0 &&
           std::all_of(rays.begin(), rays.end(),
                       [&](Double3 ray) { return dot(plane, ray) + margin * length(ray) < 0; });
}

/// Return the rays through the corners of the view.
/// planes  makeViewPlanes
std::array<Double3, 4> makeCornerRays(const std::array<Double3, 5>& planes)
{
    std::array<Double3, 4> rays;
    for (size_t corner = 0; corner < rays.size(); ++corner)
    {
        const Double3 ray = cross(planes[corner % 2], planes[2 + corner / 2]);
        rays[corner] = dot(ray, planes[4]) < 0 ? ray * -1.0 : ray;
    }
    return rays;
}

} // namespace

bool mayShowFace(const FrameView& view, const ShadowLight& face, float range)
{
    const double margin = findMargin(view);
    // the tests below are of planes through the eye
    if (margin > kMaxMargin || isOrthographic(view))
        return true;
    const Pyramid pyramid = makeFace(view, face, range, margin);
    const std::array<Double3, 5> planes = makeViewPlanes(view);
    for (const Double3& plane : planes)
        if (isBehind(pyramid, range, plane, margin))
            return false;
    const std::array<Double3, 4> rays = makeCornerRays(planes);
    const Double3 along = widen(face.direction);
    constexpr double kHalfRoot = 0.70710678118654752;
    for (const Double3& side :
         {widen(face.right), widen(face.right) * -1.0, widen(face.down), widen(face.down) * -1.0})
        if (isViewBehind(rays, (along + side) * kHalfRoot, pyramid.apex, margin))
            return false;
    return true;
}

} // namespace hearth::shared
