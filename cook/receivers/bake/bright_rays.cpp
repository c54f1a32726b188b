// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bright_rays.h"

#include "cook/receivers/bake/bounces.h"
#include "cook/receivers/bake/surface_texels.h"
#include "formats/base/index.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hearth::receivers
{

namespace
{

/// Rounds in which the mean of rays that are no brighter than kBrightRay times it is found.
constexpr int kMeanRounds = 6;

/// Three of each light of a group. Loops over all of them, used or not, are vector instructions.
using Values = std::array<float, 3 * kLightGroup>;

/// Values that the rays of a texel bring.
using RayValues = std::array<Values, kElementRays>;

/// Means of values: those of bright rays which are spread, and the rest.
struct SplitMean
{
    Values regular, bright;
};

/// Values of the brightest rays, each channel in falling order.
using BrightestValues = std::array<Values, kManyBrightRays>;

BrightestValues findBrightest(const RayValues& values, uint32_t count)
{
    BrightestValues brightest{};
    for (uint32_t i = 0; i < count; ++i)
    {
        Values value = values[i];
        for (Values& rank : brightest)
            for (size_t k = 0; k < value.size(); ++k)
            {
                const float larger = std::max(rank[k], value[k]);
                value[k] = std::min(rank[k], value[k]);
                rank[k] = larger;
            }
    }
    return brightest;
}

/// Return the part that is spread of light which so many rays bring.
constexpr float spreadShare(uint32_t rays)
{
    return std::clamp((static_cast<float>(kManyBrightRays) - static_cast<float>(rays)) /
                          (kManyBrightRays - kFewBrightRays),
                      0.0f, 1.0f);
}

SplitMean splitMean(const RayValues& values, uint32_t count)
{
    const float share = 1 / static_cast<float>(count);
    Values all{}, largest{};
    for (uint32_t i = 0; i < count; ++i)
        for (size_t k = 0; k < all.size(); ++k)
        {
            all[k] += values[i][k];
            largest[k] = std::max(largest[k], values[i][k]);
        }
    bool has_bright = false;
    for (size_t k = 0; k < all.size(); ++k)
    {
        all[k] *= share;
        has_bright |= largest[k] > kBrightRay * all[k];
    }
    if (!has_bright)
        return {all, {}};
    Values mean = all;
    for (int round = 0; round < kMeanRounds; ++round)
    {
        Values sum{};
        for (uint32_t i = 0; i < count; ++i)
            for (size_t k = 0; k < sum.size(); ++k)
                sum[k] += std::min(values[i][k], kBrightRay * mean[k]);
        for (size_t k = 0; k < sum.size(); ++k)
            mean[k] = sum[k] * share;
    }
    const BrightestValues brightest = findBrightest(values, count);
    SplitMean split{{}, {}};
    for (uint32_t rays = 1; rays < kManyBrightRays; ++rays)
        for (size_t k = 0; k < all.size(); ++k)
        {
            // light between two ranks is brought by all rays of higher ranks
            const float limit = std::max(kBrightRay * mean[k], kBrightRank * brightest.back()[k]);
            const float step = std::max(brightest[rays - 1][k], limit) - std::max(brightest[rays][k], limit);
            split.bright[k] += share * spreadShare(rays) * static_cast<float>(rays) * step;
        }
    for (size_t k = 0; k < all.size(); ++k)
    {
        split.bright[k] = std::min(split.bright[k], all[k]);
        split.regular[k] = all[k] - split.bright[k];
    }
    return split;
}

/// Elements that the open rays of an element meet.
struct OpenRays
{
    std::array<uint32_t, kElementRays> hits;
    uint32_t count = 0, missed = 0;
};

OpenRays listOpenRays(const GatherTable& table, size_t element)
{
    OpenRays rays;
    for (uint32_t point = 0; point < kTexelPoints; ++point)
        if ((table.openPoints(element) >> point & 1u) != 0)
            for (const uint32_t hit : table.hits(element).subspan(point * kPointRays, kPointRays))
            {
                rays.missed += hit == kInvalidIndex ? 1 : 0;
                rays.hits[rays.count++] = hit;
            }
    return rays;
}

/// Texels of a rectangle in the open, by their cells.
class CellGrid
{
public:
    CellGrid(const TexelDomain& domain, const GatherTable& table, uint32_t first)
        : width_(static_cast<int32_t>(domain.width)),
          height_(static_cast<int32_t>(domain.height)),
          texels_(size_t{domain.width} * domain.height, kInvalidIndex)
    {
        for (uint32_t i = 0; i < domain.texels.size(); ++i)
            if (table.openPoints(first + i) != 0)
                texels_[size_t{domain.texels[i].y} * domain.width + domain.texels[i].x] = first + i;
    }

    /// Call visit(texel, distance) for the texels around a cell and that of the cell; distances are in cells.
    /// Each must be reached from the cell across the edges of texels that count: no light goes through walls.
    /// counts  is called with a texel and its distance
    template <typename Counts, typename Visit>
    void visitAround(int32_t x, int32_t y, const Counts& counts, const Visit& visit) const
    {
        constexpr int32_t kSide = 2 * kSpreadTexels + 1;
        std::array<bool, size_t{kSide} * kSide> is_known{};
        std::array<std::pair<int32_t, int32_t>, is_known.size()> reached;
        size_t count = 0;
        const auto reach = [&](int32_t dx, int32_t dy)
        {
            const int32_t squared = dx * dx + dy * dy;
            if (squared > kSpreadTexels * kSpreadTexels)
                return;
            bool& known = is_known[static_cast<size_t>((dy + kSpreadTexels) * kSide + dx + kSpreadTexels)];
            const uint32_t texel = std::exchange(known, true) ? kInvalidIndex : find(x + dx, y + dy);
            const float distance = std::sqrt(static_cast<float>(squared));
            if (texel == kInvalidIndex || !counts(texel, distance))
                return;
            visit(texel, distance);
            reached[count++] = {dx, dy};
        };
        reach(0, 0);
        for (size_t i = 0; i < count; ++i)
        {
            const auto [dx, dy] = reached[i];
            reach(dx - 1, dy);
            reach(dx + 1, dy);
            reach(dx, dy - 1);
            reach(dx, dy + 1);
        }
    }

private:
    uint32_t find(int32_t x, int32_t y) const
    {
        return x < 0 || y < 0 || x >= width_ || y >= height_
                   ? kInvalidIndex
                   : texels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
    }

    int32_t width_, height_;
    std::vector<uint32_t> texels_;
};

/// Light of texels by kinds of rays: [texels][3 of each light].
struct SplitLight
{
    std::vector<float> regular, bright;
    std::vector<uint8_t> has_bright; ///< [texels]
};

/// count  values of an element
void splitTexel(const GatherTable& table, std::span<const float> outgoing, size_t count, size_t sky,
                size_t texel, SplitLight& light)
{
    const OpenRays rays = listOpenRays(table, texel);
    if (rays.count == 0)
        return;
    Values missed{};
    if (sky != kInvalidIndex && rays.missed > 0)
        for (size_t c = 0; c < 3; ++c)
            missed[3 * sky + c] = table.skyIrradiance(texel)[static_cast<int>(c)] *
                                  static_cast<float>(rays.count) / static_cast<float>(rays.missed);
    RayValues values;
    for (uint32_t i = 0; i < rays.count; ++i)
    {
        values[i] = missed;
        if (rays.hits[i] != kInvalidIndex)
            std::copy_n(&outgoing[rays.hits[i] * count], count, values[i].begin());
    }
    const SplitMean mean = splitMean(values, rays.count);
    for (size_t k = 0; k < count; ++k)
    {
        light.regular[texel * count + k] = mean.regular[k];
        light.bright[texel * count + k] = mean.bright[k];
        light.has_bright[texel] |= mean.bright[k] > 0 ? 1 : 0;
    }
}

/// Numbers of bright texels in rectangles of cells.
class BrightCells
{
public:
    BrightCells(const TexelDomain& domain, uint32_t first, const SplitLight& split)
        : width_(domain.width), height_(domain.height), sums_(size_t{width_ + 1} * (height_ + 1))
    {
        for (uint32_t i = 0; i < domain.texels.size(); ++i)
            at(domain.texels[i].x + 1u, domain.texels[i].y + 1u) = split.has_bright[first + i];
        for (uint32_t y = 1; y <= height_; ++y)
            for (uint32_t x = 1; x <= width_; ++x)
                at(x, y) += at(x - 1, y) + at(x, y - 1) - at(x - 1, y - 1);
    }

    /// Return whether a texel within kSpreadTexels of a cell, each way, is bright.
    bool isAnyNear(uint32_t x, uint32_t y) const
    {
        constexpr auto kReach = static_cast<uint32_t>(kSpreadTexels);
        const uint32_t left = x - std::min(x, kReach), right = std::min(x + kReach + 1, width_);
        const uint32_t low = y - std::min(y, kReach), high = std::min(y + kReach + 1, height_);
        return at(right, high) - at(left, high) - at(right, low) + at(left, low) != 0;
    }

private:
    uint32_t at(uint32_t x, uint32_t y) const { return sums_[size_t{y} * (width_ + 1) + x]; }
    uint32_t& at(uint32_t x, uint32_t y) { return sums_[size_t{y} * (width_ + 1) + x]; }

    uint32_t width_, height_;
    std::vector<uint32_t> sums_; ///< over all cells before a column and a row
};

/// Texels of an instance, by which its bright light is spread.
class Surface
{
public:
    Surface(const BakeScene& scene, const TexelDomain& domain, const GatherTable& table,
            const SplitLight& split, uint32_t first)
        : domain_(domain),
          split_(split),
          first_(first),
          grid_(domain, table, first),
          bright_(domain, first, split),
          texels_(scene, domain)
    {
    }

    /// Add the mean of the bright light around a texel to its light.
    /// number  of a texel of the domain in the open
    void spread(size_t number, size_t count, std::vector<float>& light) const
    {
        if (!bright_.isAnyNear(domain_.texels[number].x, domain_.texels[number].y))
            return;
        float weights = 0;
        Values sums{};
        grid_.visitAround(
            domain_.texels[number].x, domain_.texels[number].y,
            [&](uint32_t texel, float distance) { return texels_.areNear(number, texel - first_, distance); },
            [&](uint32_t texel, float distance)
            {
                const float weight = 1 - distance / (kSpreadTexels + 1);
                weights += weight;
                if (split_.has_bright[texel] == 0)
                    return;
                for (size_t k = 0; k < count; ++k)
                    sums[k] += split_.bright[texel * count + k] * weight;
            });
        for (size_t k = 0; k < count; ++k)
            light[(first_ + number) * count + k] += sums[k] / weights;
    }

private:
    const TexelDomain& domain_;
    const SplitLight& split_;
    uint32_t first_;
    CellGrid grid_;
    BrightCells bright_;
    SurfaceTexels texels_;
};

using Blocks = tbb::blocked_range<size_t>;

} // namespace

std::vector<float> gatherTexels(const BakeScene& scene, std::span<const TexelDomain> domains,
                                const GatherTable& table, std::span<const float> outgoing, size_t light_count,
                                size_t sky)
{
    const size_t count = 3 * light_count;
    size_t texels = 0;
    for (const TexelDomain& domain : domains)
        texels += domain.texels.size();
    SplitLight split{std::vector<float>(texels * count), std::vector<float>(texels * count),
                     std::vector<uint8_t>(texels)};
    tbb::parallel_for(Blocks(0, texels, 64),
                      [&](const Blocks& range)
                      {
                          for (size_t texel = range.begin(); texel != range.end(); ++texel)
                              splitTexel(table, outgoing, count, sky, texel, split);
                      });
    std::vector<float> light = split.regular;
    uint32_t first = 0;
    for (const TexelDomain& domain : domains)
    {
        const Surface surface(scene, domain, table, split, first);
        tbb::parallel_for(Blocks(0, domain.texels.size(), 64),
                          [&](const Blocks& range)
                          {
                              for (size_t number = range.begin(); number != range.end(); ++number)
                                  if (table.openPoints(first + number) != 0)
                                      surface.spread(number, count, light);
                          });
        first += static_cast<uint32_t>(domain.texels.size());
    }
    return light;
}

} // namespace hearth::receivers
