// Lists the shared libraries that a program is linked with.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::graph
{

/// Return the paths of all libraries that the loader would map for the executable, transitively; sorted. They
/// are searched where the loader searches: LD_LIBRARY_PATH, the file's RUNPATH, the system's folders (in
/// place of the loader's own list of these). Libraries that are not found are left out; a file that is not a
/// 64-bit ELF file has none.
/// source   System V gABI, "Dynamic Linking"; ld.so(8)
std::vector<std::string> findLibraries(const std::string& executable);

} // namespace hearth::graph
