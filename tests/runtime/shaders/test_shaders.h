// Compiled shaders of the tests, each named after its file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>

namespace hearth::shaders
{

extern const std::span<const uint32_t> branches_comp;
extern const std::span<const uint32_t> brick_march_comp;
extern const std::span<const uint32_t> fetch_texels_comp;
extern const std::span<const uint32_t> forward_vert;
extern const std::span<const uint32_t> forward_frag;
extern const std::span<const uint32_t> uv_derivatives_frag;

} // namespace hearth::shaders
