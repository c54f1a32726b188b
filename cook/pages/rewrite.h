// Gives the vertices of a clusters part other visibilities, page by page. See README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <functional>
#include <span>
#include <string>

namespace hearth::pages
{

/// A decoded page of a mesh with visibility.
struct PageVertices
{
    uint32_t page = 0;                                  ///< chunk PGTB
    uint32_t mesh = 0;                                  ///< chunk MESH
    formats::Range clusters;                            ///< chunk CLUS
    std::span<const formats::ClusterGeometry> geometry; ///< of each of them
};

/// Says what the vertices of a page see: codes of formats/codecs/visibility_code.h, one for each vertex of geometry[0], then of
/// geometry[1], and so on. They hold those that the page has. Called for each page once, in any order, by many threads at
/// once; what it says may only depend on the page.
using VisibilityEdit = std::function<void(const PageVertices& page, std::span<uint32_t> codes)>;

/// Write the part again, with what `edit` makes of its visibilities. All else stays: triangles, vertices and their order,
/// so that records of clusters hold, and pages of meshes without visibility to the byte. Where nothing is edited, the part is
/// the same to the byte. The same bytes for any number of threads; a few dozen pages are in memory at a time.
///
/// part    a clusters part, whose pages have codec `clusters`
/// errors: those of PackView::read, decodePage and checkHierarchy; chunk_codec for pages of another codec; cannot_write.
Status rewriteVisibility(const formats::ContainerReader& part, const std::string& output_path,
                         const VisibilityEdit& edit);

} // namespace hearth::pages
