// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/validate.h"

#include "cook/mesh/deformation.h"
#include "cook/mesh/grid.h"
#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "formats/base/assert.h"
#include "formats/codecs/page_decode.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::clusters
{

namespace
{

using namespace formats;

Error wrong(Issue issue, const char* what, size_t index, std::string detail)
{
    return {issue, "", std::string(what) + " " + std::to_string(index), std::move(detail)};
}

double distance(Float3 a, Float3 b)
{
    const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
    return std::sqrt(x * x + y * y + z * z);
}

Status checkOrder(const Hierarchy& h)
{
    uint32_t next = 0;
    for (size_t l = h.levels.size(); l-- > 0;)
    {
        if (h.levels[l].clusters.first != next)
            return wrong(Issue::meaning_order, "level", l, "its clusters do not follow the coarser level's");
        uint64_t triangles = 0;
        for (uint32_t c = 0; c < h.levels[l].clusters.count; ++c)
        {
            if (h.clusters[next].level != l)
                return wrong(Issue::meaning_order, "cluster", next, "is not of its level");
            triangles += h.clusters[next++].triangle_count;
        }
        if (triangles != h.levels[l].triangle_count)
            return wrong(Issue::meaning_value, "level", l, "counts its triangles wrong");
    }
    if (next != h.clusters.size())
        return wrong(Issue::meaning_range, "cluster", next, "is in no level");
    next = 0;
    for (uint32_t g = 0; g < h.groups.size(); ++g)
    {
        if (h.groups[g].clusters.first != next || h.groups[g].clusters.count == 0)
            return wrong(Issue::meaning_order, "group", g, "is empty or does not follow the one before");
        for (uint32_t c = 0; c < h.groups[g].clusters.count; ++c, ++next)
            if (h.clusters[next].group != g || h.clusters[next].level != h.groups[g].level ||
                h.clusters[next].page != h.groups[g].page)
                return wrong(Issue::meaning_reference, "cluster", next, "and its group do not agree");
    }
    if (next != h.clusters.size())
        return wrong(Issue::meaning_range, "cluster", next, "is in no group");
    return success();
}

Status checkMonotone(const Hierarchy& h)
{
    std::vector<uint8_t> replaced(h.groups.size(), 0);
    for (size_t c = 0; c < h.clusters.size(); ++c)
    {
        const ClusterRecord& cluster = h.clusters[c];
        if ((cluster.refined_group == kInvalidIndex) != (cluster.level == 0))
            return wrong(Issue::meaning_tree, "cluster", c,
                         "of level 0 was made from a group, or another was not");
        if (cluster.refined_group == kInvalidIndex)
            continue;
        const GroupRecord& finer = h.groups[cluster.refined_group];
        const GroupRecord& own = h.groups[cluster.group];
        if (finer.set_offset != 0)
            return wrong(Issue::meaning_tree, "cluster", c,
                         "was made from a group behind the first of its set");
        replaced[cluster.refined_group] = 1;
        if (cluster.refined_group <= cluster.group || finer.level + 1 != cluster.level)
            return wrong(Issue::meaning_tree, "cluster", c, "was not made from a group of the finer level");
        if (!(finer.error <= own.error))
            return wrong(Issue::meaning_monotone, "cluster", c, "error falls towards the root");
        if (std::isfinite(own.error) &&
            !(finer.position_error <= own.position_error && own.position_error <= own.error &&
              finer.normal_error <= own.normal_error && finer.uv_error <= own.uv_error))
            return wrong(Issue::meaning_monotone, "cluster", c, "a part of the error falls towards the root");
        if (distance(finer.sphere_center, own.sphere_center) + finer.sphere_radius > own.sphere_radius)
            return wrong(Issue::meaning_monotone, "cluster", c,
                         "the finer group's sphere leaves its group's");
    }
    for (size_t g = 0; g < h.groups.size(); ++g)
        if ((replaced[g - h.groups[g].set_offset] != 0) != std::isfinite(h.groups[g].error))
            return wrong(Issue::meaning_tree, "group", g,
                         "is a root with a finite error, or no root without");
    return success();
}

/// Check that the groups of a set are equal, and are all groups of their level: an authored LOD fits beside
/// none of them.
Status checkSets(const Hierarchy& h)
{
    for (size_t g = 0; g < h.groups.size(); ++g)
    {
        const GroupRecord& group = h.groups[g];
        if (group.set_offset > g)
            return wrong(Issue::meaning_reference, "group", g, "its set begins before the mesh");
        const GroupRecord& first = h.groups[g - group.set_offset];
        if (!(group.sphere_center == first.sphere_center) || group.sphere_radius != first.sphere_radius ||
            group.error != first.error || group.level != first.level ||
            group.position_error != first.position_error || group.normal_error != first.normal_error ||
            group.uv_error != first.uv_error)
            return wrong(Issue::meaning_value, "group", g, "is not as the first of its set");
        const bool follows = g > 0 && h.groups[g - 1].level == group.level;
        const bool in_set = follows && (group.set_offset != 0 || h.groups[g - 1].set_offset != 0);
        if (in_set && group.set_offset != h.groups[g - 1].set_offset + 1)
            return wrong(Issue::meaning_order, "group", g, "is not of the set of its level");
    }
    return success();
}

Status checkPages(const Hierarchy& h)
{
    uint32_t next = 0;
    for (size_t p = 0; p < h.pages.size(); ++p)
    {
        const PageRecord& page = h.pages[p];
        if (page.size > kMaxPageBytes || page.offset % kChunkAlignment != 0)
            return wrong(Issue::meaning_value, "page", p, "is too large or not aligned");
        if (page.clusters.first != next || page.clusters.count == 0)
            return wrong(Issue::meaning_order, "page", p, "is empty or does not follow the one before");
        for (uint32_t c = 0; c < page.clusters.count; ++c, ++next)
            if (h.clusters[next].page != p)
                return wrong(Issue::meaning_reference, "cluster", next, "and its page do not agree");
        for (uint32_t i = 0; i < page.parents.count; ++i)
            if (h.page_parents[page.parents.first + i] >= p)
                return wrong(Issue::meaning_order, "page", p, "its parent comes after it");
    }
    for (size_t c = 0; c < h.clusters.size(); ++c)
    {
        if (h.clusters[c].refined_group == kInvalidIndex)
            continue;
        const uint32_t first = h.clusters[c].refined_group;
        for (uint32_t g = first; g < h.groups.size() && h.groups[g].set_offset == g - first; ++g)
        {
            const uint32_t finer = h.groups[g].page;
            const auto parents =
                std::span(h.page_parents).subspan(h.pages[finer].parents.first, h.pages[finer].parents.count);
            if (finer != h.clusters[c].page &&
                std::find(parents.begin(), parents.end(), h.clusters[c].page) == parents.end())
                return wrong(Issue::meaning_reference, "page", finer, "misses a parent");
        }
    }
    return success();
}

Result<ClusterGeometry> readGeometry(const Hierarchy& h, const DecodedHierarchy& decoded, uint32_t c)
{
    const auto geometry = ClusterGeometry::at(decoded.pages[h.clusters[c].page], h.clusters[c], h.mesh);
    if (!geometry)
        return wrong(Issue::meaning_range, "cluster", c, "lies outside its page");
    return *geometry;
}

Status checkCone(const ClusterRecord& cluster, float grid_step, size_t c, Float3 pa, Float3 pb, Float3 pc)
{
    const auto sub = [](Float3 a, Float3 b) {
        return std::array<double, 3>{double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
    };
    const auto dot3 = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto u = sub(pb, pa), v = sub(pc, pa);
    std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double area = std::sqrt(dot3(n, n));
    if (!(area > 0))
        return wrong(Issue::meaning_bounds, "cluster", c,
                     "has a normal cone though a triangle has no normal");
    const Float3 ray = coneAxis(cluster);
    const std::array<double, 3> axis{ray.x, ray.y, ray.z};
    const double axis_length = std::sqrt(dot3(axis, axis));
    const double cosine = dot3(n, axis) / area / axis_length;
    const double sine = coneCutoff(cluster);
    if (cosine < std::sqrt(1 - sine * sine))
        return wrong(Issue::meaning_bounds, "cluster", c, "a normal leaves the cone");
    const Box3 box = clusterBox(cluster, grid_step);
    std::array<double, 3> to_apex{};
    for (size_t i = 0; i < 3; ++i)
    {
        const int k = static_cast<int>(i);
        to_apex[i] = (double{box.min[k]} + box.max[k]) / 2 - double{pa[k]} -
                     axis[i] / axis_length * coneBack(cluster, grid_step);
    }
    if (dot3(n, to_apex) > 0)
        return wrong(Issue::meaning_bounds, "cluster", c, "the apex is in front of a triangle");
    return success();
}

/// True if the box is exact, except for the high corner of a box with a shift.
bool isTightBox(const ClusterRecord& cluster, float grid_step, const Box3& vertices)
{
    const Box3 box = clusterBox(cluster, grid_step);
    for (int axis = 0; axis < 3; ++axis)
    {
        const double slack = ((1 << cluster.extent_shift) - 1) * double{grid_step};
        if (box.min[axis] != vertices.min[axis] || box.max[axis] < vertices.max[axis] ||
            box.max[axis] > vertices.max[axis] + slack)
            return false;
    }
    return true;
}

Status checkGeometry(const Hierarchy& h, const DecodedHierarchy& decoded)
{
    for (uint32_t c = 0; c < h.clusters.size(); ++c)
    {
        const ClusterRecord& cluster = h.clusters[c];
        HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry, readGeometry(h, decoded, c));
        if (cluster.triangle_count < 1 || cluster.triangle_count > kMaxClusterTriangles ||
            cluster.vertex_count < 3 || cluster.vertex_count > kMaxClusterVertices)
            return wrong(Issue::meaning_value, "cluster", c, "has too many or too few vertices or triangles");
        const GroupRecord& group = h.groups[cluster.group];
        Box3 box;
        for (uint32_t v = 0; v < cluster.vertex_count; ++v)
        {
            const Float3 p = geometry.position(v);
            box.add(p);
            if (distance(p, group.sphere_center) > group.sphere_radius)
                return wrong(Issue::meaning_bounds, "cluster", c, "a vertex leaves its group's sphere");
            if (cluster.refined_group != kInvalidIndex &&
                distance(p, h.groups[cluster.refined_group].sphere_center) >
                    h.groups[cluster.refined_group].sphere_radius)
                return wrong(Issue::meaning_bounds, "cluster", c,
                             "a vertex leaves the sphere of the finer group");
        }
        if (!isTightBox(cluster, h.mesh.grid_step, box))
            return wrong(Issue::meaning_bounds, "cluster", c, "its box is not that of its vertices");
        std::vector<uint8_t> used(cluster.vertex_count, 0);
        for (uint32_t t = 0; t < cluster.triangle_count; ++t)
        {
            const auto corner = geometry.triangle(t);
            if (std::max({corner[0], corner[1], corner[2]}) >= cluster.vertex_count)
                return wrong(Issue::meaning_geometry, "cluster", c, "an index is out of range");
            for (const uint32_t k : corner)
                used[k] = 1;
            const Float3 pa = geometry.position(corner[0]), pb = geometry.position(corner[1]),
                         pc = geometry.position(corner[2]);
            if (cluster.level == 0 && (pa == pb || pb == pc || pc == pa))
                return wrong(Issue::meaning_geometry, "cluster", c, "a triangle lacks an edge");
            if (cluster.cone_cutoff != kNoCone)
                HEARTH_TRY(checkCone(cluster, h.mesh.grid_step, c, pa, pb, pc));
        }
        if (std::count(used.begin(), used.end(), 1) != static_cast<ptrdiff_t>(used.size()))
            return wrong(Issue::meaning_geometry, "cluster", c, "a vertex is not used");
    }
    return success();
}

/// Triangle with all its attributes, as a hash that does not depend on which corner comes first.
struct TriangleKey
{
    std::array<uint64_t, 3> corners;
    uint32_t material;
    friend auto operator<=>(const TriangleKey&, const TriangleKey&) = default;
};

TriangleKey makeKey(std::array<uint64_t, 3> corners, uint32_t material)
{
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return {corners, material};
}

uint64_t hashWords(std::span<const uint32_t> words)
{
    return hashBytes(std::as_bytes(words));
}

void addDelta(std::vector<uint32_t>& words, Float3 delta)
{
    for (const float part : {delta.x, delta.y, delta.z})
        words.push_back(std::bit_cast<uint32_t>(part + 0.0f));
}

/// Hash a vertex of the source after its coding, independent of the cluster that contains it.
uint64_t sourceVertexHash(const mesh::SourceMesh& source, uint32_t layout, double grid_step, uint32_t v)
{
    std::vector<uint32_t> words;
    const auto addPoint = [&](double steps)
    { words.push_back(static_cast<uint32_t>(static_cast<int32_t>(std::nearbyint(steps)))); };
    for (int axis = 0; axis < 3; ++axis)
        addPoint(source.positions[v][axis] / grid_step);
    if (layout & kVertexNormal)
        words.push_back(encodeNormal(layout, source.normals[v]));
    if (layout & kVertexTangent)
        words.push_back(encodeTangent(layout, source.tangents[v],
                                      decodeNormal(layout, encodeNormal(layout, source.normals[v]))));
    for (uint32_t set = 0; set < 4; ++set)
        if ((layout & kVertexUv0 << set) && uvFractionBits(layout, set) == 0)
            words.insert(words.end(), {std::bit_cast<uint32_t>(source.uvs[set][v].x),
                                       std::bit_cast<uint32_t>(source.uvs[set][v].y)});
        else if (layout & kVertexUv0 << set)
        {
            const double step = uvStep(uvFractionBits(layout, set));
            addPoint(source.uvs[set][v].x / step);
            addPoint(source.uvs[set][v].y / step);
        }
    if (layout & kVertexColor)
        for (const uint32_t word : encodeColor(layout, source.colors[v]))
            words.push_back(word);
    for (size_t set = 0; set < source.joint_sets.size(); ++set)
    {
        const Float4 w = source.weight_sets[set][v];
        const std::array<float, 4> weights{w.x, w.y, w.z, w.w};
        for (size_t i = 0; i < 4; ++i)
            words.push_back(source.joint_sets[set][v].joint[i] | quantizeUnorm(weights[i], 65535) << 16);
    }
    for (const mesh::MorphTarget& target : source.morph_targets)
    {
        addDelta(words, target.positions[v]);
        addDelta(words, target.normals.empty() ? Float3{} : target.normals[v]);
    }
    return hashWords(words);
}

/// Hash a vertex of a cluster in the same way.
uint64_t vertexHash(const ClusterGeometry& geometry, const ClusterRecord& cluster, uint32_t v,
                    size_t morph_targets)
{
    const uint32_t layout = geometry.layout();
    std::vector<uint32_t> words;
    for (size_t axis = 0; axis < 3; ++axis)
        words.push_back(static_cast<uint32_t>(cluster.base[axis]) + geometry.gridOffset(v)[axis]);
    if (layout & kVertexNormal)
        words.push_back(geometry.normalCode(v));
    if (layout & kVertexTangent)
        words.push_back(geometry.word(v, attributeWord(layout, kVertexTangent)));
    for (uint32_t set = 0; set < 4; ++set)
        if ((layout & kVertexUv0 << set) && uvFractionBits(layout, set) == 0)
            words.insert(words.end(), {std::bit_cast<uint32_t>(geometry.uv(v, set).x),
                                       std::bit_cast<uint32_t>(geometry.uv(v, set).y)});
        else if (layout & kVertexUv0 << set)
            for (const int32_t point : geometry.uvPoint(v, set))
                words.push_back(static_cast<uint32_t>(point));
    if (layout & kVertexColor)
    {
        const uint32_t first = attributeWord(layout, kVertexColor);
        words.push_back(geometry.word(v, first));
        words.push_back((layout & kVertexColor16) ? geometry.word(v, first + 1) : 0);
    }
    if (geometry.influenceCount() > 0)
    {
        const auto joints = geometry.joints(v), weights = geometry.weightCodes(v);
        for (uint32_t i = 0; i < geometry.influenceCount(); ++i)
            words.push_back(joints[i] | weights[i] << 16);
    }
    for (uint32_t target = 0, next = 0; target < morph_targets; ++target)
    {
        const bool moves = next < geometry.morphCount() && geometry.morphTarget(next) == target;
        addDelta(words, moves ? geometry.morphPosition(next, v) : Float3{});
        addDelta(words, moves ? geometry.morphNormal(next, v) : Float3{});
        next += moves ? 1 : 0;
    }
    return hashWords(words);
}

/// Return the source on the grid that it shares with its authored LODs.
mesh::SourceMesh onGrid(const mesh::SourceMesh& source, std::span<const mesh::SourceMesh> authored,
                        uint32_t layout)
{
    mesh::SourceMesh joined = source;
    for (const mesh::SourceMesh& level : authored)
    {
        const auto first = static_cast<uint32_t>(joined.positions.size());
        joined.positions.insert(joined.positions.end(), level.positions.begin(), level.positions.end());
        for (const uint32_t index : level.indices)
            joined.indices.push_back(first + index);
    }
    mesh::snapToGrid(joined);
    joined.positions.resize(source.vertexCount());
    if (influencesPerVertex(layout) != 0)
        mesh::reduceInfluences(joined, influencesPerVertex(layout));
    // where authored LODs have larger deltas, the steps are coarser
    if (authored.empty())
        mesh::snapMorphTargets(joined);
    else
        joined.morph_targets.clear();
    return joined;
}

Status checkFinestLevel(const mesh::SourceMesh& source, std::span<const mesh::SourceMesh> authored,
                        const Hierarchy& h, const DecodedHierarchy& decoded)
{
    const mesh::SourceMesh on_grid = onGrid(source, authored, h.mesh.attributes);
    std::vector<uint64_t> hashes(source.vertexCount());
    // a mesh of triangles without area has no grid, and no clusters
    for (uint32_t v = 0; h.mesh.grid_step > 0 && v < hashes.size(); ++v)
        hashes[v] = sourceVertexHash(on_grid, h.mesh.attributes, h.mesh.grid_step, v);
    std::vector<TriangleKey> wanted;
    for (size_t t = 0; t < source.triangleCount(); ++t)
    {
        const uint32_t a = source.indices[t * 3], b = source.indices[t * 3 + 1],
                       c = source.indices[t * 3 + 2];
        const bool loses_edge = on_grid.positions[a] == on_grid.positions[b] ||
                                on_grid.positions[b] == on_grid.positions[c] ||
                                on_grid.positions[c] == on_grid.positions[a];
        if (!loses_edge && !mesh::isDegenerate(source.positions[a], source.positions[b], source.positions[c]))
            wanted.push_back(makeKey({hashes[a], hashes[b], hashes[c]}, source.triangle_materials[t]));
    }
    if (wanted.size() + h.mesh.degenerate_triangles != source.triangleCount())
        return wrong(Issue::meaning_value, "mesh", 0, "counts the triangles without area wrong");

    std::vector<TriangleKey> found;
    for (uint32_t c = 0; c < h.clusters.size(); ++c)
    {
        if (h.clusters[c].level != 0)
            continue;
        HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry, readGeometry(h, decoded, c));
        std::vector<uint64_t> vertex_hashes;
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            vertex_hashes.push_back(vertexHash(geometry, h.clusters[c], v, on_grid.morph_targets.size()));
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        {
            const auto corner = geometry.triangle(t);
            found.push_back(
                makeKey({vertex_hashes[corner[0]], vertex_hashes[corner[1]], vertex_hashes[corner[2]]},
                        h.clusters[c].material));
        }
    }
    std::sort(wanted.begin(), wanted.end());
    std::sort(found.begin(), found.end());
    if (wanted != found)
        return wrong(Issue::meaning_geometry, "level", 0,
                     "has " + std::to_string(found.size()) + " triangles that are not the source's " +
                         std::to_string(wanted.size()));
    return success();
}

} // namespace

Result<DecodedHierarchy> decodeHierarchy(const Hierarchy& h)
{
    DecodedHierarchy decoded;
    PageDecoder decoder;
    for (size_t p = 0; p < h.pages.size(); ++p)
    {
        const PageRecord& page = h.pages[p];
        const auto stored = std::span(h.page_bytes).subspan(page.offset, page.stored_size);
        if (hashBytes(stored) != page.hash)
            return wrong(Issue::page_hash, "page", p, "");
        std::vector<std::byte> bytes(page.size);
        if (page.codec != static_cast<uint32_t>(PageCodec::clusters) ||
            !decoder.decode(stored, recordsInRange<ClusterRecord>(h.clusters, page.clusters),
                            h.mesh.attributes, bytes))
            return wrong(Issue::chunk_codec, "page", p, "");
        decoded.pages.push_back(std::move(bytes));
    }
    std::vector<Float3> places;
    for (uint32_t c = 0; c < h.clusters.size(); ++c)
    {
        HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry, readGeometry(h, decoded, c));
        DecodedHierarchy::Cluster cluster;
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
            for (const uint32_t corner : geometry.triangle(t))
            {
                if (corner >= geometry.vertexCount())
                    return wrong(Issue::meaning_geometry, "cluster", c, "an index is out of range");
                cluster.positions.push_back(static_cast<uint32_t>(places.size()) + corner);
            }
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            places.push_back(geometry.position(v));
        decoded.clusters.push_back(std::move(cluster));
    }
    const mesh::Weld weld = mesh::weldPositions(places);
    decoded.positions.resize(weld.position_count);
    for (size_t v = 0; v < places.size(); ++v)
        decoded.positions[weld.position_id_of_vertex[v]] = places[v];
    for (DecodedHierarchy::Cluster& cluster : decoded.clusters)
        for (uint32_t& position : cluster.positions)
            position = weld.position_id_of_vertex[position];
    return decoded;
}

std::vector<uint32_t> findCutClusters(const Hierarchy& h, std::span<const uint8_t> replaced)
{
    HEARTH_ASSERT(replaced.size() == h.groups.size());
    std::vector<uint32_t> drawn;
    for (uint32_t c = 0; c < h.clusters.size(); ++c)
    {
        const uint32_t refined = h.clusters[c].refined_group;
        if ((refined == kInvalidIndex || replaced[refined] != 0) && replaced[h.clusters[c].group] == 0)
            drawn.push_back(c);
    }
    return drawn;
}

Status validateHierarchy(const mesh::SourceMesh& source, const Hierarchy& hierarchy,
                         std::span<const mesh::SourceMesh> authored)
{
    if (hierarchy.mesh.source_triangles != source.triangleCount() ||
        hierarchy.mesh.lod_count != hierarchy.levels.size() ||
        hierarchy.mesh.clusters.count != hierarchy.clusters.size() ||
        hierarchy.mesh.groups.count != hierarchy.groups.size() ||
        hierarchy.mesh.pages.count != hierarchy.pages.size())
        return wrong(Issue::meaning_value, "mesh", 0, "its counts are not those of its tables");
    HEARTH_TRY(checkOrder(hierarchy));
    HEARTH_TRY(checkMonotone(hierarchy));
    HEARTH_TRY(checkSets(hierarchy));
    HEARTH_TRY(checkPages(hierarchy));
    HEARTH_ASSIGN_OR_RETURN(const DecodedHierarchy decoded, decodeHierarchy(hierarchy));
    HEARTH_TRY(checkGeometry(hierarchy, decoded));
    return checkFinestLevel(source, authored, hierarchy, decoded);
}

} // namespace hearth::clusters
