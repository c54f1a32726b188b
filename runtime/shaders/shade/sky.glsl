// Procedural sky that lights every scene: a smooth gradient from ground over horizon to zenith. Needs the
// lighting block, which holds the radiances; the including file includes it before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

// Radiance from a direction, prefiltered for a surface of this roughness (0..1).
vec3 skyRadiance(vec3 direction, float roughness)
{
    float width = mix(0.12, 1.0, roughness);
    vec3 above = mix(lighting.sky_horizon, lighting.sky_zenith, smoothstep(-roughness, 1.0, direction.y));
    return mix(lighting.sky_ground, above, smoothstep(-width, width, direction.y));
}

// Irradiance / pi on a surface with this normal.
vec3 skyIrradiance(vec3 normal)
{
    vec3 above = mix(lighting.sky_horizon, lighting.sky_zenith, 0.5 + 0.3 * normal.y);
    return mix(lighting.sky_ground, above, 0.5 + 0.5 * normal.y);
}
