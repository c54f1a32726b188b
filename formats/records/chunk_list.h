// Registry of all chunk types: readers, reports, FORMAT.md and the tests use this list.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/bricks.h"
#include "formats/records/deformation.h"
#include "formats/records/extras.h"
#include "formats/records/material_layers.h"
#include "formats/records/mesh.h"
#include "formats/records/probe.h"
#include "formats/records/provenance.h"
#include "formats/records/proxy.h"
#include "formats/records/receivers.h"
#include "formats/records/scene.h"
#include "formats/records/specular.h"
#include "formats/records/surroundings.h"

#include <algorithm>
#include <array>

namespace hearth::formats
{

/// Purpose of a chunk, by which reports sum the bytes of a pack.
enum class ChunkPurpose : uint8_t
{
    geometry,
    textures,
    animation,
    light,
    scene,
    other,
};

struct ChunkInfo
{
    uint32_t type;
    uint32_t version; ///< newest version that this code reads
    ChunkPurpose purpose;
    std::string_view content; ///< empty for tables of records
    bool one_per_index;       ///< many chunks of the type, one for each mesh or image
    std::string_view meaning;
    RecordInfo record{}; ///< of a table of records
};

/// Describe a chunk that is one table of records.
template <typename T>
constexpr ChunkInfo makeTableInfo(uint32_t type, uint32_t version, ChunkPurpose purpose,
                                  std::string_view meaning)
{
    return {type, version, purpose, "", false, meaning, recordInfo<T>()};
}

inline constexpr std::array kChunkList{
    ChunkInfo{kChunkMeta, 1, ChunkPurpose::scene, "JSON text", false, "provenance and import report"},
    ChunkInfo{kChunkStrings, 1, ChunkPurpose::scene, "UTF-8 text", false,
              "string table that every StringRef points into"},
    makeTableInfo<NodeRecord>(kChunkNodes, 1, ChunkPurpose::scene,
                              "the scene's nodes, in the order of the source"),
    makeTableInfo<InstanceRecord>(kChunkInstances, 1, ChunkPurpose::scene,
                                  "drawn copies of meshes, rest pose"),
    makeTableInfo<CameraRecord>(kChunkCameras, 1, ChunkPurpose::scene, "cameras of the source"),
    makeTableInfo<LightRecord>(kChunkLights, 2, ChunkPurpose::scene, "punctual lights"),
    makeTableInfo<ShadowSphereRecord>(kChunkShadowSpheres, 1, ChunkPurpose::scene,
                                      "spheres that get shadow maps of their own"),
    makeTableInfo<MaterialRecord>(kChunkMaterials, 1, ChunkPurpose::scene, "metallic-roughness materials"),
    makeTableInfo<MaterialLayersRecord>(kChunkMaterialLayers, 1, ChunkPurpose::scene,
                                        "reflectance, clear coat and sheen of materials that have them"),
    makeTableInfo<ImageRecord>(kChunkImages, 4, ChunkPurpose::textures, "images"),
    makeTableInfo<TexturePieceRecord>(kChunkTexturePieces, 1, ChunkPurpose::textures,
                                      "pieces of the texels of all images"),
    ChunkInfo{kChunkImageData, 1, ChunkPurpose::textures, "texels", true,
              "one for each image: all mips, finest first; in packs each piece is a zstd frame"},
    makeTableInfo<SkinRecord>(kChunkSkins, 1, ChunkPurpose::animation, "skins"),
    makeTableInfo<JointRecord>(kChunkJoints, 1, ChunkPurpose::animation, "joints of all skins"),
    makeTableInfo<AnimationRecord>(kChunkAnimations, 3, ChunkPurpose::animation, "animations"),
    makeTableInfo<AnimationChannelRecord>(kChunkChannels, 3, ChunkPurpose::animation,
                                          "channels of all animations"),
    ChunkInfo{kChunkKeys, 1, ChunkPurpose::animation, "f32[]", false, "times and values of all channels"},
    ChunkInfo{kChunkKeyBits, 1, ChunkPurpose::animation, "u32[]", false, "packed keys of channels"},
    ChunkInfo{kChunkMorphWeights, 1, ChunkPurpose::animation, "f32[]", false,
              "rest weights of nodes with morph targets"},
    makeTableInfo<AssetRecord>(kChunkAssets, 1, ChunkPurpose::scene,
                               "the sources, and what of the pack each is"),
    makeTableInfo<ExtrasRecord>(kChunkExtras, 1, ChunkPurpose::scene,
                                "custom properties of the source's objects"),
    makeTableInfo<MeshRecord>(kChunkMeshes, 2, ChunkPurpose::geometry,
                              "one for each mesh of the source, same index; then copies of some"),
    makeTableInfo<LevelRecord>(kChunkLevels, 1, ChunkPurpose::geometry, "levels of detail of all meshes"),
    makeTableInfo<GroupRecord>(kChunkGroups, 2, ChunkPurpose::geometry, "groups of all meshes"),
    makeTableInfo<ClusterRecord>(kChunkClusters, 2, ChunkPurpose::geometry, "clusters of all meshes"),
    makeTableInfo<PageRecord>(kChunkPageTable, 1, ChunkPurpose::geometry, "the geometry pages"),
    ChunkInfo{kChunkPageParents, 1, ChunkPurpose::geometry, "u32[]", false,
              "for each page, the pages that it refines"},
    ChunkInfo{kChunkPages, 2, ChunkPurpose::geometry, "pages", false,
              "geometry; stored without a codec, each page has its own"},
    ChunkInfo{kChunkSourceMesh, 1, ChunkPurpose::other, "SourceMeshHeader, SourceArray[], data", true,
              "parts only: a mesh as imported"},
    ChunkInfo{kChunkInstanceMeshes, 1, ChunkPurpose::other, "u32[]", false,
              "parts only: mesh of each instance, where meshes have copies"},
    makeTableInfo<AuthoredLodRecord>(kChunkAuthoredLods, 2, ChunkPurpose::other,
                                     "parts only: which meshes are levels of detail of others"),
    makeTableInfo<AuthoredLevelRecord>(kChunkAuthoredLevels, 1, ChunkPurpose::other,
                                       "which levels were made by hand, and from what"),
    makeTableInfo<DeformedMeshRecord>(kChunkDeformedMeshes, 1, ChunkPurpose::animation,
                                      "meshes with a skin or morph targets"),
    makeTableInfo<DeformedClusterRecord>(kChunkDeformedClusters, 2, ChunkPurpose::animation,
                                         "where their clusters can be in all poses"),
    ChunkInfo{kChunkClusterJoints, 2, ChunkPurpose::animation, "u32[]", false,
              "which joints move each of these clusters, and their shares in its frame"},
    makeTableInfo<DeformedGroupRecord>(kChunkDeformedGroups, 1, ChunkPurpose::other,
                                       "parts only: where their groups can be"),
    makeTableInfo<ProxyRecord>(kChunkProxies, 1, ChunkPurpose::geometry,
                               "proxies: simple meshes that stand for others"),
    makeTableInfo<ProxySectionRecord>(kChunkProxySections, 1, ChunkPurpose::geometry,
                                      "sections of all proxies: by material, or convex parts"),
    ChunkInfo{kChunkProxyPositions, 1, ChunkPurpose::geometry, "f32[3][]", false, "of all proxies"},
    ChunkInfo{kChunkProxyIndices, 1, ChunkPurpose::geometry, "u32[]", false, "of all proxies"},
    makeTableInfo<ProxyBindingRecord>(kChunkProxyBindings, 1, ChunkPurpose::geometry,
                                      "where vertices of meshes are on their proxies"),
    makeTableInfo<SpecularTableRecord>(kChunkSpecular, 1, ChunkPurpose::light,
                                       "the table of specular occlusion, one at most"),
    makeTableInfo<ProbeRecord>(kChunkProbes, 3, ChunkPurpose::light, "light probes"),
    ChunkInfo{kChunkProbeTexels, 1, ChunkPurpose::light, "u32[]", false,
              "of all probes: RGB9E5 by mip, face, row and column"},
    makeTableInfo<ReceiverAtlasRecord>(kChunkReceivers, 1, ChunkPurpose::light,
                                       "the atlas of receivers, one at most"),
    makeTableInfo<ReceiverLampRecord>(kChunkReceiverLamps, 1, ChunkPurpose::light,
                                      "lamps that receivers weigh"),
    makeTableInfo<ReceiverRectRecord>(kChunkReceiverRects, 1, ChunkPurpose::light,
                                      "which part of the atlas an instance has"),
    makeTableInfo<ReceiverBlockRecord>(kChunkReceiverBlocks, 1, ChunkPurpose::light,
                                       "blocks of texels with the same lamps"),
    ChunkInfo{kChunkReceiverWords, 1, ChunkPurpose::light, "u32[]", false,
              "of all blocks: places, then colours"},
    makeTableInfo<ReceiverAtlasRecord>(kChunkFaceReceivers, 1, ChunkPurpose::light,
                                       "the faces of bricks as receivers, one at most"),
    makeTableInfo<ReceiverBlockRecord>(kChunkFaceBlocks, 1, ChunkPurpose::light,
                                       "blocks of faces with the same lamps"),
    ChunkInfo{kChunkFaceWords, 1, ChunkPurpose::light, "u32[]", false,
              "of all blocks of faces: their numbers, then colours"},
    makeTableInfo<SurroundingsRecord>(kChunkSurroundings, 1, ChunkPurpose::light,
                                      "surroundings of each instance"),
    makeTableInfo<RadianceTransferRecord>(kChunkRadianceTransfers, 1, ChunkPurpose::light,
                                          "light that occluders give back"),
    makeTableInfo<BrickGridRecord>(kChunkBrickGrid, 1, ChunkPurpose::light,
                                   "the grid of bricks, one at most"),
    makeTableInfo<BrickGroupRecord>(kChunkBrickGroups, 1, ChunkPurpose::light, "all groups of the grid"),
    makeTableInfo<BrickRecord>(kChunkBricks, 1, ChunkPurpose::light, "the bricks of all groups"),
    ChunkInfo{kChunkBrickOpacity, 1, ChunkPurpose::light, "u8[]", false, "of each solid voxel"},
    ChunkInfo{kChunkBrickAlbedo, 1, ChunkPurpose::light, "u32[]", false, "of each face"},
    ChunkInfo{kChunkBrickNormals, 1, ChunkPurpose::light, "u16[]", false, "of each face"},
    ChunkInfo{kChunkBrickEmission, 1, ChunkPurpose::light, "u32[]", false, "of each face"},
    ChunkInfo{kChunkBrickLighting, 1, ChunkPurpose::light, "u32[]", false, "of each face"},
    makeTableInfo<ReflectorRecord>(kChunkReflectors, 1, ChunkPurpose::light,
                                   "what surrounds each lamp, as its shade"),
};

/// Return the list entry of a type, or nullptr: readers skip unknown types.
constexpr const ChunkInfo* chunkInfo(uint32_t type)
{
    const auto found = std::find_if(kChunkList.begin(), kChunkList.end(),
                                    [type](const ChunkInfo& chunk) { return chunk.type == type; });
    return found == kChunkList.end() ? nullptr : &*found;
}

/// Return the version that writers give a chunk: 1 for types that are not in the list.
constexpr uint32_t chunkVersion(uint32_t type)
{
    const ChunkInfo* info = chunkInfo(type);
    return info == nullptr ? 1 : info->version;
}

} // namespace hearth::formats
