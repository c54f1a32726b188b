// Options of an import, and limits on untrusted sources.
// Every reader treats its bytes as hostile: it checks counts against what is there before it allocates or reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/read_list.h"

#include <cstdint>

namespace hearth::import
{

/// Limits that keep a hostile file from taking the machine; generous for real assets.
struct ImportLimits
{
    uint64_t max_file_bytes = uint64_t{8} << 30;
    uint64_t max_vertices = uint64_t{1} << 28;     ///< of one mesh
    uint64_t max_triangles = uint64_t{1} << 28;    ///< of one mesh
    uint64_t max_image_texels = uint64_t{1} << 26; ///< 8192 x 8192: what a mobile GPU can use
    uint32_t max_image_size = 16384;
    uint64_t max_instances = uint64_t{1} << 20;
};

struct ImportOptions
{
    ImportLimits limits;
    float crease_angle_rad = 1.0471976f; ///< 60 degrees: sharper edges of a mesh without normals stay hard
    tools::ReadList* reads = nullptr;    ///< notes the files that are read; null: nobody asks
};

} // namespace hearth::import
