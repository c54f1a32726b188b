// Everything that a runtime does with a pack, on any bytes: opens it, and if that succeeds uses all of it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <cstddef>
#include <span>

namespace hearth::test
{

/// `bytes` at an address that is a multiple of 64. Returns the error of opening the pack, if there is one; aborts where
/// a pack that was accepted breaks a promise that code behind the checker relies on.
Status exercisePack(std::span<const std::byte> bytes);

} // namespace hearth::test
