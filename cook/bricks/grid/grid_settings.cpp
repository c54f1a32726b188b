// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/grid_settings.h"

#include "formats/records/bricks.h"

#include <cstdio>

namespace hearth::bricks
{

namespace
{

constexpr std::array<double, 11> kSeries{1, 1.25, 1.6, 2, 2.5, 3.2, 4, 5, 6.4, 8, 10};

constexpr double kMaxVoxels = formats::kMaxGridVoxels;

// Relative tolerance for counting voxels: an extent of 512 m with 0.1 m voxels means 5120 voxels despite
// rounding.
constexpr double kCountTolerance = 1e-4;

std::string text(double value)
{
    char out[32];
    std::snprintf(out, sizeof(out), "%.6g", value);
    return out;
}

/// Return the smallest number of the series that is at least `size`, from 10^-6 on.
double roundUpToSeries(double size)
{
    for (int exponent = -6; exponent < 9; ++exponent)
        for (const double step : kSeries)
        {
            // multiply or divide by powers that are whole numbers, so that 0.1 and 1.6 are the doubles
            // nearest to them
            double power = 1;
            for (int i = 0; i < std::abs(exponent); ++i)
                power *= 10;
            const double candidate = exponent < 0 ? step / power : step * power;
            if (candidate >= size * (1 - 1e-6))
                return candidate;
        }
    return size;
}

double longestSide(const Box3& box)
{
    const Float3 size = box.max - box.min;
    return box.empty() ? 0 : std::max({size.x, size.y, size.z});
}

struct Axis
{
    double origin;
    double voxels;
};

/// Place the voxels along one axis, where no extent is set.
Axis placeAxis(double min, double max, double size)
{
    // use multiples of the voxel size as planes, so that a surface in a plane has room behind it on both
    // sides
    const double first = std::ceil(min / size - kCountTolerance) - 1;
    const double last = std::floor(max / size + kCountTolerance) + 1;
    return {first * size, last - first};
}

Error usage(const std::string& object, const std::string& detail)
{
    return {Issue::usage, object, "", detail};
}

Status checkSettings(const GridSettings& settings)
{
    if (settings.voxel_size && !(std::isfinite(*settings.voxel_size) && *settings.voxel_size > 0))
        return usage("--voxel-size", text(*settings.voxel_size) + " is not a size: give metres above 0");
    if (settings.min.has_value() != settings.max.has_value())
        return usage("--min, --max", "an extent needs both");
    if (!settings.min)
        return success();
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto along = [&](const Double3& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
        const double low = along(*settings.min), high = along(*settings.max);
        if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
            return usage("--min, --max", std::string("the extent along ") + "xyz"[axis] + " is " + text(low) +
                                             " to " + text(high) +
                                             ": give two finite numbers, the lesser one first");
    }
    return success();
}

} // namespace

double firstVoxelSize(const Box3& box)
{
    const double side = longestSide(box);
    return side > 0 ? roundUpToSeries(std::max(0.9 * side / 512, std::min(0.1, side / 64))) : 1;
}

double nextVoxelSize(double size)
{
    return roundUpToSeries(size * 1.01);
}

Result<GridFrame> makeGridFrame(const GridSettings& settings, const Box3& box, double size)
{
    HEARTH_TRY(checkSettings(settings));
    GridFrame frame;
    frame.voxel_size = static_cast<float>(size);
    if (!(frame.voxel_size > 0) || !std::isfinite(frame.voxel_size))
        return usage("--voxel-size", text(size) + " m is not a size that a file can hold");
    const double rounded = frame.voxel_size;
    for (int axis = 0; axis < 3; ++axis)
    {
        Axis along{0, 1};
        if (settings.min)
        {
            const auto at = [&](const Double3& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
            const double extent = at(*settings.max) - at(*settings.min);
            along = {at(*settings.min), std::max(1.0, std::ceil(extent / rounded - kCountTolerance))};
        }
        else if (!box.empty())
            along = placeAxis(box.min[axis], box.max[axis], rounded);
        if (!(along.voxels <= kMaxVoxels))
            return usage("--voxel-size",
                         text(size) + " m makes " + text(along.voxels) + " voxels along " + "xyz"[axis] +
                             ", " + text(kMaxVoxels) + " are the most: give at least " +
                             text(size * along.voxels / kMaxVoxels) + ", or a smaller extent (--min, --max)");
        frame.origin[axis] = static_cast<float>(along.origin);
        if (!std::isfinite(frame.origin[axis]))
            return usage("--min, --max", text(along.origin) + " is not a place that a file can hold");
        frame.voxels[static_cast<size_t>(axis)] = static_cast<uint32_t>(along.voxels);
    }
    const uint64_t groups = frame.groupCount() * sizeof(formats::BrickGroupRecord);
    if (groups > settings.memory)
        return usage("memory of bricks",
                     std::to_string(settings.memory) + " bytes are less than the empty grid takes, " +
                         std::to_string(groups) +
                         ": give more, a larger --voxel-size or a smaller extent (--min, --max)");
    return frame;
}

} // namespace hearth::bricks
