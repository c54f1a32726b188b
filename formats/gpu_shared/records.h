// What the GPU reads and writes, written once for C++ and GLSL (std430; std140 for the uniform blocks). The first
// three are the records of formats/records/mesh.h and formats/records/scene.h byte for byte, so that a pack's tables are uploaded as they are.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_RECORDS_H
#define HEARTH_SHARED_RECORDS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// formats::InstanceRecord. Rows of the 3x4 matrix: xyz the linear part, w the translation in metres.
struct Instance
{
    Float4 world_from_object_x;
    Float4 world_from_object_y;
    Float4 world_from_object_z;
    uint mesh;
    uint node;
    uint flags;
    float scale_max;
};

/// formats::GroupRecord. A pack has 0 in `absent`, so that its table says that everything is resident.
struct Group
{
    Float3 sphere_center;
    float sphere_radius;
    float error;
    uint level;
    uint first_cluster;
    uint cluster_count;
    uint page;
    uint set_offset;
    float position_error;
    float normal_error;
    float uv_error;
    uint absent; ///< 1: its set is not wholly in the geometry pool, what it was made into stands in for it
    uint reserved0;
    uint reserved1;
};

/// formats::ClusterRecord, in words.
struct Cluster
{
    int base_x;
    int base_y;
    int base_z;
    uint extent_xy; ///< x in the low half
    uint extent_z;  ///< extent_shift << 16, level << 24
    uint cone;      ///< axis in the low half, cutoff
    uint cone_back; ///< vertex_count << 16
    uint counts;    ///< triangle_count, page_word << 16
    uint material;
    uint group;
    uint refined_group;
    uint page;
};

/// Bounds of a mesh over all its levels, in object space.
struct MeshBounds
{
    Float3 box_min;
    float grid_step;
    Float3 box_max;
    uint reserved;
};

/// Inverse of the linear part of an instance's matrix, for the normal-cone test in object space.
/// The w of the first row is 1, or 0 where the matrix has no inverse: such an instance is never cone-culled.
struct InstanceInverse
{
    Float4 object_from_world_x;
    Float4 object_from_world_y;
    Float4 object_from_world_z;
};

/// What the instance pass finds out for a frame and the cluster pass uses.
struct InstanceState
{
    Float3 eye_object;
    float eye_slack; ///< how far eye_object may be off through rounding, object space
    uint visible;    ///< kInstance*
    uint cone_valid; ///< 0: the instance has no inverse and eye_object means nothing
    float grid_step; ///< of its mesh
    uint reserved;
};

/// Clusters order[first .. first + count) of one instance, all drawn by the same bin; one workgroup.
struct WorkItem
{
    uint instance;
    uint first;
    uint count; ///< 1 to kWorkItemClusters
    uint flags; ///< bits kItem*
};

/// Groups [first, first + count) of the mesh of one instance; one workgroup of the page requests.
struct GroupItem
{
    uint instance;
    uint first;
    uint count; ///< 1 to kWorkItemClusters
};

/// What the cluster pass found in a work item, and after the scan where its clusters go.
struct WorkResult
{
    uint mask_low;  ///< bit i: cluster order[first + i] is drawn
    uint mask_high; ///< the same for 32 + i
    uint offset;    ///< clusters drawn by the items before it in its scan block
    uint later_low; ///< bit i: what was drawn last frame hides the cluster, the late phase looks again
    uint later_high;
};

/// One slot of the visible list; a slot's number is the upper 25 bits of the visibility buffer.
struct VisibleCluster
{
    uint instance;
    uint cluster;
};

/// Items [first_item, first_item + item_count) of the work list are drawn by one indirect draw with one pipeline.
struct Bin
{
    uint first_item;
    uint item_count;
};

/// The indirect draw of a bin (VkDrawIndirectCommand), and the first slot of the visible list that it draws:
/// drawIndirectFirstInstance is not required of the device, so the first instance is always 0.
struct BinDraw
{
    uint vertex_count;
    uint instance_count;
    uint first_vertex;
    uint first_instance;
    uint first_slot;
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

/// Counters of a frame, for the caller to read back.
struct FrameCounters
{
    uint drawn_clusters;   ///< clusters that passed all tests
    uint dropped_clusters; ///< of these, the last ones for which the visible list had no slot
    uint early_clusters;   ///< of these, the first ones, which the early phase found
    uint reserved;
};

/// What drawing needs of a cluster.
struct ClusterDraw
{
    uint address;       ///< of its first vertex, in words of the geometry pool; the UV bases stand before it
    uint counts;        ///< vertices | triangles << 9 | level << 17 | kDrawMorphs
    uint vertex_layout; ///< formats::VertexAttributes
    uint material;      ///< 1 + row of the material table; 0 is the sky
    int base_x;         ///< positions are (base + offset) * grid_step
    int base_y;
    int base_z;
    float grid_step;
};

/// Of ClusterDraw::counts: morph targets stand behind the triangles.
HEARTH_CONSTANT uint kDrawMorphs = 0x80000000u;

/// Knots of the LOD curve (lod_curve.h).
HEARTH_CONSTANT uint kLodKnots = 8;

/// Camera and switches of one frame. All positions that reach the screen are relative to the eye, in world axes,
/// so that coordinates far from the origin keep their precision: clip = (x . p, y . p, z_near, w . p).
struct FrameView
{
    Float4 clip_x; ///< w unused, here and below
    Float4 clip_y;
    Float4 clip_w;
    Float4 planes[5]; ///< left, right, bottom, top, near: inside where dot(xyz, p) + w >= 0
    Float3 eye;       ///< world
    float z_near;     ///< metres; the far plane is infinite, depth = z_near / distance
    float lod_scale;  ///< pixels that one metre covers at a distance of one metre
    float threshold;  ///< error in pixels that is not worth refining; negative: refine everything
    uint flags;       ///< bits kCull*
    uint instance_count;
    float width; ///< pixels
    float height;
    uint reserved0;
    uint reserved1;
    Float4 lod_curve[8]; ///< from distance x on the factor goes from y to z, by w a metre
};

/// From where and at what size a depth pyramid was drawn (occlusion.h).
struct OcclusionView
{
    Float4 clip_x; ///< as FrameView
    Float4 clip_y;
    Float4 clip_w;
    Float3 eye;
    float z_near;
    uint width; ///< pixels
    uint height;
    uint level_count; ///< 0: nothing is known and nothing hidden
    uint reserved;
};

HEARTH_CONSTANT uint kWorkItemClusters = 64;
/// Work items that one workgroup of the scan adds up.
HEARTH_CONSTANT uint kScanBlockItems = 1024;
/// Workgroups of a dispatch in x; more go to y (65535 is what every device has in each).
HEARTH_CONSTANT uint kDispatchRow = 32768;
/// Vertices of one instance of a cluster draw: 128 triangles without indices.
HEARTH_CONSTANT uint kClusterVertices = 384;
/// The geometry pool is cut into slices of 128 MiB, the storage buffer range that every device has.
HEARTH_CONSTANT uint kPoolSliceBits = 25; ///< of a word address
HEARTH_CONSTANT uint kPoolSlices = 4;
HEARTH_CONSTANT uint kItemDoubleSided = 1; ///< skip the normal cone

HEARTH_CONSTANT uint kCullInstances = 1;
HEARTH_CONSTANT uint kCullFrustum = 2;
HEARTH_CONSTANT uint kCullCone = 4;
HEARTH_CONSTANT uint kCullOcclusion = 8;
HEARTH_CONSTANT uint kCullEverything = 15;
/// Views of casters only: leave out instances that have moved since they were loaded, or those that have not.
HEARTH_CONSTANT uint kCullMoving = 16;
HEARTH_CONSTANT uint kCullResting = 32;

/// Of Instance::flags, beside formats::InstanceFlags: the instance has moved since it was loaded.
HEARTH_CONSTANT uint kInstanceMoves = 0x80000000u;
/// It is mirrored where it was not when it was loaded, or the other way round: its bin draws the wrong side of its triangles
/// unless their corners are taken in the other order.
HEARTH_CONSTANT uint kInstanceTurned = 0x40000000u;

/// What culling a frame without the occlusion test is one of; with it, two follow each other.
HEARTH_CONSTANT uint kPhaseWhole = 0;
HEARTH_CONSTANT uint kPhaseEarly = 1; ///< what the last frame's depth does not hide
HEARTH_CONSTANT uint kPhaseLate = 2;  ///< of the rest, what the depth of the early clusters does not hide

HEARTH_CONSTANT uint kInstanceHidden = 0;   ///< nothing of it can be seen
HEARTH_CONSTANT uint kInstanceVisible = 1;  ///< its clusters are looked at
HEARTH_CONSTANT uint kInstanceDeferred = 2; ///< hidden by the last frame's depth: the late phase decides
HEARTH_CONSTANT uint kInstanceLate = 3;     ///< was deferred, and its clusters are looked at now

/// Visibility buffer: slot << kTriangleBits | triangle.
HEARTH_CONSTANT uint kTriangleBits = 7;
HEARTH_CONSTANT uint kNothingVisible = 0xFFFFFFFFu;
HEARTH_CONSTANT uint kMaxSlots = (1u << 25) - 2u;

HEARTH_CONSTANT uint kNoGroup = 0xFFFFFFFFu;

HEARTH_SHARED_END

#endif
