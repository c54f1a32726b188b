// What tells one build of a cooker from another.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/file_hashes.h"

#include <string>

namespace hearth::graph
{

/// SHA-256 over the executable and the shared libraries that it is linked with: nobody can forget to raise a number, and
/// an update of zstd or Embree counts as a change of what uses it. The price is that cooks by different builds of the same
/// sources share nothing.
///
/// returns empty where there is no such executable
std::string cookerVersion(const std::string& executable, FileHashes& hashes);

/// The class of this processor, as far as the bytes of ray-traced parts depend on it: Embree takes the widest of these.
const char* processorClass();

} // namespace hearth::graph
