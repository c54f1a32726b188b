// Encodes ASTC with libastcenc.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/encode.h"

namespace hearth::texels
{

/// Encode texels; on the caller's thread. Blocks do not depend on each other.
/// candidate  of family astc or astc_hdr
std::vector<std::byte> encodeAstc(const Candidate& candidate, const StoredTexels& texels, Effort effort);

} // namespace hearth::texels
