// URIs of glTF: relative paths, percent-encoded, and data URIs.
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

/// The bytes of "data:[type][;parameters];base64,...": strict base64 with its padding.
/// Nothing where it is not that.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

/// Every "%41" replaced by its byte, once; nothing where a '%' is not followed by two hexadecimal digits.
std::optional<std::string> percentDecoded(std::string_view uri);

} // namespace hearth::import
