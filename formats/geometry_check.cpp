// Meaning of geometry pages: every page is decoded and each cluster held against the bounds that its record claims.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/check_tools.h"
#include "formats/double3.h"
#include "formats/pack_check.h"

namespace hearth::formats::check
{

namespace
{

bool legalUv(const ClusterGeometry& geometry, uint32_t vertex, uint32_t set)
{
    if (uvFractionBits(geometry.layout(), set) == 0)
        return finite(geometry.uv(vertex, set));
    const std::array<int32_t, 2> point = geometry.uvPoint(vertex, set);
    return std::all_of(point.begin(), point.end(),
                       [](int32_t coordinate)
                       { return coordinate >= -kGridMost && coordinate <= kGridMost; });
}

/// The weights fall and sum to 1; joints are the skin's, and joint 0 where there is no weight.
bool legalInfluences(const ClusterGeometry& geometry, uint32_t vertex, uint32_t joint_count)
{
    const std::array<uint32_t, 8> joints = geometry.joints(vertex);
    const std::array<uint32_t, 8> weights = geometry.weightCodes(vertex);
    uint32_t sum = 0;
    for (size_t i = 0; i < joints.size(); ++i)
    {
        if (joints[i] >= joint_count || (weights[i] == 0 && joints[i] != 0) ||
            (i > 0 && weights[i] > weights[i - 1]))
            return false;
        sum += weights[i];
    }
    return sum == 65535;
}

Status checkVertices(const PackView& view, size_t i, const ClusterGeometry& geometry, uint32_t joint_count)
{
    const ClusterRecord& cluster = view.clusters()[i];
    const uint32_t layout = geometry.layout();
    const auto wrong = [&](Issue issue, uint32_t vertex, const char* what)
    { return fail(view, issue, "cluster", i, "vertex " + std::to_string(vertex) + ": " + what); };
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
    {
        const std::array<uint32_t, 3> offset = geometry.gridOffset(v);
        for (int axis = 0; axis < 3; ++axis)
            if (offset[static_cast<size_t>(axis)] > boxSteps(cluster, axis))
                return wrong(Issue::meaning_bounds, v, "it lies outside the cluster's box");
        if (!geometry.has(kVertexWide) && (!geometry.has(kVertexNormal) || geometry.has(kVertexFineNormal)) &&
            geometry.word(v, 1) >> 16 != 0)
            return wrong(Issue::meaning_padding, v, "the unused half of a word is not 0");
        if (geometry.has(kVertexNormal) && !legalNormal(layout, geometry.normalCode(v)))
            return wrong(Issue::meaning_geometry, v, "its normal has no legal code");
        if (geometry.has(kVertexTangent) &&
            !legalTangent(layout, geometry.word(v, attributeWord(layout, kVertexTangent))))
            return wrong(Issue::meaning_geometry, v, "its tangent has no legal code");
        if (geometry.has(kVertexVisibility) && !legalVisibility(geometry.visibilityCode(v)))
            return wrong(Issue::meaning_geometry, v, "its visibility has no legal code");
        for (uint32_t set = 0; set < 4; ++set)
            if (geometry.has(kVertexUv0 << set) && !legalUv(geometry, v, set))
                return wrong(Issue::meaning_geometry, v, "a UV is not finite, or beyond the grid");
        if (geometry.has(kVertexInfluences) && !legalInfluences(geometry, v, joint_count))
            return wrong(
                Issue::meaning_geometry, v,
                "its weights do not fall, or sum to 1, or one is that of a joint that its skin has not");
    }
    return success();
}

/// Targets ascend, each moves a vertex; steps are powers of two.
Status checkMorphs(const PackView& view, size_t i, const MeshRecord& mesh, const ClusterGeometry& geometry)
{
    const auto wrong = [&](uint32_t morph, const char* what)
    {
        return fail(view, Issue::meaning_geometry, "cluster", i,
                    "morph target " + std::to_string(geometry.morphTarget(morph)) + ": " + what);
    };
    for (uint32_t morph = 0; morph < geometry.morphCount(); ++morph)
    {
        if (geometry.morphTarget(morph) >= mesh.morph_target_count)
            return wrong(morph, "its mesh has not so many");
        if (morph > 0 && geometry.morphTarget(morph) <= geometry.morphTarget(morph - 1))
            return wrong(morph, "targets do not ascend");
        if (!powerOfTwo(geometry.morphStep(morph)))
            return wrong(morph, "its step is not a power of two");
        bool moves = false;
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            moves = moves || geometry.morphWords(morph, v) != std::array<uint32_t, 3>{};
        if (!moves)
            return wrong(morph, "it moves no vertex of the cluster");
    }
    return success();
}

/// The normal cone holds the triangle's normal, and its apex is not in front of the triangle.
Status checkCone(const PackView& view, size_t i, float grid_step, Double3 normal, Double3 corner)
{
    const ClusterRecord& cluster = view.clusters()[i];
    const Double3 axis = widen(coneAxis(cluster));
    const double sine = length(cross(normal, axis)) / length(axis);
    if (!(dot(normal, axis) > 0) || !(sine <= coneCutoff(cluster) + kConeSlack))
        return fail(view, Issue::meaning_bounds, "cluster", i,
                    "a triangle's normal lies outside its normal cone");
    const Box3 box = boxOf(cluster, grid_step);
    const Double3 center = (widen(box.min) + widen(box.max)) * 0.5;
    const double back = coneBack(cluster, grid_step);
    const double reach = length(widen(box.max) - center) + back;
    if (!(dot(normal, center - axis * (back / length(axis)) - corner) <= kApexSlack * reach))
        return fail(view, Issue::meaning_bounds, "cluster", i,
                    "the apex of its normal cone is in front of a triangle");
    return success();
}

Status checkTriangles(const PackView& view, size_t i, float grid_step, const ClusterGeometry& geometry)
{
    bool has_area = false;
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        const std::array<uint32_t, 3> corners = geometry.triangle(t);
        for (const uint32_t corner : corners)
            if (corner >= geometry.vertexCount())
                return fail(view, Issue::meaning_geometry, "cluster", i,
                            "triangle " + std::to_string(t) + " names vertex " + std::to_string(corner) +
                                " of " + std::to_string(geometry.vertexCount()));
        const Double3 a = widen(geometry.position(corners[0]));
        const Double3 b = widen(geometry.position(corners[1]));
        const Double3 c = widen(geometry.position(corners[2]));
        const Double3 normal = cross(b - a, c - a);
        const double area = length(normal);
        if (!(area > 0))
            continue;
        has_area = true;
        if (view.clusters()[i].cone_cutoff != kNoCone)
            HEARTH_TRY(checkCone(view, i, grid_step, {normal.x / area, normal.y / area, normal.z / area}, a));
    }
    if (!has_area)
        return fail(view, Issue::meaning_geometry, "cluster", i, "none of its triangles has an area");
    return success();
}

/// Clusters lie in the page in their order; what is between them, behind them and behind their indices is zero.
Status checkPage(const PackView& view, uint32_t page_index, std::span<const std::byte> page,
                 uint32_t joint_count)
{
    const PageRecord& record = view.pages()[page_index];
    const MeshRecord& mesh = view.meshes()[record.mesh];
    size_t end = 0;
    for (uint32_t i = record.clusters.first; i < record.clusters.first + record.clusters.count; ++i)
    {
        const ClusterRecord& cluster = view.clusters()[i];
        const auto geometry = ClusterGeometry::at(page, cluster, mesh);
        if (!geometry)
            return fail(view, Issue::meaning_range, "cluster", i, "its geometry lies outside its page");
        const size_t first = size_t{cluster.page_word} * 4;
        if (first < end)
            return fail(view, Issue::meaning_order, "cluster", i, "its geometry overlaps that of another");
        if (!allZero(page.subspan(end, first - end)))
            return fail(view, Issue::meaning_padding, "cluster", i, "bytes before its geometry are not 0");
        HEARTH_TRY(checkVertices(view, i, *geometry, joint_count));
        HEARTH_TRY(checkMorphs(view, i, mesh, *geometry));
        HEARTH_TRY(checkTriangles(view, i, mesh.grid_step, *geometry));
        end = first + geometry->bytes().size();
        const size_t indices_end =
            clusterBytes(geometry->layout(), cluster.vertex_count, 0) + size_t{cluster.triangle_count} * 3;
        const size_t words_end =
            clusterBytes(geometry->layout(), cluster.vertex_count, cluster.triangle_count);
        if (!allZero(page.subspan(first + indices_end, words_end - indices_end)))
            return fail(view, Issue::meaning_padding, "cluster", i, "bytes behind its indices are not 0");
    }
    if (!allZero(page.subspan(end)))
        return fail(view, Issue::meaning_padding, "page", page_index, "bytes at its end are not 0");
    return success();
}

/// For each mesh, how many joints its skin has; a part that has no nodes does not say.
std::vector<uint32_t> jointCounts(const PackView& view)
{
    std::vector<uint32_t> counts(view.meshes().size(), ~0u);
    for (const NodeRecord& node : view.nodes())
        if (node.mesh < counts.size() && node.skin < view.skins().size())
            counts[node.mesh] = std::min(counts[node.mesh], view.skins()[node.skin].joints.count);
    return counts;
}

} // namespace

Status checkPageGeometry(const PackView& view)
{
    std::vector<std::byte> buffer(kPageMaxBytes);
    const std::vector<uint32_t> joint_counts = jointCounts(view);
    for (uint32_t i = 0; i < view.pages().size(); ++i)
    {
        const std::span<std::byte> page = std::span(buffer).first(view.pages()[i].size);
        HEARTH_TRY(view.decodePage(i, page));
        HEARTH_TRY(checkPage(view, i, page, joint_counts[view.pages()[i].mesh]));
    }
    return success();
}

} // namespace hearth::formats::check
