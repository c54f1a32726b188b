// Writes a Document as one GLB file.
// glTF 2.0 specification, Khronos Group; extensions named where they are used.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"
#include "sample_assets/document.h"

#include <cstddef>

namespace hearth::samples
{

/// The document as the bytes of a GLB file. Same document, same bytes.
/// Indices of `document` must be in range, and attribute arrays of equal length (asserted).
std::vector<std::byte> encodeGlb(const Document& document);

/// Write bytes under `path`, whole or not at all. errors: cannot_write.
Status writeFile(const std::string& path, std::span<const std::byte> bytes);

} // namespace hearth::samples
