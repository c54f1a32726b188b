// The shared libraries that a program is linked with.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::graph
{

/// Paths of all libraries that the loader would map for the executable, those of libraries included; sorted. They are looked
/// for where the loader does: LD_LIBRARY_PATH, the file's RUNPATH, the system's folders (in place of the loader's own list of
/// the same). What is not found is left out; a file that is no 64-bit ELF has none.
/// source   System V gABI, "Dynamic Linking"; ld.so(8)
std::vector<std::string> librariesOf(const std::string& executable);

} // namespace hearth::graph
