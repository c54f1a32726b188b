// A mesh both as a pack and as the cooker's own tables, with the same indices: cuts are made by the pack and
// verified by the tables.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/page_graph.h"
#include "tests/support/cuts.h"
#include "tests/support/test_scene.h"

#include <optional>
#include <random>
#include <span>
#include <vector>

namespace hearth::test
{

class CookedMesh
{
public:
    explicit CookedMesh(const mesh::SourceMesh& source, std::span<const mesh::SourceMesh> authored = {});

    const formats::PackView& view() const { return *view_; }

    /// Expect that the cut draws the surface once and, if it consists of one mesh alone, without a crack.
    void expectWhole(const std::vector<uint32_t>& cut, bool watertight = true) const;

private:
    clusters::Hierarchy hierarchy_;
    TestScene scene_;
    std::optional<formats::PackView> view_;
    clusters::DecodedHierarchy decoded_;
    Boundary boundary_;
};

/// True if a cut has more than one level and so seams: between refined and unrefined parts, or their
/// replacements.
bool mixesLevels(const formats::PackView& view, const std::vector<uint32_t>& cut);

/// Return the mesh without materials.
mesh::SourceMesh plain(mesh::SourceMesh mesh);

/// A rock with authored LODs: sets of groups that are replaced together, over several pages.
CookedMesh rockWithAuthoredLevels();

/// The pinned pages, and each other page with the given chance if all pages that it needs are there.
std::vector<uint8_t> randomClosedSet(const pack::PageGraph& graph, double chance, std::mt19937& random);

} // namespace hearth::test
