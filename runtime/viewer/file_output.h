// Atomic file output, and PNG and JPEG encoding.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::viewer
{

/// Write to a temporary file beside `path` and rename it into place. errors: cannot_write.
Status writeFile(const std::string& path, std::span<const std::byte> bytes);

/// Encode `rgba` as a PNG file in memory. errors: internal.
Result<std::vector<std::byte>> encodePng(std::span<const std::byte> rgba, uint32_t width, uint32_t height);

/// Encode `rgba` as a JPEG file, at a quality that keeps the colours of single pixels apart. errors:
/// internal.
Result<std::vector<std::byte>> encodeJpeg(std::span<const std::byte> rgba, uint32_t width, uint32_t height);

} // namespace hearth::viewer
