// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/texels/street.h"

#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

namespace hearth::bench
{

namespace
{

using reference::Double3;

constexpr uint32_t kHouses = 12; ///< on each side
constexpr uint32_t kGrounds = 4; ///< one behind the other
constexpr uint32_t kCrates = 40;
constexpr double kHouse = 12;     ///< metres, the width and height of a front
constexpr double kHouseDepth = 8; ///< metres
constexpr double kLength = 160, kHalfWidth = 10;
constexpr double kGroundUnit = 10; ///< metres of ground that a texture covers
constexpr double kCrate = 1;       ///< metres
constexpr uint32_t kCell = 64;     ///< texels along a side of a repeated detail
constexpr uint32_t kQuads = 12;    ///< along a side of a panel

/// Walls of a house that the street sees.
std::vector<Panel> makeHouse(double side, double z, uint32_t texture)
{
    const double x = side * kHalfWidth;
    const Double3 up{0, kHouse, 0}, deep{side * kHouseDepth, 0, 0};
    const double deep_u = kHouseDepth / kHouse;
    return {{{x, 0, z}, {0, 0, -kHouse}, up, 1, 1, texture},
            {{x, 0, z}, deep, up, deep_u, 1, texture},
            {{x, 0, z - kHouse}, deep, up, deep_u, 1, texture}};
}

/// Box on the ground, turned about its height.
std::vector<Panel> makeCrate(Double3 middle, double turn, uint32_t texture)
{
    constexpr double kUv = 0.125; // as dense as a wall, nearly
    const Double3 a = Double3{std::cos(turn), 0, std::sin(turn)} * kCrate;
    const Double3 b = Double3{-std::sin(turn), 0, std::cos(turn)} * kCrate;
    const Double3 up{0, kCrate, 0};
    const Double3 corner = middle - (a + b) * 0.5;
    return {{corner, a, up, kUv, kUv, texture},
            {corner, b, up, kUv, kUv, texture},
            {corner + a, b, up, kUv, kUv, texture},
            {corner + b, a, up, kUv, kUv, texture},
            {corner + up, a, b, kUv, kUv, texture}};
}

samples::TriangleMesh makeMesh(const Panel& panel)
{
    samples::TriangleMesh mesh = samples::makeGrid(
        kQuads, kQuads,
        [&](Float2 at, Float3& position, Float2& uv)
        {
            const Double3 p = panel.corner + panel.across * double{at.x} + panel.up * double{at.y};
            position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
            uv = {at.x * static_cast<float>(panel.u), at.y * static_cast<float>(panel.v)};
        });
    const Double3 normal = normalize(cross(panel.across, panel.up));
    mesh.normals.assign(
        mesh.positions.size(),
        Float3{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)});
    return mesh;
}

/// Repeat a detail of noise, brighter or darker in each cell: so files are small, and no mip is flat.
samples::Image makeImage(uint32_t texture, uint32_t side)
{
    std::mt19937 random(texture + 1);
    std::vector<uint8_t> detail(size_t{kCell} * kCell * 3);
    for (uint8_t& value : detail)
        value = static_cast<uint8_t>(random() >> 24);
    const uint32_t cells = side / kCell;
    std::vector<uint32_t> brightness(size_t{cells} * cells);
    for (uint32_t& value : brightness)
        value = static_cast<uint32_t>(64 * (1 + random() % 4)); // few, by which rows repeat themselves
    samples::Image image{.name = textureName(texture), .width = side, .height = side, .texels = {}};
    image.texels.resize(size_t{side} * side * 4);
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x)
        {
            uint8_t* const texel = &image.texels[(size_t{y} * side + x) * 4];
            const uint8_t* const from = &detail[(size_t{y % kCell} * kCell + x % kCell) * 3];
            const uint32_t factor = brightness[size_t{y / kCell} * cells + x / kCell];
            for (int channel = 0; channel < 3; ++channel)
                texel[channel] = static_cast<uint8_t>(from[channel] * factor >> 8);
            texel[3] = 255;
        }
    return image;
}

/// Eye and axes of a picture's pixels.
struct PixelRays
{
    Double3 eye, forward, right, down; ///< right and down: a pixel, one metre before the eye
    double half_width, half_height;    ///< pixels

    PixelRays(const shared::Camera& camera, uint32_t width, uint32_t height)
        : eye(camera.position),
          forward(normalize(Double3(camera.target) - eye)),
          half_width(0.5 * width),
          half_height(0.5 * height)
    {
        const double pixel = std::tan(0.5 * double{camera.y_fov_rad}) / half_height;
        const Double3 unit_right = normalize(cross(forward, Double3(camera.up)));
        right = unit_right * pixel;
        down = cross(forward, unit_right) * pixel;
    }

    /// Return the direction through a place of the picture, in pixels from its top left; 1 m deep.
    Double3 through(double x, double y) const
    {
        return forward + right * (x - half_width) + down * (y - half_height);
    }
};

/// Place where a line of sight meets the plane of a panel.
struct Meeting
{
    double depth;
    double across, up; ///< 0 to 1 within the panel
};

std::optional<Meeting> meetPlane(const Panel& panel, Double3 eye, Double3 direction)
{
    const Double3 normal = cross(panel.across, panel.up);
    const double slope = dot(normal, direction);
    if (slope == 0)
        return std::nullopt;
    const double depth = dot(normal, panel.corner - eye) / slope;
    const Double3 from_corner = eye + direction * depth - panel.corner;
    return Meeting{depth, dot(from_corner, panel.across) / dot(panel.across, panel.across),
                   dot(from_corner, panel.up) / dot(panel.up, panel.up)};
}

/// Return the mip that a sampler takes, by "Scale Factor Operation" and "LOD(s) Operation" of the Vulkan
/// specification; the UVs change by differences over a pixel.
double findMip(const Panel& panel, const PixelRays& rays, double x, double y, uint32_t side,
               double max_anisotropy)
{
    const auto move = [&](double dx, double dy)
    {
        const auto from = meetPlane(panel, rays.eye, rays.through(x - dx, y - dy));
        const auto to = meetPlane(panel, rays.eye, rays.through(x + dx, y + dy));
        if (!from || !to)
            return std::numeric_limits<double>::infinity();
        return side * std::hypot((to->across - from->across) * panel.u, (to->up - from->up) * panel.v);
    };
    const double along_x = move(0.5, 0), along_y = move(0, 0.5);
    const auto [shorter, longer] = std::minmax(along_x, along_y);
    const double anisotropy = std::clamp(longer / shorter, 1.0, max_anisotropy);
    return std::max(std::log2(longer / anisotropy), 0.0);
}

} // namespace

Street makeStreet()
{
    Street street;
    const double pitch = kLength / kHouses;
    for (const double side : {-1.0, 1.0})
        for (uint32_t i = 0; i < kHouses; ++i)
            street.objects.push_back(makeHouse(side, -pitch * i, street.textures++));
    const double segment = kLength / kGrounds;
    for (uint32_t i = 0; i < kGrounds; ++i)
        street.objects.push_back({{{-kHalfWidth, 0, -segment * i},
                                   {2 * kHalfWidth, 0, 0},
                                   {0, 0, -segment},
                                   2 * kHalfWidth / kGroundUnit,
                                   segment / kGroundUnit,
                                   street.textures++}});
    std::mt19937 random(9);
    const auto uniform = [&](double low, double high)
    { return low + (high - low) * (static_cast<double>(random()) / 4294967296.0); };
    for (uint32_t i = 0; i < kCrates; ++i)
    {
        const double x = uniform(2, kHalfWidth - 1) * (i % 2 == 0 ? 1 : -1);
        const double z = -kLength * (i + 0.5) / kCrates;
        street.objects.push_back(makeCrate({x, 0, z}, uniform(0, std::numbers::pi / 2), i % street.textures));
    }
    return street;
}

std::string textureName(uint32_t texture)
{
    return fmt::format("street {}", texture);
}

samples::Document makeDocument(const Street& street, uint32_t side)
{
    samples::Document document;
    for (uint32_t texture = 0; texture < street.textures; ++texture)
    {
        samples::Material material{.name = textureName(texture), .double_sided = true, .unlit = true};
        material.base_color_image = samples::add(document.images, makeImage(texture, side));
        samples::add(document.materials, material);
    }
    for (size_t i = 0; i < street.objects.size(); ++i)
    {
        samples::TriangleMesh mesh;
        for (const Panel& panel : street.objects[i])
            samples::append(mesh, makeMesh(panel));
        const auto material = static_cast<int>(street.objects[i].front().texture);
        samples::addObject(document, fmt::format("object {}", i).c_str(), {{mesh, material}});
    }
    return document;
}

std::vector<WantedMip> findWantedMips(const Street& street, uint32_t side, const shared::Camera& camera,
                                      uint32_t width, uint32_t height, double max_anisotropy)
{
    const PixelRays rays(camera, width, height);
    std::vector<WantedMip> pixels;
    for (uint32_t row = 0; row < height; ++row)
        for (uint32_t column = 0; column < width; ++column)
        {
            const double x = column + 0.5, y = row + 0.5;
            const Panel* seen = nullptr;
            double depth = std::numeric_limits<double>::infinity();
            for (const std::vector<Panel>& object : street.objects)
                for (const Panel& panel : object)
                    if (const auto at = meetPlane(panel, rays.eye, rays.through(x, y));
                        at && at->depth > double{camera.z_near} && at->depth < depth && at->across >= 0 &&
                        at->across <= 1 && at->up >= 0 && at->up <= 1)
                    {
                        seen = &panel;
                        depth = at->depth;
                    }
            WantedMip pixel;
            if (seen != nullptr)
                pixel = {seen->texture, findMip(*seen, rays, x, y, side, max_anisotropy)};
            pixels.push_back(pixel);
        }
    return pixels;
}

} // namespace hearth::bench
