// Exercises a pack of arbitrary bytes like a runtime: opens it, and if that succeeds uses all of it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <span>

namespace hearth::test
{

/// Exercise `bytes`, whose address is a multiple of 64. Returns the first error of opening the pack or of
/// reading its pages and texels, if any. Aborts if data that was handed out breaks a guarantee that code
/// behind the checker relies on, or if a read fails although the check of the whole pack succeeded.
Status exercisePack(std::span<const std::byte> bytes);

} // namespace hearth::test
