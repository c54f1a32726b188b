// Specialization constants of the pipelines that draw and shade clusters: their ids, and the values that
// are no numbers. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SPECIALIZATION_H
#define HEARTH_SHARED_SPECIALIZATION_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Pool slices that the scene uses: 1 or kPoolSlices.
HEARTH_CONSTANT uint kConstantUsedSlices = 0;
HEARTH_CONSTANT uint kConstantTextures = 1;      ///< as Material::textures
HEARTH_CONSTANT uint kConstantUvSets = 2;        ///< as Material::uv_sets
HEARTH_CONSTANT uint kConstantUnlit = 3;         ///< 1: the material is unlit
HEARTH_CONSTANT uint kConstantDeformed = 4;      ///< source of the vertices of deformed meshes, below
HEARTH_CONSTANT uint kConstantSkyVisibility = 5; ///< 1: some of the meshes have sky visibility
HEARTH_CONSTANT uint kConstantLayers = 6;        ///< bits kLayer* (shading.h) of the material
/// 1: shaders compare the numbers of materials; 0: the depth test does.
HEARTH_CONSTANT uint kConstantComparesMaterial = 7;
/// 1: compares with shadow maps may be bilinear; 0: the device filters no depths of their format.
HEARTH_CONSTANT uint kConstantFiltersShadows = 8;
HEARTH_CONSTANT uint kConstantLightList = 9; ///< lights that a pixel evaluates, below
/// Colour that shading writes, and the format of bloom: kStored*, below.
HEARTH_CONSTANT uint kConstantStored = 10;
HEARTH_CONSTANT uint kConstantReflects = 11;    ///< 1: what surrounds lamps gives light back (reflector.h)
HEARTH_CONSTANT uint kConstantReceivers = 12;   ///< 1: the scene has receivers (receivers/receiver_rows.h)
HEARTH_CONSTANT uint kConstantLocalProbes = 13; ///< 1: the scene has local probes (local_probes.h)
/// Number of the material's function among those of the game, from 1; 0: none.
HEARTH_CONSTANT uint kConstantMaterialFunction = 14;
/// 1: the image that a frame shows holds sRGB codes, which the shader computes; 0: its format does, if any.
HEARTH_CONSTANT uint kConstantEncodes = 15;
/// Number of the material's motion among those of the game, from 1; 0: none.
HEARTH_CONSTANT uint kConstantMaterialMotion = 16;
HEARTH_CONSTANT uint kConstantCount = 17;

/// Lights that a pixel evaluates, beside those that every point gets.
HEARTH_CONSTANT uint kLightListFrame = 0; ///< all of the frame
HEARTH_CONSTANT uint kLightListCells = 1; ///< those of its cell of the light grid
HEARTH_CONSTANT uint kLightListTiles = 2; ///< those of its tile of the image
HEARTH_CONSTANT uint kLightListSlots = 3; ///< those of its slot of the visible list
/// None: light_volume.h is drawn for each of the frame.
HEARTH_CONSTANT uint kLightListVolumes = 4;
/// Lights of the pixel's bits (light_bits.h), and behind them lights of its cell.
HEARTH_CONSTANT uint kLightListBits = 5;

/// Source of the vertices of deformed meshes.
HEARTH_CONSTANT uint kDeformedNone = 0; ///< no deformed meshes: rigid scenes and bins pay nothing for them
HEARTH_CONSTANT uint kDeformedOnDemand = 1; ///< skinned on demand by the shader that draws
/// Skinned by an earlier pass, as far as the scratch buffer has room.
HEARTH_CONSTANT uint kDeformedPreSkinned = 2;

HEARTH_CONSTANT uint kStoredDisplay = 0;       ///< the finished colour
HEARTH_CONSTANT uint kStoredGraded = 1;        ///< the same, with exposure and photo filter
HEARTH_CONSTANT uint kStoredPacked = 2;        ///< radiance in B10G11R11_UFLOAT
HEARTH_CONSTANT uint kStoredHalf = 3;          ///< radiance in R16G16B16A16_SFLOAT
HEARTH_CONSTANT uint kStoredExposedPacked = 4; ///< as kStoredPacked, times the exposure: what a frame shows
HEARTH_CONSTANT uint kStoredExposedHalf = 5;   ///< as kStoredHalf, times the exposure

HEARTH_SHARED_END

#endif
