// Runs loops on all cores. Each index writes only its own result, so the outcome does not depend on threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <functional>

namespace hearth::samples
{

/// Call body(i) for every i in [0, count), in any order and on any thread; return when all have ended.
void parallelFor(size_t count, const std::function<void(size_t)>& body);

} // namespace hearth::samples
