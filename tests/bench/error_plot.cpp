// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/error_plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hearth::bench
{

namespace
{

constexpr double kWidth = 300, kHeight = 240, kLeft = 52, kTop = 30, kGap = 30, kBottom = 44;

constexpr int kColumns = 4;

// Axes: share of the triangles from 1 to 1/1000, rms distance from 1e-5 to 1e-2 of the diagonal.
constexpr double kMinShare = -3, kMinError = -5, kMaxError = -2;

double getX(double share)
{
    return std::log10(share) / kMinShare * kWidth;
}
double getY(double error)
{
    return kHeight - (std::log10(error) - kMinError) / (kMaxError - kMinError) * kHeight;
}

std::string axes()
{
    std::string svg =
        fmt::format("<rect width='{}' height='{}' fill='#fff' stroke='#999'/>\n", kWidth, kHeight);
    for (int power = 0; power >= static_cast<int>(kMinShare); --power)
    {
        const double x = getX(std::pow(10.0, power));
        svg += fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y2='{1}' stroke='#ddd'/>\n", x, kHeight);
        svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{} %</text>\n", x, kHeight + 16,
                           std::pow(10.0, power + 2));
    }
    for (int power = static_cast<int>(kMinError); power <= static_cast<int>(kMaxError); ++power)
    {
        const double y = getY(std::pow(10.0, power));
        svg += fmt::format("<line x2='{0}' y1='{1:.1f}' y2='{1:.1f}' stroke='#ddd'/>\n", kWidth, y);
        svg += fmt::format("<text x='-6' y='{:.1f}' text-anchor='end'>1e{}</text>\n", y + 4, power);
    }
    return svg;
}

std::string panel(const MeshCurve& curve)
{
    std::string svg = axes();
    svg += fmt::format(
        "<text x='0' y='-10' font-weight='bold'>{}, {:.0f} triangles: rms distance / diagonal</text>\n",
        curve.mesh, curve.source_triangles);
    svg += fmt::format(
        "<text x='{}' y='{}' text-anchor='middle'>triangles of the source that are drawn</text>\n",
        kWidth / 2, kHeight + 34);
    std::string points;
    for (const CutQuality& cut : curve.cuts)
        if (cut.rms > 0)
            points += fmt::format("{:.1f},{:.1f} ",
                                  getX(static_cast<double>(cut.triangles) / curve.source_triangles),
                                  getY(cut.rms / curve.diagonal));
    // nested <svg> that clips at the axes
    svg += fmt::format("<svg width='{}' height='{}'><polyline points='{}' fill='none' stroke='#c0392b' "
                       "stroke-width='2'/></svg>\n",
                       kWidth, kHeight, points);
    for (const PeerCut& cut : curve.peer->cuts)
        if (cut.share > 0 && cut.rms > 0)
            svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='#2c3e50'/>\n", getX(cut.share),
                               getY(cut.rms));
    return svg;
}

} // namespace

std::string errorPlot(const std::vector<MeshCurve>& curves)
{
    std::string panels;
    int count = 0;
    constexpr double kColumnWidth = kWidth + kLeft + kGap, kRowHeight = kTop + kHeight + kBottom;
    for (const MeshCurve& curve : curves)
        if (curve.peer != nullptr && curve.peer->cuts[1].share > 0)
        {
            panels += fmt::format("<g transform='translate({:.1f},{:.1f})'>\n{}</g>\n",
                                  kLeft + kColumnWidth * (count % kColumns),
                                  kTop + kRowHeight * (count / kColumns), panel(curve));
            ++count;
        }
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{}' height='{}' font-family='sans-serif' "
        "font-size='11'>\n<rect width='100%' height='100%' fill='#fff'/>\n{}</svg>\n",
        kColumnWidth * std::min(count, kColumns), kRowHeight * ((count + kColumns - 1) / kColumns), panels);
}

} // namespace hearth::bench
