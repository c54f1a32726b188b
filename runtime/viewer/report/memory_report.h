// Device memory of a scene and of the images that it is drawn into, by what it holds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/renderer.h"

#include <string>

namespace hearth::viewer
{

/// Bytes on the device.
struct MemoryCounts
{
    uint64_t attachments = 0;      ///< of a frame, without those that exist on the tile only
    uint64_t tile_attachments = 0; ///< these: 0 on devices without lazily allocated memory
    uint64_t pyramid = 0;          ///< depth pyramid
    uint64_t lists = 0;            ///< material tiles and gathered light
    uint64_t geometry = 0;
    uint64_t textures = 0;
    uint64_t tables = 0; ///< everything else of the scene, and what blocks of memory leave free
    uint64_t shadow_maps = 0;
};
MemoryCounts countMemory(const gpu::Scene& scene, const gpu::FrameTargets& targets);

/// Format as a JSON object.
std::string formatMemoryJson(const MemoryCounts& counts);

/// Format as one line for each kind that there is.
std::string formatMemoryText(const MemoryCounts& counts);

} // namespace hearth::viewer
