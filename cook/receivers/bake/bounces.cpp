// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bounces.h"

#include "cook/receivers/bake/bright_rays.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/assert.h"
#include "formats/gpu_shared/brick_lighting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <bit>
#include <limits>

namespace hearth::receivers
{

namespace
{

/// Seed of the shadow rays.
constexpr uint64_t kShadowSeed = 2;

/// Share of a light's greatest value below which changes count as none.
constexpr float kDark = 1e-4f;

using Blocks = tbb::blocked_range<size_t>;

std::vector<float> computeDirect(const BakeScene& scene, const BakeRays& rays, const Elements& elements,
                                 const GatherTable& table, size_t first, size_t count, uint64_t& ray_count)
{
    const DirectLight lights(scene, rays);
    std::vector<float> direct(elements.list().size() * 3 * count);
    std::atomic<uint64_t> rays_of_all = 0;
    const auto addPoint = [&](size_t element, size_t number, float share, uint64_t& traced)
    {
        const ReceivingPoint point = receivingPoint(scene, elements.list()[element], number, rays.offset);
        const uint64_t seed = sampling::deriveSeed(kShadowSeed, element * kTexelPoints + number);
        float* sums = &direct[element * 3 * count];
        for (size_t k = 0; k < count; ++k)
        {
            const Float3 light = (scene.isSky(first + k) ? table.skyIrradiance(element)
                                                         : lights.at(first + k, point, seed, traced)) *
                                 share;
            for (int channel = 0; channel < 3; ++channel)
                *sums++ += light[channel];
        }
    };
    tbb::parallel_for(Blocks(0, elements.list().size(), 64),
                      [&](const Blocks& range)
                      {
                          uint64_t traced = 0;
                          for (size_t element = range.begin(); element != range.end(); ++element)
                          {
                              const uint32_t open = table.openPoints(element);
                              for (size_t point = 0; point < kTexelPoints; ++point)
                                  if ((open >> point & 1u) != 0)
                                      addPoint(element, point, 1 / static_cast<float>(std::popcount(open)),
                                               traced);
                          }
                          rays_of_all += traced;
                      });
    ray_count = rays_of_all;
    return direct;
}

/// Values of elements or tiles: three of each light of a group.
using LightValues = std::array<float, 3 * kLightGroup>;

/// Light that tiles send out by the lights alone, and how they reflect what they receive after bounces.
struct TileSurfaces
{
    std::vector<float> sent;     ///< [tiles][3 of each light], over 1 / pi
    std::vector<float> direct;   ///< irradiance, likewise
    std::vector<Float3> albedos; ///< [tiles]
    std::vector<float> greatest; ///< of each light's direct irradiance, above 0
};

Float3 reflectance(const Elements& elements, size_t element)
{
    const Float3 albedo = elements.albedos()[element];
    return {std::min(albedo.x, shared::kMaxBrickAlbedo), std::min(albedo.y, shared::kMaxBrickAlbedo),
            std::min(albedo.z, shared::kMaxBrickAlbedo)};
}

/// Average the elements of each tile.
TileSurfaces averageTiles(const Elements& elements, const BounceTiles& tiles, std::span<const float> direct,
                          size_t count)
{
    TileSurfaces surfaces{std::vector<float>(tiles.size() * 3 * count),
                          std::vector<float>(tiles.size() * 3 * count), std::vector<Float3>(tiles.size()),
                          std::vector<float>(count, std::numeric_limits<float>::min())};
    for (size_t tile = 0; tile < tiles.size(); ++tile)
    {
        float* sent = &surfaces.sent[tile * 3 * count];
        float* irradiance = &surfaces.direct[tile * 3 * count];
        const float share = 1 / static_cast<float>(tiles.members(tile).size());
        for (const uint32_t element : tiles.members(tile))
        {
            const Float3 albedo = reflectance(elements, element);
            surfaces.albedos[tile] += albedo * share;
            for (size_t k = 0; k < 3 * count; ++k)
            {
                const float value = direct[element * 3 * count + k] * share;
                irradiance[k] += value;
                sent[k] += value * albedo[static_cast<int>(k % 3)];
            }
        }
        for (size_t k = 0; k < 3 * count; ++k)
            surfaces.greatest[k / 3] = std::max(surfaces.greatest[k / 3], irradiance[k]);
    }
    return surfaces;
}

/// Set the mean over the rays of a tile of a value of the tiles that they meet, 0 where they meet none.
/// values  `count` of each tile
void gatherTile(const BounceTiles& tiles, size_t tile, std::span<const float> values, size_t count,
                LightValues& mean)
{
    mean.fill(0);
    for (const uint32_t hit : tiles.hits(tile))
        for (size_t k = 0; k < count && hit != kInvalidIndex; ++k)
            mean[k] += values[hit * count + k];
    const float share = 1 / static_cast<float>(tiles.hits(tile).size());
    for (float& value : mean)
        value *= share;
}

/// Return the irradiance that tiles receive by so many bounces, or as many as change one of them:
/// [tiles][3 of each light].
std::vector<float> bounceBetweenTiles(const BounceTiles& tiles, const TileSurfaces& surfaces, size_t count,
                                      uint32_t bounces)
{
    std::vector<float> received(surfaces.sent.size());
    // what tiles sent out before the last bounce, and what they send out after it
    std::vector<float> before(surfaces.sent.size()), after = surfaces.sent;
    bool is_settled = false;
    for (uint32_t bounce = 0; bounce < bounces && !is_settled; ++bounce)
    {
        before.swap(after);
        std::atomic<bool> has_changed = false;
        tbb::parallel_for(Blocks(0, tiles.size(), 256),
                          [&](const Blocks& range)
                          {
                              LightValues mean;
                              bool changed = false;
                              for (size_t tile = range.begin(); tile != range.end(); ++tile)
                              {
                                  gatherTile(tiles, tile, before, 3 * count, mean);
                                  for (size_t k = 0; k < 3 * count; ++k)
                                  {
                                      const size_t i = tile * 3 * count + k;
                                      changed |= std::abs(mean[k] - received[i]) >
                                                 kSettled * (surfaces.direct[i] + mean[k]) +
                                                     kDark * kSettled * surfaces.greatest[k / 3];
                                      received[i] = mean[k];
                                      after[i] = surfaces.sent[i] +
                                                 mean[k] * surfaces.albedos[tile][static_cast<int>(k % 3)];
                                  }
                              }
                              if (changed)
                                  has_changed = true;
                          });
        is_settled = !has_changed;
    }
    return received;
}

/// Return the light that elements send out before the last bounce, over 1 / pi: [elements][3 of each light].
std::vector<float> reflectFromElements(const Elements& elements, const BounceTiles& tiles,
                                       std::span<const float> direct, size_t count, uint32_t bounces)
{
    std::vector<float> outgoing(direct.size());
    if (bounces == 0)
        return outgoing;
    const std::vector<float> received =
        bounceBetweenTiles(tiles, averageTiles(elements, tiles, direct, count), count, bounces - 1);
    for (size_t element = 0; element < elements.list().size(); ++element)
    {
        const size_t tile = tiles.find(element);
        if (tile == kInvalidIndex)
            continue;
        const Float3 albedo = reflectance(elements, element);
        for (size_t k = 0; k < 3 * count; ++k)
            outgoing[element * 3 * count + k] =
                (direct[element * 3 * count + k] + received[tile * 3 * count + k]) *
                albedo[static_cast<int>(k % 3)];
    }
    return outgoing;
}

} // namespace

GroupLight computeLight(const BakeScene& scene, const BakeRays& rays, const Elements& elements,
                        std::span<const TexelDomain> domains, const GatherTable& table,
                        const BounceTiles& tiles, size_t first, size_t count, uint32_t bounces)
{
    HEARTH_ASSERT(count > 0 && count <= kLightGroup && first + count <= scene.lightCount());
    GroupLight light;
    const std::vector<float> direct =
        computeDirect(scene, rays, elements, table, first, count, light.shadow_rays);
    const std::vector<float> outgoing = reflectFromElements(elements, tiles, direct, count, bounces);
    const bool has_sky = scene.isSky(first + count - 1);
    light.irradiance =
        gatherTexels(scene, domains, table, outgoing, count, has_sky ? count - 1 : kInvalidIndex);
    for (size_t i = 0; i < light.irradiance.size(); ++i)
        if (const size_t number = first + i / 3 % count; !scene.isSun(number) && !scene.isSky(number))
            light.irradiance[i] += direct[i];
    return light;
}

} // namespace hearth::receivers
