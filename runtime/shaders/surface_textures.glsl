// The textures of a material at a surface. Which textures there are, and which UV sets they use, is fixed when the
// pipeline is made: a scene has few such combinations, and what is not there costs nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

layout(constant_id = 1) const uint kTextures = 0u; // as Material.textures
layout(constant_id = 2) const uint kUvSets = 0u;   // as Material.uv_sets

bool hasTexture(uint slot) { return (kTextures >> slot & 1u) != 0u; }

uint uvSetOf(uint slot) { return kUvSets >> (slot * 4u) & 15u; }

// The coordinates that each texture uses; those of one set are read once.
struct SurfaceUvs
{
    SurfaceUv slots[kTextureCount];
};

SurfaceUvs surfaceUvs(Surface s)
{
    SurfaceUvs uvs;
    SurfaceUv none = SurfaceUv(vec2(0.0), vec2(0.0), vec2(0.0));
    for (uint slot = 0u; slot < kTextureCount; ++slot)
    {
        uvs.slots[slot] = none;
        if (!hasTexture(slot))
            continue;
        bool known = false;
        for (uint before = 0u; before < slot; ++before)
            if (hasTexture(before) && uvSetOf(before) == uvSetOf(slot) && !known)
            {
                uvs.slots[slot] = uvs.slots[before];
                known = true;
            }
        if (!known)
            uvs.slots[slot] = surfaceUv(s, uvSetOf(slot));
    }
    return uvs;
}

// (1, 1, 1, 1) where the material has no such texture.
vec4 sampleSurface(Surface s, SurfaceUvs uvs, uint slot, sampler2D image)
{
    if (!hasTexture(slot))
        return vec4(1.0);
    SurfaceUv at = uvs.slots[slot];
    return textureGrad(image, transformUv(slot, at.uv), transformUvVector(slot, at.dx), transformUvVector(slot, at.dy));
}

// Unit, world axes, towards the side that is seen.
vec3 shadingNormal(Surface s, SurfaceUvs uvs)
{
    vec3 normal = smoothNormal(s);
    if (hasTexture(kTextureNormal))
    {
        vec3 mapped = sampleSurface(s, uvs, kTextureNormal, normal_texture).xyz * 2.0 - 1.0;
        mapped.xy *= material.normal_scale;
        vec3 tangent, bitangent;
        tangentFrame(s, normal, uvSetOf(kTextureNormal), tangent, bitangent);
        normal = normalizeOr(tangent * mapped.x + bitangent * mapped.y + normal * mapped.z, normal);
    }
    return s.front ? normal : -normal;
}
