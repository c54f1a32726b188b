// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/size_outliers.h"

#include "formats/container/container_reader.h"
#include "formats/records/provenance.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

// Factor by which an outlier differs. A chair and a house differ by less, metres and centimetres by more.
constexpr double kOutlierFactor = 20;

// With two sources, nothing tells which of them is wrong.
constexpr size_t kMinSources = 3;

std::string outlierWarning(const std::string& source, double side, double median, size_t count)
{
    const bool is_larger = side > median;
    return formatMessage(
        {Issue::size_outlier, source, "",
         fmt::format(
             "its largest side is {:.3g} m, {:.0f} times {} than that of the median of {} sources, {:.3g} m",
             side, is_larger ? side / median : median / side, is_larger ? "larger" : "smaller", count,
             median)});
}

} // namespace

std::vector<SizeOutlier> findSizeOutliers(const std::string& pack, const std::vector<std::string>& sources)
{
    const auto reader = formats::ContainerReader::open(pack, formats::Check::structure);
    if (!reader.ok())
        return {};
    const auto assets = reader->records<formats::AssetRecord>(formats::kChunkAssets);
    if (!assets.ok() || assets->span().size() != sources.size())
        return {};
    std::vector<double> sides;
    for (const formats::AssetRecord& asset : assets->span())
        if (formats::largestSide(asset) > 0)
            sides.push_back(double{formats::largestSide(asset)});
    if (sides.size() < kMinSources)
        return {};
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>((sides.size() - 1) / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    const double median = *middle;

    std::vector<SizeOutlier> outliers;
    for (size_t i = 0; i < sources.size(); ++i)
    {
        const double side = double{formats::largestSide(assets->span()[i])};
        if (side > 0 && (side >= kOutlierFactor * median || side * kOutlierFactor <= median))
            outliers.push_back({i, outlierWarning(sources[i], side, median, sides.size())});
    }
    return outliers;
}

} // namespace hearth::command
