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

/// Return the greatest of each light's values, at least above 0.
std::vector<float> findGreatest(const std::vector<float>& values, size_t count)
{
    std::vector<float> greatest(count, std::numeric_limits<float>::min());
    for (size_t i = 0; i < values.size(); ++i)
        greatest[i / 3 % count] = std::max(greatest[i / 3 % count], values[i]);
    return greatest;
}

/// Set the light that elements send out, over 1 / pi: albedo times irradiance.
void reflectFrom(size_t element, const Elements& elements, size_t count, const float* irradiance,
                 std::vector<float>& outgoing)
{
    const Float3 albedo = elements.albedos()[element];
    for (size_t k = 0; k < 3 * count; ++k)
        outgoing[element * 3 * count + k] =
            irradiance[k] * std::min(albedo[static_cast<int>(k % 3)], shared::kMaxBrickAlbedo);
}

} // namespace

GroupLight computeLight(const BakeScene& scene, const BakeRays& rays, const Elements& elements,
                        std::span<const TexelDomain> domains, const GatherTable& table, size_t first,
                        size_t count, uint32_t bounces)
{
    HEARTH_ASSERT(count > 0 && count <= kLightGroup && first + count <= scene.lightCount());
    GroupLight light;
    const std::vector<float> direct =
        computeDirect(scene, rays, elements, table, first, count, light.shadow_rays);
    std::vector<float> irradiance = direct;
    // what elements sent out before the last bounce, and what they send out after it
    std::vector<float> before(direct.size()), after(direct.size());
    for (size_t element = 0; element < elements.list().size(); ++element)
        reflectFrom(element, elements, count, &direct[element * 3 * count], after);
    const std::vector<float> greatest = findGreatest(direct, count);
    bool is_settled = false;
    for (uint32_t bounce = 0; bounce < bounces && !is_settled; ++bounce)
    {
        before.swap(after);
        std::atomic<bool> has_changed = false;
        tbb::parallel_for(Blocks(0, elements.list().size(), 256),
                          [&](const Blocks& range)
                          {
                              std::array<float, 3 * kLightGroup> mean;
                              bool changed = false;
                              for (size_t element = range.begin(); element != range.end(); ++element)
                              {
                                  table.gather(element, before, 3 * count, mean.data());
                                  float* values = &irradiance[element * 3 * count];
                                  for (size_t k = 0; k < 3 * count; ++k)
                                  {
                                      const float value = direct[element * 3 * count + k] + mean[k];
                                      changed |= std::abs(value - values[k]) >
                                                 kSettled * value + kDark * kSettled * greatest[k / 3];
                                      values[k] = value;
                                  }
                                  reflectFrom(element, elements, count, values, after);
                              }
                              if (changed)
                                  has_changed = true;
                          });
        is_settled = !has_changed;
    }
    const bool has_sky = scene.isSky(first + count - 1);
    light.irradiance =
        gatherTexels(scene, domains, table, before, count, has_sky ? count - 1 : kInvalidIndex);
    for (size_t i = 0; i < light.irradiance.size(); ++i)
        if (const size_t number = first + i / 3 % count; !scene.isSun(number) && !scene.isSky(number))
            light.irradiance[i] += direct[i];
    return light;
}

} // namespace hearth::receivers
