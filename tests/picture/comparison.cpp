// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/comparison.h"

#include "tests/reference/flip.h"

#include <cstdio>

namespace hearth::picture
{

namespace
{

Difference differ(const reference::Image& expected, const reference::Image& drawn)
{
    const reference::FlipMap map = reference::flip(expected, drawn);
    return {map.mean(), reference::makeFlipImage(map)};
}

const reference::Image& at(const DrawnPictures& drawn, Setting setting)
{
    return drawn[static_cast<size_t>(setting)];
}

} // namespace

Comparison compare(std::string reference, const ReferenceImages& images, const DrawnPictures& drawn)
{
    Comparison comparison;
    comparison.reference = std::move(reference);
    comparison.open = develop(images.open, kOversampling);
    comparison.full = develop(average(images.full[0], images.full[1]), kOversampling);
    comparison.noise =
        differ(develop(images.full[0], kOversampling), develop(images.full[1], kOversampling)).flip;
    comparison.open_open = differ(comparison.open, at(drawn, Setting::open));
    comparison.plain_open = differ(comparison.open, at(drawn, Setting::plain));
    comparison.plain_full = differ(comparison.full, at(drawn, Setting::plain));
    comparison.full_full = differ(comparison.full, at(drawn, Setting::full));
    return comparison;
}

std::string_view tableHead()
{
    return "mean FLIP of Hearth's picture beside a reference's, and light on walls that no lamp reaches over "
           "the "
           "reference's\n"
           "                     nothing      default      default       all on      halves of\n"
           "                    occludes       beside       beside       beside       the full\n"
           "scene     beside        both         open         full         full      reference    walls\n";
}

std::string describe(const SceneResult& result)
{
    std::string rows;
    char line[200];
    for (const Comparison& c : result.comparisons)
    {
        std::snprintf(line, sizeof(line), "%-9s %-7s %12.4f %12.4f %12.4f %12.4f %14.4f", result.name.c_str(),
                      c.reference.c_str(), c.open_open.flip, c.plain_open.flip, c.plain_full.flip,
                      c.full_full.flip, c.noise);
        rows += line;
        std::snprintf(line, sizeof(line), "%9.3f", c.walls.value_or(0));
        rows += c.walls ? line : "";
        rows += "\n";
    }
    if (result.agreement)
    {
        std::snprintf(line, sizeof(line),
                      "%-9s the references differ by %.4f without occlusion, by %.4f with full light\n", "",
                      result.agreement->open, result.agreement->full);
        rows += line;
    }
    std::snprintf(line, sizeof(line), "%-9s baked ambient occlusion is off by %.4f rms\n", "",
                  result.occlusion.rms);
    return rows + line;
}

} // namespace hearth::picture
