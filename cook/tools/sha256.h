// SHA-256 of bytes and files: identifies contents in keys, caches and lists of files read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hearth::tools
{

/// Return the SHA-256 as 64 lower-case hexadecimal digits.
std::string computeSha256(std::span<const std::byte> bytes);
std::string computeSha256(std::string_view text);

/// Hash the content of a regular file, read piece by piece; nullopt if it cannot be read.
std::optional<std::string> computeFileSha256(const std::string& path);

/// True if `text` has the form that the functions above return.
bool isSha256(std::string_view text);

} // namespace hearth::tools
