// List of all shaders of the renderer, with the names that the embedded modules lack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>

namespace hearth::test
{

struct ListedShader
{
    const char* name;                ///< of its variable in shaders.h
    std::span<const uint32_t> words; ///< as embedded
    const char* named_file;          ///< the same module with the names of the source, SPIR-V
};

std::span<const ListedShader> listedShaders();

} // namespace hearth::test
