// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/environment/environment.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::environment
{

namespace
{

constexpr double kPi = std::numbers::pi;

/// Return the solid angle of the rectangle from (0, 0) to (a, b) of the plane z = 1, with the sign of a b.
double cornerSolidAngle(double a, double b)
{
    return std::atan2(a * b, std::sqrt(a * a + b * b + 1));
}

/// Return the direction of a point of a face; a and b run from -1 to 1, rightwards and downwards.
/// Source: Vulkan 1.3, section "Cube Map Face Selection".
Double3 faceDirection(uint32_t face, double a, double b)
{
    switch (face)
    {
    case 0:
        return {1, -b, -a};
    case 1:
        return {-1, -b, a};
    case 2:
        return {a, 1, b};
    case 3:
        return {a, -1, -b};
    case 4:
        return {a, -b, 1};
    default:
        return {-a, -b, -1};
    }
}

} // namespace

Double3 panelDirection(Layout layout, uint32_t panel, PanelPoint point)
{
    if (layout == Layout::cube)
    {
        HEARTH_ASSERT(panel < 6);
        const Double3 direction = faceDirection(panel, 2 * point.u - 1, 2 * point.v - 1);
        return direction * (1 / length(direction));
    }
    HEARTH_ASSERT(panel == 0);
    const double from_zenith = kPi * point.v, longitude = kPi * (1 - 2 * point.u);
    const double sine = std::sin(from_zenith);
    return {sine * std::sin(longitude), std::cos(from_zenith), sine * std::cos(longitude)};
}

double panelSolidAngle(Layout layout, const PanelArea& area)
{
    if (layout == Layout::lat_long)
        // cos(a) - cos(b), without the cancellation of that form
        return 4 * kPi * (area.u1 - area.u0) * std::sin(kPi / 2 * (area.v0 + area.v1)) *
               std::sin(kPi / 2 * (area.v1 - area.v0));
    const double a0 = 2 * area.u0 - 1, a1 = 2 * area.u1 - 1, b0 = 2 * area.v0 - 1, b1 = 2 * area.v1 - 1;
    return cornerSolidAngle(a1, b1) - cornerSolidAngle(a0, b1) - cornerSolidAngle(a1, b0) +
           cornerSolidAngle(a0, b0);
}

CubePlace findCubePlace(Double3 direction)
{
    const double x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
    uint32_t face;
    double a, b, depth;
    if (z >= x && z >= y)
    {
        face = direction.z < 0 ? 5 : 4;
        a = direction.z < 0 ? -direction.x : direction.x;
        b = -direction.y;
        depth = z;
    }
    else if (y >= x)
    {
        face = direction.y < 0 ? 3 : 2;
        a = direction.x;
        b = direction.y < 0 ? -direction.z : direction.z;
        depth = y;
    }
    else
    {
        face = direction.x < 0 ? 1 : 0;
        a = direction.x < 0 ? direction.z : -direction.z;
        b = -direction.y;
        depth = x;
    }
    HEARTH_ASSERT(depth > 0);
    return {face, {(a / depth + 1) / 2, (b / depth + 1) / 2}};
}

size_t findTexel(const Environment& environment, Double3 direction)
{
    CubePlace place{0, {}};
    if (environment.layout == Layout::cube)
        place = findCubePlace(direction);
    else
        place.point = {0.5 - std::atan2(direction.x, direction.z) / (2 * kPi),
                       std::atan2(std::hypot(direction.x, direction.z), direction.y) / kPi};
    const auto texel = [](double at, uint32_t count)
    { return static_cast<uint32_t>(std::clamp(at * count, 0.0, count - 1.0)); };
    return environment.index(place.panel, texel(place.point.u, environment.width),
                             texel(place.point.v, environment.height));
}

} // namespace hearth::environment
