// Specializes SPIR-V modules before a driver gets them. Shading is a few large modules with many
// specialization constants, and a pipeline needs a small part of one: drivers that get the part alone
// create pipelines in a fraction of the time, and so do validation layers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hearth::gpu
{

/// Return a module that computes the same as `spirv` with these values of its specialization constants.
/// It has none, nor code that they make unreachable or that nothing uses. Constants that control
/// branches are propagated through 32-bit integers and booleans (M. Wegman, F. K. Zadeck, "Constant
/// propagation with conditional branches", 1991); arithmetic of floats stays as it is, to the bit.
/// spirv      a valid module, of one target environment with the result
/// constants  value of specialization constant i; constants without a value have their default
/// Returns nothing if a constant depends on the others by an instruction that this does not know.
std::optional<std::vector<uint32_t>> specializeShader(std::span<const uint32_t> spirv,
                                                      std::span<const uint32_t> constants);

/// Return the module with all descriptors in set 0, for pipelines of which all sets are joined to one.
std::vector<uint32_t> moveToOneSet(std::span<const uint32_t> spirv);

} // namespace hearth::gpu
