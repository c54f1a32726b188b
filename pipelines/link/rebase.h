// Rebases the indices of a part's records to the start of the part's tables in the merged pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/deformation.h"
#include "formats/records/extras.h"
#include "formats/records/material_layers.h"
#include "formats/records/mesh.h"
#include "formats/records/provenance.h"
#include "formats/records/proxy.h"
#include "formats/records/scene.h"
#include "formats/records/surroundings.h"

namespace hearth::link
{

/// Start of each table of one source in the merged tables.
struct TableOffsets
{
    uint32_t strings = 0;      ///< bytes; of the import part, or of the textures part, which begins with them
    uint32_t mesh_strings = 0; ///< bytes; of the clusters part
    uint32_t assets = 0;
    uint32_t nodes = 0;
    uint32_t cameras = 0;
    uint32_t lights = 0;
    uint32_t materials = 0;
    uint32_t images = 0;
    uint32_t skins = 0;
    uint32_t joints = 0;
    uint32_t animations = 0;
    uint32_t channels = 0;
    uint32_t keys = 0;
    uint32_t key_words = 0;
    uint32_t morph_weights = 0;
    uint32_t meshes = 0;
    uint32_t levels = 0;
    uint32_t groups = 0;
    uint32_t clusters = 0;
    uint32_t pages = 0;
    uint32_t page_parents = 0;
    uint32_t deformed_clusters = 0;
    uint32_t cluster_joints = 0;
    uint32_t radiance_transfers = 0;
    uint32_t proxy_sections = 0;
    uint32_t proxy_positions = 0;
    uint32_t proxy_indices = 0;
    uint32_t proxy_bindings = 0;
    uint64_t page_bytes = 0; ///< in chunk PAGE
};

void rebase(formats::NodeRecord& node, const TableOffsets& offsets);
void rebase(formats::InstanceRecord& instance, const TableOffsets& offsets);
void rebase(formats::CameraRecord& camera, const TableOffsets& offsets);
void rebase(formats::LightRecord& light, const TableOffsets& offsets);
void rebase(formats::ShadowSphereRecord& sphere, const TableOffsets& offsets);
void rebase(formats::ExtrasRecord& extras, const TableOffsets& offsets);
void rebase(formats::MaterialRecord& material, const TableOffsets& offsets);
void rebase(formats::MaterialLayersRecord& layers, const TableOffsets& offsets);
void rebase(formats::ImageRecord& image, const TableOffsets& offsets);
void rebase(formats::SkinRecord& skin, const TableOffsets& offsets);
void rebase(formats::JointRecord& joint, const TableOffsets& offsets);
void rebase(formats::AnimationRecord& animation, const TableOffsets& offsets);
void rebase(formats::AnimationChannelRecord& channel, const TableOffsets& offsets);
void rebase(formats::MeshRecord& mesh, const TableOffsets& offsets);
void rebase(formats::LevelRecord& level, const TableOffsets& offsets);
void rebase(formats::GroupRecord& group, const TableOffsets& offsets);
void rebase(formats::ClusterRecord& cluster, const TableOffsets& offsets);
void rebase(formats::PageRecord& page, const TableOffsets& offsets);
void rebase(formats::AuthoredLevelRecord& level, const TableOffsets& offsets);
void rebase(formats::DeformedMeshRecord& mesh, const TableOffsets& offsets);
void rebase(formats::DeformedClusterRecord& cluster, const TableOffsets& offsets);
void rebase(formats::ProxyRecord& proxy, const TableOffsets& offsets);
void rebase(formats::ProxySectionRecord& section, const TableOffsets& offsets);
void rebase(formats::SurroundingsRecord& surroundings, const TableOffsets& offsets);
void rebase(uint32_t& page_parent, const TableOffsets& offsets);

} // namespace hearth::link
