// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/capture.h"

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

/// Distance in texels over which a speck is spread, and how many times the median around it makes one.
constexpr int kSpread = 4;
constexpr float kSpeck = 3;
/// Specks around a texel, of 81 texels, at most: more are a bright surface.
constexpr int kMaxSpecks = 27;

/// Results of a texel: light of its rays, and shares of them.
struct TexelSight
{
    LeavingLight light;
    float sky = 0;
    float black = 0;
};

/// Spread bounced light that few paths have found by chance over the texels around, with all its energy.
/// Light that the probe sees as it is stays where it is.
/// sights  of a face, side x side
void spreadSpecks(std::span<TexelSight> sights, uint32_t side)
{
    std::vector<Float3> spread(sights.size());
    std::vector<float> around;
    std::vector<size_t> places;
    const auto count = static_cast<int>(side);
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
        {
            around.clear();
            places.clear();
            for (int row = std::max(y - kSpread, 0); row <= std::min(y + kSpread, count - 1); ++row)
                for (int column = std::max(x - kSpread, 0); column <= std::min(x + kSpread, count - 1);
                     ++column)
                {
                    places.push_back(static_cast<size_t>(row * count + column));
                    around.push_back(shared::luminance(sights[places.back()].light.bounced));
                }
            const size_t at = static_cast<size_t>(y * count + x);
            const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
            std::nth_element(around.begin(), middle, around.end());
            const float own = shared::luminance(sights[at].light.bounced), speck = kSpeck * *middle;
            const auto bright = std::ranges::count_if(around, [speck](float value) { return value > speck; });
            const bool is_speck = *middle > 0 && own > speck && bright <= kMaxSpecks;
            const float kept = is_speck ? *middle / own : 1;
            spread[at] += sights[at].light.bounced * kept;
            if (!is_speck)
                continue;
            for (const size_t place : places)
                spread[place] += sights[at].light.bounced * ((1 - kept) / static_cast<float>(places.size()));
        }
    for (size_t i = 0; i < sights.size(); ++i)
        sights[i].light.bounced = spread[i];
}

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
    for (size_t face = 0; face < 6; ++face)
        spreadSpecks(std::span(sights).subspan(face * side * side, size_t{side} * side), side);
    std::ranges::transform(sights, capture.radiance.texels.begin(),
                           [](const TexelSight& sight) { return sight.light.radiance(); });
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
