// Checks that the records of formats/gpu_shared/records.h have the offsets and sizes of the file format's
// records.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/records.h"
#include "formats/records/mesh.h"
#include "formats/records/scene.h"

#include <cstddef>

#define HEARTH_SAME_OFFSET(shared_type, shared_member, record_type, record_member)                           \
    static_assert(offsetof(hearth::shared::shared_type, shared_member) ==                                    \
                  offsetof(hearth::formats::record_type, record_member))

static_assert(sizeof(hearth::shared::Instance) == sizeof(hearth::formats::InstanceRecord));
HEARTH_SAME_OFFSET(Instance, world_from_object_x, InstanceRecord, world_from_object);
HEARTH_SAME_OFFSET(Instance, mesh, InstanceRecord, mesh);
HEARTH_SAME_OFFSET(Instance, node, InstanceRecord, node);
HEARTH_SAME_OFFSET(Instance, flags, InstanceRecord, flags);
HEARTH_SAME_OFFSET(Instance, scale_max, InstanceRecord, scale_max);

static_assert(sizeof(hearth::shared::Group) == sizeof(hearth::formats::GroupRecord));
HEARTH_SAME_OFFSET(Group, sphere_center, GroupRecord, sphere_center);
HEARTH_SAME_OFFSET(Group, sphere_radius, GroupRecord, sphere_radius);
HEARTH_SAME_OFFSET(Group, error, GroupRecord, error);
HEARTH_SAME_OFFSET(Group, level, GroupRecord, level);
HEARTH_SAME_OFFSET(Group, first_cluster, GroupRecord, clusters);
HEARTH_SAME_OFFSET(Group, page, GroupRecord, page);
HEARTH_SAME_OFFSET(Group, set_offset, GroupRecord, set_offset);
HEARTH_SAME_OFFSET(Group, position_error, GroupRecord, position_error);
HEARTH_SAME_OFFSET(Group, normal_error, GroupRecord, normal_error);
HEARTH_SAME_OFFSET(Group, uv_error, GroupRecord, uv_error);
HEARTH_SAME_OFFSET(Group, absent, GroupRecord, reserved);

static_assert(sizeof(hearth::shared::Cluster) == sizeof(hearth::formats::ClusterRecord));
HEARTH_SAME_OFFSET(Cluster, base_x, ClusterRecord, base);
HEARTH_SAME_OFFSET(Cluster, extent_xy, ClusterRecord, extent);
HEARTH_SAME_OFFSET(Cluster, extent_z, ClusterRecord, extent[2]);
HEARTH_SAME_OFFSET(Cluster, cone, ClusterRecord, cone_axis);
HEARTH_SAME_OFFSET(Cluster, cone_back, ClusterRecord, cone_back);
HEARTH_SAME_OFFSET(Cluster, counts, ClusterRecord, triangle_count);
HEARTH_SAME_OFFSET(Cluster, material, ClusterRecord, material);
HEARTH_SAME_OFFSET(Cluster, group, ClusterRecord, group);
HEARTH_SAME_OFFSET(Cluster, refined_group, ClusterRecord, refined_group);
HEARTH_SAME_OFFSET(Cluster, page, ClusterRecord, page);

#undef HEARTH_SAME_OFFSET

static_assert(hearth::shared::kNoGroup == hearth::kInvalidIndex);
// sizes in std430 and std140 layout
static_assert(sizeof(hearth::shared::MeshBounds) == 32);
static_assert(sizeof(hearth::shared::InstanceInverse) == 48);
static_assert(sizeof(hearth::shared::InstanceState) == 32);
static_assert(sizeof(hearth::shared::FrameView) == 320);
static_assert(sizeof(hearth::shared::BinDraw) == 32);
static_assert(sizeof(hearth::shared::WorkItem) == 16);
static_assert(sizeof(hearth::shared::GroupItem) == 12);
static_assert(sizeof(hearth::shared::WorkResult) == 20);
static_assert(sizeof(hearth::shared::OcclusionView) == 80);
static_assert(sizeof(hearth::shared::ClusterDraw) == 36);
static_assert(hearth::shared::kClusterVertices == 3 * hearth::formats::kMaxClusterTriangles);
