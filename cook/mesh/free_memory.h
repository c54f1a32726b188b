// Frees the memory of arrays before their owner ends.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <vector>

namespace hearth::mesh
{

/// Empty the vector and free its memory; clear() and assigning {} keep it.
template <typename T>
void freeMemory(std::vector<T>& values)
{
    std::vector<T>().swap(values);
}

} // namespace hearth::mesh
