// A mesh as a pack and as the cooker's own tables, whose numbers are the same: cuts by the pack, proofs by the tables.
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

    /// Draws the surface once, and where it is made of one mesh alone, without a crack.
    void expectWhole(const std::vector<uint32_t>& cut, bool watertight = true) const;

private:
    clusters::Hierarchy hierarchy_;
    TestScene scene_;
    std::optional<formats::PackView> view_;
    clusters::DecodedHierarchy decoded_;
    cuts::Border border_;
};

/// Cuts that have more than one level have seams: between what is refined and what is not, or stands in for it.
bool mixesLevels(const formats::PackView& view, const std::vector<uint32_t>& cut);

/// Without materials.
mesh::SourceMesh plain(mesh::SourceMesh mesh);

/// A rock with levels made by hand: sets of groups that are replaced together, over several pages.
CookedMesh rockWithAuthoredLevels();

/// The pinned pages, and each other with the given chance if all that it needs is there.
std::vector<uint8_t> randomClosedSet(const pack::PageGraph& graph, double chance, std::mt19937& random);

} // namespace hearth::test
