// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/proxy_surfaces.h"

#include "cook/mesh/closest_point.h"
#include "cook/mesh/edge_split.h"
#include "formats/pack/proxy_sections.h"

#include <algorithm>
#include <limits>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Maximum distance between a mesh and a proxy that it is fitted on, both ways, over the diagonal of the
// mesh's box.
constexpr float kMaxDistance = 0.05f;

// Minimum cosine between a triangle of a proxy and the triangle of the mesh that gives it normals, where
// there is such a triangle: 45 degrees, so that a triangle beside a hard edge has no normals from beyond it.
constexpr double kMinCosine = 0.7;

// Place at which a corner asks for its normal, on the way to the middle of its triangle: beside a hard edge,
// and not on it.
constexpr float kInset = 0.01f;

// Edges longer than this share of the diagonal are split, since a proxy has large triangles on flat walls,
// where visibility changes all the same ...
constexpr float kMaxEdge = 1.0f / 64;

// ... as long as the mesh has this many triangles for each: at most a fifth of its vertices.
constexpr size_t kTrianglesPerSplit = 6;

// Triangles that are looked up in sequence; each search starts at the triangle that the previous one found.
constexpr size_t kTrianglesPerTask = 128;

/// Choose the coarsest level of a mesh with at least as many triangles as its proxy: a finer one has normals
/// of details that the proxy does not have.
uint32_t chooseLevel(const PackView& part, uint32_t mesh, size_t triangles)
{
    const std::vector<uint64_t> counts = countLevelTriangles(part, mesh);
    uint32_t level = 0;
    while (level + 1 < counts.size() && counts[level + 1] >= triangles)
        ++level;
    return level;
}

/// Split the edges of a proxy that are longer than a length, or longer ones alone, so that it has at most so
/// many triangles; none if it has more already.
mesh::SplitSurface splitProxy(std::span<const Float3> positions, std::span<const uint32_t> indices,
                              float length, size_t max_triangles)
{
    constexpr float kStep = 1.25f;
    constexpr int kSteps = 16; // more, and the proxy is of another size than the mesh
    for (int step = 0; step < kSteps && indices.size() / 3 < max_triangles; ++step, length *= kStep)
        if (auto split = mesh::splitLongEdges(positions, indices, length, max_triangles))
            return *std::move(split);
    return mesh::splitLongEdges(positions, indices, std::numeric_limits<float>::max(), indices.size() / 3)
        .value();
}

/// A level of a mesh, to be asked what is near a point.
class NearbySurface
{
public:
    NearbySurface(const LevelArrays& level, const SourceNormals& normals)
        : level_(level), closest_({level.positions, {}, level.indices}, level.indices.size() / 3)
    {
        normals_.resize(level.positions.size());
        tbb::parallel_for(size_t{0}, normals_.size(),
                          [&](size_t v)
                          { normals_[v] = normals.find(level.positions[v], level.normals[v]); });
    }

    /// Find the closest point that faces a way, or at least its side, or else any.
    /// hint  as of ClosestPoint::find
    mesh::ClosestPoint::Hit find(Float3 point, Float3 facing, uint32_t hint) const
    {
        return closest_.findAnywhere(point, facing, hint, kMinCosine);
    }

    /// Return the normal at a point that was found, `facing` if it is on the other side.
    Float3 normal(const mesh::ClosestPoint::Hit& found, Float3 facing) const
    {
        if (found.triangle == kInvalidIndex)
            return facing;
        const uint32_t* corners = &level_.indices[size_t{found.triangle} * 3];
        const Float3 sum = normals_[corners[0]] * (1 - found.u - found.v) + normals_[corners[1]] * found.u +
                           normals_[corners[2]] * found.v;
        const Float3 normal = normalizeOr(sum, facing);
        return dot(normal, facing) > 0 ? normal : facing;
    }

private:
    const LevelArrays& level_;
    std::vector<Float3> normals_; ///< of the level's vertices, as the source has them
    mesh::ClosestPoint closest_;
};

} // namespace

std::string_view proxyUseName(ProxyUse use)
{
    switch (use)
    {
    case ProxyUse::none:
        return "none";
    case ProxyUse::fit:
        return "fit";
    case ProxyUse::all:
        break;
    }
    return "all";
}

const ProxyRecord* findFitProxy(const PackView& proxies, const MeshRecord& mesh, uint32_t number)
{
    const float max_distance = kMaxDistance * length(mesh.box_max - mesh.box_min);
    if (!(max_distance > 0))
        return nullptr;
    for (const ProxyRecord& proxy :
         std::ranges::equal_range(proxies.proxies(), number, {}, &ProxyRecord::mesh))
        if (proxy.indices.count > 0 && proxy.distance <= max_distance &&
            proxy.mesh_distance <= max_distance && !hasConvexParts(proxies, proxy))
            return &proxy;
    return nullptr;
}

Result<ProxySurface> makeProxySurface(SceneSurfaces& surfaces, const PackView& proxies,
                                      const ProxyRecord& proxy, const PackView& part,
                                      const SourceNormals& normals)
{
    const MeshRecord& mesh = part.meshes()[proxy.mesh];
    const float diagonal = length(mesh.box_max - mesh.box_min);
    const std::span<const Float3> corners_of_proxy =
        recordsInRange(proxies.proxyPositions(), proxy.positions);
    const std::span<const uint32_t> triangles_of_proxy =
        recordsInRange(proxies.proxyIndices(), proxy.indices);
    const mesh::SplitSurface split = splitProxy(corners_of_proxy, triangles_of_proxy, kMaxEdge * diagonal,
                                                mesh.source_triangles / kTrianglesPerSplit);
    const std::span<const Float3> positions = split.positions;
    const std::span<const uint32_t> indices = split.indices;
    const uint32_t number = chooseLevel(part, proxy.mesh, indices.size() / 3);
    HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::readLevel(part, proxy.mesh, number));
    const LevelArrays level = extractLevel(pages, number);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<uint32_t> level_colors, surfaces.colors.find(pages, level));
    const NearbySurface nearby(level, normals);

    ProxySurface surface;
    LevelArrays& arrays = surface.arrays;
    arrays.reach = std::max(kMaxDistance * diagonal, 2 * proxy.distance);
    arrays.indices.resize(indices.size());
    arrays.positions.resize(indices.size());
    arrays.normals.resize(indices.size());
    std::vector<uint32_t> near_middle(indices.size() / 3);
    const auto fill = [&](size_t triangle, uint32_t& hint)
    {
        Float3 corners[3];
        for (size_t k = 0; k < 3; ++k)
            corners[k] = positions[indices[triangle * 3 + k]];
        const Float3 facing = normalizeOr(cross(corners[1] - corners[0], corners[2] - corners[0]), {0, 0, 1});
        const Float3 middle = (corners[0] + corners[1] + corners[2]) / 3;
        for (size_t k = 0; k < 3; ++k)
        {
            const auto found = nearby.find(corners[k] + (middle - corners[k]) * kInset, facing, hint);
            const size_t corner = triangle * 3 + k;
            arrays.indices[corner] = static_cast<uint32_t>(corner);
            arrays.positions[corner] = corners[k];
            arrays.normals[corner] = nearby.normal(found, facing);
        }
        hint = nearby.find(middle, facing, hint).triangle;
        near_middle[triangle] = hint;
    };
    tbb::parallel_for(size_t{0}, (near_middle.size() + kTrianglesPerTask - 1) / kTrianglesPerTask,
                      [&](size_t block)
                      {
                          uint32_t hint = kInvalidIndex;
                          const size_t end = std::min(near_middle.size(), (block + 1) * kTrianglesPerTask);
                          for (size_t t = block * kTrianglesPerTask; t < end; ++t)
                              fill(t, hint);
                      });
    for (size_t t = 0; t < near_middle.size(); ++t)
    {
        const uint32_t nearest = near_middle[t];
        arrays.triangle_materials.push_back(level.triangle_materials[nearest]);
        if (!surfaces.masks.occludes(level.triangle_materials[nearest]))
            continue;
        for (size_t k = 0; k < 3; ++k)
            surface.occluding_corners.push_back(static_cast<uint32_t>(t * 3 + k));
        surface.colors.push_back(level_colors[nearest]);
    }
    return surface;
}

void addProxy(Occluders& occluders, const ProxySurface& surface, std::span<const Affine3> world_from_mesh)
{
    if (surface.occluding_corners.empty())
        return;
    const Occluders::Mesh added = occluders.add({.positions = surface.arrays.positions,
                                                 .corners = surface.occluding_corners,
                                                 .colors = surface.colors});
    for (const Affine3& transform : world_from_mesh)
        occluders.place(added, transform);
}

} // namespace hearth::visibility
