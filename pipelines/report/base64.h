// Base64 encoding, for data URIs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>

namespace hearth::report
{

std::string base64(std::string_view bytes);

} // namespace hearth::report
