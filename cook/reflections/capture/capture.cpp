// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/capture.h"

#include "cook/reflections/capture/specks.h"
#include "cook/sampling/owen_sobol.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>

namespace hearth::reflections
{

using environment::Environment;
using environment::Layout;

namespace
{

/// Rays of a texel.
constexpr uint32_t kTexelRays = 4;

/// Metres of the box behind a surface that the probe is close to.
constexpr float kMinHalfBox = 0.01f;

/// Results of a texel: light of its rays, and shares of them.
struct TexelSight
{
    LeavingLight light;
    float sky = 0;
    float black = 0;
};

Float3 skySeen(const shared::SceneLighting& lighting, const std::optional<Environment>& sky, Float3 direction)
{
    return sky ? sky->texels[environment::findTexel(*sky, widen(direction))]
               : shared::skyRadiance(lighting.sky, direction);
}

/// Add up the sight of all texels by their solid angles.
void sumSight(const Environment& cube, std::span<const TexelSight> sights, Capture& capture)
{
    double mean = 0, black = 0;
    Double3 moment;
    for (size_t i = 0; i < sights.size(); ++i)
    {
        const auto x = static_cast<uint32_t>(i % cube.width),
                   y = static_cast<uint32_t>(i / cube.width % cube.width);
        const environment::PanelArea area = cube.area(x, y);
        const double angle = panelSolidAngle(Layout::cube, area);
        const auto panel = static_cast<uint32_t>(i / (size_t{cube.width} * cube.width));
        mean += sights[i].sky * angle;
        black += sights[i].black * angle;
        moment =
            moment + panelDirection(Layout::cube, panel, {(area.u0 + area.u1) / 2, (area.v0 + area.v1) / 2}) *
                         (sights[i].sky * angle);
    }
    constexpr double kPi = std::numbers::pi;
    const Float3 along = narrow(moment * (1 / (2 * kPi)));
    capture.sky_share = {along.x, along.y, along.z, static_cast<float>(mean / (4 * kPi))};
    capture.black_share = black / (4 * kPi);
}

} // namespace

Capture captureRadiance(const Surfaces& surfaces, const shared::SceneLighting& lighting,
                        const std::optional<Environment>& sky, Float3 position, uint32_t side)
{
    const PathLight light(surfaces, lighting);
    Capture capture{.radiance = {Layout::cube, side, side, std::vector<Float3>(size_t{6} * side * side)},
                    .sky_share = {},
                    .lamp_harmonics = light.lampHarmonics(position)};
    std::vector<TexelSight> sights(capture.radiance.texels.size());
    const auto shootTexel = [&](size_t i)
    {
        const auto panel = static_cast<uint32_t>(i / (size_t{side} * side));
        const auto x = static_cast<uint32_t>(i % side), y = static_cast<uint32_t>(i / side % side);
        for (uint32_t ray = 0; ray < kTexelRays; ++ray)
        {
            const Float2 in_texel = sampling::unitPoint(sampling::owenSobol(ray, sampling::deriveSeed(i, 0)));
            const Float3 direction = narrow(panelDirection(
                Layout::cube, panel, {(x + double{in_texel.x}) / side, (y + double{in_texel.y}) / side}));
            const std::optional<SurfaceHit> hit = surfaces.nearest(position, direction);
            sights[i].sky += hit ? 0 : 1.0f / kTexelRays;
            sights[i].black += hit && hit->is_black ? 1.0f / kTexelRays : 0;
            const float footprint = hit ? std::max(2 * hit->distance / static_cast<float>(side), 1e-6f) : 0;
            const LeavingLight seen =
                hit ? light.leaving(*hit, footprint, sampling::deriveSeed(sampling::deriveSeed(i, 1), ray))
                    : LeavingLight{.shown = skySeen(lighting, sky, direction), .albedo = {}, .bounced = {}};
            sights[i].light.shown += seen.shown / kTexelRays;
            sights[i].light.albedo += seen.albedo / kTexelRays;
            sights[i].light.bounced += seen.bounced / kTexelRays;
        }
    };
    tbb::parallel_for(size_t{0}, sights.size(), shootTexel);
    std::vector<Float3> bounced;
    for (const TexelSight& sight : sights)
        bounced.push_back(sight.light.bounced);
    for (size_t face = 0; face < 6; ++face)
        spreadSpecks(std::span(bounced).subspan(face * side * side, size_t{side} * side), side);
    for (size_t i = 0; i < sights.size(); ++i)
        capture.radiance.texels[i] = sights[i].light.shown + sights[i].light.albedo * bounced[i];
    sumSight(capture.radiance, sights, capture);
    return capture;
}

Box3 findBox(const Surfaces& surfaces, Float3 position)
{
    Box3 scene = surfaces.box();
    scene.add(position);
    const float far = std::max(length(scene.max - scene.min), 1.0f);
    const auto distance = [&](Float3 axis)
    {
        const std::optional<SurfaceHit> hit = surfaces.nearest(position, axis);
        return std::max(hit ? hit->distance : 2 * far, kMinHalfBox);
    };
    return {position - Float3{distance({-1, 0, 0}), distance({0, -1, 0}), distance({0, 0, -1})},
            position + Float3{distance({1, 0, 0}), distance({0, 1, 0}), distance({0, 0, 1})}};
}

} // namespace hearth::reflections
