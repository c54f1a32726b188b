// Buffers that the GPU reads and writes (std430; std140 for the uniform blocks). One source for C++ and GLSL.
// The first three structs are the records of formats/records/mesh.h and formats/records/scene.h byte for
// byte, so a pack's tables are uploaded unchanged.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_RECORDS_H
#define HEARTH_SHARED_RECORDS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// formats::InstanceRecord. Rows of the 3x4 matrix: xyz is the linear part, w the translation in metres.
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

/// formats::GroupRecord. A pack has 0 in `absent`: its table means that everything is resident.
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
    /// 1: its page set is not wholly in the geometry pool, and its simplified version is drawn instead
    uint absent;
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
    uint counts;    ///< triangle_count, uv_density << 8, page_word << 16
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

/// Inverse of the linear part of an instance's matrix, for the normal-cone test in object space. The w of the
/// first row is 1, or 0 where the matrix has no inverse: such an instance is never cone-culled.
struct InstanceInverse
{
    Float4 object_from_world_x;
    Float4 object_from_world_y;
    Float4 object_from_world_z;
};

/// Result of the instance pass for one frame, read by the cluster pass.
struct InstanceState
{
    Float3 eye_object;
    float eye_slack; ///< bound of the rounding error of eye_object, object space
    uint visible;    ///< kInstance*
    uint cone_valid; ///< 0: the instance has no inverse and eye_object is invalid
    float grid_step; ///< quantisation step of its mesh
    uint reserved;
};

/// Clusters order[first .. first + count) of one instance, all drawn by the same bin. One workgroup.
struct WorkItem
{
    uint instance;
    uint first;
    uint count; ///< 1 to kWorkItemClusters
    uint flags; ///< bits kItem*
};

/// Groups [first, first + count) of the mesh of one instance. One workgroup of the page requests.
struct GroupItem
{
    uint instance;
    uint first;
    uint count; ///< 1 to kWorkItemClusters
};

/// Result of the cluster pass for a work item, and after the scan the position of its clusters in the output.
struct WorkResult
{
    uint mask_low;  ///< bit i: cluster order[first + i] is drawn
    uint mask_high; ///< the same for 32 + i
    uint offset;    ///< number of clusters drawn by earlier items of its scan block
    /// Bit i: the last frame's depth occludes the cluster, and the late phase tests it again
    uint later_low;
    uint later_high;
};

/// Slot of the visible list. The slot number is the upper 25 bits of the visibility buffer.
struct VisibleCluster
{
    uint instance;
    uint cluster;
};

/// Items [first_item, first_item + item_count) of the work list, drawn by one indirect draw with one
/// pipeline.
struct Bin
{
    uint first_item;
    uint item_count;
};

/// Indirect draw of a bin (VkDrawIndirectCommand), and its first slot of the visible list. The first instance
/// is always 0, because drawIndirectFirstInstance is not required of the device.
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
    uint dropped_clusters; ///< number of drawn clusters without a slot in the visible list; the last ones
    uint early_clusters;   ///< number of drawn clusters that the early phase found; the first ones
    uint reserved;
};

/// Data of a cluster for drawing.
struct ClusterDraw
{
    uint address;       ///< first vertex, in words of the geometry pool; the UV bases are stored before it
    uint counts;        ///< packDrawCounts, and kDrawMorphs
    uint vertex_layout; ///< bits kVertex* (vertex_layout.h)
    uint material;      ///< 1 + row of the material table; 0 is the sky
    int base_x;         ///< positions are (base + offset) * grid_step
    int base_y;
    int base_z;
    float grid_step;
    float position_error; ///< bounds the distance of its surface to the source; object space
};

/// Bit of ClusterDraw::counts: morph targets are stored after the triangles.
HEARTH_CONSTANT uint kDrawMorphs = 0x80000000u;

/// Return ClusterDraw::counts without kDrawMorphs; the functions below read it.
HEARTH_FUNCTION uint packDrawCounts(uint vertices, uint triangles, uint level)
{
    return vertices | triangles << 9 | level << 17;
}
HEARTH_FUNCTION uint vertexCount(HEARTH_IN(ClusterDraw) draw)
{
    return draw.counts & 0x1FFu;
}
HEARTH_FUNCTION uint triangleCount(HEARTH_IN(ClusterDraw) draw)
{
    return draw.counts >> 9 & 0xFFu;
}
HEARTH_FUNCTION uint clusterLevel(HEARTH_IN(ClusterDraw) draw)
{
    return draw.counts >> 17 & 0xFFu;
}

/// Number of knots of the LOD curve (lod_curve.h).
HEARTH_CONSTANT uint kLodKnots = 8;

/// Camera and flags of one frame. All positions that reach the screen are relative to the eye, in world axes,
/// so coordinates far from the origin keep their precision: clip = (x . p, y . p, z_near, w . p), or of an
/// orthographic view (x . p + x_w, y . p + y_w, (z_far - w . p) depth_scale, 1).
struct FrameView
{
    Float4 clip_x; ///< w: shift of an orthographic image, here and below; else 0
    Float4 clip_y;
    Float4 clip_w;    ///< xyz: axis of the view, unit; w: z_far of an orthographic view, else 0
    Float4 planes[5]; ///< left, right, bottom, top, near: inside where dot(xyz, p) + w >= 0
    Float3 eye;       ///< world
    float z_near;     ///< metres; without a far plane depth = z_near / distance along the axis
    float lod_scale;  ///< pixels that one metre covers at a distance of one metre, or orthographic at any
    float threshold;  ///< error in pixels below which a group is not refined; negative: refine everything
    uint flags;       ///< bits kCull*
    uint instance_count;
    float width; ///< pixels
    float height;
    float corner_cosine;    ///< of the angle between the view's axis and a corner of the image, or less
    float depth_scale;      ///< of an orthographic view, 1 / (z_far - z_near); else 0
    Float4 lod_curve[8];    ///< from distance x on the factor goes from y to z, with slope w per metre
    Float4 material_inputs; ///< of the game, for its material functions
};

/// View that a depth pyramid was rendered from (occlusion.h).
struct OcclusionView
{
    Float4 clip_x; ///< as FrameView
    Float4 clip_y;
    Float4 clip_w;
    Float3 eye;
    float z_near;
    uint width; ///< pixels
    uint height;
    uint level_count; ///< 0: there is no pyramid and nothing is occluded
    float depth_scale;
};

/// Clusters or groups of a work item: threads of its workgroup.
HEARTH_CONSTANT uint kWorkItemClusters = 64;
/// Threads of a workgroup of the passes with a thread for each instance, or for each bin.
HEARTH_CONSTANT uint kGroupInstances = 64;
HEARTH_CONSTANT uint kGroupBins = 64;
/// Work items that one workgroup of the scan sums.
HEARTH_CONSTANT uint kScanBlockItems = 1024;
/// Workgroups of a dispatch in x; the rest go to y (65535 is guaranteed in each).
HEARTH_CONSTANT uint kMaxDispatchX = 32768;
/// Vertices of one instance of a cluster draw: 128 triangles without indices.
HEARTH_CONSTANT uint kClusterVertices = 384;
/// Bits of a word address inside a slice. The geometry pool is cut into slices of 128 MiB, the storage buffer
/// range that every device supports.
HEARTH_CONSTANT uint kPoolSliceAddressBits = 25;
HEARTH_CONSTANT uint kPoolSlices = 4;
HEARTH_CONSTANT uint kItemDoubleSided = 1; ///< skip the normal cone

HEARTH_CONSTANT uint kCullInstances = 1;
HEARTH_CONSTANT uint kCullFrustum = 2;
HEARTH_CONSTANT uint kCullCone = 4;
HEARTH_CONSTANT uint kCullOcclusion = 8;
HEARTH_CONSTANT uint kCullEverything = 15;
/// Bits of shadow caster views: leave out instances that have moved since loading, or instances that have
/// not.
HEARTH_CONSTANT uint kCullMoving = 16;
HEARTH_CONSTANT uint kCullStatic = 32;

/// Bit of Instance::flags, beside kInstanceMirrored: the instance has moved since loading.
HEARTH_CONSTANT uint kInstanceMoved = 0x80000000u;
/// Bit of Instance::flags: the handedness of the matrix has changed since loading. Its bin would draw the
/// wrong side of its triangles, so their corners are taken in reverse order.
HEARTH_CONSTANT uint kInstanceHandednessChanged = 0x40000000u;

/// Copy of words from one buffer to another, by a workgroup.
struct CopyRegion
{
    uint source; ///< words from the front of the buffer, here and below
    uint target;
    uint words; ///< at most kMaxCopyWords
    uint reserved;
};
HEARTH_CONSTANT uint kMaxCopyWords = 1024;
HEARTH_CONSTANT uint kGroupCopyWords = 128; ///< threads of a workgroup

/// Culling phase. A frame without the occlusion test has the phase kPhaseWhole; with it, the early and late
/// phases follow each other.
HEARTH_CONSTANT uint kPhaseWhole = 0;
HEARTH_CONSTANT uint kPhaseEarly = 1; ///< clusters that the last frame's depth does not occlude
/// of the rest, clusters that the depth of the early clusters does not occlude
HEARTH_CONSTANT uint kPhaseLate = 2;

HEARTH_CONSTANT uint kInstanceHidden = 0;   ///< culled
HEARTH_CONSTANT uint kInstanceVisible = 1;  ///< its clusters are tested
HEARTH_CONSTANT uint kInstanceDeferred = 2; ///< occluded by the last frame's depth: the late phase decides
HEARTH_CONSTANT uint kInstanceLate = 3;     ///< was deferred, and its clusters are tested in the late phase

/// Visibility buffer: slot << kTriangleBits | triangle.
HEARTH_CONSTANT uint kTriangleBits = 7;
HEARTH_CONSTANT uint kVisibilitySky = 0xFFFFFFFFu;
HEARTH_CONSTANT uint kMaxSlots = (1u << 25) - 2u;

HEARTH_CONSTANT uint kNoGroup = 0xFFFFFFFFu;

HEARTH_SHARED_END

#endif
