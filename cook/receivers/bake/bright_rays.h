// Spreads the light of rays that meet something small and bright, such as the inside of a lampshade, over the
// texels around: few rays meet it, and those that do would leave bright specks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/gather_table.h"

namespace hearth::receivers
{

/// Texels each way over which the light of bright rays is spread.
inline constexpr int32_t kSpreadTexels = 12;

/// Light of a ray, over the mean of the texel's rays, above which it is spread.
inline constexpr float kBrightRay = 4;

/// Rays of a texel up to which all light that they alone bring is spread, and from which on none of it:
/// what many rays meet has little noise, and shadows of its own.
inline constexpr uint32_t kFewBrightRays = 4, kManyBrightRays = 8;

/// Light of a ray, over that of the ray of rank kManyBrightRays, above which it is spread: a lit wall that
/// many rays meet keeps its shape, and does not hide a speck.
inline constexpr float kBrightRank = 2;

/// Gather the light of all texels: the mean over the rays of each of what elements send out that they meet, 0
/// for those that meet none. Spread that of bright rays over texels of the same surface. Does not depend on
/// the number of threads.
/// domains      of the elements
/// outgoing     [elements][light_count][3] of light that elements send out, over 1 / pi
/// light_count  1 to kLightGroup
/// sky          number of the sky among the lights: its rays that meet nothing count, too; or kInvalidIndex
/// returns      [texels][light_count][3]
std::vector<float> gatherTexels(const BakeScene& scene, std::span<const TexelDomain> domains,
                                const GatherTable& table, std::span<const float> outgoing, size_t light_count,
                                size_t sky);

} // namespace hearth::receivers
