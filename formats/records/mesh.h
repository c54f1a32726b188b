// Chunks of the mesh hierarchy and its geometry pages, as packed, and of the source meshes in parts. See
// FORMAT.md, "Hierarchy"; the cut rule is at GroupRecord.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/vertex_layout.h"
#include "formats/records/container.h"

namespace hearth::formats
{

inline constexpr uint32_t kChunkMeshes = fourCC("MESH");         ///< MeshRecord[]
inline constexpr uint32_t kChunkLevels = fourCC("LEVL");         ///< LevelRecord[]
inline constexpr uint32_t kChunkGroups = fourCC("GRUP");         ///< GroupRecord[]
inline constexpr uint32_t kChunkClusters = fourCC("CLUS");       ///< ClusterRecord[]
inline constexpr uint32_t kChunkPageTable = fourCC("PGTB");      ///< PageRecord[]
inline constexpr uint32_t kChunkPageParents = fourCC("PGPA");    ///< u32[]: pages that a page refines
inline constexpr uint32_t kChunkPages = fourCC("PAGE");          ///< pages, each aligned to 64 bytes
inline constexpr uint32_t kChunkSourceMesh = fourCC("SMSH");     ///< mesh `index` as imported
inline constexpr uint32_t kChunkInstanceMeshes = fourCC("IMSH"); ///< u32[]: mesh of each instance
inline constexpr uint32_t kChunkAuthoredLods = fourCC("ALOD");   ///< AuthoredLodRecord[]

inline constexpr uint32_t kMaxClusterTriangles = 128;
inline constexpr uint32_t kMaxClusterVertices = 256;
inline constexpr uint32_t kMaxPageBytes = 65536;

// vertex layout of a mesh, which shaders share
using shared::kVertexColor;
using shared::kVertexColor16;
using shared::kVertexInfluences;
using shared::kVertexInfluences8;
using shared::kVertexNormal;
using shared::kVertexNormal16;
using shared::kVertexTangent;
using shared::kVertexUv0;
using shared::kVertexUv1;
using shared::kVertexUv2;
using shared::kVertexUv3;
using shared::kVertexUvs;
using shared::kVertexUvStepShift;
using shared::kVertexVisibility;
using shared::kVertexWideOffsets;

using shared::gridUvs;
using shared::influencesPerVertex;
using shared::uvBaseWords;
using shared::vertexWords;

inline constexpr uint32_t kVertexInfluenceBits = kVertexInfluences | kVertexInfluences8;

struct MeshRecord
{
    StringRef name;
    uint32_t attributes;
    uint32_t source_faces;
    uint32_t source_triangles;
    uint32_t source_vertices;
    uint32_t degenerate_triangles;
    uint32_t lod_count;
    Range levels;
    Range groups;
    Range clusters;
    Range pages;
    Float3 box_min;
    Float3 box_max;
    uint32_t skinned;
    uint32_t morph_target_count;
    float grid_step;
    float grid_error;
};

/// Level of detail. Levels are stored finest first: the first level of a mesh is the source.
struct LevelRecord
{
    Range clusters;
    uint32_t triangle_count;
    float max_error;
};

/// Clusters that are simplified together and replaced together.
/// If the next level is an authored LOD, all groups of the finer level are replaced together: they are a set.
/// The groups of a set follow each other and share sphere, error and level; clusters made from the set refer
/// to its first group.
/// The cut: with E(g) the projected error of a group, draw cluster x if and only if
///     (x.refined_group == none or E(refined_group) <= threshold) and E(group) > threshold,
/// where E of a root group (error = infinity) is infinite. Errors and spheres are monotone: for every cluster
/// x, error(refined_group) <= error(group), and the sphere of refined_group lies inside the sphere of group.
struct GroupRecord
{
    Float3 sphere_center;
    float sphere_radius;
    float error;
    uint32_t level;
    Range clusters;
    uint32_t page;
    uint32_t set_offset;
    float position_error;
    float normal_error;
    float uv_error;
    uint32_t reserved[3];
};

/// Culling and drawing data of a cluster; 48 bytes, read by the GPU unchanged (formats/gpu_shared/records.h).
/// Its box is base .. base + (extent << extent_shift), in steps of the mesh's grid. The apex of its normal
/// cone is 16 cone_back << extent_shift steps behind the middle of the box, against the axis.
struct ClusterRecord
{
    int32_t base[3];
    uint16_t extent[3];
    uint8_t extent_shift;
    uint8_t level;
    uint16_t cone_axis;
    uint16_t cone_cutoff;
    uint16_t cone_back;
    uint16_t vertex_count;
    uint8_t triangle_count;
    uint8_t uv_density;
    uint16_t page_word;
    uint32_t material;
    uint32_t group;
    uint32_t refined_group;
    uint32_t page;
};

/// cone_cutoff of a cone that never culls.
inline constexpr uint16_t kNoCone = 65535;

/// Storage of a page.
enum class PageCodec : uint32_t
{
    none = 0,     ///< decoded form
    zstd = 1,     ///< decoded form as one zstd frame
    clusters = 2, ///< triangles and vertices as differences from earlier ones: formats/codecs/page_codec.h
};

/// Page: clusters of whole groups, in the order of the cluster table. Each cluster's data starts at its
/// page_word: uvBaseWords words, vertex_count vertices, then 3 u8 vertex indices for each triangle, padded to
/// 4 bytes with zeros; in a mesh with morph targets, then the cluster's morph section (vertex_codec.h).
struct PageRecord
{
    uint64_t offset;
    uint32_t stored_size;
    uint32_t size;
    uint32_t codec;
    uint32_t mesh;
    Range clusters;
    Range parents;
    uint64_t hash;
    uint32_t reserved[2];
};

enum class SourceSemantic : uint32_t
{
    position = 0,          ///< f32 x 3
    normal = 1,            ///< f32 x 3, unit
    tangent = 2,           ///< f32 x 4, w = +-1: sign of the bitangent
    uv = 3,                ///< f32 x 2, set 0..3
    color = 4,             ///< f32 x 4, linear
    joints = 5,            ///< u16 x 4, set 0..; joint of the skin
    weights = 6,           ///< f32 x 4, set 0..; sum over the sets is 1
    index = 7,             ///< u32 x 3 for each triangle
    triangle_material = 8, ///< u32 for each triangle, or none
    morph_position = 9,    ///< f32 x 3 deltas, set = target
    morph_normal = 10,     ///< f32 x 3 deltas, set = target
    morph_tangent = 11,    ///< f32 x 3 deltas, set = target
};

/// Authored LOD: mesh `lod` is mesh `mesh` with less detail, in the same object space. It is not drawn by
/// itself. Records of one mesh follow each other, finest first; meshes ascending.
struct AuthoredLodRecord
{
    uint32_t mesh;
    uint32_t lod;
    uint32_t number;
    StringRef name;
};

/// Header of chunk SMSH: SourceMeshHeader, then array_count SourceArrays, then the data, each array
/// 16-aligned.
struct SourceMeshHeader
{
    uint32_t array_count;
    uint32_t face_count;
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t source_vertex_count;
    StringRef name;
    uint32_t reserved;
};

struct SourceArray
{
    uint32_t semantic;
    uint32_t set;
    uint64_t offset;
    uint64_t count;
    uint32_t element_size;
    uint32_t reserved;
};

} // namespace hearth::formats

HEARTH_RECORD(
    hearth::formats::MeshRecord, 104, HEARTH_FIELD(hearth::formats::MeshRecord, name, "may be empty"),
    HEARTH_FIELD(hearth::formats::MeshRecord, attributes, "the layout of its vertices"),
    HEARTH_FIELD(hearth::formats::MeshRecord, source_faces, "polygons before triangulation"),
    HEARTH_FIELD(hearth::formats::MeshRecord, source_triangles, "triangles of the source"),
    HEARTH_FIELD(hearth::formats::MeshRecord, source_vertices, "vertices as the source counts them"),
    HEARTH_FIELD(hearth::formats::MeshRecord, degenerate_triangles,
                 "source triangles without area, not kept"),
    HEARTH_FIELD(hearth::formats::MeshRecord, lod_count, "number of levels"),
    HEARTH_FIELD(hearth::formats::MeshRecord, levels, "chunk LEVL, finest first"),
    HEARTH_FIELD(hearth::formats::MeshRecord, groups, "chunk GRUP"),
    HEARTH_FIELD(hearth::formats::MeshRecord, clusters, "chunk CLUS"),
    HEARTH_FIELD(hearth::formats::MeshRecord, pages, "chunk PGTB; the first holds the coarsest level"),
    HEARTH_FIELD(hearth::formats::MeshRecord, box_min, "object space"),
    HEARTH_FIELD(hearth::formats::MeshRecord, box_max, "object space"),
    HEARTH_FIELD(hearth::formats::MeshRecord, skinned, "1: its vertices have joints and weights"),
    HEARTH_FIELD(hearth::formats::MeshRecord, morph_target_count, "morph targets"),
    HEARTH_FIELD(hearth::formats::MeshRecord, grid_step,
                 "a power of two; all positions are whole multiples of it; 0 without clusters"),
    HEARTH_FIELD(hearth::formats::MeshRecord, grid_error,
                 "how far at most a vertex of the source moved to come on the grid"));
HEARTH_RECORD(hearth::formats::LevelRecord, 16,
              HEARTH_FIELD(hearth::formats::LevelRecord, clusters, "chunk CLUS"),
              HEARTH_FIELD(hearth::formats::LevelRecord, triangle_count, ""),
              HEARTH_FIELD(hearth::formats::LevelRecord, max_error,
                           "largest error of its clusters, object space"));
HEARTH_RECORD(hearth::formats::GroupRecord, 64,
              HEARTH_FIELD(hearth::formats::GroupRecord, sphere_center, "object space"),
              HEARTH_FIELD(hearth::formats::GroupRecord, sphere_radius,
                           "contains the spheres of all refined groups"),
              HEARTH_FIELD(hearth::formats::GroupRecord, error,
                           "object space; of what replaces it, for the cut; infinity for a root"),
              HEARTH_FIELD(hearth::formats::GroupRecord, level, "of its clusters"),
              HEARTH_FIELD(hearth::formats::GroupRecord, clusters, "chunk CLUS"),
              HEARTH_FIELD(hearth::formats::GroupRecord, page, "that holds all its clusters"),
              HEARTH_FIELD(hearth::formats::GroupRecord, set_offset,
                           "its index in its set of groups; 0 if it is alone"),
              HEARTH_FIELD(hearth::formats::GroupRecord, position_error,
                           "object space; bounds the distance of what replaces it to the source"),
              HEARTH_FIELD(hearth::formats::GroupRecord, normal_error,
                           "radians, root mean square: normals of what replaces it"),
              HEARTH_FIELD(hearth::formats::GroupRecord, uv_error,
                           "object space, root mean square: UVs of set 0, as lengths on the surface"),
              HEARTH_FIELD(hearth::formats::GroupRecord, reserved, "0"));
HEARTH_RECORD(hearth::formats::ClusterRecord, 48,
              HEARTH_FIELD(hearth::formats::ClusterRecord, base,
                           "low corner of the box in steps of the grid; offsets of positions count from it"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, extent,
                           "size of the box, rounded up where extent_shift is not 0"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, extent_shift,
                           "0 to 9; not 0: a wide cluster, its offsets are 32 bits"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, level, "0 is the source"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, cone_axis, "normal cone: octahedral, 2 x snorm8"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, cone_cutoff,
                           "sine of the half-angle in 1/65536, rounded up; 65535: the cone never culls"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, cone_back,
                           "the apex: every triangle's plane has it on or behind its front side"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, vertex_count, "1 to 256"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, triangle_count, "1 to 128"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, uv_density,
                           "c: 2^((c - 128) / 8) UV units a metre of object space; 0: none that are read"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, page_word,
                           "first word of its data in the decoded page"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, material, "material, or none for the default"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, group, "group that it is simplified in"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, refined_group,
                           "group that it was made from, none at level 0; its error is the cluster's"),
              HEARTH_FIELD(hearth::formats::ClusterRecord, page, "page that holds the geometry"));
HEARTH_RECORD(hearth::formats::PageRecord, 56,
              HEARTH_FIELD(hearth::formats::PageRecord, offset,
                           "from the start of chunk PAGE; a multiple of 64"),
              HEARTH_FIELD(hearth::formats::PageRecord, stored_size, "bytes in the file"),
              HEARTH_FIELD(hearth::formats::PageRecord, size, "bytes after decompression, at most 65536"),
              HEARTH_FIELD(hearth::formats::PageRecord, codec, "how the page is stored"),
              HEARTH_FIELD(hearth::formats::PageRecord, mesh, "mesh"),
              HEARTH_FIELD(hearth::formats::PageRecord, clusters, "chunk CLUS"),
              HEARTH_FIELD(hearth::formats::PageRecord, parents,
                           "chunk PGPA: pages, all earlier, that hold what this page refines"),
              HEARTH_FIELD(hearth::formats::PageRecord, hash, "XXH3-64 of the stored bytes"),
              HEARTH_FIELD(hearth::formats::PageRecord, reserved, "0"));
HEARTH_RECORD(hearth::formats::AuthoredLodRecord, 20,
              HEARTH_FIELD(hearth::formats::AuthoredLodRecord, mesh, "chunk SMSH of this index"),
              HEARTH_FIELD(hearth::formats::AuthoredLodRecord, lod, "chunk SMSH of this index"),
              HEARTH_FIELD(hearth::formats::AuthoredLodRecord, number,
                           "3 of rock_LOD3; none where nobody gave it a number"),
              HEARTH_FIELD(hearth::formats::AuthoredLodRecord, name,
                           "of the file or node that it came from; may be empty"));
HEARTH_RECORD(hearth::formats::SourceMeshHeader, 32,
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, array_count, ""),
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, face_count, "polygons before triangulation"),
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, vertex_count, "of the arrays that follow"),
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, triangle_count, ""),
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, source_vertex_count,
                           "vertices as the source counts them"),
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, name, "may be empty"),
              HEARTH_FIELD(hearth::formats::SourceMeshHeader, reserved, "0"));
HEARTH_RECORD(hearth::formats::SourceArray, 32,
              HEARTH_FIELD(hearth::formats::SourceArray, semantic, "what it holds"),
              HEARTH_FIELD(hearth::formats::SourceArray, set, "UV set, influence set or morph target"),
              HEARTH_FIELD(hearth::formats::SourceArray, offset,
                           "from the start of the chunk; a multiple of 16"),
              HEARTH_FIELD(hearth::formats::SourceArray, count, "elements"),
              HEARTH_FIELD(hearth::formats::SourceArray, element_size, "bytes of one element"),
              HEARTH_FIELD(hearth::formats::SourceArray, reserved, "0"));
