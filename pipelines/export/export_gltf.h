// Writes a pack, or one mesh of it, as glTF 2.0 in one GLB file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/scene.h"

#include <string>
#include <vector>

namespace hearth::gltf_export
{

struct ExportSummary
{
    size_t nodes = 0;
    size_t meshes = 0;
    size_t triangles = 0; ///< of all meshes, with their levels and proxies
    size_t materials = 0;
    size_t images = 0;
    size_t skins = 0;
    size_t animations = 0;
    size_t lights = 0;
    size_t cameras = 0;
    std::vector<std::string> omissions; ///< "light probes: 3"
};

/// Write the file. A mesh alone has its materials; one that joints or morph targets deform also has
/// the nodes, skins and clips of the scene, and is drawn once.
/// pack    checked
/// options  a mesh exists; the error is not negative (asserted)
/// errors: those of PackView::decodePage and imageData; cannot_write
Result<ExportSummary> exportGltf(const formats::PackView& pack, const ExportOptions& options,
                                 const std::string& path);

} // namespace hearth::gltf_export
