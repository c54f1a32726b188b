// Encodes formats with blocks of 4 x 4 texels: ETC2, EAC, BC.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/encode.h"

namespace hearth::texels
{

/// Encode texels; on the caller's thread. Blocks do not depend on each other.
/// candidate  of family etc2 or bc
std::vector<std::byte> encodeBlocks(const Candidate& candidate, const StoredTexels& texels, Effort effort);

} // namespace hearth::texels
