// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/march_csv.h"

#include "cook/bricks/light/march_lanes.h"
#include "formats/base/atomic_file.h"
#include "formats/base/csv_table.h"
#include "formats/base/regular_file.h"
#include "formats/pack/pack_check.h"

#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

namespace hearth::bricks
{

namespace
{

constexpr std::string_view kHeader = "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z";

/// Make a ray from six numbers. Return nothing if the direction has no length or the origin exceeds the range
/// of floats.
std::optional<MarchRay> makeRay(std::span<const double> row)
{
    const double size = std::hypot(row[3], row[4], row[5]);
    if (!(size > 0) || !std::isfinite(size))
        return std::nullopt;
    const auto point = [](double x, double y, double z) {
        return Float3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    };
    const MarchRay ray{point(row[0], row[1], row[2]), point(row[3] / size, row[4] / size, row[5] / size)};
    return isFinite(ray.origin) ? std::optional(ray) : std::nullopt;
}

/// Open and check a pack or a part with bricks.
Result<formats::PackView> openBricks(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(path));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView view, formats::PackView::read(std::move(reader)));
    HEARTH_TRY(checkBricks(view));
    if (view.brickGrid().empty())
        return Error{Issue::chunk_missing, path, formats::chunkName(formats::kChunkBrickGrid, 0),
                     "the file has no bricks"};
    return view;
}

} // namespace

Result<std::vector<MarchRay>> readRayCsv(std::string_view text, const std::string& name)
{
    HEARTH_ASSIGN_OR_RETURN(const CsvTable rows, readCsvTable(text, kHeader, name));
    std::vector<MarchRay> rays;
    for (size_t i = 0; i < rows.size(); ++i)
    {
        const std::optional<MarchRay> ray = makeRay(rows.row(i));
        if (!ray)
            return makeCsvRowError(name, rows.lines[i], "its direction is 0, or a number is too large");
        rays.push_back(*ray);
    }
    return rays;
}

std::string marchRaysToCsv(const shared::BrickMasks& bricks, const std::vector<MarchRay>& rays)
{
    std::vector<shared::BrickRay> marched;
    marched.reserve(rays.size());
    for (const MarchRay& ray : rays)
        marched.push_back(brickRay(bricks.grid, ray.origin, ray.direction, shared::kBrickInfinity));
    marchRays(MarchTable(bricks), marched);
    std::string text = "hit,x,y,z,face,t\n";
    for (const shared::BrickRay& end : marched)
    {
        if (end.inside == 0)
            text += "0,,,,,\n";
        else
            fmt::format_to(std::back_inserter(text), "1,{},{},{},{},{}\n", end.x, end.y, end.z,
                           formats::voxelFaceName(end.face), brickDistance(bricks.grid, end));
    }
    return text;
}

Status marchCsvFile(const std::string& input, const std::string& rays, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView file, openBricks(input));
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(rays));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<MarchRay> all, readRayCsv(text, rays));
    const shared::BrickMasks masks{formats::toBrickGrid(file.brickGrid()[0]), file.brickGroupsAlongAxis(),
                                   file.bricks()};
    return writeText(output, marchRaysToCsv(masks, all));
}

} // namespace hearth::bricks
