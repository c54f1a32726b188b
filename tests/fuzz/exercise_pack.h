// Everything that a runtime does with a pack, on any bytes: opens it, and if that succeeds uses all of it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <span>

namespace hearth::test
{

/// `bytes` at an address that is a multiple of 64. Returns the first error of opening the pack or reading its pages and texels,
/// if there is one; aborts where what was handed out breaks a promise that code behind the checker relies on, or where a
/// read fails that the check of the whole pack knows nothing of.
Status exercisePack(std::span<const std::byte> bytes);

} // namespace hearth::test
