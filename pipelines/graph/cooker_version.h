// Version of a cooker's build, for cache keys.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/file_hashes.h"

#include <string>

namespace hearth::graph
{

/// Hash the executable and the shared libraries that it is linked with (SHA-256). Unlike a version number,
/// nobody can forget to raise it, and an update of zstd or Embree counts as a change of the cookers that use
/// it. The program that hearth-import starts is hashed, too. The price is that cooks by different builds of
/// the same sources share nothing.
///
/// returns  empty where there is no such executable
std::string cookerVersion(const std::string& executable, FileHashes& hashes);

/// Return the class of this processor, as far as the bytes of ray-traced parts depend on it: Embree uses the
/// widest of these vector extensions.
const char* processorClass();

} // namespace hearth::graph
