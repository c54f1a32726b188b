// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/dusk.h"

#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/textures.h"
#include "sample_assets/sky.h"

namespace hearth::samples
{

namespace
{

float starBrightness(Float2 uv)
{
    const TileNoise::Cell star = TileNoise{150, 701}.cellular({uv.x, uv.y * 0.25f});
    const float size = 0.02f + 0.05f * static_cast<float>(star.hash >> 24) / 255.0f;
    return (star.hash & 7u) == 0 ? smoothstep(size * 1.6f, 0, star.nearest) : 0.0f;
}

Float4 skyColor(Float2 uv)
{
    const Float3 direction = skyDirection(uv);
    const Float3 sun = duskSunDirection();
    const float up = direction.y;
    const Float3 flat = normalize({direction.x, 0.0001f, direction.z});
    const float towards_sun = 0.5f + 0.5f * dot(flat, normalize({sun.x, 0, sun.z}));

    const Float3 zenith{0.012f, 0.022f, 0.070f}, middle{0.075f, 0.085f, 0.19f}, rose{0.30f, 0.16f, 0.20f};
    Float3 color = lerp(middle, zenith, smoothstep(0.12f, 0.75f, up));
    color = lerp(rose, color, smoothstep(0.0f, 0.22f, up));
    const float near_sun = towards_sun * towards_sun * towards_sun * towards_sun;
    const float glow = near_sun * smoothstep(0.38f, 0.0f, up);
    color = lerp(color, Float3{0.95f, 0.40f, 0.12f}, glow * 0.9f);

    // thin clouds in streaks along the horizon, lit from below on the sun's side
    const float streaks =
        TileNoise{5, 711}.fbm({uv.x, uv.y * 4.0f}, 5) + 0.25f * TileNoise{24, 712}.fbm(uv, 3);
    const float cloud =
        smoothstep(0.06f, 0.34f, streaks) * smoothstep(0.02f, 0.1f, up) * smoothstep(0.55f, 0.2f, up);
    color =
        lerp(color, lerp(Float3{0.10f, 0.08f, 0.13f}, Float3{0.85f, 0.28f, 0.16f}, near_sun), cloud * 0.55f);

    const float star = starBrightness(uv) * smoothstep(0.15f, 0.6f, up) * (1 - cloud) * (1 - glow);
    color = lerp(color, Float3{0.85f, 0.88f, 1.0f}, star * 0.8f);
    return {color.x, color.y, color.z, 1};
}

Float4 hazeColor(Float2 uv)
{
    const float haze = uv.y * (2 - uv.y);
    const Float3 c = Float3{0.055f, 0.042f, 0.075f} * (haze * haze);
    return {c.x, c.y, c.z, 1};
}

} // namespace

Float3 duskSunDirection()
{
    return normalize({0.62f, 0.20f, -0.70f});
}

void addDuskSky(Document& document, float radius)
{
    addSky(document, "dusk_sky", radius, skyColor);
}

int addDuskHillMaterial(Document& document)
{
    Material material;
    material.name = "hills";
    material.base_color = {0.055f, 0.060f, 0.042f, 1};
    material.emissive_image = add(document.images, paintColor("hill_haze", 8, 128, hazeColor));
    material.emissive = {1, 1, 1};
    return add(document.materials, material);
}

void dimReflectance(Document& document)
{
    for (Material& material : document.materials)
        if (!material.unlit)
            material.base_color = {material.base_color.x * kDuskReflectance,
                                   material.base_color.y * kDuskReflectance,
                                   material.base_color.z * kDuskReflectance, material.base_color.w};
    for (Light& light : document.lights)
        light.intensity /= kDuskReflectance;
}

} // namespace hearth::samples
