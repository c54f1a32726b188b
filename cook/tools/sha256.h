// SHA-256 of bytes and files: what names contents in keys, caches and lists of what was read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hearth::tools
{

/// 64 lower-case hexadecimal digits.
std::string sha256Of(std::span<const std::byte> bytes);
std::string sha256Of(std::string_view text);

/// Of a regular file's content, read piece by piece; nullopt where it cannot be read.
std::optional<std::string> sha256OfFile(const std::string& path);

/// Whether `text` is written as the functions above write it.
bool isSha256(std::string_view text);

} // namespace hearth::tools
