// Decodes URIs of glTF: relative paths, percent-encoded, and data URIs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

bool isDataUri(std::string_view uri);

/// Return the bytes of "data:[type][;parameters];base64,...": strict base64 with its padding; nullopt for
/// anything else.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

/// Replace every "%41" by its byte, once; nullopt if a '%' is not followed by two hexadecimal digits.
std::optional<std::string> decodePercent(std::string_view uri);

} // namespace hearth::import
