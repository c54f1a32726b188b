// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/cluster_bounds.h"
#include "formats/container/container_reader.h"
#include "tests/formats/malformed/malformed_packs.h"

#include <cstring>
#include <limits>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kHuge = 0xFFFFFFF0u; ///< first + count overflows 32 bits

// A cluster of the strip: base of u and v, then vertices of 6 words: position (with the normal in the upper
// half of its second), tangent, UV, colour, visibility.
constexpr size_t kStripVertices = 2 * 4;
constexpr size_t kStripIndices = kStripVertices + 4 * 6 * 4; ///< first cluster of a page

// The cluster of the triangle: the base of its UVs; vertices of 7 words: position, UV, joints and weights;
// then indices and the section of one target.
constexpr size_t kTriangleVertices = 2 * 4;
constexpr size_t kTriangleJoints = kTriangleVertices + 3 * 4;
constexpr size_t kTriangleWeights = kTriangleVertices + 5 * 4;
constexpr size_t kTriangleIndices = kTriangleVertices + 3 * 7 * 4;
constexpr size_t kTriangleMorphs = kTriangleIndices + 4;

/// Overwrite a word of the first cluster of a page.
template <typename T>
void poke(PackModel& pack, size_t page, size_t byte, T value)
{
    std::memcpy(pack.decoded_pages[page].data() + byte, &value, sizeof(T));
}

/// Set all errors, as in a group that has a replacement.
void setErrors(GroupRecord& group, float error)
{
    group.error = group.position_error = group.uv_error = error;
    group.normal_error = 1;
}

std::vector<MalformedPack> malformedTables()
{
    return {
        {"meshLevelsOutside", Issue::meaning_range, "mesh 0",
         [](PackModel& p) { p.meshes[0].levels.count = kHuge; }},
        {"meshGroupsOrder", Issue::meaning_order, "mesh 2",
         [](PackModel& p) { p.meshes[2].groups.first = 2; }},
        {"meshClustersOutside", Issue::meaning_range, "mesh 2",
         [](PackModel& p) { p.meshes[2].clusters.count = 2; }},
        {"meshPagesOverlap", Issue::meaning_order, "mesh 2",
         [](PackModel& p) {
             p.meshes[2].pages = {2, 2};
         }},
        {"meshAttributes", Issue::meaning_value, "mesh 1",
         [](PackModel& p) { p.meshes[1].attributes = 1u << 12; }},
        {"meshGrid", Issue::meaning_value, "mesh 0", [](PackModel& p) { p.meshes[0].grid_step = 0.3f; }},
        {"meshGridError", Issue::meaning_value, "mesh 0",
         [](PackModel& p) { p.meshes[0].grid_error = kNaN; }},
        {"meshSkinnedWithoutInfluences", Issue::meaning_value, "mesh 0",
         [](PackModel& p) { p.meshes[0].skinned = 1; }},
        {"meshInfluencesWithoutSkin", Issue::meaning_value, "mesh 2",
         [](PackModel& p) { p.meshes[2].skinned = 0; }},
        {"meshSkinned", Issue::meaning_value, "mesh 2", [](PackModel& p) { p.meshes[2].skinned = 2; }},
        {"meshBoxInfinite", Issue::meaning_value, "mesh 1",
         [](PackModel& p) { p.meshes[1].box_min.x = kInfinity; }},
        {"meshBoxEmpty", Issue::meaning_value, "mesh 1", [](PackModel& p) { p.meshes[1].box_min.x = 1; }},
        {"meshLodCount", Issue::meaning_value, "mesh 0", [](PackModel& p) { p.meshes[0].lod_count = 3; }},
        {"meshTriangles", Issue::meaning_value, "mesh 0",
         [](PackModel& p) { p.meshes[0].source_triangles = 9; }},
        {"meshDegenerate", Issue::meaning_value, "mesh 1",
         [](PackModel& p) { p.meshes[1].degenerate_triangles = 1; }},
        {"levelLeft", Issue::meaning_range, "level 3", [](PackModel& p) { p.levels.push_back(p.levels[0]); }},
        {"groupLeft", Issue::meaning_range, "group 4", [](PackModel& p) { p.groups.push_back(p.groups[0]); }},
        {"clusterLeft", Issue::meaning_range, "cluster 7",
         [](PackModel& p) { p.clusters.push_back(p.clusters[0]); }},
        {"pageLeft", Issue::meaning_range, "page 4", [](PackModel& p) { p.pages.push_back(p.pages[0]); }},

        {"levelOutside", Issue::meaning_range, "level 1",
         [](PackModel& p) { p.levels[1].clusters.count = kHuge; }},
        {"levelEmpty", Issue::meaning_range, "level 1", [](PackModel& p) { p.levels[1].clusters.count = 0; }},
        {"levelsCoarsestFirst", Issue::meaning_order, "level 1",
         [](PackModel& p)
         {
             std::swap(p.levels[0], p.levels[1]);
             p.meshes[0].source_triangles = 4;
         }},
        {"levelOfCluster", Issue::meaning_order, "level 0", [](PackModel& p) { p.clusters[4].level = 1; }},
        {"levelTriangles", Issue::meaning_value, "level 1",
         [](PackModel& p) { p.levels[1].triangle_count = 5; }},
        {"levelError", Issue::meaning_value, "level 1", [](PackModel& p) { p.levels[1].max_error = 0.2f; }},
        {"levelMissesClusters", Issue::meaning_range, "cluster 4",
         [](PackModel& p)
         {
             p.levels[0] = {{2, 2}, 4, 0};
             p.meshes[0].source_triangles = 4;
         }},

        {"groupOutside", Issue::meaning_range, "group 1",
         [](PackModel& p) { p.groups[1].clusters.count = kHuge; }},
        {"groupOrder", Issue::meaning_order, "group 1", [](PackModel& p) { p.groups[1].clusters.first = 3; }},
        {"groupMissesClusters", Issue::meaning_range, "mesh 0",
         [](PackModel& p) { p.groups[2].clusters.count = 1; }},
        {"groupTakesOtherMesh", Issue::meaning_range, "mesh 0",
         [](PackModel& p)
         {
             p.groups[2].clusters.count = 3;
             p.clusters[6].group = 2;
             p.clusters[6].page = 2;
         }},
        {"groupEmpty", Issue::meaning_value, "group 3", [](PackModel& p) { p.groups[3].clusters.count = 0; }},
        {"groupSphereNaN", Issue::meaning_value, "group 0",
         [](PackModel& p) { p.groups[0].sphere_center.x = kNaN; }},
        {"groupRadiusNegative", Issue::meaning_value, "group 0",
         [](PackModel& p) { p.groups[0].sphere_radius = -1; }},
        {"groupErrorNaN", Issue::meaning_value, "group 1", [](PackModel& p) { p.groups[1].error = kNaN; }},
        {"groupPositionErrorInfinite", Issue::meaning_value, "group 0",
         [](PackModel& p) { p.groups[0].position_error = kInfinity; }},
        {"groupPositionErrorExceedsError", Issue::meaning_value, "group 1",
         [](PackModel& p) { p.groups[1].position_error = 2 * p.groups[1].error; }},
        {"groupNormalErrorNegative", Issue::meaning_value, "group 1",
         [](PackModel& p) { p.groups[1].normal_error = -1; }},
        {"groupUvErrorNaN", Issue::meaning_value, "group 1",
         [](PackModel& p) { p.groups[1].uv_error = kNaN; }},
        {"groupPage", Issue::meaning_reference, "group 1", [](PackModel& p) { p.groups[1].page = 3; }},
        {"groupReserved", Issue::meaning_padding, "group 1",
         [](PackModel& p) { p.groups[1].reserved[1] = 1; }},
        {"groupOfCluster", Issue::meaning_reference, "group 1",
         [](PackModel& p) { p.clusters[3].group = 2; }},
        {"groupLevel", Issue::meaning_reference, "group 1", [](PackModel& p) { p.groups[1].level = 1; }},
        {"groupRootWithFiniteError", Issue::meaning_tree, "group 0",
         [](PackModel& p) { setErrors(p.groups[0], 5); }},
        {"groupThatNothingReplaces", Issue::meaning_tree, "group 2",
         [](PackModel& p) { p.clusters[1].refined_group = 1; }},

        {"groupSetOutsideMesh", Issue::meaning_reference, "group 0",
         [](PackModel& p) { p.groups[0].set_offset = 1; }},
        {"groupSetWithGap", Issue::meaning_order, "group 2",
         [](PackModel& p) { p.groups[2].set_offset = 2; }},
        {"groupSetOfUnlike", Issue::meaning_value, "group 2",
         [](PackModel& p) { p.groups[2].set_offset = 1; }},
        {"groupSetOfUnlikeUvErrors", Issue::meaning_value, "group 2",
         [](PackModel& p)
         {
             p.groups[2].set_offset = 1;
             p.groups[2].sphere_center = p.groups[1].sphere_center;
             p.groups[2].uv_error = 0;
         }},
        {"groupSetNotNamedByItsFirst", Issue::meaning_reference, "cluster 1",
         [](PackModel& p)
         {
             p.groups[2].set_offset = 1;
             p.groups[2].sphere_center = p.groups[1].sphere_center;
         }},
        {"groupSetThatNothingReplaces", Issue::meaning_tree, "group 0",
         [](PackModel& p)
         {
             p.groups[2].set_offset = 1;
             p.groups[2].sphere_center = p.groups[1].sphere_center;
             setErrors(p.groups[0], 5);
             p.clusters[1].refined_group = 1;
         }},

        {"clusterTriangles", Issue::meaning_value, "cluster 3",
         [](PackModel& p) {
             p.clusters[3].triangle_count = 0, p.levels[0].triangle_count = 6,
             p.meshes[0].source_triangles = 6;
         }},
        {"clusterVertices", Issue::meaning_value, "cluster 3",
         [](PackModel& p) { p.clusters[3].vertex_count = 257; }},
        {"clusterBeyondGrid", Issue::meaning_value, "cluster 1",
         [](PackModel& p) { p.clusters[1].base[2] = kMaxGridCoordinate + 1; }},
        {"clusterExtentShift", Issue::meaning_value, "cluster 1",
         [](PackModel& p) { p.clusters[1].extent_shift = kMaxExtentShift + 1; }},
        {"clusterBoxOutsideMesh", Issue::meaning_bounds, "cluster 1",
         [](PackModel& p) { ++p.clusters[1].extent[2]; }},
        {"clusterConeAxis", Issue::meaning_value, "cluster 1",
         [](PackModel& p) { p.clusters[1].cone_axis = 0x0080; }},
        {"clusterUvDensity", Issue::meaning_value, "cluster 6",
         [](PackModel& p)
         {
             p.meshes[2].attributes = kVertexInfluences;
             p.clusters[6].uv_density = 1;
         }},
        {"clusterRefinedMissing", Issue::meaning_tree, "cluster 0",
         [](PackModel& p) { p.clusters[0].refined_group = kInvalidIndex; }},
        {"clusterRefinedAtLevel0", Issue::meaning_tree, "cluster 2",
         [](PackModel& p) { p.clusters[2].refined_group = 2; }},
        {"clusterRefinedOutside", Issue::meaning_reference, "cluster 0",
         [](PackModel& p) { p.clusters[0].refined_group = 3; }},
        {"clusterRefinedItself", Issue::meaning_tree, "cluster 0",
         [](PackModel& p) { p.clusters[0].refined_group = 0; }},
        {"clusterMadeFromRoot", Issue::meaning_value, "cluster 0",
         [](PackModel& p) { p.groups[1].error = kInfinity; }},
        {"clusterErrorGrows", Issue::meaning_monotone, "cluster 0",
         [](PackModel& p) { p.groups[0].error = 0.05f; }},
        {"clusterNormalErrorFalls", Issue::meaning_monotone, "cluster 0",
         [](PackModel& p)
         {
             setErrors(p.groups[0], 5);
             p.groups[0].normal_error = 0.125f;
         }},
        {"clusterSphereGrows", Issue::meaning_monotone, "cluster 0",
         [](PackModel& p) { p.groups[0].sphere_radius = 2.4f; }},
        {"clusterMaterial", Issue::meaning_reference, "cluster 0",
         [](PackModel& p) { p.clusters[0].material = 1; }},
    };
}

std::vector<MalformedPack> malformedPages()
{
    return {
        {"pageClustersOutside", Issue::meaning_range, "page 0",
         [](PackModel& p) { p.pages[0].clusters.count = kHuge; }},
        {"pageClustersOrder", Issue::meaning_order, "page 1",
         [](PackModel& p) {
             p.pages[1].clusters = {3, 1};
         }},
        {"pageWithoutClusters", Issue::meaning_value, "page 3",
         [](PackModel& p) { p.pages[3].clusters.count = 0; }},
        {"pageOfCluster", Issue::meaning_reference, "page 1",
         [](PackModel& p) { p.pages[1].clusters.count = 3; }},
        {"pageMesh", Issue::meaning_reference, "page 3", [](PackModel& p) { p.pages[3].mesh = 0; }},
        {"pageTooLarge", Issue::meaning_value, "page 0",
         [](PackModel& p) { p.pages[0].size = kMaxPageBytes + 1; }},
        {"pageCodec", Issue::meaning_value, "page 0", [](PackModel& p) { p.pages[0].codec = 3; }},
        {"pageStoredSize", Issue::meaning_value, "page 1", [](PackModel& p) { ++p.pages[1].size; }},
        {"pageReserved", Issue::meaning_padding, "page 2", [](PackModel& p) { p.pages[2].reserved[1] = 1; }},
        {"pageParentsOutside", Issue::meaning_range, "page 2",
         [](PackModel& p) { p.pages[2].parents.count = kHuge; }},
        {"pageParentsOrder", Issue::meaning_order, "page 2",
         [](PackModel& p) {
             p.pages[2].parents = {0, 2};
         }},
        {"pageParentMissing", Issue::meaning_reference, "page 1",
         [](PackModel& p)
         {
             p.pages[1].parents.count = 0;
             p.pages[2].parents = {0, 1};
             p.pages[3].parents = {1, 0};
             p.page_parents.pop_back();
         }},
        {"pageParentLater", Issue::meaning_order, "page 1", [](PackModel& p) { p.page_parents[0] = 2; }},
        {"pageParentWrong", Issue::meaning_reference, "page 2", [](PackModel& p) { p.page_parents[1] = 1; }},
        {"pageParentLeft", Issue::meaning_range, "parent 2",
         [](PackModel& p) { p.page_parents.push_back(0); }},
        {"pageOffset", Issue::meaning_order, "page 1", [](PackModel& p) { p.pages[1].offset += 64; }},
        {"pageOutside", Issue::meaning_range, "page 3", [](PackModel& p) { p.page_bytes.pop_back(); }},
        {"pagePadding", Issue::meaning_padding, "page 1",
         [](PackModel& p) { p.page_bytes[p.pages[1].offset - 1] = std::byte{1}; }},
        {"pageBytesBehind", Issue::meaning_range, "chunk PAGE 0",
         [](PackModel& p) { p.page_bytes.resize(p.page_bytes.size() + 64); }},
        {"pagePaddingBehind", Issue::meaning_padding, "chunk PAGE 0",
         [](PackModel& p) { p.page_bytes.push_back(std::byte{1}); }},
        {"pageHash", Issue::page_hash, "page 2", [](PackModel& p) { ++p.pages[2].hash; }},
        {"pageNotZstd", Issue::chunk_codec, "page 0",
         [](PackModel& p)
         {
             p.page_bytes[0] = std::byte{0};
             p.pages[0].hash = hashBytes(std::span(p.page_bytes).first(p.pages[0].stored_size));
         }},
        {"pageSizeNotItsFrames", Issue::chunk_codec, "page 0", [](PackModel& p) { ++p.pages[0].size; }},
    };
}

std::vector<MalformedPack> malformedGeometry()
{
    return {
        {"geometryOutsidePage", Issue::meaning_range, "cluster 6",
         [](PackModel& p) { p.clusters[6].page_word = 16; }},
        {"geometryOffsetHuge", Issue::meaning_range, "cluster 0",
         [](PackModel& p) { p.clusters[0].page_word = 0xFFFF; }},
        {"geometryOverlaps", Issue::meaning_order, "cluster 3",
         [](PackModel& p) { --p.clusters[3].page_word; }},
        {"geometryPadding", Issue::meaning_padding, "cluster 2",
         [](PackModel& p) { poke(p, 1, kStripIndices + 6, uint8_t{1}); }, true},
        {"geometryBytesBehind", Issue::meaning_padding, "page 2",
         [](PackModel& p) { p.decoded_pages[2].resize(p.decoded_pages[2].size() + 4, std::byte{1}); }, true},
        {"positionOutsideBox", Issue::meaning_bounds, "cluster 2",
         [](PackModel& p) { poke(p, 1, kStripVertices + 2, uint16_t{97}); }, true},
        {"positionHalfUsed", Issue::meaning_padding, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleVertices + 6, uint16_t{1}); }, true},
        {"normalCode", Issue::meaning_geometry, "cluster 4",
         [](PackModel& p) { poke(p, 2, kStripVertices + 6, uint16_t{0x0080}); }, true},
        {"tangentCode", Issue::meaning_geometry, "cluster 4",
         [](PackModel& p) { poke(p, 2, kStripVertices + 8, uint32_t{0x100}); }, true},
        {"visibilityCode", Issue::meaning_geometry, "cluster 4",
         [](PackModel& p) { poke(p, 2, kStripVertices + 20, uint32_t{0x00800000}); }, true},
        {"uvBeyondGrid", Issue::meaning_geometry, "cluster 0",
         [](PackModel& p) { poke(p, 0, 4, kMaxGridCoordinate + 1); }, true},
        {"indexOutside", Issue::meaning_geometry, "cluster 0",
         [](PackModel& p) { poke(p, 0, kStripIndices + 5, uint8_t{4}); }, true},
        {"allDegenerate", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleIndices + 1, uint8_t{0}); }, true},
        {"jointOfNoSkin", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleJoints, uint16_t{2}); }, true},
        {"jointWithoutWeight", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleJoints + 4, uint16_t{1}); }, true},
        {"weightsSum", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleWeights, uint16_t{40001}); }, true},
        {"weightsRise", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleWeights, uint32_t{25535u | 40000u << 16}); }, true},
        {"morphCount", Issue::meaning_range, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleMorphs, uint32_t{2}); }, true},
        {"morphTarget", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleMorphs + 4, uint32_t{1}); }, true},
        {"morphStep", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p) { poke(p, 3, kTriangleMorphs + 8, 0.3f); }, true},
        {"morphMovesNothing", Issue::meaning_geometry, "cluster 6",
         [](PackModel& p)
         {
             for (size_t word = 0; word < 9; ++word)
                 poke(p, 3, kTriangleMorphs + 12 + 4 * word, uint32_t{0});
         },
         true},
        {"coneTooNarrow", Issue::meaning_bounds, "cluster 2",
         [](PackModel& p) { p.clusters[2].cone_cutoff = 65536 / 20; }},
        {"coneTurned", Issue::meaning_bounds, "cluster 0",
         [](PackModel& p) {
             p.clusters[0].cone_axis = static_cast<uint16_t>(NormalCode<8>::encode({0, -1, 0}));
         }},
        {"triangleTurned", Issue::meaning_bounds, "cluster 0",
         [](PackModel& p)
         {
             poke(p, 0, kStripIndices + 1, uint8_t{2});
             poke(p, 0, kStripIndices + 2, uint8_t{1});
         },
         true},
        {"apexInFront", Issue::meaning_bounds, "cluster 1",
         [](PackModel& p)
         {
             // The box may be too large: its centre then lies above the flat quad.
             p.clusters[1].extent[1] = 96;
             p.clusters[1].cone_back = 0;
         }},
    };
}

} // namespace

const std::vector<MalformedPack>& malformedHierarchies()
{
    static const std::vector<MalformedPack> cases = []
    {
        std::vector<MalformedPack> all = malformedTables();
        for (MalformedPack& pack : malformedPages())
            all.push_back(std::move(pack));
        for (MalformedPack& pack : malformedGeometry())
            all.push_back(std::move(pack));
        return all;
    }();
    return cases;
}

} // namespace hearth::test
