// The sky that lights every scene (formats/gpu_shared/sky.h). Needs scene/light_block.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/light_cone.h"
#include "runtime/shaders/scene/sky_rows.glsl"
#include "runtime/shaders/shade/shading_tables.glsl"

// radiance as lobes of each roughness reflect it, over skyImageFactor; its largest texel is beyond mediump
layout(set = kSetScene, binding = kSceneSkyCube) uniform samplerCube sky_cube;

// Largest radiance of a reflection: half of what mediump holds.
const float kMaxMirrorRadiance = 32768.0;

// Mean radiance of the gradient over a cone.
mediump vec3 skyConeRadiance(LightCone cone)
{
    const mediump vec2 nodes = vec2(kSkyTableHeights, kSkyTableAngles);
    // node (height, half-angle)
    mediump vec2 node = skyTableCoordinates(cone.axis.y, cone.cos_half_angle) * (nodes - 1.0);
    vec2 at = (node + vec2(0.5, 0.5 + float(kSkyTableRow))) / kShadingTablesSize;
    return skyMeanRadiance(sceneSky(), textureLod(shading_tables, at, 0.0).rg); // one mip
}

// Radiance from a direction, as the camera sees it.
vec3 skyBackground(vec3 direction)
{
    Sky sky = sceneSky();
    if (!hasSkyImage(sky))
        return skyRadiance(sky, direction);
    // texels of a pixel: sharp mips alone are filtered for that
    float side = float(textureSize(sky_cube, 0).x);
    vec3 across = max(abs(dFdx(direction)), abs(dFdy(direction)));
    float lod = log2(max(max(across.x, max(across.y, across.z)) * 0.5 * side, 1.0));
    return skyImageFactor(sky) * textureLod(sky_cube, direction, min(lod, float(skyImageSharpMips(sky)))).rgb;
}

// Mean radiance over a wide cone: of the diffuse part or of sheen.
mediump vec3 skyDiffuse(LightCone cone)
{
    Sky sky = sceneSky();
    return hasSkyImage(sky) ? skyImageConeRadiance(sky, cone.axis, cone.cos_half_angle) : skyConeRadiance(cone);
}

// Cone from which a lobe gets the light of the sky, under an open one.
// mirror  reflection of the view direction at the normal, unit
LightCone skyLobeCone(LobeTotal lobe, vec3 mirror, vec3 normal, mediump float roughness, mediump float n_dot_v)
{
    LightCone cone = lobeCone(lobe, mirror, normal);
    if (hasSkyImage(sceneSky()))
    {
        mediump float turn = skyLobe(roughness, n_dot_v).turn;
        cone.axis = normalize(mirror * (1.0 - turn) + normal * turn);
    }
    return cone;
}

// Mean radiance over the visible part of a lobe. A part of the lobe sees what a smaller roughness would:
// alpha, the square of the roughness, is about in proportion to the half-angle.
// open     cone of the whole lobe
// diffuse  mean radiance of the diffuse part
mediump vec3 skyMirror(LightCone visible, LightCone open, mediump float roughness, mediump float n_dot_v,
                       mediump vec3 diffuse)
{
    Sky sky = sceneSky();
    if (!hasSkyImage(sky))
        return skyConeRadiance(visible);
    SkyLobe lobe = skyLobe(roughness, n_dot_v);
    mediump float share = (1.0 - visible.cos_half_angle) / max(1.0 - open.cos_half_angle, 1e-4);
    mediump float part = lobe.roughness * sqrt(sqrt(clamp(share, 0.0, 1.0)));
    float first = float(skyImageSharpMips(sky));
    float last = float(textureQueryLevels(sky_cube)) - 1.0 - first;
    float lod = first + last * part * (2.0 - part); // formats/records/probe.h
    mediump vec3 narrow = min(skyImageFactor(sky) * textureLod(sky_cube, visible.axis, lod).rgb, kMaxMirrorRadiance);
    mediump vec3 wide = mix(diffuse, 0.28209479 * skyImageHarmonic(sky, 0u), lobe.even);
    return mix(narrow, wide, lobe.wide);
}
