// A point of a surface as shading sees it, however it was found, and the textures of its material there. Which textures
// there are, and which UV sets they use, is fixed when the pipeline is made: a scene has few such combinations, and what
// is not there costs nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/visibility_cone.h"

layout(constant_id = 1) const uint kTextures = 0u; // as Material.textures
layout(constant_id = 2) const uint kUvSets = 0u;   // as Material.uv_sets
layout(constant_id = 5) const bool kSkyVisibility = false; // some of its meshes say what they see of the sky

struct SurfacePoint
{
    vec3 position;  // relative to the eye
    vec3 normal;    // unit, world axes, on the front side; not yet bent by the normal map
    vec3 flat_normal; // unit, world axes, of the triangle, towards the side that is seen
    vec3 tangent;   // unit, world axes; only where the material has a normal map
    vec3 bitangent;
    vec3 color;     // of the vertices
    bool front;     // the side that is seen
    VisibilityMoments sky; // of what is seen of the sky: world axes, towards the side that is seen
};

struct SurfaceUv
{
    vec2 uv;
    vec2 dx; // per pixel
    vec2 dy;
};

// The coordinates that each texture uses.
struct SurfaceUvs
{
    SurfaceUv slots[kTextureCount];
};

bool hasTexture(uint slot) { return (kTextures >> slot & 1u) != 0u; }

uint uvSetOf(uint slot) { return kUvSets >> (slot * 4u) & 15u; }

// Nothing hides the sky from the side of the normal.
VisibilityMoments openSky(vec3 normal) { return VisibilityMoments(2.0 * kVisibilityPi, normal * kVisibilityPi); }

// `v`, or `fallback` where v is too short to have a direction.
vec3 normalizeOr(vec3 v, vec3 fallback)
{
    float len2 = dot(v, v);
    return len2 > 1e-30 ? v * inversesqrt(len2) : fallback;
}

// Tangent and bitangent (unit) from any vector along the tangent; side: -1 where the bitangent is flipped.
void completeFrame(vec3 normal, vec3 along, float side, out vec3 tangent, out vec3 bitangent)
{
    vec3 across = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    tangent = normalizeOr(along, normalize(cross(normal, across)));
    bitangent = normalizeOr(cross(normal, tangent), across) * side;
}

// (1, 1, 1, 1) where the material has no such texture.
vec4 sampleSurface(SurfaceUvs uvs, uint slot, sampler2D image)
{
    if (!hasTexture(slot))
        return vec4(1.0);
    SurfaceUv at = uvs.slots[slot];
    return textureGrad(image, transformUv(slot, at.uv), transformUvVector(slot, at.dx), transformUvVector(slot, at.dy));
}

// Perceptual. Below 0.045 the highlight of a punctual light is smaller than half floats resolve.
float surfaceRoughness(vec4 metallic_roughness) { return clamp(material.roughness * metallic_roughness.g, 0.045, 1.0); }

// Of the angle between normal and eye, as the material model takes it.
float clampedCosine(vec3 normal, vec3 to_eye) { return clamp(abs(dot(normal, to_eye)), 1e-4, 1.0); }

// Unit, world axes, towards the side that is seen.
vec3 shadingNormal(SurfacePoint point, SurfaceUvs uvs)
{
    vec3 normal = point.normal;
    if (hasTexture(kTextureNormal))
    {
        vec3 mapped = sampleSurface(uvs, kTextureNormal, normal_texture).xyz * 2.0 - 1.0;
        mapped.xy *= material.normal_scale;
        normal = normalizeOr(point.tangent * mapped.x + point.bitangent * mapped.y + normal * mapped.z, normal);
    }
    return point.front ? normal : -normal;
}
