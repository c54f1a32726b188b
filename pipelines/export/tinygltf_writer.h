// Writes a glTF document as GLB with tinygltf, whose types and exceptions stay in this unit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/export/gltf_document.h"

namespace hearth::gltf_export
{

/// Write the file atomically. The same document gives the same bytes.
/// errors: cannot_write, also where the file would exceed the 4 GiB that GLB can have, or where a text
/// of the document is not UTF-8
Status writeGlb(const GltfDocument& document, const std::string& path);

} // namespace hearth::gltf_export
