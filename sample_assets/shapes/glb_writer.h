// Writes a Document as one GLB file.
// glTF 2.0 specification, Khronos Group; extensions named where they are used.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "sample_assets/shapes/document.h"

#include <cstddef>

namespace hearth::samples
{

/// The bytes of a GLB file, in two pieces: a scene of gigabytes is not copied together.
struct GlbFile
{
    std::vector<std::byte> head;   ///< header, JSON chunk, header of the binary chunk
    std::vector<std::byte> binary; ///< that chunk's bytes
};

/// The document as a GLB file. Same document, same bytes.
/// Indices of `document` must be in range, and attribute arrays of equal length (asserted).
GlbFile encodeGlb(const Document& document);

/// Write the file under `path`, whole or not at all. errors: cannot_write.
Status writeFile(const std::string& path, const GlbFile& glb);

} // namespace hearth::samples
