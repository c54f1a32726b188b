// Iterates the light of elements, bounce by bounce, for some lights at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/bounce_tiles.h"

namespace hearth::receivers
{

/// Lights that are computed at once: their values of an element lie side by side, so that a gather ray costs
/// two cache lines for all of them.
inline constexpr size_t kLightGroup = 8;

/// Irradiance of each texel under each light of a group, 3 values each. Of suns it is what arrives after a
/// bounce: a game draws their own light with sharp shadows.
struct GroupLight
{
    std::vector<float> irradiance;
    uint64_t shadow_rays = 0;
};

/// Compute irradiance E = D + G(albedo E), with D of the lights and G the mean of a gather table: the limit
/// of as many bounces as asked for, or as many as change a tile by more than kSettled of its value. All but
/// the last are between tiles (BounceTiles). The last one is between elements, and spreads what few rays meet
/// (gatherTexels). Does not depend on the number of threads.
/// domains       of the elements
/// first, count  lights of the scene, 1 to kLightGroup
GroupLight computeLight(const BakeScene& scene, const BakeRays& rays, const Elements& elements,
                        std::span<const TexelDomain> domains, const GatherTable& table,
                        const BounceTiles& tiles, size_t first, size_t count, uint32_t bounces);

/// Share of a tile's light below which a bounce ends the iteration.
inline constexpr float kSettled = 0.0003f;

} // namespace hearth::receivers
