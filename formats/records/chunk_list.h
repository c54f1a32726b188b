// Lists every chunk type: readers, FORMAT.md and the tests use this list.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/bricks.h"
#include "formats/records/deformation.h"
#include "formats/records/mesh.h"
#include "formats/records/provenance.h"
#include "formats/records/scene.h"
#include "formats/records/specular.h"

#include <algorithm>
#include <array>

namespace hearth::formats
{

struct ChunkInfo
{
    uint32_t type;
    uint32_t version; ///< newest version that this code reads
    std::string_view content;
    bool one_per_index; ///< many chunks of the type, one for each mesh or image
    std::string_view meaning;
};

inline constexpr std::array kChunkList{
    ChunkInfo{kChunkMeta, 1, "JSON text", false, "provenance and import report"},
    ChunkInfo{kChunkStrings, 1, "UTF-8 text", false, "string table that every StringRef points into"},
    ChunkInfo{kChunkNodes, 1, "NodeRecord[]", false, "the scene's nodes, in the order of the source"},
    ChunkInfo{kChunkInstances, 1, "InstanceRecord[]", false, "drawn copies of meshes, rest pose"},
    ChunkInfo{kChunkCameras, 1, "CameraRecord[]", false, "cameras of the source"},
    ChunkInfo{kChunkLights, 1, "LightRecord[]", false, "punctual lights"},
    ChunkInfo{kChunkShadowSpheres, 1, "ShadowSphereRecord[]", false,
              "spheres that get shadow maps of their own"},
    ChunkInfo{kChunkMaterials, 1, "MaterialRecord[]", false, "metallic-roughness materials"},
    ChunkInfo{kChunkImages, 1, "ImageRecord[]", false, "images"},
    ChunkInfo{kChunkImageData, 1, "texels", true, "one for each image: all mips, finest first"},
    ChunkInfo{kChunkSkins, 1, "SkinRecord[]", false, "skins"},
    ChunkInfo{kChunkJoints, 1, "JointRecord[]", false, "joints of all skins"},
    ChunkInfo{kChunkAnimations, 2, "AnimationRecord[]", false, "animations"},
    ChunkInfo{kChunkChannels, 2, "AnimationChannelRecord[]", false, "channels of all animations"},
    ChunkInfo{kChunkKeys, 1, "f32[]", false, "times and values of all channels"},
    ChunkInfo{kChunkKeyBits, 1, "u32[]", false, "packed keys of channels"},
    ChunkInfo{kChunkMorphWeights, 1, "f32[]", false, "rest weights of nodes with morph targets"},
    ChunkInfo{kChunkAssets, 1, "AssetRecord[]", false, "the sources, and what of the pack each is"},
    ChunkInfo{kChunkMeshes, 2, "MeshRecord[]", false, "one for each mesh of the source, same index"},
    ChunkInfo{kChunkLevels, 1, "LevelRecord[]", false, "levels of detail of all meshes"},
    ChunkInfo{kChunkGroups, 2, "GroupRecord[]", false, "groups of all meshes"},
    ChunkInfo{kChunkClusters, 1, "ClusterRecord[]", false, "clusters of all meshes"},
    ChunkInfo{kChunkPageTable, 1, "PageRecord[]", false, "the geometry pages"},
    ChunkInfo{kChunkPageParents, 1, "u32[]", false, "for each page, the pages that it refines"},
    ChunkInfo{kChunkPages, 2, "pages", false, "geometry; stored without a codec, each page has its own"},
    ChunkInfo{kChunkSourceMesh, 1, "SourceMeshHeader, SourceArray[], data", true,
              "parts only: a mesh as imported"},
    ChunkInfo{kChunkAuthoredLods, 2, "AuthoredLodRecord[]", false,
              "parts only: which meshes are levels of detail of others"},
    ChunkInfo{kChunkAuthoredLevels, 1, "AuthoredLevelRecord[]", false,
              "which levels were made by hand, and from what"},
    ChunkInfo{kChunkDeformedMeshes, 1, "DeformedMeshRecord[]", false, "meshes with a skin or morph targets"},
    ChunkInfo{kChunkDeformedClusters, 2, "DeformedClusterRecord[]", false,
              "where their clusters can be in all poses"},
    ChunkInfo{kChunkClusterJoints, 1, "u32[]", false, "which joints move each of these clusters"},
    ChunkInfo{kChunkDeformedGroups, 1, "DeformedGroupRecord[]", false,
              "parts only: where their groups can be"},
    ChunkInfo{kChunkSpecular, 1, "SpecularTableRecord[]", false,
              "the table of specular occlusion, one at most"},
    ChunkInfo{kChunkBrickGrid, 1, "BrickGridRecord[]", false, "the grid of bricks, one at most"},
    ChunkInfo{kChunkBrickGroups, 1, "BrickGroupRecord[]", false, "all groups of the grid"},
    ChunkInfo{kChunkBricks, 1, "BrickRecord[]", false, "the bricks of all groups"},
    ChunkInfo{kChunkBrickOpacity, 1, "u8[]", false, "of each solid voxel"},
    ChunkInfo{kChunkBrickAlbedo, 1, "u32[]", false, "of each face"},
    ChunkInfo{kChunkBrickNormals, 1, "u16[]", false, "of each face"},
    ChunkInfo{kChunkBrickEmission, 1, "u32[]", false, "of each face"},
    ChunkInfo{kChunkBrickLighting, 1, "u32[]", false, "of each face"},
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
