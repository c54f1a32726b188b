// Small but complete pack, made by hand: every chunk type of a pack, two levels, six clusters, three pages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

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
#include "tests/support/brick_model.h"
#include "tests/support/container_image.h"

#include <string>
#include <vector>

namespace hearth::test
{

/// Content of a pack as plain arrays, so that a test can break one thing and write it with right hashes.
struct PackModel
{
    std::string meta;
    std::string strings;
    std::vector<formats::AssetRecord> assets;
    std::vector<formats::ExtrasRecord> extras;
    std::vector<formats::NodeRecord> nodes;
    std::vector<formats::InstanceRecord> instances;
    std::vector<formats::CameraRecord> cameras;
    std::vector<formats::LightRecord> lights;
    std::vector<formats::ShadowSphereRecord> shadow_spheres;
    std::vector<formats::MaterialRecord> materials;
    std::vector<formats::MaterialLayersRecord> material_layers;
    std::vector<formats::ImageRecord> images;
    std::vector<std::vector<std::byte>> image_data;
    std::vector<formats::TexturePieceRecord> texture_pieces;
    std::vector<formats::SkinRecord> skins;
    std::vector<formats::JointRecord> joints;
    std::vector<formats::AnimationRecord> animations;
    std::vector<formats::AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<uint32_t> key_bits;
    std::vector<float> morph_weights;
    std::vector<formats::MeshRecord> meshes;
    std::vector<formats::LevelRecord> levels;
    std::vector<formats::GroupRecord> groups;
    std::vector<formats::ClusterRecord> clusters;
    std::vector<formats::PageRecord> pages;
    std::vector<uint32_t> page_parents;
    std::vector<std::vector<std::byte>> decoded_pages;
    std::vector<std::byte> page_bytes; ///< chunk PAGE
    std::vector<formats::AuthoredLevelRecord> authored_levels;
    std::vector<formats::DeformedMeshRecord> deformed_meshes;
    std::vector<formats::DeformedClusterRecord> deformed_clusters;
    std::vector<uint32_t> cluster_joints;
    std::vector<formats::DeformedGroupRecord> deformed_groups; ///< only in parts
    std::vector<formats::SpecularTableRecord> specular_tables;
    std::vector<formats::ProbeRecord> probes;
    std::vector<uint32_t> probe_texels;
    std::vector<formats::ReceiverAtlasRecord> receiver_atlases;
    std::vector<formats::ReceiverLampRecord> receiver_lamps;
    std::vector<formats::ReceiverRectRecord> receiver_rects;
    std::vector<formats::ReceiverBlockRecord> receiver_blocks;
    std::vector<uint32_t> receiver_words;
    std::vector<formats::ReceiverAtlasRecord> face_atlases;
    std::vector<formats::ReceiverBlockRecord> face_blocks;
    std::vector<uint32_t> face_words;
    std::vector<formats::ProxyRecord> proxies;
    std::vector<formats::ProxySectionRecord> proxy_sections;
    std::vector<Float3> proxy_positions;
    std::vector<uint32_t> proxy_indices;
    std::vector<formats::ProxyBindingRecord> proxy_bindings;
    std::vector<formats::SurroundingsRecord> surroundings;
    std::vector<formats::RadianceTransferRecord> radiance_transfers;
    std::vector<uint32_t> instance_meshes; ///< parts only
    std::vector<formats::BrickGridRecord> brick_grids;
    BrickModel bricks; ///< without its grid, which is in brick_grids

    /// Encode decoded_pages into page_bytes again, and set offset, size and hash of the page records. The
    /// second page is stored uncompressed, the others by zstd.
    void sealPages();

    /// Cut the texels of all images into pieces. Without it images have none.
    void sealImages();

    /// Return the chunks in the order in which hearth-link writes them; `compressed` selects zstd for the
    /// tables.
    std::vector<ChunkImage> chunks(bool compressed = false) const;

    AlignedBytes bytes(bool compressed = false) const
    {
        return assemble(formats::ContainerKind::pack, chunks(compressed));
    }

private:
    ChunkImage imageChunk(uint32_t image, bool compressed) const;
};

/// Mesh 0: a folded strip of four quads. Level 0 has a cluster for each quad, in two groups of two. Each
/// group was simplified to one flat quad; those two quads are the root group, which is marked as an authored
/// LOD. Page 0 holds the root, pages 1 and 2 a group each.
/// Mesh 1: no triangles. Mesh 2: one triangle without attributes, skinned, with one morph target that moves
/// its last vertex.
PackModel smallPack();

} // namespace hearth::test
