// Checks geometry pages: decodes every page and tests each cluster against the bounds in its record.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"
#include "formats/pack/cone_check.h"

#include <atomic>
#include <mutex>

namespace hearth::formats::check
{

namespace
{

/// True if the weights descend and sum to 1, all joints belong to the skin, and a joint without weight is 0.
bool areLegalInfluences(const ClusterGeometry& geometry, uint32_t vertex, uint32_t joint_count)
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

/// Search for the first wrong vertex of a cluster, and the first rule that it breaks. Rules are tested one
/// after the other over all vertices, because all vertices have the same word layout.
class FirstBadVertex
{
public:
    explicit FirstBadVertex(uint32_t vertex_count) : vertex_(vertex_count) {}

    /// Test a rule on all vertices before the first wrong one. Call in the order of importance.
    /// legal  predicate on a vertex number
    template <typename Legal>
    void test(Issue issue, const char* what, const Legal& legal)
    {
        for (uint32_t v = 0; v < vertex_; ++v)
            if (!legal(v))
            {
                vertex_ = v;
                issue_ = issue;
                what_ = what;
            }
    }

    Status status(const PackView& view, size_t cluster) const
    {
        if (what_ == nullptr)
            return success();
        return makeError(view, issue_, "cluster", cluster,
                         "vertex " + std::to_string(vertex_) + ": " + what_);
    }

private:
    uint32_t vertex_; ///< first wrong vertex so far
    Issue issue_{};
    const char* what_ = nullptr;
};

void testUvs(const ClusterGeometry& geometry, uint32_t set, FirstBadVertex& wrong)
{
    constexpr const char* kWhat = "a UV is not finite, or beyond the grid";
    const auto isOnGrid = [](int32_t coordinate)
    { return coordinate >= -kMaxGridCoordinate && coordinate <= kMaxGridCoordinate; };
    if (uvFractionBits(geometry.layout(), set) == 0)
        wrong.test(Issue::meaning_geometry, kWhat, [&](uint32_t v) { return finite(geometry.uv(v, set)); });
    else
        wrong.test(Issue::meaning_geometry, kWhat,
                   [&](uint32_t v)
                   {
                       const std::array<int32_t, 2> point = geometry.uvPoint(v, set);
                       return isOnGrid(point[0]) && isOnGrid(point[1]);
                   });
}

Status checkVertices(const PackView& view, size_t i, const ClusterGeometry& geometry, uint32_t joint_count)
{
    const ClusterRecord& cluster = view.clusters()[i];
    const uint32_t layout = geometry.layout();
    FirstBadVertex wrong(geometry.vertexCount());
    const std::array<int64_t, 3> most{boxSteps(cluster, 0), boxSteps(cluster, 1), boxSteps(cluster, 2)};
    wrong.test(Issue::meaning_bounds, "it lies outside the cluster's box",
               [&](uint32_t v)
               {
                   const std::array<uint32_t, 3> offset = geometry.gridOffset(v);
                   return offset[0] <= most[0] && offset[1] <= most[1] && offset[2] <= most[2];
               });
    if (!geometry.has(kVertexWideOffsets) && (!geometry.has(kVertexNormal) || geometry.has(kVertexNormal16)))
        wrong.test(Issue::meaning_padding, "the unused half of a word is not 0",
                   [&](uint32_t v) { return geometry.word(v, 1) >> 16 == 0; });
    if (geometry.has(kVertexNormal))
        wrong.test(Issue::meaning_geometry, "its normal has no legal code",
                   [&](uint32_t v) { return isLegalNormal(layout, geometry.normalCode(v)); });
    if (geometry.has(kVertexTangent))
        wrong.test(Issue::meaning_geometry, "its tangent has no legal code",
                   [&, word = attributeWord(layout, kVertexTangent)](uint32_t v)
                   { return isLegalTangent(layout, geometry.word(v, word)); });
    if (geometry.has(kVertexVisibility))
        wrong.test(Issue::meaning_geometry, "its visibility has no legal code",
                   [&, word = attributeWord(layout, kVertexVisibility)](uint32_t v)
                   { return isLegalVisibility(geometry.word(v, word)); });
    for (uint32_t set = 0; set < 4; ++set)
        if (geometry.has(kVertexUv0 << set))
            testUvs(geometry, set, wrong);
    if (geometry.has(kVertexInfluences))
        wrong.test(Issue::meaning_geometry,
                   "its weights do not fall, or sum to 1, or one is that of a joint that its skin has not",
                   [&](uint32_t v) { return areLegalInfluences(geometry, v, joint_count); });
    return wrong.status(view, i);
}

/// Check that targets ascend, that each moves a vertex, and that steps are powers of two.
Status checkMorphs(const PackView& view, size_t i, const MeshRecord& mesh, const ClusterGeometry& geometry)
{
    const auto wrong = [&](uint32_t morph, const char* what)
    {
        return makeError(view, Issue::meaning_geometry, "cluster", i,
                         "morph target " + std::to_string(geometry.morphTarget(morph)) + ": " + what);
    };
    for (uint32_t morph = 0; morph < geometry.morphCount(); ++morph)
    {
        if (geometry.morphTarget(morph) >= mesh.morph_target_count)
            return wrong(morph, "its mesh has not so many");
        if (morph > 0 && geometry.morphTarget(morph) <= geometry.morphTarget(morph - 1))
            return wrong(morph, "targets do not ascend");
        if (!isPowerOfTwo(geometry.morphStep(morph)))
            return wrong(morph, "its step is not a power of two");
        bool moves = false;
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            moves = moves || geometry.morphWords(morph, v) != std::array<uint32_t, 3>{};
        if (!moves)
            return wrong(morph, "it moves no vertex of the cluster");
    }
    return success();
}

Status checkTriangles(const PackView& view, size_t i, float grid_step, const ClusterGeometry& geometry)
{
    const ClusterRecord& cluster = view.clusters()[i];
    const bool has_cone = cluster.cone_cutoff != kNoCone;
    const ConeCheck cone(cluster, grid_step);
    std::array<Double3, kMaxClusterVertices> positions;
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        positions[v] = widen(geometry.position(v));
    bool has_area = false;
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        const std::array<uint32_t, 3> corners = geometry.triangle(t);
        for (const uint32_t corner : corners)
            if (corner >= geometry.vertexCount())
                return makeError(view, Issue::meaning_geometry, "cluster", i,
                                 "triangle " + std::to_string(t) + " names vertex " + std::to_string(corner) +
                                     " of " + std::to_string(geometry.vertexCount()));
        const Double3 a = positions[corners[0]];
        const Double3 normal = cross(positions[corners[1]] - a, positions[corners[2]] - a);
        const double length2 = dot(normal, normal);
        if (!(length2 > 0))
            continue;
        has_area = true;
        if (has_cone && !cone.containsNormal(normal, length2))
            return makeError(view, Issue::meaning_bounds, "cluster", i,
                             "a triangle's normal lies outside its normal cone");
        if (has_cone && !cone.isApexBehind(normal, length2, a))
            return makeError(view, Issue::meaning_bounds, "cluster", i,
                             "the apex of its normal cone is in front of a triangle");
    }
    if (!has_area)
        return makeError(view, Issue::meaning_geometry, "cluster", i, "none of its triangles has an area");
    return success();
}

/// First error of items that are checked in any order. Thread-safe.
class FirstError
{
public:
    /// True if an item before this one is known to be wrong, so this one does not matter.
    bool isBefore(uint32_t item) const { return first_.load(std::memory_order_relaxed) < item; }

    void add(uint32_t item, Error error)
    {
        const std::lock_guard lock(mutex_);
        if (isBefore(item))
            return;
        first_.store(item, std::memory_order_relaxed);
        status_ = std::move(error);
    }

    Status take() { return std::move(status_); }

private:
    std::atomic<uint32_t> first_ = kInvalidIndex;
    std::mutex mutex_;
    Status status_ = success();
};

} // namespace

std::vector<uint32_t> jointCounts(const PackView& view)
{
    std::vector<uint32_t> counts(view.meshes().size(), ~0u);
    for (const NodeRecord& node : view.nodes())
        if (node.mesh < counts.size() && node.skin < view.skins().size())
            counts[node.mesh] = std::min(counts[node.mesh], view.skins()[node.skin].joints.count);
    return counts;
}

/// Check a page. Clusters are stored in order; the gaps between them, the end of the page and the padding
/// after indices are zero.
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
            return makeError(view, Issue::meaning_range, "cluster", i, "its geometry lies outside its page");
        const size_t first = size_t{cluster.page_word} * 4;
        if (first < end)
            return makeError(view, Issue::meaning_order, "cluster", i,
                             "its geometry overlaps that of another");
        if (!allZero(page.subspan(end, first - end)))
            return makeError(view, Issue::meaning_padding, "cluster", i,
                             "bytes before its geometry are not 0");
        HEARTH_TRY(checkVertices(view, i, *geometry, joint_count));
        HEARTH_TRY(checkMorphs(view, i, mesh, *geometry));
        HEARTH_TRY(checkTriangles(view, i, mesh.grid_step, *geometry));
        end = first + geometry->bytes().size();
        const size_t indices_end =
            clusterBytes(geometry->layout(), cluster.vertex_count, 0) + size_t{cluster.triangle_count} * 3;
        const size_t words_end =
            clusterBytes(geometry->layout(), cluster.vertex_count, cluster.triangle_count);
        if (!allZero(page.subspan(first + indices_end, words_end - indices_end)))
            return makeError(view, Issue::meaning_padding, "cluster", i,
                             "bytes behind its indices are not 0");
    }
    if (!allZero(page.subspan(end)))
        return makeError(view, Issue::meaning_padding, "page", page_index, "bytes at its end are not 0");
    return success();
}

Status checkPageGeometry(const PackView& view, const PageLoop& loop)
{
    PackView checked = view;
    checked.enablePageChecks();
    FirstError error;
    loop(static_cast<uint32_t>(view.pages().size()),
         [&](uint32_t page)
         {
             if (error.isBefore(page))
                 return;
             Status status = checked.checkPage(page);
             if (!status.ok())
                 error.add(page, std::move(status).error());
         });
    return error.take();
}

} // namespace hearth::formats::check
