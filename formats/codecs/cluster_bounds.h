// The box and the normal cone of a cluster, from the whole numbers of its record. The culling shaders decode the same
// words in formats/gpu_shared/decisions.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/vertex_codec.h"

namespace hearth::formats
{

/// Units of ClusterRecord::cone_back, in steps << extent_shift: 16 bits of them reach from the middle of a cluster to
/// the apex of any cone.
inline constexpr uint32_t kConeBackSteps = 16;

/// Largest ClusterRecord::extent_shift: as far as two corners of the grid are apart.
inline constexpr uint32_t kMostExtentShift = 9;

/// The layout of a cluster's vertices: that of its mesh, and whether its offsets need more than 16 bits.
constexpr uint32_t layoutOf(const ClusterRecord& cluster, uint32_t mesh_layout)
{
    return mesh_layout | (cluster.extent_shift > 0 ? uint32_t{kVertexWide} : 0u);
}

/// Steps from the base to the high corner of the box.
constexpr int64_t boxSteps(const ClusterRecord& cluster, int axis)
{
    return int64_t{cluster.extent[axis]} << cluster.extent_shift;
}

inline Box3 boxOf(const ClusterRecord& cluster, float grid_step)
{
    Box3 box;
    for (int axis = 0; axis < 3; ++axis)
    {
        box.min[axis] = static_cast<float>(cluster.base[axis]) * grid_step;
        box.max[axis] = static_cast<float>(cluster.base[axis] + boxSteps(cluster, axis)) * grid_step;
    }
    return box;
}

/// Unit vector along the middle of the cluster's normals.
inline Float3 coneAxis(const ClusterRecord& cluster)
{
    return NormalCode<8>::decode(cluster.cone_axis);
}

/// Sine of the cone's half-angle.
constexpr float coneCutoff(const ClusterRecord& cluster)
{
    return static_cast<float>(cluster.cone_cutoff) * 0x1p-16f;
}

/// How far behind the middle of the box the apex is.
constexpr double coneBack(const ClusterRecord& cluster, float grid_step)
{
    return static_cast<double>(uint64_t{cluster.cone_back} * kConeBackSteps << cluster.extent_shift) *
           static_cast<double>(grid_step);
}

} // namespace hearth::formats
