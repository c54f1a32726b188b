// Decodes the bounding box and normal cone of a cluster from the integers of its record. The culling shaders
// decode the same words in formats/gpu_shared/decisions.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/vertex_codec.h"

namespace hearth::formats
{

/// Unit of ClusterRecord::cone_back, in steps << extent_shift: 16 bits reach from the middle of a cluster to
/// the apex of any cone.
inline constexpr uint32_t kConeBackSteps = 16;

/// Largest ClusterRecord::extent_shift: covers the whole grid from corner to corner.
inline constexpr uint32_t kMaxExtentShift = 9;

/// Return the vertex layout of a cluster: its mesh's layout, and kVertexWideOffsets if its offsets need more
/// than 16 bits.
constexpr uint32_t clusterVertexLayout(const ClusterRecord& cluster, uint32_t mesh_layout)
{
    return mesh_layout | (cluster.extent_shift > 0 ? uint32_t{kVertexWideOffsets} : 0u);
}

/// Return the number of steps from the base to the high corner of the box.
constexpr int64_t boxSteps(const ClusterRecord& cluster, int axis)
{
    return int64_t{cluster.extent[axis]} << cluster.extent_shift;
}

inline Box3 clusterBox(const ClusterRecord& cluster, float grid_step)
{
    Box3 box;
    for (int axis = 0; axis < 3; ++axis)
    {
        box.min[axis] = static_cast<float>(cluster.base[axis]) * grid_step;
        box.max[axis] = static_cast<float>(cluster.base[axis] + boxSteps(cluster, axis)) * grid_step;
    }
    return box;
}

/// Return the unit vector along the middle of the cluster's normals.
inline Float3 coneAxis(const ClusterRecord& cluster)
{
    return NormalCode<8>::decode(cluster.cone_axis);
}

/// Return the sine of the cone's half-angle.
constexpr float coneCutoff(const ClusterRecord& cluster)
{
    return static_cast<float>(cluster.cone_cutoff) * 0x1p-16f;
}

/// Return the distance of the apex behind the middle of the box.
constexpr double coneBack(const ClusterRecord& cluster, float grid_step)
{
    return static_cast<double>(uint64_t{cluster.cone_back} * kConeBackSteps << cluster.extent_shift) *
           static_cast<double>(grid_step);
}

} // namespace hearth::formats
