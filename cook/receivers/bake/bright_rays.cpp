// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bright_rays.h"

#include "cook/receivers/bake/bounces.h"
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

/// Least cosine between the normals of texels that share the light of bright rays.
constexpr float kSameSide = 0.8f;

/// Values of the rays of a texel, in one channel of a light.
using RayValues = std::array<float, kElementRays>;

/// Mean of values: that of bright rays which is spread, and the rest.
struct SplitMean
{
    float regular, bright;
};

SplitMean splitMean(const RayValues& values, uint32_t count)
{
    float all = 0;
    for (uint32_t i = 0; i < count; ++i)
        all += values[i];
    const float share = 1 / static_cast<float>(count);
    all *= share;
    float mean = all;
    uint32_t bright_rays = 0;
    for (int round = 0; round < kMeanRounds; ++round)
    {
        const float limit = kBrightRay * mean;
        float sum = 0;
        bright_rays = 0;
        for (uint32_t i = 0; i < count; ++i)
        {
            sum += std::min(values[i], limit);
            bright_rays += values[i] > limit ? 1u : 0u;
        }
        mean = sum * share;
    }
    if (bright_rays >= kManyBrightRays)
        return {all, 0};
    const float part = std::min(static_cast<float>(kManyBrightRays - bright_rays) /
                                    static_cast<float>(kManyBrightRays - kFewBrightRays),
                                1.0f);
    const float bright = std::max(all - mean, 0.0f) * part;
    return {all - bright, bright};
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

/// Place of a texel on its surface.
struct TexelPlace
{
    Float3 position, normal;
};

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
    const Float3 seen = table.skyIrradiance(texel);
    for (size_t k = 0; k < count; ++k)
    {
        const bool is_sky = k / 3 == sky && rays.missed > 0;
        const float missed = is_sky ? seen[static_cast<int>(k % 3)] * static_cast<float>(rays.count) /
                                          static_cast<float>(rays.missed)
                                    : 0;
        RayValues values;
        for (uint32_t i = 0; i < rays.count; ++i)
            values[i] = rays.hits[i] == kInvalidIndex ? missed : outgoing[rays.hits[i] * count + k];
        const SplitMean mean = splitMean(values, rays.count);
        light.regular[texel * count + k] = mean.regular;
        light.bright[texel * count + k] = mean.bright;
        light.has_bright[texel] |= mean.bright > 0 ? 1 : 0;
    }
}

/// Return the places of an instance's texels.
std::vector<TexelPlace> findPlaces(const BakeScene& scene, const TexelDomain& domain)
{
    std::vector<TexelPlace> places;
    for (const DomainTexel& texel : domain.texels)
    {
        Element middle;
        middle.points.fill(texel.middle);
        const ReceivingPoint point = receivingPoint(scene, middle, 0, 0);
        places.push_back({point.position, point.side});
    }
    return places;
}

/// Return the world length of a texel, the median of those between neighbours in a row.
float measureTexel(const TexelDomain& domain, std::span<const TexelPlace> places)
{
    std::vector<float> lengths;
    for (size_t i = 0; i + 1 < places.size(); ++i)
        if (domain.texels[i + 1].y == domain.texels[i].y && domain.texels[i + 1].x == domain.texels[i].x + 1)
            lengths.push_back(length(places[i + 1].position - places[i].position));
    if (lengths.empty())
        return 0;
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));
    return lengths[lengths.size() / 2];
}

/// Texels of an instance, by which its bright light is spread.
class Surface
{
public:
    Surface(const BakeScene& scene, const TexelDomain& domain, const GatherTable& table, uint32_t first)
        : domain_(domain),
          first_(first),
          grid_(domain, table, first),
          places_(findPlaces(scene, domain)),
          texel_(measureTexel(domain, places_))
    {
    }

    /// Add the mean of the bright light around a texel to its light.
    /// number  of a texel of the domain in the open
    void spread(size_t number, size_t count, const SplitLight& split, std::vector<float>& light) const
    {
        const TexelPlace& at = places_[number];
        float weights = 0;
        std::array<float, 3 * kLightGroup> sums{};
        grid_.visitAround(
            domain_.texels[number].x, domain_.texels[number].y,
            [&](uint32_t texel, float distance) { return isNear(at, places_[texel - first_], distance); },
            [&](uint32_t texel, float distance)
            {
                const float weight = 1 - distance / (kSpreadTexels + 1);
                weights += weight;
                if (split.has_bright[texel] == 0)
                    return;
                for (size_t k = 0; k < count; ++k)
                    sums[k] += split.bright[texel * count + k] * weight;
            });
        for (size_t k = 0; k < count; ++k)
            light[(first_ + number) * count + k] += sums[k] / weights;
    }

private:
    /// True if a place is on the surface around another, and not on a chart that lies beside it by chance.
    bool isNear(const TexelPlace& a, const TexelPlace& b, float distance) const
    {
        const Float3 offset = b.position - a.position;
        const float reach = 2 * texel_ * (distance + 1);
        return dot(a.normal, b.normal) >= kSameSide && dot(offset, offset) <= reach * reach &&
               std::abs(dot(offset, a.normal)) <= 0.25f * reach;
    }

    const TexelDomain& domain_;
    uint32_t first_;
    CellGrid grid_;
    std::vector<TexelPlace> places_;
    float texel_; ///< metres
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
        const Surface surface(scene, domain, table, first);
        tbb::parallel_for(Blocks(0, domain.texels.size(), 64),
                          [&](const Blocks& range)
                          {
                              for (size_t number = range.begin(); number != range.end(); ++number)
                                  if (table.openPoints(first + number) != 0)
                                      surface.spread(number, count, split, light);
                          });
        first += static_cast<uint32_t>(domain.texels.size());
    }
    return light;
}

} // namespace hearth::receivers
