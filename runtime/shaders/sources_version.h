// Version of the shaders' sources: shaders of material functions must have been compiled with the same.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string_view>

namespace hearth::shaders
{

extern const std::string_view kSourcesVersion; ///< hash of the files, by cmake/hash_shader_sources.cmake

} // namespace hearth::shaders
