// Layers of a material: another dielectric reflectance (KHR_materials_ior, KHR_materials_specular), sheen
// (KHR_materials_sheen), and a clear coat over both (KHR_materials_clearcoat). Pipelines of materials without
// them have none of this code. Include after brdf.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/sheen.h"
#include "formats/gpu_shared/specialization.h"

layout(constant_id = kConstantLayers) const uint kLayers = 0u;

layout(set = kSetMaterial, binding = kMaterialLayers, std140) uniform LayersBlock { MaterialLayers material_layers; };
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureSpecular) uniform mediump sampler2D specular_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureClearcoat) uniform mediump sampler2D clearcoat_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureClearcoatNormal) uniform sampler2D clearcoat_normal_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureSheen) uniform mediump sampler2D sheen_texture;

// Sheen and clear coat at a point; only those that the material has are set.
struct Layers
{
    mediump vec3 sheen_color;
    mediump float sheen_roughness; // perceptual
    SheenTotal sheen;
    vec3 coat_normal; // unit, towards the visible side
    float coat_roughness; // perceptual
    float coat_n_dot_v;
    LobeTotal coat_lobe;
    mediump float clearcoat; // strength
    mediump float coat_albedo; // share of constant light that the coat reflects
};

bool hasLayer(uint layer) { return (kLayers & layer) != 0u; }

// Sample a texture of the layers; (1, 1, 1, 1) if the material does not have it.
vec4 sampleLayer(SurfaceUvs uvs, uint slot, sampler2D image)
{
    if (!hasTexture(slot))
        return vec4(1.0);
    uint row = 2u * (slot - kFirstLayerTexture);
    vec3 u = material_layers.uv_rows[row].xyz, v = material_layers.uv_rows[row + 1u].xyz;
    SurfaceUv at = uvs.sets[textureUvSet(slot)];
    vec3 uv = vec3(at.uv, 1.0);
    return textureGrad(image, vec2(dot(u, uv), dot(v, uv)), vec2(dot(u.xy, at.dx), dot(v.xy, at.dx)),
                       vec2(dot(u.xy, at.dy), dot(v.xy, at.dy)));
}

DielectricReflectance surfaceDielectric(SurfaceUvs uvs)
{
    if (!hasLayer(kLayerSpecular))
        return defaultDielectric();
    mediump vec4 specular = sampleLayer(uvs, kTextureSpecular, specular_texture);
    mediump float strength = material_layers.specular;
    return specularDielectric(material_layers.dielectric_f0 * specular.rgb, strength * specular.a);
}

Layers surfaceLayers(SurfacePoint point, SurfaceUvs uvs, Shading s)
{
    Layers layers;
    if (hasLayer(kLayerSheen))
    {
        mediump vec4 sheen = sampleLayer(uvs, kTextureSheen, sheen_texture);
        mediump vec3 color = material_layers.sheen_color;
        mediump float roughness = material_layers.sheen_roughness;
        layers.sheen_color = color * sheen.rgb;
        layers.sheen_roughness = clampSheenRoughness(roughness * sheen.a);
        mediump vec4 texel = reflectanceTexel(sheenCoordinates(layers.sheen_roughness, s.n_dot_v), 0.5 + float(kSheenTableColumn));
        layers.sheen = SheenTotal(texel.r, texel.g, texel.b);
    }
    if (hasLayer(kLayerClearcoat))
    {
        mediump vec4 coat = sampleLayer(uvs, kTextureClearcoat, clearcoat_texture);
        vec3 normal = point.normal;
        if (hasTexture(kTextureClearcoatNormal))
            normal = mappedNormal(point, sampleLayer(uvs, kTextureClearcoatNormal, clearcoat_normal_texture).xy,
                                  material_layers.clearcoat_normal_scale);
        mediump float strength = material_layers.clearcoat;
        layers.clearcoat = strength * coat.r;
        layers.coat_normal = point.front ? normal : -normal;
        layers.coat_roughness = clampRoughness(material_layers.clearcoat_roughness * coat.g);
        layers.coat_n_dot_v = clampedCosine(layers.coat_normal, s.to_eye);
        layers.coat_lobe = lobeTotal(layers.coat_roughness, layers.coat_n_dot_v);
        layers.coat_albedo = layers.clearcoat * lobeAlbedo(vec3(kDielectricF0), 1.0, layers.coat_lobe).x;
    }
    return layers;
}

// Share of light that the clear coat leaves to what is below.
mediump float belowCoat(Layers layers) { return hasLayer(kLayerClearcoat) ? 1.0 - layers.coat_albedo : 1.0; }

// Radiance with sheen on top.
// below  radiance of the surface without sheen
// light  mean radiance that arrives at the lobe
vec3 addSheen(Layers layers, vec3 below, vec3 light)
{
    return below * belowSheen(layers.sheen_color, layers.sheen) +
           layers.sheen_color * min(layers.sheen.albedo, 1.0) * light;
}

// Radiance with the clear coat on top.
// below  radiance of the surface without a coat
// light  mean radiance that arrives at the lobe
vec3 addCoat(Layers layers, vec3 below, vec3 light) { return below * belowCoat(layers) + layers.coat_albedo * light; }

// As reflected(), with all layers.
vec3 layeredLight(Shading s, Layers layers, vec3 to_light)
{
    vec3 radiance = reflected(s, to_light);
    vec3 half_vector = normalizeOr(to_light + s.to_eye, s.normal);
    if (hasLayer(kLayerSheen))
    {
        radiance *= belowSheen(layers.sheen_color, layers.sheen);
        float n_dot_l = dot(s.normal, to_light);
        if (n_dot_l > 0.0)
            radiance += layers.sheen_color *
                        (sheenLimit(layers.sheen) * n_dot_l *
                         sheenLobe(layers.sheen_roughness, dot(s.normal, half_vector), n_dot_l, s.n_dot_v));
    }
    if (hasLayer(kLayerClearcoat))
    {
        radiance *= belowCoat(layers);
        float n_dot_l = dot(layers.coat_normal, to_light);
        if (n_dot_l > 0.0)
        {
            float n_dot_h = clamp(dot(layers.coat_normal, half_vector), 0.0, 1.0);
            mediump float v_dot_h = clamp(dot(s.to_eye, half_vector), 0.0, 1.0);
            LobeTotal lobe = layers.coat_lobe;
            mediump vec3 f0 = vec3(kDielectricF0);
            mediump float several = layers.coat_albedo / onceScattered(f0, 1.0, lobe).x;
            radiance += several * fresnelSchlick(f0, 1.0, v_dot_h) * n_dot_l *
                        ggxLobe(layers.coat_roughness, n_dot_h, n_dot_l, layers.coat_n_dot_v);
        }
    }
    return radiance;
}
