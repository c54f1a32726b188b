// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/light_plot.h"

#include "tests/bench/aims.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hearth::bench
{

namespace
{

constexpr double kWidth = 340, kHeight = 240, kLeft = 52, kTop = 30, kGap = 30, kBottom = 58;

// Axes: voxel size from 2 cm to 2 m, error from 0.5 % to 200 %.
constexpr double kMinSize = 0.02, kMaxSize = 2, kMinError = 0.005, kMaxError = 2;

double getX(double size)
{
    return std::log(size / kMinSize) / std::log(kMaxSize / kMinSize) * kWidth;
}
double getY(double error)
{
    return kHeight -
           std::log(std::max(error, kMinError) / kMinError) / std::log(kMaxError / kMinError) * kHeight;
}

std::string axes()
{
    std::string svg =
        fmt::format("<rect width='{}' height='{}' fill='#fff' stroke='#999'/>\n", kWidth, kHeight);
    for (const double size : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
        svg += fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y2='{1}' stroke='#ddd'/>\n"
                           "<text x='{0:.1f}' y='{2}' text-anchor='middle'>{3} m</text>\n",
                           getX(size), kHeight, kHeight + 16, size);
    for (const double error : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0})
        svg += fmt::format("<line x2='{0}' y1='{1:.1f}' y2='{1:.1f}' stroke='#ddd'/>\n"
                           "<text x='-6' y='{2:.1f}' text-anchor='end'>{3:.0f} %</text>\n",
                           kWidth, getY(error), getY(error) + 4, 100 * error);
    return svg + fmt::format("<line x2='{0}' y1='{1:.1f}' y2='{1:.1f}' stroke='#27ae60' "
                             "stroke-dasharray='5 3'/>\n",
                             kWidth, getY(findAim("light", "rms error at voxels of 0.1 m: room").limit));
}

template <typename Value>
std::string line(const LightCurve& curve, const char* color, const Value& value)
{
    std::string points, dots;
    for (const LightCurve::Size& size : curve.sizes)
    {
        const double x = getX(size.voxel_size), y = getY(value(size));
        points += fmt::format("{:.1f},{:.1f} ", x, y);
        dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}'/>\n", x, y, color);
    }
    return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='2'/>\n", points, color) +
           dots;
}

std::string panel(const LightCurve& curve)
{
    constexpr const char *kWhole = "#c0392b", *kIndirect = "#2c3e50", *kAll = "#bdc3c7";
    std::string svg = axes();
    svg += fmt::format("<text y='-10' font-weight='bold'>{}: rms error of irradiance over its mean</text>\n",
                       curve.scene);
    svg += fmt::format("<text y='{}'>edge of a voxel; <tspan fill='{}'>all light</tspan>, <tspan "
                       "fill='{}'>indirect light over its own mean</tspan>,</text>\n",
                       kHeight + 34, kWhole, kIndirect);
    svg += fmt::format("<text y='{}'><tspan fill='#7f8c8d'>all light with points within {} m of lamps "
                       "too</tspan>, <tspan fill='#27ae60'>limit</tspan></text>\n",
                       kHeight + 48, reference::kNearLamp);
    svg += line(curve, kAll, [](const LightCurve::Size& size) { return size.all.whole; });
    svg += line(curve, kIndirect, [](const LightCurve::Size& size) { return size.away.indirect; });
    svg += line(curve, kWhole, [](const LightCurve::Size& size) { return size.away.whole; });
    return svg;
}

} // namespace

std::string lightPlot(const std::vector<LightCurve>& curves)
{
    constexpr double kColumnWidth = kLeft + kWidth + kGap;
    std::string panels;
    for (size_t i = 0; i < curves.size(); ++i)
        panels += fmt::format("<g transform='translate({:.1f},{:.1f})'>\n{}</g>\n",
                              kLeft + kColumnWidth * static_cast<double>(i), kTop, panel(curves[i]));
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{}' height='{}' font-family='sans-serif' "
        "font-size='11'>\n<rect width='100%' height='100%' fill='#fff'/>\n{}</svg>\n",
        kColumnWidth * static_cast<double>(curves.size()), kTop + kHeight + kBottom, panels);
}

} // namespace hearth::bench
