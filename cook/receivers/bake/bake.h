// Bakes the irradiance that each light of a scene causes at the texels of its instances, all bounces
// included, so that a game can weigh the lights as it likes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/atlas_layout.h"
#include "cook/receivers/bake/bake_scene.h"

namespace hearth::receivers
{

inline constexpr double kMinTexelsPerMetre = 1.0 / 1024, kMaxTexelsPerMetre = 1024;
inline constexpr uint32_t kMaxBounces = 256;

struct BakeSettings
{
    double texels_per_metre = 16; ///< kMinTexelsPerMetre to kMaxTexelsPerMetre
    float patch_size = 0.25f;     ///< metres: light of surfaces without texels (Elements)
    uint32_t bounces = 32;        ///< at most; fewer where light no longer changes. 0: direct light alone
};

/// Texel of the atlas that has light.
struct BakedTexel
{
    uint16_t x = 0, y = 0; ///< in the atlas
    bool is_copy = false;  ///< of a texel beside it: no surface has it, or all of that is inside of a wall
    uint32_t instance = 0;
    Float3 position; ///< world, of the surface at the texel's centre, or the surface's nearest point to it
    Float3 normal;   ///< unit, of the smooth surface
};

/// Rectangle of an instance.
struct InstanceRectangle
{
    RectangleSize size; ///< 0 without texels
    AtlasPlace place;
    UvCheck uvs; ///< why it has none
};

struct BakedReceivers
{
    uint32_t width = 0, height = 0;            ///< of the atlas
    std::vector<InstanceRectangle> rectangles; ///< of the scene's instances
    std::vector<BakedTexel> texels;            ///< by rows of the atlas
    size_t light_count = 0;
    /// Linear Rec.709, of each texel, and of each light of the scene in its order: for a lamp of I candela at
    /// d metres I cos / d^2 before bounces; for a sun bounces alone.
    std::vector<Float3> irradiance;
    uint64_t shadow_rays = 0, gather_rays = 0;

    std::span<const Float3> light(size_t texel) const
    {
        return std::span(irradiance).subspan(texel * light_count, light_count);
    }
};

/// Bake all lights. The result does not depend on the number of threads. Memory: about 350 bytes for an
/// element (texel or patch), 500 for eight of the lights, and the result.
/// returns  nullopt if the rectangles do not fit into an atlas
std::optional<BakedReceivers> bakeReceivers(const BakeScene& scene, const BakeSettings& settings);

} // namespace hearth::receivers
