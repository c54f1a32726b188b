// Surface point as shading sees it, and the textures of its material. The present textures and their UV sets
// are specialization constants: a scene has few combinations, and absent textures cost nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/specialization.h"
#include "formats/gpu_shared/visibility_cone.h"
#include "runtime/shaders/scene/directions.glsl"

layout(constant_id = kConstantTextures) const uint kTextures = 0u;
layout(constant_id = kConstantUvSets) const uint kUvSets = 0u;
layout(constant_id = kConstantSkyVisibility) const bool kSkyVisibility = false;

// Light of a point from the atlas of receivers (receivers.glsl).
struct ReceivedLight
{
    bool is_known; // the diffuse light is that of the atlas, in place of baked lamps and of surroundings
    mediump vec3 mean_radiance; // irradiance / pi
    mediump vec3 emission_weight; // of the instance
};
const ReceivedLight kNoReceivedLight = ReceivedLight(false, vec3(0.0), vec3(1.0));

struct SurfacePoint
{
    vec3 position;  // relative to the eye
    vec3 normal;    // unit, world axes, on the front side; before normal mapping
    vec3 flat_normal; // unit, world axes, of the triangle, towards the visible side
    float error;    // metres, bounds the distance of the triangle to the source
    vec3 tangent;   // unit, world axes; where the material or its clear coat has a normal map, or a function
    vec3 bitangent;
    mediump vec3 color; // vertex colour
    bool front;     // the front side is visible
    VisibilityMoments sky; // sky visibility: world axes, towards the visible side
    uint instance;
    uint slot; // of the visible list
    ReceivedLight received;
#ifdef HEARTH_MATERIAL_FUNCTIONS
    vec3 position_dx; // per pixel
    vec3 position_dy;
#endif
};

struct SurfaceUv
{
    vec2 uv;
    vec2 dx; // per pixel
    vec2 dy;
};

// UV sets that a vertex may have.
const uint kUvSetCount = 4u;

// UV coordinates of each UV set that a texture uses.
struct SurfaceUvs
{
    SurfaceUv sets[kUvSetCount];
};

bool hasTexture(uint slot) { return (kTextures >> slot & 1u) != 0u; }

uint textureUvSet(uint slot) { return uvSet(kUvSets, slot); }

// True if a texture of the material uses a UV set: a constant of each pipeline.
bool usesUvSet(uint set)
{
#ifdef HEARTH_MATERIAL_FUNCTIONS
    bool uses = set == 0u; // material functions may read it
#else
    bool uses = false;
#endif
    for (uint slot = 0u; slot < kTextureCount; ++slot)
        uses = uses || (hasTexture(slot) && textureUvSet(slot) == set);
    return uses;
}

// Visibility of an unoccluded sky on the side of the normal.
VisibilityMoments openSky(mediump vec3 normal) { return VisibilityMoments(2.0 * kVisibilityPi, normal * kVisibilityPi); }

// Compute tangent and bitangent (unit) from any vector along the tangent. side: -1 if the bitangent is
// flipped.
void completeFrame(vec3 normal, vec3 along, float side, out vec3 tangent, out vec3 bitangent)
{
    vec3 across = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    tangent = normalizeOr(along, normalize(cross(normal, across)));
    bitangent = normalizeOr(cross(normal, tangent), across) * side;
}

// Sample a texture of the material; (1, 1, 1, 1) if the material does not have it.
vec4 sampleSurface(SurfaceUvs uvs, uint slot, sampler2D image)
{
    if (!hasTexture(slot))
        return vec4(1.0);
    SurfaceUv at = uvs.sets[textureUvSet(slot)];
    return textureGrad(image, transformUv(slot, at.uv), transformUvVector(slot, at.dx), transformUvVector(slot, at.dy));
}

// Perceptual roughness. Below 0.045 the highlight of a punctual light is smaller than half floats resolve.
float clampRoughness(float roughness) { return clamp(roughness, 0.045, 1.0); }

float surfaceRoughness(vec4 metallic_roughness) { return clampRoughness(material.roughness * metallic_roughness.g); }

// Normal on the front side with a normal map applied: unit, world axes.
// texel  of the map: x and y of a unit vector. Formats of two channels store no z
vec3 mappedNormal(SurfacePoint point, vec2 texel, float scale)
{
    vec2 slope = texel * 2.0 - 1.0;
    vec3 mapped = vec3(slope * scale, sqrt(max(0.0, 1.0 - dot(slope, slope))));
    return normalizeOr(point.tangent * mapped.x + point.bitangent * mapped.y + point.normal * mapped.z, point.normal);
}

// Shading normal with the normal map applied: unit, world axes, towards the visible side.
vec3 shadingNormal(SurfacePoint point, SurfaceUvs uvs)
{
    vec3 normal = point.normal;
    if (hasTexture(kTextureNormal))
        normal = mappedNormal(point, sampleSurface(uvs, kTextureNormal, normal_texture).xy, material.normal_scale);
    return point.front ? normal : -normal;
}
