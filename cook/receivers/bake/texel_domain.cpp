// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/texel_domain.h"

#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>

namespace hearth::receivers
{

namespace
{

/// Barycentric weight by which a point must be inside a triangle to count for the overlap: neighbours share
/// their edges.
constexpr double kInside = 1e-4;

/// Point in texels.
struct Point
{
    double x, y;
};

Point operator-(Point a, Point b)
{
    return {a.x - b.x, a.y - b.y};
}

double dot(Point a, Point b)
{
    return a.x * b.x + a.y * b.y;
}

double cross(Point a, Point b)
{
    return a.x * b.y - a.y * b.x;
}

/// Triangle in texels, with an area other than 0.
struct FlatTriangle
{
    std::array<Point, 3> corners;
    double double_area; ///< negative if the corners run clockwise

    /// True if the triangle and the texel at x, y have an area in common: no edge of one separates them.
    /// Both are convex, so the separating axis theorem holds.
    bool touches(uint32_t x, uint32_t y) const
    {
        for (size_t i = 0; i < 3; ++i)
        {
            const Point from = corners[i], along = corners[(i + 1) % 3] - from;
            // the corner of the texel farthest on the inner side of the edge
            const double sign = double_area > 0 ? 1 : -1;
            const Point corner{x + (sign * along.y < 0 ? 1.0 : 0.0), y + (sign * along.x > 0 ? 1.0 : 0.0)};
            if (sign * cross(along, corner - from) <= 0)
                return false;
        }
        return true;
    }

    /// Return the weights of corners 1 and 2 at a point.
    Point weightsAt(Point p) const
    {
        const Point offset = p - corners[0];
        return {cross(offset, corners[2] - corners[0]) / double_area,
                cross(corners[1] - corners[0], offset) / double_area};
    }
};

/// Point of a triangle near a place in a texel.
struct NearestPoint
{
    double distance2 = std::numeric_limits<double>::infinity(); ///< texels, squared
    SurfacePoint point;
    uint32_t covering = 0; ///< triangles that have the place inside, up to 2

    /// Compare with the point of another triangle. Of equal ones the first stays.
    void consider(const FlatTriangle& triangle, uint32_t number, Point place)
    {
        const Point weights = triangle.weightsAt(place);
        const double smallest = std::min({weights.x, weights.y, 1 - weights.x - weights.y});
        if (smallest >= kInside)
            covering = std::min(covering + 1, 2u);
        if (smallest >= 0)
        {
            accept(0, number, weights);
            return;
        }
        for (size_t i = 0; i < 3; ++i)
        {
            const Point from = triangle.corners[i], along = triangle.corners[(i + 1) % 3] - from;
            const double way = std::clamp(dot(place - from, along) / dot(along, along), 0.0, 1.0);
            const Point nearest{from.x + along.x * way, from.y + along.y * way};
            const Point offset = nearest - place;
            std::array<double, 3> at{};
            at[i] = 1 - way;
            at[(i + 1) % 3] = way;
            accept(dot(offset, offset), number, {at[1], at[2]});
        }
    }

private:
    void accept(double found2, uint32_t number, Point weights)
    {
        if (!(found2 < distance2))
            return;
        distance2 = found2;
        point = {number, {static_cast<float>(weights.x), static_cast<float>(weights.y)}};
    }
};

/// Strata of a texel, and its centre.
using TexelPlaces = std::array<NearestPoint, kTexelPoints + 1>;

std::array<Point, kTexelPoints + 1> placesIn(uint32_t x, uint32_t y)
{
    std::array<Point, kTexelPoints + 1> places{};
    const std::array<Float2, kTexelPoints> strata = texelStrata();
    for (size_t i = 0; i < strata.size(); ++i)
        places[i] = {x + double{strata[i].x}, y + double{strata[i].y}};
    places[kTexelPoints] = {x + 0.5, y + 0.5};
    return places;
}

/// Texels of a rectangle that triangles have touched so far.
class Raster
{
public:
    Raster(uint32_t width, uint32_t height)
        : width_(width), height_(height), slots_(size_t{width} * height, kInvalidIndex)
    {
    }

    void add(const Triangle& triangle, uint32_t number)
    {
        FlatTriangle flat{};
        Point low{1e9, 1e9}, high{-1e9, -1e9};
        for (size_t i = 0; i < 3; ++i)
        {
            const Float2 uv = triangle.uvs[i];
            const Point corner{std::clamp(double{uv.x}, 0.0, 1.0) * width_,
                               std::clamp(double{uv.y}, 0.0, 1.0) * height_};
            flat.corners[i] = corner;
            low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
            high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
        }
        flat.double_area = cross(flat.corners[1] - flat.corners[0], flat.corners[2] - flat.corners[0]);
        if (flat.double_area == 0)
            return;
        const auto end_x = std::min(static_cast<uint32_t>(high.x) + 1, width_);
        const auto end_y = std::min(static_cast<uint32_t>(high.y) + 1, height_);
        for (auto y = static_cast<uint32_t>(low.y); y < end_y; ++y)
            for (auto x = static_cast<uint32_t>(low.x); x < end_x; ++x)
                if (flat.touches(x, y))
                    addTo(x, y, flat, number);
    }

    /// Return the domain; points stay off edges by `margin` metres.
    TexelDomain finish(std::span<const Triangle> triangles, uint32_t first_triangle, float margin) const
    {
        TexelDomain domain{width_, height_, {}, 0};
        uint64_t covered = 0, several = 0;
        for (uint32_t y = 0; y < height_; ++y)
            for (uint32_t x = 0; x < width_; ++x)
            {
                const uint32_t slot = slots_[size_t{y} * width_ + x];
                if (slot == kInvalidIndex)
                    continue;
                const auto finished = [&](const SurfacePoint& point)
                {
                    const Triangle& triangle = triangles[point.triangle - first_triangle];
                    return SurfacePoint{point.triangle, insetPoint(triangle, point.weights, margin)};
                };
                DomainTexel texel{static_cast<uint16_t>(x), static_cast<uint16_t>(y), {}, {}};
                for (size_t i = 0; i < kTexelPoints; ++i)
                {
                    texel.points[i] = finished(places_[slot][i].point);
                    covered += places_[slot][i].covering > 0 ? 1u : 0u;
                    several += places_[slot][i].covering > 1 ? 1u : 0u;
                }
                texel.middle = finished(places_[slot][kTexelPoints].point);
                domain.texels.push_back(texel);
            }
        if (covered > 0)
            domain.overlap = static_cast<double>(several) / static_cast<double>(covered);
        return domain;
    }

private:
    void addTo(uint32_t x, uint32_t y, const FlatTriangle& flat, uint32_t number)
    {
        uint32_t& slot = slots_[size_t{y} * width_ + x];
        if (slot == kInvalidIndex)
        {
            slot = static_cast<uint32_t>(places_.size());
            places_.emplace_back();
        }
        const auto places = placesIn(x, y);
        for (size_t i = 0; i < places.size(); ++i)
            places_[slot][i].consider(flat, number, places[i]);
    }

    uint32_t width_, height_;
    std::vector<uint32_t> slots_; ///< of each texel: index in places_
    std::vector<TexelPlaces> places_;
};

} // namespace

std::array<Float2, kTexelPoints> texelStrata()
{
    // a rotated grid: no two points share a row or a column
    return {Float2{0.375f, 0.125f}, {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}};
}

Float2 insetPoint(const Triangle& triangle, Float2 weights, float margin)
{
    const float area = length(crossEdges(triangle));
    std::array<float, 3> at{1 - weights.x - weights.y, weights.x, weights.y};
    for (size_t i = 0; i < 3; ++i)
    {
        const Float3 edge = triangle.corners[(i + 2) % 3] - triangle.corners[(i + 1) % 3];
        // the margin over the corner's height above its opposite edge
        const float height_share = area > 0 ? margin * length(edge) / area : 0.25f;
        at[i] = std::max(at[i], std::min(height_share, 0.25f));
    }
    const float sum = at[0] + at[1] + at[2];
    return {at[1] / sum, at[2] / sum};
}

TexelDomain rasterise(std::span<const Triangle> triangles, uint32_t first_triangle, uint32_t width,
                      uint32_t height, float margin)
{
    HEARTH_ASSERT(width > 0 && width <= 65535 && height > 0 && height <= 65535);
    Raster raster(width, height);
    for (size_t i = 0; i < triangles.size(); ++i)
        raster.add(triangles[i], first_triangle + static_cast<uint32_t>(i));
    return raster.finish(triangles, first_triangle, margin);
}

} // namespace hearth::receivers
