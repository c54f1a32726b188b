// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/cooked_mesh.h"

#include "tests/reference/culling/cut_checker.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hearth::test
{

CookedMesh::CookedMesh(const mesh::SourceMesh& source, std::span<const mesh::SourceMesh> authored)
    : hierarchy_(clusters::buildHierarchy(source, authored, {}))
{
    scene_.addHierarchy(hierarchy_);
    view_ = scene_.build();
    auto decoded = clusters::decodeHierarchy(hierarchy_);
    HEARTH_ASSERT(decoded.ok());
    decoded_ = std::move(*decoded);
    boundary_ = cuts::findSourceBoundary(hierarchy_, decoded_);
}

void CookedMesh::expectWhole(const std::vector<uint32_t>& cut, bool watertight) const
{
    const reference::CoverageReport coverage = reference::checkCoverage(view(), 0, cut);
    EXPECT_EQ(coverage.missing, 0u);
    EXPECT_EQ(coverage.overlapping, 0u);
    std::vector<uint32_t> triangles;
    for (const uint32_t cluster : cut)
        triangles.insert(triangles.end(), decoded_.clusters[cluster].positions.begin(),
                         decoded_.clusters[cluster].positions.end());
    if (watertight)
    {
        EXPECT_EQ(findCrack(boundary_, findBoundary(triangles)), "");
    }
}

bool mixesLevels(const formats::PackView& view, const std::vector<uint32_t>& cut)
{
    const auto getLevel = [&](uint32_t cluster) { return view.clusters()[cluster].level; };
    return std::any_of(cut.begin(), cut.end(),
                       [&](uint32_t cluster) { return getLevel(cluster) != getLevel(cut.front()); });
}

mesh::SourceMesh plain(mesh::SourceMesh mesh)
{
    return withMaterial(std::move(mesh), kInvalidIndex);
}

CookedMesh rockWithAuthoredLevels()
{
    const std::vector<mesh::SourceMesh> levels{plain(shapes::rock(36, 0.3f)), plain(shapes::rock(20, 0.28f)),
                                               plain(shapes::rock(4, 0.2f))};
    return CookedMesh(plain(shapes::rock(60, 0.3f)), levels);
}

std::vector<uint8_t> randomClosedSet(const pack::PageGraph& graph, double chance, std::mt19937& random)
{
    std::vector<uint8_t> resident(graph.pageCount(), 0);
    for (const uint32_t page : graph.pinned())
        resident[page] = 1;
    for (uint32_t page = 0; page < graph.pageCount(); ++page)
    {
        bool possible = static_cast<double>(random()) < chance * 4294967296.0;
        for (const uint32_t needed : graph.needs(page))
            possible &= resident[needed] != 0;
        resident[page] |= possible ? 1 : 0;
    }
    return resident;
}

} // namespace hearth::test
