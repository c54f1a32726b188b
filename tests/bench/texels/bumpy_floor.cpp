// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/texels/bumpy_floor.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/reference/double3.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::bench
{

namespace
{

using reference::Double3;

constexpr uint32_t kTexels = 512; ///< along a side of the normal map
constexpr float kTile = 0.5f;     ///< metres that the normal map covers
constexpr float kHalfWidth = 40, kLength = 80;
constexpr float kDistance = 15; ///< metres, from the eye to the middle of the picture
constexpr float kMiddle = -40;  ///< its z
constexpr float kFov = 0.35f;
constexpr float kAside = 0.01f; // x of directions, without which rotationLookingAt has no turn for the sun
constexpr double kReflectance = 0.04; ///< of plastic, seen along the normal

/// Make a map of bumps that tile, some four texels wide and wider.
samples::Image makeNormalMap(float slope)
{
    const samples::TileNoise noise{.cells = 32, .seed = 77};
    std::vector<float> heights(size_t{kTexels} * kTexels);
    for (uint32_t y = 0; y < kTexels; ++y)
        for (uint32_t x = 0; x < kTexels; ++x)
            heights[size_t{y} * kTexels + x] =
                noise.fbm({(float(x) + 0.5f) / kTexels, (float(y) + 0.5f) / kTexels}, 3);
    const auto height = [&](uint32_t x, uint32_t y)
    { return double{heights[size_t{y % kTexels} * kTexels + x % kTexels]}; };
    std::vector<std::array<double, 2>> slopes;
    double squares = 0;
    for (uint32_t y = 0; y < kTexels; ++y)
        for (uint32_t x = 0; x < kTexels; ++x)
        {
            slopes.push_back({height(x + 1, y) - height(x + kTexels - 1, y),
                              height(x, y + 1) - height(x, y + kTexels - 1)});
            squares += slopes.back()[0] * slopes.back()[0] + slopes.back()[1] * slopes.back()[1];
        }
    const double scale = double{slope} / std::sqrt(squares / (2.0 * kTexels * kTexels));
    samples::Image image{.name = "bumps", .width = kTexels, .height = kTexels, .texels = {}};
    for (const auto& [x, y] : slopes)
    {
        const Double3 normal = normalize(Double3{x * scale, y * scale, 1});
        for (const double c : {normal.x, normal.y, normal.z})
            image.texels.push_back(static_cast<uint8_t>(std::lround((c * 0.5 + 0.5) * 255)));
        image.texels.push_back(255);
    }
    return image;
}

samples::Image makeRoughnessMap(float roughness)
{
    samples::Image image{.name = "roughness", .width = kTexels, .height = kTexels, .texels = {}};
    for (uint32_t i = 0; i < kTexels * kTexels; ++i)
        image.texels.insert(image.texels.end(),
                            {255, static_cast<uint8_t>(std::lround(roughness * 255)), 0, 255});
    return image;
}

/// Samples the finest mip, bilinear, and repeats it.
Double3 sampleNormal(const samples::Image& map, double u, double v)
{
    const double x = u * kTexels - 0.5, y = v * kTexels - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    Double3 sum{};
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx)
        {
            const double weight = (dx == 0 ? left + 1 - x : x - left) * (dy == 0 ? top + 1 - y : y - top);
            const auto wrap = [](double at)
            { return static_cast<size_t>(static_cast<int64_t>(at) & (kTexels - 1)); };
            const uint8_t* texel = &map.texels[(wrap(top + dy) * kTexels + wrap(left + dx)) * 4];
            sum = sum + Double3{texel[0] / 127.5 - 1, texel[1] / 127.5 - 1, texel[2] / 127.5 - 1} * weight;
        }
    return normalize(sum);
}

/// The specular lobe of glTF 2.0, appendix B, times the cosine.
double reflect(Double3 normal, Double3 to_eye, Double3 to_sun, double roughness)
{
    const double nl = dot(normal, to_sun);
    if (nl <= 0)
        return 0;
    const double nv = std::max(dot(normal, to_eye), 1e-3);
    const Double3 half = normalize(to_eye + to_sun);
    const double nh = std::clamp(dot(normal, half), 0.0, 1.0);
    const double a2 = std::pow(roughness, 4);
    const double d = nh * nh * (a2 - 1) + 1;
    const double distribution = a2 / (std::numbers::pi * d * d);
    const double visibility =
        0.5 / (nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2));
    const double fresnel = kReflectance + (1 - kReflectance) * std::pow(1 - dot(to_eye, half), 5);
    return distribution * visibility * fresnel * nl;
}

/// Return the unit vector up to the sun; with a positive z to the eye.
Float3 rise(const BumpyFloor& floor, float z)
{
    const float angle = floor.elevation_deg * std::numbers::pi_v<float> / 180;
    return {kAside, std::sin(angle), std::copysign(std::cos(angle), z)};
}

} // namespace

samples::Document makeBumpyFloor(const BumpyFloor& floor)
{
    samples::Document document;
    samples::Material material{.name = "floor", .base_color = {0, 0, 0, 1}, .roughness = 1};
    if (floor.slope > 0)
        material.normal_image = add(document.images, makeNormalMap(floor.slope));
    material.metallic_roughness_image = add(document.images, makeRoughnessMap(floor.roughness));
    const int index = add(document.materials, material);
    samples::TriangleMesh mesh =
        samples::makeGrid(8, 8,
                          [](Float2 uv, Float3& position, Float2& texture_uv)
                          {
                              position = {(2 * uv.x - 1) * kHalfWidth, 0, -uv.y * kLength};
                              texture_uv = {position.x / kTile, position.z / kTile};
                          });
    const Float3 to_sun = rise(floor, -1);
    mesh.normals.assign(mesh.positions.size(), Float3{0, 1, 0});
    samples::addObject(document, "floor", {{mesh, index}});
    samples::addLight(
        document,
        {.name = "sun", .kind = samples::LightKind::directional, .intensity = floor.sun, .flicker = {}},
        to_sun, samples::rotationLookingAt(to_sun, {0, 0, 0}));
    return document;
}

shared::Camera floorCamera(const BumpyFloor& floor)
{
    const Float3 middle{0, 0, kMiddle};
    return {.position = middle + rise(floor, 1) * kDistance,
            .target = middle,
            .up = {0, 1, 0},
            .y_fov_rad = kFov,
            .z_near = 0.01f};
}

double reflectedSun(const BumpyFloor& floor, uint32_t width, uint32_t height, uint32_t points_per_side)
{
    const samples::Image map = floor.slope > 0 ? makeNormalMap(floor.slope) : samples::Image{};
    const double roughness = std::round(double{floor.roughness} * 255) / 255;
    const shared::Camera camera = floorCamera(floor);
    const Double3 eye(camera.position), to_sun = normalize(Double3(rise(floor, -1)));
    const Double3 forward = normalize(Double3(camera.target) - eye);
    const Double3 right = normalize(cross(forward, Double3{0, 1, 0}));
    const Double3 up = cross(right, forward);
    const double extent = std::tan(double{kFov} / 2);
    const uint32_t columns = width * points_per_side, rows = height * points_per_side;
    double sum = 0;
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column)
        {
            const double x = (2 * (column + 0.5) / columns - 1) * extent * width / height;
            const double y = (1 - 2 * (row + 0.5) / rows) * extent;
            const Double3 ray = normalize(forward + right * x + up * y);
            const Double3 hit = eye + ray * (-eye.y / ray.y);
            Double3 normal{0, 1, 0};
            if (floor.slope > 0)
            {
                // u runs along x; the normal map's y points against v, which runs along z
                const Double3 bump = sampleNormal(map, hit.x / double{kTile}, hit.z / double{kTile});
                normal = {bump.x, bump.z, -bump.y};
            }
            sum += reflect(normal, ray * -1, to_sun, roughness);
        }
    return sum * double{floor.sun} / (double(rows) * columns);
}

} // namespace hearth::bench
