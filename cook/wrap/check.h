// Checks what a wrap promises, in the floats that are stored.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/wrap/source_tree.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::wrap
{

/// Broken promise of a wrap.
struct Fault
{
    std::string text;                ///< "" if it holds all
    std::vector<uint32_t> triangles; ///< some that break it; none if it is no matter of single triangles
};

/// Find a promise that a wrap breaks: it is watertight, each of its triangles has an area, it does not
/// intersect itself, touches no triangle of the source, and has all vertices of the source inside.
Fault findFault(const Surface& wrap, const SourceTree& source);

} // namespace hearth::wrap
