// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cpu_rasteriser.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::reference
{

using namespace formats;

namespace
{

constexpr double kSubpixel = 256; ///< vertices lie on a grid of 1/256 pixel
constexpr double kEdgeBand = 1.0 / 256;
constexpr double kDepthBand = 1e-5; ///< relative

/// A vertex in screen space. Pixel centres are at whole numbers: 0.5 is subtracted before snapping.
struct ScreenVertex
{
    double x, y;    ///< before snapping, converted from float
    int64_t fx, fy; ///< snapped, in 1/256 pixel
    double depth;
};

struct ScreenTriangle
{
    ScreenVertex v[3];
    uint32_t id;
    bool only_excuses; ///< masked: its pixels cannot be predicted
};

// Planes of the clip volume as (x, y, z, w) factors: a point is inside if the sum is >= 0.
constexpr std::array<Float4, 5> kClipPlanes{Float4{1, 0, 0, 1}, Float4{-1, 0, 0, 1}, Float4{0, 1, 0, 1},
                                            Float4{0, -1, 0, 1}, Float4{0, 0, -1, 1}};

float planeDistance(const Float4& plane, const Float4& p)
{
    return plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w * p.w;
}

/// Mask of the planes by which a vertex must be clipped. The sides have a guard band of twice the width.
uint32_t clipMask(const Float4& p)
{
    uint32_t mask = 0;
    for (size_t i = 0; i < kClipPlanes.size(); ++i)
    {
        Float4 plane = kClipPlanes[i];
        if (i < 4)
            plane = {plane.x * 0.5f, plane.y * 0.5f, plane.z, plane.w};
        if (planeDistance(plane, p) < 0)
            mask |= 1u << i;
    }
    return mask;
}

Float4 interpolate(const Float4& a, const Float4& b, float t)
{
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.w + t * (b.w - a.w)};
}

/// Clip a polygon plane by plane (Sutherland and Hodgman).
std::vector<Float4> clipPolygon(std::vector<Float4> polygon, uint32_t planes)
{
    for (size_t i = 0; i < kClipPlanes.size(); ++i)
    {
        if (!(planes >> i & 1u))
            continue;
        std::vector<Float4> kept;
        for (size_t v = 0; v < polygon.size(); ++v)
        {
            const Float4& a = polygon[v];
            const Float4& b = polygon[(v + 1) % polygon.size()];
            const float da = planeDistance(kClipPlanes[i], a), db = planeDistance(kClipPlanes[i], b);
            if (da >= 0)
                kept.push_back(a);
            if ((da >= 0) != (db >= 0))
                kept.push_back(da < 0 ? interpolate(a, b, da / (da - db))
                                      : interpolate(b, a, db / (db - da)));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

ScreenVertex toScreen(const Float4& clip, float width, float height)
{
    const float over_w = 1.0f / clip.w;
    const float x = std::fma(clip.x * over_w, width * 0.5f, width * 0.5f) - 0.5f;
    const float y = std::fma(clip.y * over_w, height * 0.5f, height * 0.5f) - 0.5f;
    return {double{x}, double{y}, std::llrint(double{x} * kSubpixel), std::llrint(double{y} * kSubpixel),
            double{clip.z * over_w}};
}

/// Twice the signed area in (1/256 pixel)^2; positive if the corners are clockwise on the screen (y down).
int64_t doubleArea(const ScreenTriangle& t)
{
    return (t.v[1].fx - t.v[0].fx) * (t.v[2].fy - t.v[0].fy) -
           (t.v[2].fx - t.v[0].fx) * (t.v[1].fy - t.v[0].fy);
}

struct DepthPlane
{
    double at_origin, per_x, per_y;

    /// Compute the plane of depth. Returns false if the triangle is too thin to have one.
    static bool of(const ScreenTriangle& t, DepthPlane& plane)
    {
        const double x1 = t.v[1].x - t.v[0].x, y1 = t.v[1].y - t.v[0].y, d1 = t.v[1].depth - t.v[0].depth;
        const double x2 = t.v[2].x - t.v[0].x, y2 = t.v[2].y - t.v[0].y, d2 = t.v[2].depth - t.v[0].depth;
        const double area = x1 * y2 - x2 * y1;
        if (area == 0)
            return false;
        plane.per_x = (d1 * y2 - d2 * y1) / area;
        plane.per_y = (d2 * x1 - d1 * x2) / area;
        plane.at_origin = t.v[0].depth - plane.per_x * t.v[0].x - plane.per_y * t.v[0].y;
        return true;
    }

    double at(int64_t x, int64_t y) const
    {
        return at_origin + per_x * static_cast<double>(x) + per_y * static_cast<double>(y);
    }
};

/// True if the sample at pixel (x, y) is inside; exact. A sample on an edge counts if the edge is a top or
/// left edge.
bool covers(const ScreenTriangle& t, int64_t x, int64_t y)
{
    const int64_t px = x * 256, py = y * 256;
    for (int i = 0; i < 3; ++i)
    {
        const ScreenVertex& a = t.v[i];
        const ScreenVertex& b = t.v[(i + 1) % 3];
        const int64_t dx = b.fx - a.fx, dy = b.fy - a.fy;
        const int64_t side = dx * (py - a.fy) - dy * (px - a.fx);
        const bool top_or_left = (dy == 0 && dx > 0) || dy < 0;
        if (side < 0 || (side == 0 && !top_or_left))
            return false;
    }
    return true;
}

/// Distance in pixels from the sample to the nearest point of the triangle's outline.
double outlineDistance(const ScreenTriangle& t, int64_t x, int64_t y)
{
    double nearest = 1e30;
    for (int i = 0; i < 3; ++i)
    {
        const double ax = static_cast<double>(t.v[i].fx) / kSubpixel,
                     ay = static_cast<double>(t.v[i].fy) / kSubpixel;
        const double ex = static_cast<double>(t.v[(i + 1) % 3].fx) / kSubpixel - ax;
        const double ey = static_cast<double>(t.v[(i + 1) % 3].fy) / kSubpixel - ay;
        const double px = static_cast<double>(x) - ax, py = static_cast<double>(y) - ay;
        const double length2 = ex * ex + ey * ey;
        const double along = length2 > 0 ? std::clamp((px * ex + py * ey) / length2, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, std::hypot(px - along * ex, py - along * ey));
    }
    return nearest;
}

/// Depth of the triangle at the sample or at the point next to it, never beyond the depths of the corners.
double clampedDepth(const ScreenTriangle& t, const DepthPlane& plane, int64_t x, int64_t y)
{
    const auto [least, greatest] = std::minmax({t.v[0].depth, t.v[1].depth, t.v[2].depth});
    return std::clamp(plane.at(x, y), least, greatest);
}

/// A masked triangle at a pixel.
struct MaskedFragment
{
    double depth;
    uint32_t id;
};

class Canvas
{
public:
    Canvas(uint32_t width, uint32_t height)
        : width_(width),
          height_(height),
          nearest_(size_t{width} * height, 0.0),
          second_(nearest_),
          ids_(nearest_.size(), kNothing),
          excused_(nearest_.size(), 0)
    {
    }

    template <typename Visit>
    void forPixels(const ScreenTriangle& t, const Visit& visit) const
    {
        const auto [left, right] = std::minmax({t.v[0].fx, t.v[1].fx, t.v[2].fx});
        const auto [top, bottom] = std::minmax({t.v[0].fy, t.v[1].fy, t.v[2].fy});
        const auto pixel = [](int64_t fixed) { return fixed >> 8; };
        for (int64_t y = std::max<int64_t>(0, pixel(top) - 1);
             y <= std::min<int64_t>(height_ - 1, pixel(bottom) + 1); ++y)
            for (int64_t x = std::max<int64_t>(0, pixel(left) - 1);
                 x <= std::min<int64_t>(width_ - 1, pixel(right) + 1); ++x)
                visit(x, y, static_cast<size_t>(y) * width_ + static_cast<size_t>(x));
    }

    void draw(const ScreenTriangle& t, const DepthPlane& plane)
    {
        forPixels(t,
                  [&](int64_t x, int64_t y, size_t pixel)
                  {
                      if (!covers(t, x, y))
                          return;
                      const double depth = plane.at(x, y);
                      if (t.only_excuses)
                      {
                          masked_[pixel].push_back({depth, t.id});
                          return;
                      }
                      if (depth > nearest_[pixel])
                      {
                          second_[pixel] = nearest_[pixel];
                          nearest_[pixel] = depth;
                          ids_[pixel] = t.id;
                      }
                      else
                          second_[pixel] = std::max(second_[pixel], depth);
                  });
    }

    /// Excuse, after all triangles are drawn, the pixels beside an edge of a triangle that is, or would be,
    /// the nearest there.
    void excuseEdges(const ScreenTriangle& t, const DepthPlane& plane)
    {
        forPixels(t,
                  [&](int64_t x, int64_t y, size_t pixel)
                  {
                      if (outlineDistance(t, x, y) <= kEdgeBand &&
                          clampedDepth(t, plane, x, y) >= nearest_[pixel] * (1 - kDepthBand))
                          excused_[pixel] |= kExcuseEdge;
                  });
    }

    RasterImage finish()
    {
        RasterImage image{width_, height_, std::move(ids_), {}, std::move(excused_), {}};
        image.depths.reserve(nearest_.size());
        for (size_t i = 0; i < nearest_.size(); ++i)
        {
            image.depths.push_back(static_cast<float>(nearest_[i]));
            if (nearest_[i] > 0 && second_[i] >= nearest_[i] * (1 - kDepthBand))
                image.excused[i] |= kExcuseTie;
        }
        for (const auto& [pixel, fragments] : masked_)
            for (const MaskedFragment& fragment : fragments)
                if (fragment.depth >= nearest_[pixel] * (1 - kDepthBand))
                {
                    image.excused[pixel] |= kExcuseMask;
                    image.masked_ids[pixel].push_back(fragment.id);
                }
        return image;
    }

private:
    uint32_t width_, height_;
    std::vector<double> nearest_, second_;
    std::map<size_t, std::vector<MaskedFragment>> masked_;
    std::vector<uint32_t> ids_;
    std::vector<uint8_t> excused_;
};

/// Clip, project and orient a triangle. Appends nothing for a triangle that is not drawn, several for one
/// that was clipped.
void appendScreenTriangles(const SceneTriangle& triangle, const SceneTables& scene,
                           const shared::FrameView& frame, std::vector<ScreenTriangle>& out)
{
    const InstanceRecord& instance = scene.instances[triangle.instance];
    const auto shared_instance = std::bit_cast<shared::Instance>(instance);
    std::vector<Float4> polygon;
    uint32_t any = 0, all = ~0u;
    for (const Float3& corner : triangle.corners)
    {
        polygon.push_back(
            shared::clipPosition(frame, shared::toEyeRelative(shared_instance, frame.eye, corner)));
        any |= clipMask(polygon.back());
        all &= clipMask(polygon.back());
    }
    if (all != 0)
        return;
    if (any != 0)
        polygon = clipPolygon(std::move(polygon), any);

    const bool double_sided = isDoubleSided(scene.materials, triangle.material);
    const bool masked = triangle.material != kInvalidIndex && scene.materials[triangle.material].alpha_mode !=
                                                                  static_cast<uint32_t>(AlphaMode::opaque);
    const bool mirrored = (instance.flags & kInstanceMirrored) != 0;
    for (size_t i = 2; i < polygon.size(); ++i)
    {
        ScreenTriangle t{{toScreen(polygon[0], frame.width, frame.height),
                          toScreen(polygon[i - 1], frame.width, frame.height),
                          toScreen(polygon[i], frame.width, frame.height)},
                         triangle.id,
                         masked};
        const int64_t area = doubleArea(t);
        const bool front = (area < 0) != mirrored; // counter-clockwise as seen by the viewer
        if (area == 0 || (!front && !double_sided))
            continue;
        if (area < 0)
            std::swap(t.v[1], t.v[2]);
        out.push_back(t);
    }
}

} // namespace

RasterImage rasterise(std::span<const SceneTriangle> triangles, const SceneTables& scene,
                      const shared::FrameView& frame)
{
    std::vector<ScreenTriangle> on_screen;
    for (const SceneTriangle& triangle : triangles)
        appendScreenTriangles(triangle, scene, frame, on_screen);
    Canvas canvas(static_cast<uint32_t>(frame.width), static_cast<uint32_t>(frame.height));
    DepthPlane plane;
    for (const ScreenTriangle& t : on_screen)
        if (DepthPlane::of(t, plane))
            canvas.draw(t, plane);
    for (const ScreenTriangle& t : on_screen)
        if (DepthPlane::of(t, plane))
            canvas.excuseEdges(t, plane);
    return canvas.finish();
}

bool sameTriangle(const SceneTriangle& a, const SceneTriangle& b)
{
    if (a.instance != b.instance || a.material != b.material)
        return false;
    for (size_t turn = 0; turn < 3; ++turn)
        if (a.corners[0] == b.corners[turn] && a.corners[1] == b.corners[(turn + 1) % 3] &&
            a.corners[2] == b.corners[(turn + 2) % 3])
            return true;
    return false;
}

} // namespace hearth::reference
