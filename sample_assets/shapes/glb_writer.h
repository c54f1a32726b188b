// Writes a Document as one GLB file. glTF 2.0 specification, Khronos Group; extensions are named at their
// use.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "sample_assets/shapes/document.h"

#include <cstddef>

namespace hearth::samples
{

/// GLB file in two parts, because concatenation would copy a scene of gigabytes.
struct GlbFile
{
    std::vector<std::byte> head;   ///< header, JSON chunk, header of the binary chunk
    std::vector<std::byte> binary; ///< its content
};

/// Encode the document as a GLB file. Deterministic: the same document gives the same bytes. Indices of
/// `document` must be in range, and attribute arrays of equal length (asserted).
GlbFile encodeGlb(const Document& document);

/// Write the file to `path` atomically. errors: cannot_write.
Status writeFile(const std::string& path, const GlbFile& glb);

} // namespace hearth::samples
