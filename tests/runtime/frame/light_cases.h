// Random views and lights of all sizes, and a slow test of a light at a point that shares nothing with the
// code under test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/light_lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace hearth::test
{

struct Vector
{
    double x = 0, y = 0, z = 0;
};
inline Vector operator-(Vector a, Vector b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dotProduct(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector widen3(Float3 v)
{
    return {v.x, v.y, v.z};
}

/// True if a point is lit: within the range, and within the cone of a spot.
inline bool isLit(const shared::Light& light, Vector point, double outer_cone_rad)
{
    const Vector offset = point - widen3(light.position);
    const double distance = std::sqrt(dotProduct(offset, offset));
    if (distance >= light.range)
        return false;
    if (light.type != shared::kLightSpot || distance == 0)
        return true;
    return dotProduct(offset, widen3(light.direction)) / distance > std::cos(outer_cone_rad);
}

struct LightCase
{
    shared::Light light;
    double outer_cone_rad;
};

class LightCases
{
public:
    explicit LightCases(uint32_t seed) : random_(seed) {}

    double uniform(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    double logUniform(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }

    Float3 direction()
    {
        const double z = uniform(-1, 1);
        const double angle = uniform(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
                static_cast<float>(z)};
    }

    /// View of 1 to 4096 pixels each way, perspective or orthographic, on or off centre.
    shared::LightGridView view()
    {
        shared::LightGridView view;
        view.eye = direction() * static_cast<float>(logUniform(0.1, 1000));
        view.forward = direction();
        view.right = normalizeOr(cross(view.forward, direction()), {1, 0, 0});
        view.down = cross(view.forward, view.right);
        view.width = static_cast<float>(std::floor(logUniform(1, 4097)));
        view.height = static_cast<float>(std::floor(logUniform(1, 4097)));
        view.is_orthographic = uniform(0, 1) < 0.25;
        const double half_height =
            view.is_orthographic ? logUniform(0.5, 200) : std::tan(0.5 * uniform(0.1, 2.6));
        view.pixels_per_v = static_cast<float>(0.5 * view.height / half_height);
        view.pixels_per_u = view.pixels_per_v * static_cast<float>(uniform(0, 1) < 0.2 ? 1.3 : 1);
        const bool off = uniform(0, 1) < 0.3;
        view.center_x = view.width * static_cast<float>(off ? uniform(-0.5, 1.5) : 0.5);
        view.center_y = view.height * static_cast<float>(off ? uniform(-0.5, 1.5) : 0.5);
        view.z_near = static_cast<float>(logUniform(0.001, 1));
        return view;
    }

    /// Depth and place in the image of a point, over all depths alike, now and then on the edge of a cell.
    /// The place is up to 1/64 of a pixel off.
    Vector point(const shared::LightGridView& view, const shared::LightGridLayout& layout, Float3& image)
    {
        const double depth = logUniform(view.z_near, 2e4);
        const shared::LightCascade& cascade =
            layout.cascades[shared::lightCascadeAt(static_cast<float>(depth))];
        const double cell = 1 / double{cascade.cells_per_pixel};
        const auto place = [&](float size)
        {
            const double anywhere = uniform(0, size);
            return uniform(0, 1) < 0.3 ? std::min(cell * std::round(anywhere / cell), double{size})
                                       : anywhere;
        };
        const double x = place(view.width);
        const double y = place(view.height);
        const auto near = [&](double place, float size)
        { return static_cast<float>(std::clamp(place + uniform(-1, 1) / 64, 0.0, double{size})); };
        image = {near(x, view.width), near(y, view.height), static_cast<float>(depth)};
        const double scale = view.is_orthographic ? 1 : depth;
        const double u = (x - view.center_x) / view.pixels_per_u * scale;
        const double v = (y - view.center_y) / view.pixels_per_v * scale;
        const auto along = [&](float right, float down, float forward, float eye)
        { return eye + u * right + v * down + depth * forward; };
        return {along(view.right.x, view.down.x, view.forward.x, view.eye.x),
                along(view.right.y, view.down.y, view.forward.y, view.eye.y),
                along(view.right.z, view.down.z, view.forward.z, view.eye.z)};
    }

    /// Light of 1 mm to 10 km that lights the point, now and then only just.
    LightCase light(Vector point)
    {
        LightCase made{};
        shared::Light& light = made.light;
        const double range = logUniform(0.001, 10000);
        const double share = uniform(0, 1) < 0.3 ? 1 - logUniform(1e-6, 0.1) : std::cbrt(uniform(0, 1));
        const Float3 to_light = direction();
        const double distance = range * share;
        light.position = {static_cast<float>(point.x + to_light.x * distance),
                          static_cast<float>(point.y + to_light.y * distance),
                          static_cast<float>(point.z + to_light.z * distance)};
        light.range = static_cast<float>(range);
        light.intensity = {1, 1, 1};
        light.type = uniform(0, 1) < 0.5 ? shared::kLightPoint : shared::kLightSpot;
        if (light.type == shared::kLightSpot)
        {
            made.outer_cone_rad =
                uniform(0, 1) < 0.1 ? 0.5 * std::numbers::pi : logUniform(0.5, 90) * std::numbers::pi / 180;
            const double inner = made.outer_cone_rad * uniform(0, 1);
            const auto cos_outer = static_cast<float>(std::cos(made.outer_cone_rad));
            light.cone_scale = 1 / std::max(0.001f, static_cast<float>(std::cos(inner)) - cos_outer);
            light.cone_offset = -cos_outer * light.cone_scale;
            // an axis within the half-angle of the direction to the point
            const Float3 across = normalizeOr(cross(to_light, direction()), {1, 0, 0});
            const double angle =
                made.outer_cone_rad * (uniform(0, 1) < 0.3 ? 1 - logUniform(1e-5, 0.1) : uniform(0, 1));
            light.direction = normalizeOr(to_light * -static_cast<float>(std::cos(angle)) +
                                              across * static_cast<float>(std::sin(angle)),
                                          {1, 0, 0});
        }
        return made;
    }

private:
    std::mt19937 random_;
};

/// Lists of a grid with room for everything.
struct ListMemory
{
    explicit ListMemory(size_t lights, size_t index_words = 1u << 20)
        : frame(lights), cells(shared::kMaxLightCells), indices(index_words)
    {
    }
    shared::LightListView view() { return {&counts, frame, cells, indices}; }

    /// Return the rows of the lights of a cell.
    std::vector<uint32_t> listLights(uint32_t cell) const
    {
        std::vector<uint32_t> rows;
        const uint32_t word = cells[cell];
        const bool all = shared::lightCellCount(word) == shared::kAllLights;
        const uint32_t count = all ? counts.ranged : shared::lightCellCount(word);
        for (uint32_t i = 0; i < count; ++i)
        {
            const uint32_t pair = indices[shared::lightCellOffset(word) + i / 2];
            const uint32_t place = all ? i : (i % 2 == 0 ? pair & 0xFFFFu : pair >> 16);
            rows.push_back(frame[counts.unranged + place]);
        }
        return rows;
    }

    shared::LightListCounts counts{};
    std::vector<uint32_t> frame, cells, indices;
};

/// Return the cell of a point by the functions that shaders call.
inline uint32_t cellAt(const shared::LightGridLayout& layout, Float3 image)
{
    return shared::lightCellAt(layout.cascades[shared::lightCascadeAt(image.z)], image.x, image.y, image.z);
}

} // namespace hearth::test
