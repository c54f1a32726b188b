// Descriptor sets and bindings of all shaders. One source for C++ and GLSL: shaders name them in layout(),
// runtime/gpu in set layouts and descriptor writes. tests/runtime/gpu/gpu_interface_test.cpp compares both.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BINDINGS_H
#define HEARTH_SHARED_BINDINGS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Sets of the pipelines that draw and shade clusters. The compute passes that read vertices have the
/// scene as their set 0. All that shading binds may also be one set (FrameWay::one_set): bindings of the
/// scene, a material, the attachments and the tables of cluster views have different numbers.
HEARTH_CONSTANT uint kSetScene = 0;
HEARTH_CONSTANT uint kSetMaterial = 1;
HEARTH_CONSTANT uint kSetAttachments = 2; ///< material depth and shading
HEARTH_CONSTANT uint kSetBins = 2;        ///< visibility pass and shadow casters

/// Bindings of the scene. Seven storage buffers in the vertex stage, to which each set 2 adds one, and
/// eight in the fragment stage, which is the limit of the renderer.
HEARTH_CONSTANT uint kSceneFrame = 0;
HEARTH_CONSTANT uint kSceneInstances = 1;
HEARTH_CONSTANT uint kSceneVisible = 2;
HEARTH_CONSTANT uint kSceneDraws = 3;
HEARTH_CONSTANT uint kScenePool = 4;        ///< first of kPoolSlices bindings
HEARTH_CONSTANT uint kSceneDeformation = 7; ///< slice kDeformationSlice of the pool
HEARTH_CONSTANT uint kSceneLighting = 8;
HEARTH_CONSTANT uint kSceneShadows = 9; ///< scenes with shadows only; so is the next one
HEARTH_CONSTANT uint kSceneShadowMaps = 10;
HEARTH_CONSTANT uint kSceneSpecularTable = 11; ///< or white; or the atlas of local_probes.h
HEARTH_CONSTANT uint kSceneShadingTables = 12; ///< reflectance.h
HEARTH_CONSTANT uint kSceneReceivers = 13;     ///< atlas of receivers; one white texel in scenes without one

/// Bindings of a material.
HEARTH_CONSTANT uint kMaterialBlock = 14;
HEARTH_CONSTANT uint kMaterialTextures = 15; ///< first of kTextureCount bindings, in the order of kTexture*
HEARTH_CONSTANT uint kMaterialLayers = 24; ///< uniform block; read by the pipelines of materials with layers

/// Binding of the bins: draws of the bins, then draws of the late phase.
HEARTH_CONSTANT uint kBinsDraws = 0;

/// Bindings of the frame's images and lists that shading reads.
HEARTH_CONSTANT uint kAttachmentVisibility = 25;
HEARTH_CONSTANT uint kAttachmentTileLists = 26;
HEARTH_CONSTANT uint kAttachmentGi = 27; ///< result of the gather passes, for frames with GI

/// Bindings of the images that lights read, beside some of the scene, in the only set of the pipelines that
/// light stored surfaces.
HEARTH_CONSTANT uint kAttachmentSurfaces = 28;
HEARTH_CONSTANT uint kAttachmentDepth = 29;

/// First binding of kLightImages images that lights have been added to, or marked in, ahead of shading:
/// input attachments of renderers with such methods.
HEARTH_CONSTANT uint kAttachmentLight = 30;
HEARTH_CONSTANT uint kLightImages = 3;

/// Cube map of the sky's probe, in the scene; one black texel a face in scenes without one.
HEARTH_CONSTANT uint kSceneSkyCube = 33;

/// Index of the visibility buffer among the input attachments of the subpasses that read it.
HEARTH_CONSTANT uint kInputVisibility = 0;
/// Index of the first of kLightImages beside the visibility buffer, and without it.
HEARTH_CONSTANT uint kInputLight = 1;
HEARTH_CONSTANT uint kInputLightSampled = 0;
/// Indices of the depth and of stored surfaces among those of the subpass that adds lights.
HEARTH_CONSTANT uint kInputDepth = 0;
HEARTH_CONSTANT uint kInputSurfaces = 1;
/// Index of the radiance among those of the subpass that finishes it.
HEARTH_CONSTANT uint kInputRadiance = 0;

/// Sets of the compute passes over the tables of a scene, and of the debug views of clusters.
HEARTH_CONSTANT uint kSetTables = 0;
HEARTH_CONSTANT uint kSetOcclusion = 1;  ///< culling
HEARTH_CONSTANT uint kSetTiles = 1;      ///< material tiles
HEARTH_CONSTANT uint kSetPickPixels = 1; ///< picks: with the bindings of kSetPixels
/// Motion vectors, beside the scene: with the bindings of kSetPixels.
HEARTH_CONSTANT uint kSetMotionPixels = 1;
/// Debug views of clusters: the attachments, with their bindings.
HEARTH_CONSTANT uint kSetClusterAttachments = 1;

/// Bindings of the tables: a table has the same one in every pass, and a pass has those that it uses
/// (runtime/gpu/scene/scene_tables.h). All but uniform blocks are storage buffers.
HEARTH_CONSTANT uint kTableFrame = 0; ///< FrameView, a uniform block
HEARTH_CONSTANT uint kTableInstances = 1;
HEARTH_CONSTANT uint kTableStates = 2;
HEARTH_CONSTANT uint kTableItems = 3;
HEARTH_CONSTANT uint kTableOrder = 4;
HEARTH_CONSTANT uint kTableClusters = 5;
HEARTH_CONSTANT uint kTableGroups = 6;
HEARTH_CONSTANT uint kTableResults = 7;
HEARTH_CONSTANT uint kTableBounds = 8;
HEARTH_CONSTANT uint kTableInverses = 9;
HEARTH_CONSTANT uint kTableTotals = 10;
HEARTH_CONSTANT uint kTableCounters = 11;
HEARTH_CONSTANT uint kTableDraws = 12;
HEARTH_CONSTANT uint kTableVisible = 13;
HEARTH_CONSTANT uint kTableBins = 14;
HEARTH_CONSTANT uint kTableBinDraws = 15;
HEARTH_CONSTANT uint kTableMaterialDraws = 16;
HEARTH_CONSTANT uint kTableTileDraws = 17;
HEARTH_CONSTANT uint kTableGroupItems = 18;
HEARTH_CONSTANT uint kTablePageRequests = 19;
HEARTH_CONSTANT uint kTableDeformation = 20;
HEARTH_CONSTANT uint kTableStatistics = 21;
HEARTH_CONSTANT uint kTableShadows =
    22; ///< ShadowBlock, a uniform block; as the next ones of proxies that cast
HEARTH_CONSTANT uint kTableProxies = 23;
HEARTH_CONSTANT uint kTableProxyDraw = 24;
HEARTH_CONSTANT uint kTableProxyChunks = 25;
HEARTH_CONSTANT uint kTableProxyPositions = 26;
HEARTH_CONSTANT uint kTableProxyIndices = 27;
HEARTH_CONSTANT uint kTablePicks = 28; ///< of the pass that finds them

/// Set of word copies: they have no other.
HEARTH_CONSTANT uint kSetWordCopy = 0;

HEARTH_CONSTANT uint kWordCopyRegions = 0;
HEARTH_CONSTANT uint kWordCopySource = 1;
HEARTH_CONSTANT uint kWordCopyTarget = 2;

/// Set of the pyramid passes: the set of the occlusion test is their only one.
HEARTH_CONSTANT uint kSetPyramid = 0;

HEARTH_CONSTANT uint kOcclusionViews = 0;
HEARTH_CONSTANT uint kOcclusionPyramid = 1;
HEARTH_CONSTANT uint kOcclusionDepth = 2; ///< pyramid passes only

/// Bindings of the material tiles.
HEARTH_CONSTANT uint kTilesVisibility = 0;
HEARTH_CONSTANT uint kTilesMaterials = 1;
HEARTH_CONSTANT uint kTilesLists = 2;

/// Sets of the passes over bricks, and of the debug views of bricks.
HEARTH_CONSTANT uint kSetBricks = 0;
HEARTH_CONSTANT uint kSetFreshLight = 1; ///< update of the faces
HEARTH_CONSTANT uint kSetGather = 1;     ///< rays of the gather points

/// Bindings of the bricks. Six storage buffers, which leaves two for each set 1.
HEARTH_CONSTANT uint kBricksFrame = 0; ///< FrameView
HEARTH_CONSTANT uint kBricksView = 1;  ///< BrickView
HEARTH_CONSTANT uint kBricksGroups = 2;
HEARTH_CONSTANT uint kBricksBricks = 3;
HEARTH_CONSTANT uint kBricksOpacity = 4;
HEARTH_CONSTANT uint kBricksSurfaces = 5; ///< of the faces: albedo, emission, normals
HEARTH_CONSTANT uint kBricksLight = 6;    ///< of the faces
HEARTH_CONSTANT uint kBricksLighting = 7;

HEARTH_CONSTANT uint kFreshLightFaces = 0; ///< light of faces before the copy
HEARTH_CONSTANT uint kFreshLightLocations = 1;

/// Sets of the passes that list and count lights. Some read the scene as well, as their set 0: it leaves
/// one storage buffer, which all that they write lies in.
HEARTH_CONSTANT uint kSetLights = 0;
HEARTH_CONSTANT uint kSetSceneLights = 1; ///< the same set beside the scene
HEARTH_CONSTANT uint kSetPixels = 2;      ///< passes over the pixels of a frame

HEARTH_CONSTANT uint kLightsBuffer = 0; ///< the buffer of kSceneLighting

HEARTH_CONSTANT uint kPixelsVisibility = 0;

/// Set of the pass that chooses gather points; its set 0 is the scene.
HEARTH_CONSTANT uint kSetGatherPoint = 1;

HEARTH_CONSTANT uint kGatherPointVisibility = 0;
HEARTH_CONSTANT uint kGatherPointPoints = 1;

/// Set of the pass that smooths gathered light: it has no other.
HEARTH_CONSTANT uint kSetGatherSmooth = 0;

HEARTH_CONSTANT uint kGatherView = 0;
HEARTH_CONSTANT uint kGatherPoints = 1;
HEARTH_CONSTANT uint kGatherHistory = 2; ///< points of the last frame
HEARTH_CONSTANT uint kGatherTexels = 3;  ///< texels that shading reads

/// Set of bloom, automatic exposure and the final pass: they have no other.
HEARTH_CONSTANT uint kSetPost = 0;

HEARTH_CONSTANT uint kPostRadiance = 0; ///< the frame, or a level of bloom
HEARTH_CONSTANT uint kPostBloom = 1;    ///< coarser levels
HEARTH_CONSTANT uint kPostExposure = 2; ///< of the last frame, or of this one

/// Set of the temporal filter: it has no other.
HEARTH_CONSTANT uint kSetTemporal = 0;

HEARTH_CONSTANT uint kTemporalColor = 0;
HEARTH_CONSTANT uint kTemporalMotion = 1;
HEARTH_CONSTANT uint kTemporalDistances = 2;
HEARTH_CONSTANT uint kTemporalEarlierDistances = 3; ///< of the frame before; as the next one
HEARTH_CONSTANT uint kTemporalHistory = 4;

HEARTH_SHARED_END

#endif
