// Gives the memory of arrays back that are done with before their owner is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <vector>

namespace hearth::mesh
{

/// Empties the vector and frees its memory; clear() and assigning {} keep it.
template <typename T>
void freeMemory(std::vector<T>& values)
{
    std::vector<T>().swap(values);
}

} // namespace hearth::mesh
