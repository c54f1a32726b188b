// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/sky_map.h"

#include <algorithm>
#include <cmath>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

/// Point of a panel, and the solid angle of the panel's unit square at its scale there.
struct PanelPlace
{
    size_t panel;
    double u, v, solid_angle;
};

/// OpenEXR's latitude-longitude map: the middle looks along +Z, a quarter from the left along +X.
PanelPlace findLatLong(Double3 d)
{
    const double sine = std::hypot(d.x, d.z);
    const double u = 0.5 - std::atan2(d.x, d.z) / (2 * kPi);
    return {0, u, std::atan2(sine, d.y) / kPi, 2 * kPi * kPi * sine};
}

/// Vulkan 1.3, section "Cube Map Face Selection".
PanelPlace findCube(Double3 d)
{
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z), major = std::max({x, y, z});
    double s, t;
    size_t panel;
    if (major == z)
    {
        panel = d.z > 0 ? 4 : 5;
        s = d.z > 0 ? d.x : -d.x;
        t = -d.y;
    }
    else if (major == y)
    {
        panel = d.y > 0 ? 2 : 3;
        s = d.x;
        t = d.y > 0 ? d.z : -d.z;
    }
    else
    {
        panel = d.x > 0 ? 0 : 1;
        s = d.x > 0 ? -d.z : d.z;
        t = -d.y;
    }
    s /= major;
    t /= major;
    return {panel, (s + 1) / 2, (t + 1) / 2, 4 * std::pow(1 + s * s + t * t, -1.5)};
}

Double3 cubeDirection(size_t panel, double u, double v)
{
    const double s = 2 * u - 1, t = 2 * v - 1;
    switch (panel)
    {
    case 0:
        return normalize(Double3{1, -t, -s});
    case 1:
        return normalize(Double3{-1, -t, s});
    case 2:
        return normalize(Double3{s, 1, t});
    case 3:
        return normalize(Double3{s, -1, -t});
    case 4:
        return normalize(Double3{s, -t, 1});
    default:
        return normalize(Double3{-s, -t, -1});
    }
}

Double3 latLongDirection(double u, double v)
{
    const double from_zenith = kPi * v, longitude = 2 * kPi * (0.5 - u);
    return {std::sin(from_zenith) * std::sin(longitude), std::cos(from_zenith),
            std::sin(from_zenith) * std::cos(longitude)};
}

} // namespace

SkyMap::SkyMap(environment::Environment image) : image_(std::move(image))
{
    double sum = 0;
    const bool is_cube = image_.layout == environment::Layout::cube;
    for (size_t i = 0; i < image_.texels.size(); ++i)
    {
        const size_t x = i % image_.width, y = i / image_.width % image_.height,
                     panel = i / (size_t{image_.width} * image_.height);
        const double u = (static_cast<double>(x) + 0.5) / image_.width;
        const double v = (static_cast<double>(y) + 0.5) / image_.height;
        Double3 around{};
        for (const int64_t down : {-1, 0, 1})
            for (const int64_t across : {-1, 0, 1})
                around +=
                    texel(panel, static_cast<int64_t>(x) + across, static_cast<int64_t>(y) + down) / 9.0;
        const Double3 direction = is_cube ? cubeDirection(panel, u, v) : latLongDirection(u, v);
        sum += dot(around, {0.2126, 0.7152, 0.0722}) * find(direction).solid_angle;
        cumulated_.push_back(sum);
    }
}

SkyMap::Place SkyMap::find(Double3 direction) const
{
    const PanelPlace place =
        image_.layout == environment::Layout::cube ? findCube(direction) : findLatLong(direction);
    return {place.panel, place.u * image_.width, place.v * image_.height, place.solid_angle};
}

Double3 SkyMap::texel(size_t panel, int64_t x, int64_t y) const
{
    const int64_t width = image_.width, height = image_.height;
    x = image_.layout == environment::Layout::cube ? std::clamp<int64_t>(x, 0, width - 1)
                                                   : (x + width) % width;
    y = std::clamp<int64_t>(y, 0, height - 1);
    return Double3(image_.texels[panel * image_.width * image_.height + static_cast<size_t>(y * width + x)]);
}

Double3 SkyMap::radiance(Double3 direction) const
{
    const Place place = find(direction);
    const double left = std::floor(place.x - 0.5), top = std::floor(place.y - 0.5);
    const double right_share = place.x - 0.5 - left, lower_share = place.y - 0.5 - top;
    const auto row = [&](int64_t y)
    {
        const auto x = static_cast<int64_t>(left);
        return texel(place.panel, x, y) * (1 - right_share) + texel(place.panel, x + 1, y) * right_share;
    };
    const auto y = static_cast<int64_t>(top);
    return row(y) * (1 - lower_share) + row(y + 1) * lower_share;
}

Double3 SkyMap::pick(double choice, double u, double v) const
{
    const auto found = std::ranges::upper_bound(cumulated_, choice * cumulated_.back());
    const auto texel = static_cast<size_t>(std::min(found, cumulated_.end() - 1) - cumulated_.begin());
    const double across = (static_cast<double>(texel % image_.width) + u) / image_.width;
    const double down = (static_cast<double>(texel / image_.width % image_.height) + v) / image_.height;
    return image_.layout == environment::Layout::cube
               ? cubeDirection(texel / (size_t{image_.width} * image_.height), across, down)
               : latLongDirection(across, down);
}

double SkyMap::density(Double3 direction) const
{
    const Place place = find(direction);
    const auto inside = [](double at, uint32_t count)
    { return static_cast<size_t>(std::clamp(at, 0.0, count - 1.0)); };
    const size_t texel = (place.panel * image_.height + inside(place.y, image_.height)) * image_.width +
                         inside(place.x, image_.width);
    const double weight = cumulated_[texel] - (texel == 0 ? 0 : cumulated_[texel - 1]);
    return weight / cumulated_.back() * image_.width * image_.height / place.solid_angle;
}

} // namespace hearth::reference
