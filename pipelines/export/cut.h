// Reads a cut of a mesh's hierarchy: the clusters that are drawn at an error, and their geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <vector>

namespace hearth::gltf_export
{

/// Return the clusters that are drawn at object-space error `error`, as indices into the table of
/// clusters. The rule is documented at GroupRecord. The clusters cover the mesh once.
std::vector<uint32_t> findCutClusters(const formats::PackView& pack, const formats::MeshRecord& mesh,
                                      float error);

/// Cache of one decoded page. Clusters of a page follow each other, so one page is enough.
class PageCache
{
public:
    explicit PageCache(const formats::PackView& pack) : pack_(pack) {}

    /// Return the geometry of a cluster, valid until the next call.
    /// errors: those of PackView::decodePage; meaning_geometry
    Result<formats::ClusterGeometry> clusterGeometry(const formats::ClusterRecord& cluster,
                                                     const formats::MeshRecord& mesh);

private:
    const formats::PackView& pack_;
    uint32_t page_ = kInvalidIndex;
    std::vector<std::byte> bytes_;
};

} // namespace hearth::gltf_export
