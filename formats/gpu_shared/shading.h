// Materials and lights as the shading pass reads them: blocks in the layout std140. One source for C++ and
// GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SHADING_H
#define HEARTH_SHARED_SHADING_H

#include "formats/gpu_shared/debug_views.h"
#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/light_grid.h"

HEARTH_SHARED_BEGIN

HEARTH_CONSTANT uint kTextureBaseColor = 0;
HEARTH_CONSTANT uint kTextureMetallicRoughness = 1;
HEARTH_CONSTANT uint kTextureNormal = 2;
HEARTH_CONSTANT uint kTextureOcclusion = 3;
HEARTH_CONSTANT uint kTextureEmissive = 4;
/// Textures of layers follow.
HEARTH_CONSTANT uint kTextureSpecular = 5;  ///< RGB colour, A strength
HEARTH_CONSTANT uint kTextureClearcoat = 6; ///< R strength, G roughness
HEARTH_CONSTANT uint kTextureClearcoatNormal = 7;
HEARTH_CONSTANT uint kTextureSheen = 8; ///< RGB colour, A roughness
HEARTH_CONSTANT uint kTextureCount = 9;
HEARTH_CONSTANT uint kFirstLayerTexture = 5;
HEARTH_CONSTANT uint kLayerTextureCount = 4;

/// Return the UV set of a texture.
/// sets  Material::uv_sets
HEARTH_FUNCTION uint uvSet(uint sets, uint slot)
{
    return sets >> (2u * slot) & 3u;
}

/// Vectors of four parameters that a material has for its function and its motion.
HEARTH_CONSTANT uint kMaterialParameters = 4;

/// formats::MaterialRecord in the layout of a uniform block.
struct Material
{
    Float4 base_color;
    Float3 emissive;
    float alpha_cutoff;
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    uint flags;      ///< bits kMaterial* (record_values.h)
    uint alpha_mode; ///< kAlpha*
    uint textures;   ///< bit i: texture i is present
    uint uv_sets;    ///< two bits each: uvSet()
    /// Two rows for each texture but those of layers; uv = (row0 . (u, v, 1), row1 . (u, v, 1)).
    Float4 uv_rows[10];
    Float4 parameters[kMaterialParameters]; ///< of its function and its motion
    float motion_bound;                     ///< metres in object space
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

/// Bits of the layers that a material has: formats::hasSpecular(), hasClearcoat() and hasSheen().
HEARTH_CONSTANT uint kLayerSpecular = 1;
HEARTH_CONSTANT uint kLayerClearcoat = 2;
HEARTH_CONSTANT uint kLayerSheen = 4;

/// formats::MaterialLayersRecord in the layout of a uniform block.
struct MaterialLayers
{
    Float3 dielectric_f0; ///< reflectance of the index of refraction times the specular colour
    float specular;
    Float3 sheen_color;
    float sheen_roughness;
    float clearcoat;
    float clearcoat_roughness;
    float clearcoat_normal_scale;
    float reserved;
    Float4 uv_rows[8]; ///< as Material::uv_rows, of the textures from kFirstLayerTexture
};

/// formats::LightRecord with direction and cone prepared for the falloff.
struct Light
{
    Float3 position;  ///< world
    uint type;        ///< kLight*
    Float3 direction; ///< unit, direction of the light's rays
    float range;      ///< metres; 0: unlimited
    Float3 intensity; ///< linear colour times candela or lux, after exposure
    uint shadow_row;  ///< row of its projection in the ShadowBlock, or kNoShadow (shadow.h)
    float cone_scale; ///< spot: saturate(dot(direction, from light) * cone_scale + cone_offset)^2
    float cone_offset;
    uint reflector_gain; ///< reflector.h: the brightest sample, encodeRadiance; kNoReflector: none
    uint reflector_axis; ///< coded as normals of faces, and bits of receivers/receiver_rows.h
    uint reflected0;     ///< 4 samples of 8 bits, the first in the low byte, like the next ones
    uint reflected1;
    uint reflected2;
    uint reflected3;
    uint passed0;
    uint passed1;
    uint passed2;
    uint passed3;
};

/// Head of the buffer of lights. Behind it lie the lights, Light[capacity], rows of the sky's image, of
/// local probes and of surroundings, and the lists of the frame: LightListCounts, numbers of its lights,
/// cells and indices (light_grid.h).
struct Lighting
{
    Float3 sky_zenith; ///< radiance
    uint light_count;
    Float3 sky_horizon;
    float exposure; ///< of emission; the intensities of lights have it already
    Float3 sky_ground;
    uint surroundings_row; ///< row of 16 bytes of the buffer: first instance, or kNoSurroundings
    uint transfers_row;    ///< row of the first radiance transfer
    uint first_list_word;  ///< word of the buffer at which the lists of the frame begin
    uint first_cell_word;  ///< of the words of lists: of cells, tiles or slots
    uint first_index_word;
    uint index_words;     ///< room for indices
    uint list_count;      ///< lists of the frame; of slots, the room for their words
    uint first_in_view;   ///< row of 64 bytes: CellLight of the first ranged light of the frame
    uint sky_image_row;   ///< row of 16 bytes of the buffer: kSkyImageRows (sky.h), or kNoSkyImage
    uint receivers_row;   ///< row of 16 bytes of the buffer: ReceiverRow of the first instance
    float receiver_scale; ///< factor of the atlas's texels
    float receiver_width; ///< texels of the atlas
    float receiver_height;
    uint local_probe_row; ///< row of the first local probe (local_probes.h)
    uint local_probe_count;
    uint local_probe_side; ///< texels of an edge of their faces at roughness 0
    uint local_probe_mips;
    LightGrid grid;
    LightCascade cascades[kLightCascades];
    LightCascade tiles; ///< of the image: one slab, each tile with depths of its own
};

/// Default lighting of every scene beside its own lights: a sky of three colours (radiance), and one sun
/// where the scene has no lights. Sun and sky together make a white surface about 0.9 of display white in the
/// light and 0.25 in the shade, so shape is visible on white scans and dark fabrics alike.
HEARTH_CONSTANT Float3 kSkyZenith = Float3(0.30f, 0.36f, 0.46f);
HEARTH_CONSTANT Float3 kSkyHorizon = Float3(0.42f, 0.43f, 0.45f);
HEARTH_CONSTANT Float3 kSkyGround = Float3(0.14f, 0.132f, 0.125f);
HEARTH_CONSTANT Float3 kSunIlluminance = Float3(2.3f, 2.16f, 1.98f); ///< lux after exposure
HEARTH_CONSTANT Float3 kSunDirection = Float3(0.5f, -0.8f, -0.6f);   ///< direction of its rays; any length

/// Exposure rule: if the lights give the middle of the scene more than this, in lux, lights and emission are
/// dimmed by one factor to reach it (formats/scene/scene_lighting.h).
HEARTH_CONSTANT float kKeyIlluminance = 2.2f;

/// Method of specular occlusion of the sky. The numbers are the values of the setting.
HEARTH_CONSTANT uint kSpecularOcclusionFit = 0;
HEARTH_CONSTANT uint kSpecularOcclusionTable = 1; ///< table of the pack; the fit where the pack has none
HEARTH_CONSTANT uint kSpecularOcclusionOff = 2;

/// Pack both settings for shaders.
/// ambient   kAmbientOcclusion* (ambient_occlusion.h)
/// specular  kSpecularOcclusion*
/// spacing   kSpecularSpacing* of the table (specular_occlusion.h)
HEARTH_FUNCTION uint skyOcclusionBits(uint ambient, uint specular, uint spacing)
{
    return ambient | specular << 8 | spacing << 16;
}

/// Linear colour that one fragment adds to the overdraw view: brown at first; red is full at 4, green at 8,
/// all at 16.
HEARTH_CONSTANT Float3 kOverdrawStep = Float3(0.25f, 0.125f, 0.0625f);

HEARTH_SHARED_END

#ifdef __cplusplus
// sizes in std140 layout
static_assert(sizeof(hearth::shared::Material) == 240 + 16 * hearth::shared::kMaterialParameters);
static_assert(sizeof(hearth::shared::MaterialLayers) == 176);
static_assert(sizeof(hearth::shared::Light) == 96);
static_assert(sizeof(hearth::shared::Lighting) == 112 + 112 + 64 * (hearth::shared::kLightCascades + 1));
#endif

#endif
