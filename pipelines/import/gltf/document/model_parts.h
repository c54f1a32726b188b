// Readers of the sections of a glTF document. readGltfModel calls each once, in the order of this list,
// because later sections refer to the sizes of earlier ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/model.h"

namespace hearth::import
{

void readBuffers(const GltfObject& root, GltfModel& model);
void readBufferViews(const GltfObject& root, GltfModel& model);
void readAccessors(const GltfObject& root, GltfModel& model);

void readImages(const GltfObject& root, GltfModel& model);
void readTextures(const GltfObject& root, GltfModel& model);
void readMaterials(const GltfObject& root, GltfModel& model);

void readMeshes(const GltfObject& root, GltfModel& model);

void readCameras(const GltfObject& root, GltfModel& model);
void readLights(const GltfObject& root, GltfModel& model);
void readNodes(const GltfObject& root, size_t skin_count, GltfModel& model);
void readImageLights(const GltfObject& root, GltfModel& model);
void readScenes(const GltfObject& root, GltfModel& model);

void readSkins(const GltfObject& root, GltfModel& model);
void readAnimations(const GltfObject& root, GltfModel& model);

/// Read the members of object `name` as attributes in the order of their names: semantic -> index below
/// `size`.
GltfAttributes readAttributes(const GltfObject& object, size_t size);

/// Read the extra hearth_proxy of a node or mesh. errors: gltf_extension_value
GltfProxyMark readProxyMark(const GltfObject& object);

} // namespace hearth::import
