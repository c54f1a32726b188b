// Replaces the visibilities of the vertices of a clusters part, page by page. See cook/pages/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/container/container_writer.h"
#include "formats/pack/pack_view.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hearth::pages
{

/// Decoded page of a mesh with visibility.
struct PageVertices
{
    uint32_t page = 0;                                  ///< index in chunk PGTB
    uint32_t mesh = 0;                                  ///< index in chunk MESH
    formats::Range clusters;                            ///< range in chunk CLUS
    std::span<const formats::ClusterGeometry> geometry; ///< geometry of each cluster
};

/// Edit the visibilities of the vertices of a page: codes of formats/codecs/visibility_code.h, one for each
/// vertex of geometry[0], then of geometry[1], and so on. They contain the page's present codes. Called once
/// for each page, in any order, by many threads at once; the result may only depend on the page.
using VisibilityEdit = std::function<void(const PageVertices& page, std::span<uint32_t> codes)>;

/// Chunks that a rewritten part gets in place of its own ones.
struct ReplacedChunks
{
    std::vector<uint32_t> types;                            ///< chunks that are left out
    std::function<Status(formats::ContainerWriter&)> write; ///< writes the new ones, last; may be empty
};

/// Write the part again with visibilities as edited by `edit`. Everything else stays: triangles, vertices and
/// their order, so that records of clusters remain valid, and pages of meshes without visibility to the byte.
/// If nothing is edited, the part is identical to the byte. The same bytes for any number of threads; a few
/// dozen pages are in memory at a time.
///
/// part      a clusters part, whose pages have codec `clusters`
/// errors: those of PackView::read, decodePage and checkHierarchy; chunk_codec for pages of another codec;
/// cannot_write.
Status rewriteVisibility(const formats::ContainerReader& part, const std::string& output_path,
                         const VisibilityEdit& edit, const ReplacedChunks& replaced = {});

} // namespace hearth::pages
